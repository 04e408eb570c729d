// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/shown_unit.h>
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
    suction_in_words(const double suction, const double gradient_ratio)
    {
      const ShownUnit unit = unit_of_stresses(suction);
      return "; suction " + to_text(unit.factor * std::max(suction, 0.), 3) +
             " " + unit.name + ", margin to piping " +
             percent(1. - gradient_ratio, 3);
    }

    Console::Lines
    lines_at_depths(const ResultTable &table,
                    const ErrorBar    &error_bar,
                    const ShownUnits  &units,
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
            return units.number(number(name + "_N"));
          };
          std::string line = "tip " + force("tip_force") + ", inner " +
                             force("inner_friction") + ", outer " +
                             force("outer_friction") + ", total " +
                             force("total_force") + " " + units.force.name;
          if (table.has("total_force_with_water_N"))
            line += ", with water " + force("total_force_with_water") + " " +
                    units.force.name;
          if (down)
            line += error_in_words(error_bar.of_total_force(depth));
          if (down && table.has("required_suction_Pa"))
            line += suction_in_words(number("required_suction_Pa"),
                                     number("exit_gradient_over_critical"));
          lines.emplace_back("at " + units.depth(depth, 6) +
                               (down ? "" : ", up"),
                             line);
        }
      return lines;
    }
  } // namespace

  namespace
  {
    std::string
    pull_in_words(const LargestPull &most, const ShownUnits &units)
    {
      return units.number(most.pull) + " " + units.force.name +
             " at a penetration of " + units.depth(most.penetration, 5) + ": " +
             (most.water == 0. ? "" :
                                 "water beneath lid and tip " +
                                   units.number(most.water) + ", ") +
             "outer friction " + units.number(most.outer) +
             ", inner friction " + units.number(most.inner) + ", tip " +
             units.number(most.tip) + " " + units.force.name + "; " +
             (!most.is_capacity ?
                "not the capacity: the pull neither fell nor levelled off" :
              most.mechanism.empty() ? "the capacity" :
                                       most.mechanism);
    }
  } // namespace

  Console::Lines
  result_lines(const Records  &records,
               const ErrorBar &error_bar,
               const double    length)
  {
    const ResultTable down(records, ResultTable::Direction::down),
      up(records, ResultTable::Direction::up);
    double most_force = 0.;
    for (const ResultTable *const table : {&down, &up})
      if (!table->is_empty())
        for (const double force : table->values(table->total()))
          most_force = std::max(most_force, std::abs(force));
    const ShownUnits units{unit_of_forces(most_force), unit_of_lengths(length)};
    Console::Lines   lines;
    if (!down.is_empty())
      if (const auto [force, depth] = down.largest(down.values(down.total()));
          force > 0.)
        lines.emplace_back("largest force",
                           units.number(force) + " " + units.force.name +
                             (down.total() == "total_force_N" ?
                                "" :
                                ", with water,") +
                             " at a penetration of " + units.depth(depth, 5));
    if (const auto most = largest_pull(records))
      lines.emplace_back("largest pull", pull_in_words(*most, units));
    if (const auto depth = self_weight_penetration(records))
      lines.emplace_back("rests by weight", "at " + units.depth(*depth, 4));
    for (const ResultTable *const table : {&down, &up})
      if (!table->is_empty() &&
          (table == &down || up.length() > ResultTable::least_rise))
        for (const auto &line :
             lines_at_depths(*table, error_bar, units, table == &down))
          lines.push_back(line);
    return lines;
  }
} // namespace CaissonMPM
