// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/declared_entries.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/base/text_file.h>
#include <caisson_mpm/base/version.h>
#include <caisson_mpm/materials/umat_law.h>
#include <caisson_mpm/simulation/run_report.h>
#include <caisson_mpm/water/lid_compartment.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/revision.h>

#include <nlohmann/json.hpp>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <iomanip>
#include <sstream>
#include <utility>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    // ---------------------------------------------------------- run.json

    // RFC 8259; members keep their order
    using Json = nlohmann::ordered_json;

    /** Return an object with these members. */
    Json
    object_of(const NamedNumbers &values)
    {
      Json result = Json::object();
      for (const auto &[name, value] : values)
        result[name] = value;
      return result;
    }

    /** Return the text of a file; what is not finite is null, and bytes that
     * are no UTF-8 are replaced. */
    std::string
    text_of(const Json &json)
    {
      return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    }

    void
    append(Json &members, const Json::initializer_list_t more)
    {
      members.update(Json::object(more));
    }

    /** The time of this moment, as in 2026-11-26T08:44:10+0100. */
    std::string
    now()
    {
      const std::time_t  time = std::time(nullptr);
      std::ostringstream text;
      text << std::put_time(std::localtime(&time), "%FT%T%z");
      return text.str();
    }

    Json
    about_program(const RunFacts &facts)
    {
      return {{"version", program_version()},
              {"dealii_version", DEAL_II_PACKAGE_VERSION},
              {"scene_file", facts.scene_file},
              {"command", "caisson_mpm " + facts.command},
              {"title", facts.title},
              {"written", now()},
              {"instruction_set", facts.kernels},
              {"fingerprint", facts.fingerprint},
              {"status", facts.status}};
    }

    /** The run after which this one goes on, and where it begins. */
    Json
    about_installation(const SimulationParts &parts, const RunFacts &facts)
    {
      if (facts.installation.empty())
        return Json::object();
      return {{"installation", facts.installation},
              {"start_penetration_m",
               parts.body.shape().initial_depth() +
                 parts.body.motion().beginning().travel}};
    }

    /** What the scene sets to another value than the default, what has its
     * default, and what the program warned of. Layers have their numbers in
     * the scene. */
    Json
    about_input(const RunFacts &facts)
    {
      Json entries = Json::object(), defaults = entries, units = entries,
           warnings = Json::array();
      for (const EntryRecord &entry : declared_entries())
        if (const std::string value = entry.value();
            value != entry.default_value)
          {
            entries[entry.path] = value;
            if (!entry.unit.empty())
              units[entry.path] = entry.unit;
          }
        else if (entry.path.find("Soil/Layer ") != 0)
          defaults[entry.path] = value;
      for (const Warning &warning : facts.warnings)
        warnings.push_back(warning.text);
      return {{"entries", entries},
              {"units", units},
              {"defaults", defaults},
              {"assumed", facts.assumed},
              {"warnings", warnings}};
    }

    /** The warnings by their rank, the most important first. */
    Json
    about_results(const RunFacts &facts)
    {
      Json ranked = Json::array();
      for (const auto &[rank, name] :
           {std::make_pair(WarningRank::result, "result"),
            std::make_pair(WarningRank::input, "input"),
            std::make_pair(WarningRank::cosmetic, "cosmetic")})
        for (const Warning &warning : facts.warnings)
          if (warning.rank == rank)
            ranked.push_back({{"rank", name}, {"text", warning.text}});
      return {{"results", {{"warnings", ranked}}}};
    }

    Json
    about_size(const SimulationParts &parts, const RunFacts &facts)
    {
      const unsigned long n_points = parts.points.n_points();
      return {{"ranks", parts.grid.n_ranks()},
              {"repartitions", facts.n_repartitions},
              {"material_points",
               Utilities::MPI::sum(n_points, parts.grid.communicator())},
              {"cells", parts.grid.n_global_cells()},
              {"body_points", parts.grid.n_body_cells()},
              {"steps", facts.n_steps}};
    }

    Json
    counts(const SimulationParts &parts, const RunFacts &facts)
    {
      Json members;
      for (const auto &[name, value] : parts.totals.counts())
        members[name] = static_cast<unsigned long>(value);
      members["max_points_in_body"] = facts.max_in_body;
      return members;
    }

    Json
    about_speed(const SimulationParts &parts, const RunFacts &facts)
    {
      return {{"point_steps", facts.point_steps},
              {"wall_time_s", facts.wall_time},
              {"point_steps_per_second", facts.point_steps / facts.wall_time},
              {"peak_memory_bytes", // of all ranks together
               Utilities::MPI::sum(peak_memory_bytes(),
                                   parts.grid.communicator())}};
    }

    Json
    masses(const SimulationParts &parts)
    {
      double soil = 0.;
      parts.points.for_each([&](const MaterialPoint &p, const unsigned int) {
        soil += parts.grid.circumference() * p.mass;
      });
      return {{"body_mass_kg", parts.body.mass()},
              {"soil_mass_kg",
               Utilities::MPI::sum(soil, parts.grid.communicator())}};
    }

    Json
    about_step(const SimulationParts &parts)
    {
      const double scaling        = parts.soil.mass_scaling();
      const auto [least, largest] = parts.time_step.range_of_inertia();
      return {{"mass_scaling",
               Json::array({scaling * least, scaling * largest})},
              {"time_step_s", parts.clock.step_size},
              {"time_step_limit", parts.time_step.reason()},
              {"time_step_limits_s", object_of(parts.time_step.zone_limits())}};
    }

    NamedNumbers
    energies(const EnergyBalance &energy)
    {
      NamedNumbers result = {{"external_work_J", energy.work_of_body},
                             {"water_work_J", energy.work_on_water},
                             {"kinetic_energy_gain_J", energy.kinetic_gain}};
      for (const EnergyBalance::Term &term : EnergyBalance::terms())
        result.emplace_back(term.name, energy.*term.value);
      return result;
    }

    /** All numbers of a law, by their entries. */
    Json
    entries_of_law(const SoilMaterial &m)
    {
      Json items = Json::array();
      for (const auto &[name, unit, value] : m.law_entries())
        items.push_back({{"entry", name}, {"value", value}, {"unit", unit}});
      return items;
    }

    /** What design methods and readers need of a material. */
    Json
    about_material(const Soil        &soil,
                   const unsigned int i,
                   const PoreWater   &water)
    {
      const SoilMaterial &m       = soil.material(i);
      Json                members = {{"layer", m.layer + 1},
                                     {"top_depth_m", m.top_depth},
                                     {"law", m.law_name()},
                                     {"submerged_unit_weight_N_m3", soil.unit_weight(m)},
                                     {"K0", m.earth_pressure_at_rest},
                                     {"total_stress", water.shows_total_stress(m)}};
      const std::pair<const char *, std::optional<double>> values[] = {
        {"friction_angle_deg", m.friction_angle},
        {"cohesion_Pa", m.shear_strength},
        {"youngs_modulus_Pa", m.youngs_modulus},
        {"porosity", m.porosity},
        {"relative_density", m.density_index()},
        {"wall_friction_angle_deg", m.wall_friction_angle},
        {"wall_adhesion_Pa", m.wall_adhesion}};
      for (const auto &[name, value] : values)
        if (value)
          members[name] = *value;
      append(members,
             {{"solid_density_kg_m3", m.solid_density},
              {"law_entries", entries_of_law(m)}});
      if (m.umat)
        append(members,
               {{"library_checksum", m.umat->checksum()},
                {"p_wave_modulus_Pa", m.umat_stiffness.p_wave_modulus},
                {"poisson_ratio", m.umat_stiffness.poisson}});
      if (water.traits().uses_permeability)
        append(members,
               {{"permeability_m_s", m.permeability},
                {"permeability_ratio", m.anisotropy}});
      return members;
    }

    /** What a review of the records needs of a body that is pushed in. */
    Json
    about_tip(const SimulationParts &parts)
    {
      const BodyShape &shape = parts.body.shape();
      if (shape.width_of_tip() == 0.)
        return Json::object();
      Json depths = Json::array();
      for (const double z : parts.soil.interfaces())
        depths.push_back(-z);
      return {{"tip",
               {{"width_m", shape.width_of_tip()},
                {"initial_penetration_m", shape.initial_depth()},
                {"inner_radius_m", shape.left()},
                {"outer_radius_m", shape.right()},
                {"interface_depths_m", depths}}}};
    }

    /** The lengths and angles that pictures show. */
    Json
    about_scene(const SimulationParts &parts)
    {
      Json members = object_of(parts.body.shape().dimensions());
      if (members.empty())
        return members;
      const auto &angles = parts.body.surface().friction_angle;
      append(members,
             {{"inner_wall_friction_angle_deg", angles[inner_wall]},
              {"outer_wall_friction_angle_deg", angles[outer_wall]}});
      const auto &adhesion = parts.body.surface().adhesion;
      append(members,
             {{"inner_wall_adhesion_Pa", adhesion[inner_wall]},
              {"outer_wall_adhesion_Pa", adhesion[outer_wall]}});
      Json layers = Json::array();
      for (unsigned int i = 0; i < parts.soil.n_materials(); ++i)
        layers.push_back(about_material(parts.soil, i, *parts.water));
      append(members,
             {{"layers", layers},
              {"frame_penetrations_m",
               parts.schedule.penetrations_of_frames()}});
      const LidCompartment *const lid = parts.water->traits().lid;
      if (parts.water->traits().uses_permeability || lid != nullptr)
        append(members,
               {{"submerged_weight_N", parts.body.submerged_weight()}});
      if (const std::string reason = parts.water->reason_to_end();
          !reason.empty())
        append(members, {{"end_reason", reason}});
      if (lid != nullptr)
        append(members,
               {{"boiling_suction_at_mudline_Pa", lid->boiling_at_mudline()}});
      if (const auto place = lid != nullptr ? lid->infeasible() : std::nullopt)
        append(members,
               {{"infeasible",

                 {{"penetration_m", place->penetration},
                  {"reason", place->reason}}}});
      if (const auto travel = parts.body.motion().travel_at_rest())
        append(members,
               {{"rest_penetration_m",
                 parts.body.shape().initial_depth() + *travel}});
      return members;
    }

    // ---------------------------------------------------------- terminal

    void
    warn_of_thrown_off(Console &console, const RunTotals &totals)
    {
      for (const auto &[name, value] : totals.counts())
        if (name == "thrown_off_count" && value > 0.)
          console.warning(
            to_text(value, 12) +
            " times a material point was thrown off a free surface and stopped "
            "at a side of the mesh; it carries no load. Likely causes: soil "
            "without strength there (add some cohesion and Tension cut-off), "
            "or a dilatancy angle near the friction angle (set Method/Pressure "
            "in full cells = mean)");
    }

    void
    print_residual(Console &console, const EnergyBalance &energy)
    {
      const std::string residual = percent(energy.relative, 3) + " of the work";
      console.header({{"energy residual", residual}});
      // 1.6 % in prm/jack_coarse.prm, whose mesh makes an error of 6 %
      constexpr double largest_residual = .02;
      if (std::abs(energy.relative) > largest_residual)
        console.warning("the energy residual is " + residual +
                        ", and forces are uncertain by at least as much: see "
                        "doc/limitations.md, Energy");
    }
  } // namespace

  void
  write_run_summary(const std::string     &path,
                    const SimulationParts &parts,
                    const RunFacts        &facts)
  {
    Json members = about_program(facts);
    members.update(about_installation(parts, facts));
    members.update(about_input(facts));
    members.update(about_results(facts));
    members.update(about_size(parts, facts));
    members.update(counts(parts, facts));
    members.update(about_speed(parts, facts));
    members.update(masses(parts));
    members.update(about_step(parts));
    append(members,
           {{"energies", object_of(energies(parts.energy))},
            {"sections", object_of(parts.timer.seconds())},
            {"scene", about_scene(parts)}});
    members.update(about_tip(parts));
    if (parts.grid.is_first_rank())
      write_atomically(path, text_of(members));
  }

  int
  write_early_summary(const std::string     &path,
                      const SimulationParts &parts,
                      const RunFacts        &facts)
  {
    Json members = about_program(facts);
    if (!facts.failure.empty())
      append(members, {{"failure", facts.failure}});
    if (!facts.progress.empty())
      append(members, {{"progress", object_of(facts.progress)}});
    members.update(about_installation(parts, facts));
    members.update(about_input(facts));
    members.update(about_results(facts));
    append(members,
           {{"ranks", parts.grid.n_ranks()},
            {"cells", parts.grid.n_global_cells()},
            {"steps", facts.n_steps},
            {"wall_time_s", facts.wall_time}});
    members.update(about_step(parts));
    append(members, {{"scene", about_scene(parts)}});
    // several ranks may fail at once: each writes a file of its own first
    const std::string own =
      path + ".of_rank_" +
      to_text(Utilities::MPI::this_mpi_process(parts.grid.communicator()));
    if (const int error = try_to_write(own, text_of(members)))
      return error;
    return std::rename(own.c_str(), path.c_str()) == 0 ? 0 : errno;
  }

  void
  print_run_report(Console &console, const SimulationParts &parts)
  {
    warn_of_thrown_off(console, parts.totals);
    print_residual(console, parts.energy);
  }
} // namespace CaissonMPM
