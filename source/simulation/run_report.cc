// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/declared_entries.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/base/text_file.h>
#include <caisson_mpm/base/version.h>
#include <caisson_mpm/materials/umat_law.h>
#include <caisson_mpm/output/json.h>
#include <caisson_mpm/simulation/run_report.h>
#include <caisson_mpm/water/lid_compartment.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/revision.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <iomanip>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    // ---------------------------------------------------------- run.json

    void
    append(Json::Members &members, const Json::Members &more)
    {
      members.insert(members.end(), more.begin(), more.end());
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

    Json::Members
    about_program(const RunFacts &facts)
    {
      return {{"version", Json::text(program_version())},
              {"dealii_version", Json::text(DEAL_II_PACKAGE_VERSION)},
              {"scene_file", Json::text(facts.scene_file)},
              {"command", Json::text("caisson_mpm " + facts.command)},
              {"title", Json::text(facts.title)},
              {"written", Json::text(now())},
              {"instruction_set", Json::text(facts.kernels)},
              {"fingerprint", Json::text(facts.fingerprint)},
              {"status", Json::text(facts.status)}};
    }

    /** The run after which this one goes on, and where it begins. */
    Json::Members
    about_installation(const RecordedParts &parts, const RunFacts &facts)
    {
      if (facts.installation.empty())
        return {};
      return {{"installation", Json::text(facts.installation)},
              {"start_penetration_m",
               Json::number(parts.body.shape().initial_depth() +
                            parts.body.motion().beginning().travel)}};
    }

    /** What the scene sets to another value than the default, what has its
     * default, and what the program warned of. Layers have their numbers in
     * the scene. */
    Json::Members
    about_input(const RunFacts &facts)
    {
      const DeclaredEntries declared(ParameterAcceptor::prm);
      Json::Members         entries, defaults, units;
      for (const DeclaredEntry &entry : declared.all())
        if (entry.value != entry.default_value)
          {
            entries.emplace_back(entry.path, Json::text(entry.value));
            if (!entry.unit.empty())
              units.emplace_back(entry.path, Json::text(entry.unit));
          }
        else if (entry.path.find("Soil/Layer ") != 0)
          defaults.emplace_back(entry.path, Json::text(entry.value));
      std::vector<std::string> warnings, assumed;
      for (const Warning &warning : facts.warnings)
        warnings.push_back(Json::text(warning.text));
      for (const std::string &entry : facts.assumed)
        assumed.push_back(Json::text(entry));
      return {{"entries", Json::object(entries, 2)},
              {"units", Json::object(units, 2)},
              {"defaults", Json::object(defaults, 2)},
              {"assumed", Json::list(assumed)},
              {"warnings", Json::list(warnings)}};
    }

    /** The warnings by their rank, the most important first. */
    Json::Members
    about_results(const RunFacts &facts)
    {
      std::vector<std::string> ranked;
      for (const auto &[rank, name] :
           {std::make_pair(WarningRank::result, "result"),
            std::make_pair(WarningRank::input, "input"),
            std::make_pair(WarningRank::cosmetic, "cosmetic")})
        for (const Warning &warning : facts.warnings)
          if (warning.rank == rank)
            ranked.push_back(
              Json::flat_object({{"rank", Json::text(name)},
                                 {"text", Json::text(warning.text)}}));
      return {{"results", Json::object({{"warnings", Json::list(ranked)}}, 2)}};
    }

    Json::Members
    about_size(const RecordedParts &parts, const RunFacts &facts)
    {
      const auto sum = [&parts](const unsigned long value) {
        return Json::integer(
          Utilities::MPI::sum(value, parts.grid.communicator()));
      };
      return {{"ranks", Json::integer(parts.grid.n_ranks())},
              {"repartitions", Json::integer(facts.n_repartitions)},
              {"material_points", sum(parts.points.n_points())},
              {"cells", Json::integer(parts.grid.n_global_cells())},
              {"body_points", sum(parts.body_points.size())},
              {"steps", Json::integer(facts.n_steps)}};
    }

    Json::Members
    counts(const RecordedParts &parts, const RunFacts &facts)
    {
      Json::Members members;
      for (const auto &[name, value] : parts.totals.counts())
        members.emplace_back(name, Json::integer(value));
      members.emplace_back("max_points_in_body",
                           Json::integer(facts.max_in_body));
      return members;
    }

    Json::Members
    about_speed(const RecordedParts &parts, const RunFacts &facts)
    {
      return {{"point_steps", Json::number(facts.point_steps)},
              {"wall_time_s", Json::number(facts.wall_time)},
              {"point_steps_per_second",
               Json::number(facts.point_steps / facts.wall_time)},
              {"peak_memory_bytes", // of all ranks together
               Json::number(Utilities::MPI::sum(peak_memory_bytes(),
                                                parts.grid.communicator()))}};
    }

    Json::Members
    masses(const RecordedParts &parts)
    {
      double body = 0., soil = 0.;
      for (const BodyPoint &p : parts.body_points)
        body += p.mass;
      parts.points.for_each([&](const MaterialPoint &p, const unsigned int) {
        soil += parts.grid.circumference() * p.mass;
      });
      const auto sum = [&parts](const double value) {
        return Json::number(
          Utilities::MPI::sum(value, parts.grid.communicator()));
      };
      return {{"body_mass_kg", sum(body)}, {"soil_mass_kg", sum(soil)}};
    }

    Json::Members
    about_step(const RecordedParts &parts)
    {
      const double scaling        = parts.soil.mass_scaling();
      const auto [least, largest] = parts.time_step.range_of_inertia();
      return {{"mass_scaling",
               Json::list({Json::number(scaling * least),
                           Json::number(scaling * largest)})},
              {"time_step_s", Json::number(parts.clock.step_size)},
              {"time_step_limit", Json::text(parts.time_step.reason())},
              {"time_step_limits_s",
               Json::object(Json::numbers(parts.time_step.zone_limits()), 2)}};
    }

    NamedNumbers
    energies(const EnergyBalance &energy)
    {
      NamedNumbers result = {{"external_work_J", energy.work_of_body},
                             {"water_work_J", energy.work_on_water},
                             {"kinetic_energy_gain_J", energy.kinetic_gain}};
      for (const auto &entry : energy.entries())
        result.push_back(entry);
      return result;
    }

    /** All numbers of a law, by their entries. */
    std::string
    entries_of_law(const SoilMaterial &m)
    {
      std::string items;
      for (const auto &[name, unit] : m.law_entries())
        items += (items.empty() ? "" : ", ") +
                 Json::flat_object({{"entry", Json::text(name)},
                                    {"value", Json::number(*m.law_value(name))},
                                    {"unit", Json::text(unit)}});
      return "[" + items + "]";
    }

    /** What design methods and readers need of a material. */
    Json::Members
    about_material(const Soil        &soil,
                   const unsigned int i,
                   const bool         uses_permeability)
    {
      const SoilMaterial &m       = soil.material(i);
      Json::Members       members = {{"layer", to_text(m.layer + 1)},
                                     {"top_depth_m", Json::number(m.top_depth)},
                                     {"law", Json::text(m.law_name())},
                                     {"submerged_unit_weight_N_m3",
                                      Json::number(soil.unit_weight(m))},
                                     {"K0", Json::number(m.earth_pressure_at_rest)}};
      const std::pair<const char *, std::optional<double>> values[] = {
        {"friction_angle_deg", m.friction_angle()},
        {"cohesion_Pa", m.shear_strength()},
        {"youngs_modulus_Pa", m.law_value("Youngs modulus")},
        {"porosity", m.porosity},
        {"relative_density", m.density_index()},
        {"wall_friction_angle_deg", m.wall_friction_angle},
        {"wall_adhesion_Pa", m.wall_adhesion}};
      for (const auto &[name, value] : values)
        if (value)
          members.emplace_back(name, Json::number(*value));
      append(members,
             {{"solid_density_kg_m3", Json::number(m.solid_density)},
              {"law_entries", entries_of_law(m)}});
      if (m.umat)
        append(members,
               {{"library_checksum", Json::text(m.umat->checksum())},
                {"p_wave_modulus_Pa",
                 Json::number(m.umat_stiffness.p_wave_modulus)},
                {"poisson_ratio", Json::number(m.umat_stiffness.poisson)}});
      if (uses_permeability)
        append(members,
               {{"permeability_m_s", Json::number(m.permeability)},
                {"permeability_ratio", Json::number(m.anisotropy)}});
      return members;
    }

    /** The lengths and angles that pictures show. */
    Json::Members
    about_scene(const RecordedParts &parts)
    {
      Json::Members members = Json::numbers(parts.body.shape().dimensions());
      if (members.empty())
        return members;
      const auto angles = parts.body.surface().friction_angles();
      append(
        members,
        {{"inner_wall_friction_angle_deg", Json::number(angles[inner_wall])},
         {"outer_wall_friction_angle_deg", Json::number(angles[outer_wall])}});
      const auto &adhesion = parts.body.surface().adhesion;
      append(members,
             {{"inner_wall_adhesion_Pa", Json::number(adhesion[inner_wall])},
              {"outer_wall_adhesion_Pa", Json::number(adhesion[outer_wall])}});
      std::string layers, frames;
      for (unsigned int i = 0; i < parts.soil.n_materials(); ++i)
        layers += (i > 0 ? ", " : "") +
                  Json::flat_object(about_material(
                    parts.soil, i, parts.water->traits().uses_permeability));
      for (const double depth : parts.schedule.penetrations_of_frames())
        frames += (frames.empty() ? "" : ", ") + Json::number(depth);
      append(members,
             {{"layers", "[" + layers + "]"},
              {"frame_penetrations_m", "[" + frames + "]"}});
      const LidCompartment *const lid = parts.water->traits().lid;
      if (parts.water->traits().uses_permeability || lid != nullptr)
        append(members,
               {{"submerged_weight_N",
                 Json::number(parts.body.submerged_weight())}});
      if (const std::string reason = parts.water->reason_to_end();
          !reason.empty())
        append(members, {{"end_reason", Json::text(reason)}});
      if (const auto place = lid != nullptr ? lid->infeasible() : std::nullopt)
        append(members,
               {{"infeasible",
                 Json::flat_object(
                   {{"penetration_m", Json::number(place->penetration)},
                    {"reason", Json::text(place->reason)}})}});
      if (const auto travel = parts.body.motion().travel_at_rest())
        append(members,
               {{"rest_penetration_m",
                 Json::number(parts.body.shape().initial_depth() + *travel)}});
      return members;
    }

    // ---------------------------------------------------------- terminal

    /** What a count of the totals is, for readers. */
    std::string
    in_words(const std::string &count)
    {
      static const std::map<std::string, std::string> words = {
        {"limiter_count", "velocities cut by the limiter"},
        {"soil_into_body_m3", "soil that flowed into the body (m3)"},
        {"thrown_off_count", "points thrown off a free surface"},
        {"points_split", "points split"},
        {"points_merged", "points merged"}};
      const auto found = words.find(count);
      return found == words.end() ? count : found->second;
    }

    void
    print_counts(Console             &console,
                 const RecordedParts &parts,
                 const RunFacts      &facts)
    {
      Console::Lines lines = {
        {"points in the body", to_text(facts.max_in_body) + " at any record"}};
      for (const auto &[name, value] : parts.totals.counts())
        if (name != "held_back_count" && // large in every run, and harmless
            (value != 0. || name.find("points_") != 0))
          lines.emplace_back(in_words(name), to_text(value, 12));
      console.header(lines);
      for (const auto &[name, value] : parts.totals.counts())
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
    print_energies(Console &console, const EnergyBalance &energy)
    {
      const auto joule = [](const double value) {
        return to_text(value, 6) + " J";
      };
      console.header({{"work of the body", joule(energy.work_of_body)},
                      {"on the water", joule(energy.work_on_water)},
                      {"work of gravity", joule(energy.gravity_work)},
                      {"work of loads", joule(energy.load_work)},
                      {"stress work", joule(energy.stress_work)},
                      {"friction heat", joule(energy.friction_heat)},
                      {"kinetic energy", joule(energy.kinetic_gain)},
                      {"damping, mass floor",
                       joule(energy.damping) + ", " + joule(energy.floor)},
                      {"lost in the transfer", joule(energy.dissipation)},
                      {"energy residual",
                       joule(energy.residual) + ", " +
                         percent(energy.relative, 3) + " of the work"}});
      // 1.6 % in prm/jack_coarse.prm, whose mesh makes an error of 6 %
      constexpr double largest_residual = .02;
      if (std::abs(energy.relative) > largest_residual)
        console.warning("the energy residual is " +
                        percent(energy.relative, 3) +
                        " of the work, and forces are uncertain by about as "
                        "much: see doc/limitations.md, Energy");
    }
  } // namespace



  void
  write_run_summary(const std::string   &path,
                    const RecordedParts &parts,
                    const RunFacts      &facts)
  {
    Json::Members members = about_program(facts);
    append(members, about_installation(parts, facts));
    append(members, about_input(facts));
    append(members, about_results(facts));
    append(members, about_size(parts, facts));
    append(members, counts(parts, facts));
    append(members, about_speed(parts, facts));
    append(members, masses(parts));
    append(members, about_step(parts));
    append(members,
           {{"energies",
             Json::object(Json::numbers(energies(parts.energy)), 2)},
            {"sections", Json::object(Json::numbers(parts.timer.seconds()), 2)},
            {"scene", Json::object(about_scene(parts), 2)}});
    if (parts.grid.is_first_rank())
      write_atomically(path, Json::object(members) + "\n");
  }



  int
  write_early_summary(const std::string   &path,
                      const RecordedParts &parts,
                      const RunFacts      &facts)
  {
    Json::Members members = about_program(facts);
    if (!facts.failure.empty())
      append(members, {{"failure", Json::text(facts.failure)}});
    if (!facts.progress.empty())
      append(members, {{"progress", Json::flat_object(facts.progress)}});
    append(members, about_installation(parts, facts));
    append(members, about_input(facts));
    append(members, about_results(facts));
    append(members,
           {{"ranks", Json::integer(parts.grid.n_ranks())},
            {"cells", Json::integer(parts.grid.n_global_cells())},
            {"steps", Json::integer(facts.n_steps)},
            {"wall_time_s", Json::number(facts.wall_time)}});
    append(members, about_step(parts));
    append(members, {{"scene", Json::object(about_scene(parts), 2)}});
    // several ranks may fail at once: each writes a file of its own first
    const std::string own =
      path + ".of_rank_" +
      to_text(Utilities::MPI::this_mpi_process(parts.grid.communicator()));
    if (const int error = try_to_write(own, Json::object(members) + "\n"))
      return error;
    return std::rename(own.c_str(), path.c_str()) == 0 ? 0 : errno;
  }



  void
  print_run_report(Console             &console,
                   const RecordedParts &parts,
                   const RunFacts      &facts)
  {
    print_counts(console, parts, facts);
    print_energies(console, parts.energy);
  }



  void
  print_run_times(Console             &console,
                  const RecordedParts &parts,
                  const double         total)
  {
    std::vector<TableRow> rows;
    double                sum = 0.;
    for (const auto &[name, seconds] : parts.timer.seconds())
      {
        rows.push_back({name, seconds, 100. * seconds / total});
        sum += seconds;
      }
    rows.push_back({"set-up and rest", total - sum, 100. * (1. - sum / total)});
    rows.push_back({"total", total, 100.});
    console.table("wall time", rows);
  }
} // namespace CaissonMPM
