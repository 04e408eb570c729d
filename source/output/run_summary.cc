// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/text_file.h>
#include <caisson_mpm/output/json.h>
#include <caisson_mpm/output/run_summary.h>

namespace CaissonMPM
{
  void
  write_run_summary(const std::string &path, const RunSummary &s)
  {
    const Json::Members members = {
      {"version", Json::text(s.version)},
      {"dealii_version", Json::text(s.dealii_version)},
      {"scene_file", Json::text(s.scene_file)},
      {"instruction_set", Json::text(s.instruction_set)},
      {"fingerprint", Json::text(s.fingerprint)},
      {"status", Json::text(s.status)},
      {"ranks", Json::integer(s.ranks)},
      {"repartitions", Json::integer(s.repartitions)},
      {"material_points", Json::integer(s.material_points)},
      {"cells", Json::integer(s.cells)},
      {"body_points", Json::integer(s.body_points)},
      {"steps", Json::integer(s.steps)},
      {"limiter_count", Json::integer(s.limiter_count)},
      {"held_back", Json::integer(s.held_back)},
      {"points_lost", Json::integer(s.points_lost)},
      {"max_points_in_body", Json::integer(s.max_points_in_body)},
      {"points_split", Json::integer(s.points_split)},
      {"points_merged", Json::integer(s.points_merged)},
      {"point_steps", Json::number(s.point_steps)},
      {"wall_time_s", Json::number(s.wall_time_s)},
      {"point_steps_per_second", Json::number(s.point_steps_per_second)},
      {"peak_memory_bytes", Json::number(s.peak_memory_bytes)},
      {"body_mass_kg", Json::number(s.body_mass_kg)},
      {"soil_mass_kg", Json::number(s.soil_mass_kg)},
      {"time_step_s", Json::number(s.time_step_s)},
      {"time_step_limit", Json::text(s.time_step_limit)},
      {"time_step_limits_s", Json::object(Json::numbers(s.zone_limits), 2)},
      {"energies", Json::object(Json::numbers(s.energies), 2)},
      {"sections", Json::object(Json::numbers(s.sections), 2)},
      {"scene", Json::object(Json::numbers(s.scene), 2)}};
    write_atomically(path, Json::object(members) + "\n");
  }
} // namespace CaissonMPM
