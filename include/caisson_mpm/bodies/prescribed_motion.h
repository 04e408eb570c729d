// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A motion that is prescribed as a velocity over time.
#ifndef caisson_mpm_bodies_prescribed_motion_h
#define caisson_mpm_bodies_prescribed_motion_h

#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/time_table.h>
#include <caisson_mpm/bodies/body_motion.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  /** The velocity is piecewise linear in time; the travel is its exact
   * integral. Any force is ignored. Where the motion is slowed down, the times
   * of the table grow by the factor by which its velocities fall, so that the
   * body passes the same places. */
  class PrescribedMotion : public BodyMotion
  {
  public:
    PrescribedMotion()
      : BodyMotion("prescribed", "the velocity is a given function of time")
    {
      add_parameter(
        "Velocity",
        constant_velocity,
        "m/s",
        "The velocity of the body, positive downward and, of a cylinder's "
        "radius, outward; Velocity table replaces it.",
        dealii::Patterns::Double());
      add_parameter(
        "Ramp time",
        ramp_time,
        "s",
        "The time in which the velocity changes linearly to Velocity: from 0, "
        "or after an installation from the velocity at its end.",
        dealii::Patterns::Double(0.));
      add_parameter(
        "Velocity table",
        table_text,
        "s : m/s",
        "Pairs time : velocity, separated by commas, give a velocity that is "
        "linear in between and constant beyond; they replace Velocity and Ramp "
        "time.",
        dealii::Patterns::List(
          dealii::Patterns::List(dealii::Patterns::Double(), 2, 2, ":"),
          0,
          10000));
      add_word_or_number(
        *this,
        "Largest Mach number",
        mach_number,
        "unlimited",
        0.,
        "",
        "In drained soil, the whole motion is slowed down until the velocity "
        "of the body is at most this share of that of compression waves, which "
        "Time/Mass scaling makes slow. Other times of the scene stay as they "
        "are.",
        dealii::Patterns::Double(1e-6));
      parse_parameters_call_back.connect([this]() { fill_table(); });
    }

    /** Return the velocity of the entries, before it is slowed down. */
    double
    usual_velocity() const override
    {
      double largest = 0.;
      for (const auto &row : velocity_table)
        largest = std::max(largest, std::abs(row.second));
      return slowness * largest;
    }

    std::optional<double>
    largest_mach_number() const override
    {
      return mach_number;
    }

    void
    slow_down(const double factor) override
    {
      slowness *= factor;
      for (auto &[time, velocity] : velocity_table)
        {
          time *= factor;
          velocity /= factor;
        }
    }

    void
    check_parameters() const override
    {
      check_time_table(velocity_table, "Rigid body/Velocity table");
    }

    void
    name_unused_entries(ParameterOrigins &origins) const override
    {
      if (!table_text.empty())
        origins.add_unused({"Rigid body/Velocity", "Rigid body/Ramp time"},
                           "Rigid body/Velocity table replaces them");
    }

    void
    begin_at(const InitialMotion &start) override
    {
      BodyMotion::begin_at(start);
      fill_table();
    }

    void
    start() override
    {
      BodyMotion::start();
      velocity_ = velocity_at(0.);
    }

    std::optional<double>
    time_of_travel(const double d) const override
    {
      constexpr double never = std::numeric_limits<double>::infinity();
      if (d == beginning().travel)
        return 0.;
      const double end  = std::max(velocity_table.back().first, 0.);
      double       from = 0.;
      for (const double to : turning_times(end))
        {
          // monotone from one of these times to the next
          const double sign = travel_at(to) > travel_at(from) ? 1. : -1.;
          if (sign * (d - travel_at(from)) >= 0. &&
              sign * (travel_at(to) - d) >= 0.)
            {
              double low = from, high = to;
              for (unsigned int i = 0; i < 200 && low < high; ++i)
                {
                  const double middle = .5 * (low + high);
                  (sign * (travel_at(middle) - d) < 0. ? low : high) = middle;
                }
              return high;
            }
          from = to;
        }
      const double left = d - travel_at(end), v = velocity_table.back().second;
      return left * v > 0. ? end + left / v : never;
    }

    std::optional<std::pair<double, double>>
    travel_range(const double t) const override
    {
      std::pair<double, double> range(beginning().travel, beginning().travel);
      for (const double turn : turning_times(t))
        {
          range.first  = std::min(range.first, travel_at(turn));
          range.second = std::max(range.second, travel_at(turn));
        }
      return range;
    }

    /** Return the velocity at any time. Units: m/s. */
    double
    velocity_at(const double t) const
    {
      return value_at(velocity_table, t);
    }

    /** Return the travel at any time, with that at the beginning. Units: m. */
    double
    travel_at(const double t) const
    {
      // exact: the velocity is linear between the times of the table
      double distance = beginning().travel, from = 0.;
      for (const auto &entry : velocity_table)
        if (entry.first > from && entry.first < t)
          {
            distance += .5 * (velocity_at(from) + velocity_at(entry.first)) *
                        (entry.first - from);
            from = entry.first;
          }
      return distance + .5 * (velocity_at(from) + velocity_at(t)) * (t - from);
    }

  protected:
    void
    move(const double dt, const double /*force*/) override
    {
      travel_   = travel_at(time_ + dt);
      velocity_ = velocity_at(time_ + dt);
    }

  private:
    void
    fill_table()
    {
      velocity_table = parse_time_table(table_text);
      if (velocity_table.empty() && ramp_time > 0.)
        velocity_table = {{0., beginning().velocity},
                          {ramp_time, constant_velocity}};
      else if (velocity_table.empty())
        velocity_table = {{0., constant_velocity}};
      slowness = 1.;
    }

    /** The times up to @p end between which the travel is monotone. */
    std::vector<double>
    turning_times(const double end) const
    {
      std::vector<double> times;
      for (unsigned int i = 0; i < velocity_table.size(); ++i)
        {
          const auto &b = velocity_table[i];
          if (i > 0)
            {
              const auto &a = velocity_table[i - 1];
              if (a.second * b.second < 0.)
                times.push_back(a.first + (b.first - a.first) * a.second /
                                            (a.second - b.second));
            }
          times.push_back(b.first);
        }
      times.push_back(end);
      times.erase(std::remove_if(times.begin(),
                                 times.end(),
                                 [end](const double t) {
                                   return t <= 0. || t > end;
                                 }),
                  times.end());
      std::sort(times.begin(), times.end());
      return times;
    }

    double                constant_velocity = 0.1;
    double                ramp_time         = 0.;
    std::string           table_text;
    std::optional<double> mach_number;
    double                slowness = 1.; // by which the table is slowed down

    /** (t, v), linear in between, constant at both ends. */
    std::vector<std::pair<double, double>> velocity_table = {{0., 0.1}};
  };
} // namespace CaissonMPM

#endif
