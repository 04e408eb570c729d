// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/output/result_lines.h>
#include <caisson_mpm/output/run_results.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
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
      // with the excess pore pressure on the tip; empty where it is not
      // computed
      std::vector<double> with_water;
      std::vector<double> suction; // that is required; empty without a lid
      std::vector<double> margin;  // to piping: 1 less the gradient's share

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
        auto water = records.series("tip_water_force_N").value;
        if (has(records,
                "lid_water_balance")) // sealed: not the suction of a pump
          {
            const auto suction = records.series("suction_force_N").value;
            for (std::size_t i = 0; i < water.size(); ++i)
              water[i] -= suction[i];
          }
        for (std::size_t i = 1; i < water.size(); ++i)
          with_water.push_back(force.back()[i - 1] + water[i]);
        with_water.push_back(with_water.back());
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

    std::string
    kilonewtons(const double newtons)
    {
      constexpr double round_off   = 1e-6; // N
      const double     kilonewtons = 1e-3 * newtons;
      return std::abs(newtons) < round_off ? "0" :
             std::abs(kilonewtons) < 1e3   ? to_text(kilonewtons, 4) :
                                             to_text(std::round(kilonewtons), 9);
    }

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
    lines_at_depths(const Curves   &curves,
                    const ErrorBar &error_bar,
                    const bool      down)
    {
      const auto [top, bottom] =
        std::minmax_element(curves.depth.begin(), curves.depth.end());
      const double   step = spacing_for(*bottom - *top);
      Console::Lines lines;
      for (const double at : depths_of_lines(*top, *bottom, step, down))
        if (const auto place = find(curves.depth, at, down, step))
          {
            const auto force = [&](const unsigned int k) {
              return kilonewtons(place->value(curves.force[k]));
            };
            lines.emplace_back(
              "at " + to_text(at, 4) + (down ? " m" : " m, up"),
              "tip " + force(0) + ", inner " + force(1) + ", outer " +
                force(2) + ", total " + force(3) + " kN" +
                (curves.with_water.empty() ?
                   "" :
                   ", with water " +
                     kilonewtons(place->value(curves.with_water)) + " kN") +
                (down ? error_in_words(error_bar.of_total_force(at)) +
                          suction_in_words(curves, *place) :
                        ""));
          }
      return lines;
    }
  } // namespace

  namespace
  {
    /** Return how a pulled caisson with a sealed lid fails, by what bears it
     * and by how far the plug has followed. */
    std::string
    mechanism(const double share_of_suction,
              const double share_that_plug_follows,
              const bool   boils)
    {
      constexpr double little = .1, half = .5;
      if (boils)
        return "cavitation beneath the lid";
      if (share_of_suction < little)
        return "drained: friction on both walls";
      if (share_that_plug_follows < half)
        return "partly drained: passive suction, and water flows in through the "
               "plug";
      return "undrained: the plug rises with the caisson (reverse bearing)";
    }

    /** The record in which the median of the pull over this and two records on
     * either side is largest, so that a single jump does not count; nothing
     * where nothing pulls. */
    std::optional<std::size_t>
    record_of_largest(const std::vector<double> &pull)
    {
      constexpr std::size_t      beside = 2;
      std::optional<std::size_t> best;
      for (std::size_t i = beside; i + beside < pull.size(); ++i)
        {
          std::array<std::size_t, 2 * beside + 1> window;
          std::iota(window.begin(), window.end(), i - beside);
          std::nth_element(window.begin(),
                           window.begin() + beside,
                           window.end(),
                           [&](const std::size_t a, const std::size_t b) {
                             return pull[a] < pull[b];
                           });
          if (pull[window[beside]] > (best ? pull[*best] : 0.))
            best = window[beside];
        }
      return best;
    }

    /** What bears the largest pull of a caisson with a sealed lid. */
    Console::Lines
    lines_of_pull(const Records &records)
    {
      const auto names = records.names();
      if (std::find(names.begin(), names.end(), "lid_growth_m3") == names.end())
        return {};
      std::vector<double> pull = records.series("suction_force_N").value;
      for (const char *const name : {"total_force_N", "tip_water_force_N"})
        {
          const auto force = records.series(name).value;
          for (std::size_t i = 0; i < pull.size(); ++i)
            pull[i] -= force[i];
        }
      const auto most = record_of_largest(pull);
      if (!most)
        return {};
      const auto value = [&](const char *const name) {
        return records.series(name).value[*most];
      };
      const double growth  = value("lid_growth_m3"),
                   suction = value("suction_force_N");
      return {
        {"largest pull",
         kilonewtons(pull[*most]) + " kN at a penetration of " +
           to_text(value("penetration_m"), 5) + " m: suction " +
           kilonewtons(suction) + ", outer friction " +
           kilonewtons(-value("outer_friction_N")) + ", inner friction " +
           kilonewtons(-value("inner_friction_N")) + ", tip " +
           kilonewtons(-value("tip_force_N") - value("tip_water_force_N")) +
           " kN; " +
           mechanism(suction / pull[*most],
                     growth > 0. ? value("plug_rise_m3") / growth : 0.,
                     value("lid_cavity_m3") > 0.)}};
    }
  } // namespace

  Console::Lines
  result_lines(const Records &records, const ErrorBar &error_bar)
  {
    const Curves curves(records);
    if (curves.depth.empty())
      return {};
    const auto &total = curves.force.back();
    const auto [least, largest] =
      std::minmax_element(total.begin(), total.end());
    const auto where = [&](const auto &force) {
      return kilonewtons(*force) + " kN at a penetration of " +
             to_text(curves.depth[force - total.begin()], 5) + " m";
    };
    Console::Lines lines;
    if (*largest > 0.)
      lines.emplace_back("largest force", where(largest));
    if (*least < 0.)
      lines.emplace_back("largest tension", where(least));
    for (const auto &line : lines_of_pull(records))
      lines.push_back(line);
    if (const auto depth = self_weight_penetration(records))
      lines.emplace_back("rests by weight", "at " + to_text(*depth, 4) + " m");
    for (const bool down : {true, false})
      for (const auto &line : lines_at_depths(curves, error_bar, down))
        lines.push_back(line);
    return lines;
  }
} // namespace CaissonMPM
