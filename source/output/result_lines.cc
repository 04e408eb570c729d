// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/output/largest_pull.h>
#include <caisson_mpm/output/result_lines.h>
#include <caisson_mpm/output/run_results.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  namespace
  {
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
    suction_in_words(const double suction, const double gradient_ratio)
    {
      return "; suction " + to_text(1e-3 * std::max(suction, 0.), 3) +
             " kPa, margin to piping " + percent(1. - gradient_ratio, 3);
    }

    Console::Lines
    lines_at_depths(const ResultTable &table,
                    const ErrorBar    &error_bar,
                    const bool         down)
    {
      constexpr unsigned int most = 10;
      Console::Lines         lines;
      for (const double depth : table.depths(most))
        {
          const auto number = [&](const std::string &name) {
            return table.mean(table.values(name), depth);
          };
          const auto force = [&](const std::string &name) {
            return kilonewtons(number(name + "_N"));
          };
          std::string line = "tip " + force("tip_force") + ", inner " +
                             force("inner_friction") + ", outer " +
                             force("outer_friction") + ", total " +
                             force("total_force") + " kN";
          if (table.has("total_force_with_water_N"))
            line += ", with water " + force("total_force_with_water") + " kN";
          if (down)
            line += error_in_words(error_bar.of_total_force(depth));
          if (down && table.has("required_suction_Pa"))
            line += suction_in_words(number("required_suction_Pa"),
                                     number("exit_gradient_over_critical"));
          lines.emplace_back("at " + to_text(depth, 6) +
                               (down ? " m" : " m, up"),
                             line);
        }
      return lines;
    }
  } // namespace

  namespace
  {
    std::string
    pull_in_words(const LargestPull &most)
    {
      return kilonewtons(most.pull) + " kN at a penetration of " +
             to_text(most.penetration, 5) + " m: " +
             (most.water == 0. ?
                "" :
                "water beneath lid and tip " + kilonewtons(most.water) + ", ") +
             "outer friction " + kilonewtons(most.outer) + ", inner friction " +
             kilonewtons(most.inner) + ", tip " + kilonewtons(most.tip) +
             " kN; " +
             (!most.is_capacity ?
                "not the capacity: the pull neither fell nor levelled off" :
              most.mechanism.empty() ? "the capacity" :
                                       most.mechanism);
    }
  } // namespace

  Console::Lines
  result_lines(const Records &records, const ErrorBar &error_bar)
  {
    const ResultTable down(records, ResultTable::Direction::down),
      up(records, ResultTable::Direction::up);
    constexpr double least_rise = 1e-3; // m, of which there is something to say
    Console::Lines   lines;
    if (!down.is_empty())
      if (const auto [force, depth] = down.largest(down.values(down.total()));
          force > 0.)
        lines.emplace_back(
          "largest force",
          kilonewtons(force) +
            (down.total() == "total_force_N" ? " kN" : " kN, with water,") +
            " at a penetration of " + to_text(depth, 5) + " m");
    if (const auto most = largest_pull(records))
      lines.emplace_back("largest pull", pull_in_words(*most));
    if (const auto depth = self_weight_penetration(records))
      lines.emplace_back("rests by weight", "at " + to_text(*depth, 4) + " m");
    for (const ResultTable *const table : {&down, &up})
      if (!table->is_empty() && (table == &down || up.length() > least_rise))
        for (const auto &line :
             lines_at_depths(*table, error_bar, table == &down))
          lines.push_back(line);
    return lines;
  }
} // namespace CaissonMPM
