// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/shown_unit.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/output/largest_pull.h>
#include <caisson_mpm/output/result_lines.h>
#include <caisson_mpm/output/run_results.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace CaissonMPM
{
  namespace
  {
    /** Return the spacing of the depths, so that there are at most ten. */
    double
    spacing_for(const double range)
    {
      constexpr double most = 10.;
      for (const double step : {.1, .2, .5, 1., 2., 5., 10., 20., 50.})
        if (range <= most * step)
          return step;
      return range;
    }

    /** Forces at depths, of the records after the first: each is the mean
     * since the record before, and so belongs to the middle between them. */
    struct Curves
    {
      std::vector<double>                depth;
      std::array<std::vector<double>, 4> force; // tip, inner, outer, total
      std::vector<double> with_water; // empty where water bears nothing
      std::vector<double> suction;    // that is required; empty without a lid
      std::vector<double> margin;     // to piping: 1 less the gradient's share

      explicit Curves(const Records &records)
      {
        const auto at = records.series("penetration_m").value;
        for (std::size_t i = 1; i < at.size(); ++i)
          depth.push_back(.5 * (at[i - 1] + at[i]));
        const char *const names[] = {"tip_force_N",
                                     "inner_friction_N",
                                     "outer_friction_N",
                                     "total_force_N"};
        for (unsigned int k = 0; k < force.size(); ++k)
          {
            const auto values = records.series(names[k]).value;
            force[k].assign(values.begin() + 1, values.end());
          }
        if (depth.empty())
          return;
        add_water(records);
        add_suction(records);
        depth.push_back(at.back()); // the last record holds up to the end
        for (auto &values : force)
          values.push_back(values.back());
      }

    private:
      static bool
      has(const Records &records, const std::string &name)
      {
        const auto names = records.names();
        return std::find(names.begin(), names.end(), name) != names.end();
      }

      void
      add_water(const Records &records)
      {
        if (!has(records, "total_force_with_water_N"))
          return;
        const auto values = records.series("total_force_with_water_N").value;
        with_water.assign(values.begin() + 1, values.end());
        with_water.push_back(values.back());
      }

      /** Suction and gradients belong to the records, not to the middle between
       * them. */
      void
      add_suction(const Records &records)
      {
        if (!has(records, "required_suction_Pa"))
          return;
        const auto required = records.series("required_suction_Pa").value,
                   wall     = records.series("exit_gradient_wall").value,
                   axis     = records.series("exit_gradient_axis").value,
                   critical = records.series("critical_gradient").value;
        for (std::size_t i = 1; i < required.size(); ++i)
          {
            suction.push_back(
              std::max(.5 * (required[i - 1] + required[i]), 0.));
            const double gradient = std::max({wall[i], axis[i], 0.});
            margin.push_back(critical[i] > 0. ? 1. - gradient / critical[i] :
                                                1.);
          }
        suction.push_back(std::max(required.back(), 0.));
        margin.push_back(margin.back());
      }
    };

    /** A place between two entries of the curves. */
    struct CurvePosition
    {
      std::size_t second;
      double      share; // of the way to it

      double
      value(const std::vector<double> &values) const
      {
        return values[second - 1] +
               share * (values[second] - values[second - 1]);
      }
    };

    /** Return where the depth is passed first on the way down, or up; nothing
     * where that is nowhere, or between records that are farther apart than @p
     * step. */
    std::optional<CurvePosition>
    find(const std::vector<double> &depth,
         const double               wanted,
         const bool                 down,
         const double               step)
    {
      constexpr double rounding = 1e-9; // m
      for (std::size_t i = 1; i < depth.size(); ++i)
        {
          const double a = down ? depth[i - 1] : -depth[i - 1],
                       b = down ? depth[i] : -depth[i],
                       x = down ? wanted : -wanted;
          if (a < b && a <= x + rounding && x <= b + rounding && b - a < step)
            return CurvePosition{i, std::clamp((x - a) / (b - a), 0., 1.)};
        }
      return {};
    }

    /** Units that fit a run, and numbers in them. */
    struct ShownUnits
    {
      ShownUnit force, length;

      std::string
      number(const double newtons) const
      {
        constexpr double round_off = 1e-6; // N
        const double     value     = force.factor * newtons;
        return std::abs(newtons) < round_off ? "0" :
               std::abs(value) < 1e3         ? to_text(value, 4) :
                                               to_text(std::round(value), 9);
      }

      std::string
      depth(const double meters, const int digits) const
      {
        return to_text(length.factor * meters, digits) + " " + length.name;
      }
    };

    std::string
    error_in_words(const std::optional<ErrorBar::Error> &error)
    {
      if (!error)
        return "";
      return " -" + percent(error->below, 2) + " +" + percent(error->above, 2);
    }
  } // namespace

  namespace
  {
    std::string
    suction_in_words(const Curves &curves, const CurvePosition &place)
    {
      if (curves.suction.empty())
        return "";
      return "; suction " + to_text(1e-3 * place.value(curves.suction), 3) +
             " kPa, margin to piping " + percent(place.value(curves.margin), 3);
    }

    /** Multiples of the spacing, and on the way down the end. */
    std::vector<double>
    depths_of_lines(const double top,
                    const double bottom,
                    const double step,
                    const bool   down)
    {
      std::vector<double> depths;
      for (double i = std::ceil(top / step - 1e-6); i * step <= bottom + 1e-9;
           ++i)
        depths.push_back(i * step);
      if (down && !depths.empty() && depths.back() < bottom - 1e-3)
        depths.push_back(bottom);
      return depths;
    }

    Console::Lines
    lines_at_depths(const Curves     &curves,
                    const ErrorBar   &error_bar,
                    const ShownUnits &units,
                    const bool        down)
    {
      const auto [top, bottom] =
        std::minmax_element(curves.depth.begin(), curves.depth.end());
      const double   step = spacing_for(*bottom - *top);
      Console::Lines lines;
      for (const double at : depths_of_lines(*top, *bottom, step, down))
        if (const auto place = find(curves.depth, at, down, step))
          {
            const auto force = [&](const unsigned int k) {
              return units.number(place->value(curves.force[k]));
            };
            lines.emplace_back(
              "at " + units.depth(at, 4) + (down ? "" : ", up"),
              "tip " + force(0) + ", inner " + force(1) + ", outer " +
                force(2) + ", total " + force(3) + " " + units.force.name +
                (curves.with_water.empty() ?
                   "" :
                   ", with water " +
                     units.number(place->value(curves.with_water)) + " " +
                     units.force.name) +
                (down ? error_in_words(error_bar.of_total_force(at)) +
                          suction_in_words(curves, *place) :
                        ""));
          }
      return lines;
    }
  } // namespace

  namespace
  {
    bool
    has_sealed_lid(const Records &records)
    {
      const auto names = records.names();
      return std::find(names.begin(), names.end(), "lid_growth_m3") !=
             names.end();
    }

    std::string
    pull_in_words(const LargestPull &most, const ShownUnits &units)
    {
      return units.number(most.pull) + " " + units.force.name +
             " at a penetration of " + units.depth(most.penetration, 5) +
             ": water beneath lid and tip " + units.number(most.water) +
             ", outer friction " + units.number(most.outer) +
             ", inner friction " + units.number(most.inner) + ", tip " +
             units.number(most.tip) + " " + units.force.name + "; " +
             (most.is_capacity ?
                most.mechanism :
                "not the capacity: the pull neither fell nor levelled off");
    }
  } // namespace

  Console::Lines
  result_lines(const Records  &records,
               const ErrorBar &error_bar,
               const double    length)
  {
    const Curves curves(records);
    if (curves.depth.empty())
      return {};
    const bool  has_water = !curves.with_water.empty();
    const auto &total     = has_water ? curves.with_water : curves.force.back();
    const auto [least, largest] =
      std::minmax_element(total.begin(), total.end());
    const ShownUnits units{unit_of_forces(std::max(*largest, -*least)),
                           unit_of_lengths(length)};
    const auto       where = [&](const auto &force) {
      return units.number(*force) + " " + units.force.name +
             (has_water ? ", with water," : "") + " at a penetration of " +
             units.depth(curves.depth[force - total.begin()], 5);
    };
    const bool     is_sealed = has_sealed_lid(records);
    Console::Lines lines;
    if (*largest > 0.)
      lines.emplace_back("largest force", where(largest));
    if (*least < 0. && !is_sealed)
      lines.emplace_back("largest tension", where(least));
    if (is_sealed)
      if (const auto most = largest_pull(records))
        lines.emplace_back("largest pull", pull_in_words(*most, units));
    if (const auto depth = self_weight_penetration(records))
      lines.emplace_back("rests by weight", "at " + units.depth(*depth, 4));
    for (const bool down : {true, false})
      for (const auto &line : lines_at_depths(curves, error_bar, units, down))
        lines.push_back(line);
    return lines;
  }
} // namespace CaissonMPM
