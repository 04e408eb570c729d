// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/output/history.h>

#include <functional>

namespace CaissonMPM
{
  namespace
  {
    /** A column, how it follows from a row, and which scenes have it. */
    struct HistoryColumn
    {
      std::string                               name;
      std::function<double(const HistoryRow &)> value;
      bool SceneParts::*part = nullptr; // none: all scenes
    };

    /** All columns but the counts. */
    const std::vector<HistoryColumn> &
    history_columns()
    {
      using Row                 = const HistoryRow &;
      constexpr auto body       = &SceneParts::body;
      constexpr auto caisson    = &SceneParts::caisson;
      constexpr auto ledges     = &SceneParts::ledges;
      constexpr auto expanding  = &SceneParts::expanding_body;
      constexpr auto prescribed = &SceneParts::prescribed_soil;
      constexpr auto water      = &SceneParts::water_on_body;
      static const std::vector<HistoryColumn> columns = [=] {
        std::vector<HistoryColumn> all = {
          {"time_s", [](Row row) { return row.time; }},
          {"penetration_m", [](Row row) { return row.penetration; }},
          {"tip_force_N", [](Row row) { return row.tip; }, body},
          {"inner_friction_N", [](Row row) { return row.inner; }, body},
          {"outer_friction_N", [](Row row) { return row.outer; }, body},
          {"total_force_N", [](Row row) { return row.total; }, body},
          {"total_force_with_water_N",
           [](Row row) { return row.with_water; },
           water},
          {"top_force_N", [](Row row) { return row.top; }, body},
          {"kinetic_energy_J", [](Row row) { return row.kinetic_energy; }},
          {"external_work_J", [](Row row) { return row.external_work; }},
          {"water_work_J",
           [](Row row) { return row.energy.work_on_water; },
           water},
          {"added_mass_kg", [](Row row) { return row.added_mass; }},
          {"max_speed_m_s", [](Row row) { return row.max_speed; }},
          {"time_step_s", [](Row row) { return row.time_step; }},
          {"points_in_body",
           [](Row row) { return 1. * row.points_in_body; },
           body},
          {"contact_nodes",
           [](Row row) { return 1. * row.contact_nodes; },
           body},
          {"sticking_nodes",
           [](Row row) { return 1. * row.sticking_nodes; },
           body},
          {"step", [](Row row) { return 1. * row.step; }},
          {"lid_force_N", [](Row row) { return row.lid; }, caisson},
          {"ring_force_N", [](Row row) { return row.ring; }, ledges},
          {"cavity_pressure_Pa", [](Row row) { return row.cavity; }, expanding},
          {"prescribed_force_r_N",
           [](Row row) { return row.prescribed_r; },
           prescribed},
          {"prescribed_force_z_N",
           [](Row row) { return row.prescribed_z; },
           prescribed}};
        for (const EnergyBalance::Term &term : EnergyBalance::terms())
          all.push_back(
            {term.name, [term](Row row) { return row.energy.*term.value; }});
        return all;
      }();
      return columns;
    }

    /** The counts that not every scene has. */
    bool
    has_count(const SceneParts &scene, const std::string &name)
    {
      if (name == "points_split" || name == "points_merged")
        return scene.splitting;
      if (name == "soil_into_body_m3" || name == "held_back_count")
        return scene.body;
      return true;
    }

    bool
    has(const SceneParts &scene, const HistoryColumn &column)
    {
      return column.part == nullptr || scene.*column.part;
    }
  } // namespace

  std::vector<std::string>
  history_names(const SceneParts &scene, const std::vector<std::string> &counts)
  {
    std::vector<std::string> names;
    for (const HistoryColumn &column : history_columns())
      if (has(scene, column))
        names.push_back(column.name);
    for (const std::string &count : counts)
      if (has_count(scene, count))
        names.push_back(count);
    return names;
  }

  std::vector<double>
  history_values(const SceneParts &scene, const HistoryRow &row)
  {
    std::vector<double> values;
    for (const HistoryColumn &column : history_columns())
      if (has(scene, column))
        values.push_back(column.value(row));
    for (const auto &[name, value] : row.counts)
      if (has_count(scene, name))
        values.push_back(value);
    return values;
  }
} // namespace CaissonMPM
