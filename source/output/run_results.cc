// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/output/largest_pull.h>
#include <caisson_mpm/output/run_results.h>

#include <algorithm>

namespace CaissonMPM
{
  namespace
  {
    std::string
    row_at(const ResultTable    &table,
           const ErrorBar *const error_bar,
           const double          depth)
    {
      Json::Members result = {{"penetration_m", Json::number(depth)}};
      for (const auto &[name, value] : table.at(depth))
        {
          result.emplace_back(name, Json::number(value));
          if (error_bar != nullptr)
            for (const auto &[bound, number] :
                 error_bar->bounds(name, depth, value))
              result.emplace_back(bound, Json::number(number));
        }
      return Json::flat_object(result);
    }

    /** The rows at all depths of a table; without bounds if there is no bar. */
    std::string
    rows_of(const ResultTable &table, const ErrorBar *const error_bar)
    {
      std::string rows;
      for (const double depth : table.depths())
        rows += (rows.empty() ? "\n      " : ",\n      ") +
                row_at(table, error_bar, depth);
      return "[" + rows + "\n    ]";
    }

    /** The largest value of a column, and where. */
    std::string
    largest(const ResultTable &table, const std::string &name)
    {
      const auto [value, depth] = table.largest(table.values(name));
      return Json::flat_object(
        {{name, Json::number(value)}, {"penetration_m", Json::number(depth)}});
    }

    /** 1 less the largest ratio of a value to its limit, and where. */
    std::string
    margin(const ResultTable &table, const std::vector<double> &ratios)
    {
      const auto [ratio, depth] = table.largest(ratios);
      return Json::flat_object({{"least", Json::number(1. - ratio)},
                                {"penetration_m", Json::number(depth)}});
    }

    std::vector<double>
    ratios(const std::vector<double> &suction, const std::vector<double> &limit)
    {
      std::vector<double> result;
      for (std::size_t i = 0; i < suction.size(); ++i)
        result.push_back(limit[i] > 0. ? std::max(suction[i], 0.) / limit[i] :
                                         1.);
      return result;
    }

    Json::Members
    margins(const ResultTable &table, const ResultLimits &limits)
    {
      const auto   &required = table.values("required_suction_Pa");
      Json::Members result   = {
          {"piping", margin(table, table.values("exit_gradient_over_critical"))},
          {"boiling",
           margin(table,
                ratios(required, table.values("cavitation_suction_Pa")))}};
      if (limits.pump)
        result.emplace_back("pump",
                            margin(table,
                                   ratios(required,
                                          std::vector<double>(required.size(),
                                                              *limits.pump))));
      if (limits.skirt_length)
        {
          std::vector<double> used = table.values("room_below_lid_m");
          for (double &room : used)
            room = -room;
          result.emplace_back("room_below_lid_m",
                              Json::number(-table.largest(used).value));
        }
      return result;
    }
  } // namespace

  std::optional<double>
  self_weight_penetration(const Records &records)
  {
    const auto names = records.names();
    if (std::find(names.begin(), names.end(), "required_suction_Pa") ==
        names.end())
      return {};
    const auto suction = records.series("suction_Pa").value,
               depth   = records.series("penetration_m").value;
    for (std::size_t i = suction.size() - 1; i > 0; --i)
      if (suction[i] <= 0.)
        return i + 1 < suction.size() ? std::optional<double>(depth[i]) :
                                        std::nullopt;
    return {};
  }

  namespace
  {
    Json::Members
    of_way_down(const ResultTable  &table,
                const Records      &records,
                const ErrorBar     &error_bar,
                const ResultLimits &limits)
    {
      Json::Members result = {{"penetration_m", Json::number(table.end())},
                              {"largest_force", largest(table, table.total())}};
      if (table.has("required_suction_Pa"))
        {
          if (const auto depth = self_weight_penetration(records))
            result.emplace_back("rest_penetration_m", Json::number(*depth));
          result.emplace_back("largest_suction",
                              largest(table, "required_suction_Pa"));
          result.emplace_back("margins",
                              Json::object(margins(table, limits), 4));
        }
      result.emplace_back("at_depths", rows_of(table, &error_bar));
      return result;
    }
  } // namespace

  Json::Members
  run_results(const Records      &records,
              const ErrorBar     &error_bar,
              const ResultLimits &limits)
  {
    const auto names = records.names();
    if (std::find(names.begin(), names.end(), "total_force_N") == names.end())
      return {};
    const ResultTable table(records, ResultTable::Direction::down, limits);
    Json::Members     result;
    if (!table.is_empty())
      result = of_way_down(table, records, error_bar, limits);
    if (const auto pull = largest_pull(records))
      result.emplace_back("largest_pull", Json::flat_object(pull->json()));
    if (const ResultTable up(records, ResultTable::Direction::up);
        !up.is_empty() && up.length() > ResultTable::least_rise)
      result.emplace_back("at_depths_up", rows_of(up, nullptr));
    return result;
  }
} // namespace CaissonMPM
