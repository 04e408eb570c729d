// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/output/result_lines.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace CaissonMPM
{
  namespace
  {
    std::vector<double>
    column(const Records &records, const std::string &name)
    {
      return records.series(name, 0., std::numeric_limits<double>::max()).value;
    }

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

    /** A place between two rows: that of the second one, and the share of the
     * way to it. */
    struct Place
    {
      std::size_t row;
      double      share;

      double
      value(const std::vector<double> &values) const
      {
        return values[row - 1] + share * (values[row] - values[row - 1]);
      }
    };

    /** Return where the depth is reached first. */
    std::optional<Place>
    find(const std::vector<double> &depths, const double wanted)
    {
      for (std::size_t i = 1; i < depths.size(); ++i)
        if ((depths[i - 1] - wanted) * (depths[i] - wanted) <= 0. &&
            depths[i] != depths[i - 1])
          return Place{i,
                       (wanted - depths[i - 1]) / (depths[i] - depths[i - 1])};
      return {};
    }

    std::string
    kilonewtons(const double newtons)
    {
      return to_text(1e-3 * newtons, 4);
    }

    std::string
    error_in_words(const std::optional<double> error)
    {
      return error ? " +- " + to_text(100. * *error, 2) + " %" : "";
    }
  } // namespace



  Console::Lines
  result_lines(const Records &records, const ErrorBar &error_bar)
  {
    const auto depth   = column(records, "penetration_m"),
               tip     = column(records, "tip_force_N"),
               inner   = column(records, "inner_friction_N"),
               outer   = column(records, "outer_friction_N"),
               total   = column(records, "total_force_N");
    const auto largest = std::max_element(total.begin(),
                                          total.end(),
                                          [](const double a, const double b) {
                                            return std::abs(a) < std::abs(b);
                                          }) -
                         total.begin();
    Console::Lines lines     = {{"largest force",
                                 kilonewtons(total[largest]) +
                                   " kN at a penetration of " +
                                   to_text(depth[largest], 5) + " m"}};
    const auto [top, bottom] = std::minmax_element(depth.begin(), depth.end());
    const double step        = spacing_for(*bottom - *top);
    for (double i = std::ceil(*top / step + 1e-6); i * step <= *bottom + 1e-9;
         ++i)
      if (const auto place = find(depth, std::min(i * step, *bottom)))
        lines.emplace_back(
          "at " + to_text(i * step, 4) + " m",
          "tip " + kilonewtons(place->value(tip)) + ", inner " +
            kilonewtons(place->value(inner)) + ", outer " +
            kilonewtons(place->value(outer)) + ", total " +
            kilonewtons(place->value(total)) + " kN" +
            error_in_words(error_bar.of_total_force(i * step)));
    return lines;
  }
} // namespace CaissonMPM
