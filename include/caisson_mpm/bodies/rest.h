// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Whether a body that its loads move has come to rest.
#ifndef caisson_mpm_bodies_rest_h
#define caisson_mpm_bodies_rest_h

#include <caisson_mpm/base/run_totals.h>

#include <cmath>
#include <optional>
#include <string>

namespace CaissonMPM
{
  /** A mean over the last moments: the present counts most, and what is older
   * than a few time constants nothing. Not collective. */
  class RecentMean
  {
  public:
    /** The mean at the start is @p value. */
    explicit RecentMean(const double value = 0.)
      : mean(value)
    {}

    /** Add the @p value of a step. Units of both times: s. */
    void
    add(const double dt, const double time_constant, const double value)
    {
      mean -= std::expm1(-dt / time_constant) * (value - mean);
    }

    double
    value() const
    {
      return mean;
    }

    void
    register_totals(RunTotals &totals, const std::string &name)
    {
      totals.carry(name, mean);
    }

  private:
    double mean;
  };

  /**
   * Finds out where the body rests first: its mean speed over a fifth of a
   * second is small, and the soil bears its load within 1 %. One of the two
   * alone does not suffice: a body may be slow for a moment, or balanced while
   * it still moves, and at the start it is slow. Not collective.
   */
  class RestDetector
  {
  public:
    /** What moves the body, and how it moves. Units: N, m/s, m. */
    struct State
    {
      double load, resistance, speed, travel;
    };

    /** Look at one more step; the body is slow if its speed is below @p slow.
     * Units: s, m/s. */
    void
    look(const double dt, const State &now, const double slow)
    {
      constexpr double earliest = .5, duration = .2, share = .01; // s, s, none
      time += dt;
      mean_speed.add(dt, duration, std::abs(now.speed));
      if (!rests && time > earliest && mean_speed.value() < slow &&
          std::abs(now.load - now.resistance) < share * std::abs(now.load))
        {
          rests         = true;
          rested_travel = now.travel;
        }
    }

    /** Return the travel at which it rested first. Units: m. */
    std::optional<double>
    travel() const
    {
      return rests ? std::optional<double>(rested_travel) :
                     std::optional<double>();
    }

    void
    register_totals(RunTotals &totals)
    {
      mean_speed.register_totals(totals, "rest_mean_speed");
      totals.carry("rest_time", time);
      totals.carry("rests", rests);
      totals.carry("rested_travel", rested_travel);
    }

  private:
    RecentMean mean_speed;         // m/s
    double     time          = 0.; // since the start, s
    bool       rests         = false;
    double     rested_travel = 0.; // m
  };
} // namespace CaissonMPM

#endif
