// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/output/history.h>

#include <functional>

namespace CaissonMPM
{
  namespace
  {
    /** A column, and how it follows from a row. */
    struct HistoryColumn
    {
      std::string                               name;
      std::function<double(const HistoryRow &)> value;
    };

    /** All columns but the counts. */
    const std::vector<HistoryColumn> &
    history_columns()
    {
      using Row                                       = const HistoryRow &;
      static const std::vector<HistoryColumn> columns = [] {
        std::vector<HistoryColumn> all = {
          {"time_s", [](Row row) { return row.time; }},
          {"penetration_m", [](Row row) { return row.penetration; }},
          {"tip_force_N", [](Row row) { return row.tip; }},
          {"inner_friction_N", [](Row row) { return row.inner; }},
          {"outer_friction_N", [](Row row) { return row.outer; }},
          {"total_force_N", [](Row row) { return row.total; }},
          {"top_force_N", [](Row row) { return row.top; }},
          {"kinetic_energy_J", [](Row row) { return row.kinetic_energy; }},
          {"external_work_J", [](Row row) { return row.external_work; }},
          {"added_mass_kg", [](Row row) { return row.added_mass; }},
          {"max_speed_m_s", [](Row row) { return row.max_speed; }},
          {"time_step_s", [](Row row) { return row.time_step; }},
          {"points_in_body", [](Row row) { return 1. * row.points_in_body; }},
          {"contact_nodes", [](Row row) { return 1. * row.contact_nodes; }},
          {"sticking_nodes", [](Row row) { return 1. * row.sticking_nodes; }},
          {"step", [](Row row) { return 1. * row.step; }},
          {"lid_force_N", [](Row row) { return row.lid; }},
          {"cavity_pressure_Pa", [](Row row) { return row.cavity; }},
          {"prescribed_force_r_N", [](Row row) { return row.prescribed_r; }},
          {"prescribed_force_z_N", [](Row row) { return row.prescribed_z; }}};
        for (const EnergyBalance::Term &term : EnergyBalance::terms())
          all.push_back(
            {term.name, [term](Row row) { return row.energy.*term.value; }});
        return all;
      }();
      return columns;
    }
  } // namespace

  std::vector<std::string>
  history_names(const std::vector<std::string> &counts)
  {
    std::vector<std::string> names;
    for (const HistoryColumn &column : history_columns())
      names.push_back(column.name);
    names.insert(names.end(), counts.begin(), counts.end());
    return names;
  }

  std::vector<double>
  history_values(const HistoryRow &row)
  {
    std::vector<double> values;
    for (const HistoryColumn &column : history_columns())
      values.push_back(column.value(row));
    for (const auto &count : row.counts)
      values.push_back(count.second);
    return values;
  }
} // namespace CaissonMPM
