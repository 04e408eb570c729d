// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/base/version.h>
#include <caisson_mpm/domain/all_points.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/simulation/recorder.h>
#include <caisson_mpm/water/lid_compartment.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/revision.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  using namespace dealii;

  Recorder::Recorder(SimulationParts &parts)
    : Section("/", Influence::none)
    , parts(parts)
  {
    add_parameter("Title", known.title, "", "The title says what the scene is.")
      .influence = Influence::motion;
    enter_subsection("Output");
    add_parameter(
      "Directory",
      directory,
      "",
      "All files of the run go to this directory, which is created if it does "
      "not exist.");
    add_choice(
      *this,
      "Terminal",
      terminal,
      {{"full", Terminal::full},
       {"plain", Terminal::plain},
       {"silent", Terminal::silent}},
      "",
      "The program prints everything (full), only what does not differ from "
      "run to run (plain), or nothing (silent).");
    add_parameter(
      "Walls at each record",
      walls_at_each_record,
      "",
      "wall.csv has the stresses along the walls at each row of history.csv, "
      "which springs along the wall need, and not at the frames only.");
    leave_subsection();
  }

  void
  Recorder::register_totals(RunTotals &totals)
  {
    for (unsigned int s = 0; s < n_surfaces; ++s)
      {
        std::string surface = name_of(static_cast<Surface>(s));
        std::replace(surface.begin(), surface.end(), ' ', '_');
        totals.sum("impulse_on_" + surface + "_r", impulse_on_body[s][radial]);
        totals.sum("impulse_on_" + surface + "_z",
                   impulse_on_body[s][vertical]);
        totals.carry("recorded_force_on_" + surface, recorded_forces[s]);
      }
    totals.keep("impulse_of_water", impulse_of_water);
    totals.carry("recorded_force_of_water", recorded_force_of_water);
    totals.sum("impulse_on_soil_r", impulse_on_soil[radial]);
    totals.sum("impulse_on_soil_z", impulse_on_soil[vertical]);
    totals.keep("last_record", last_record);
    totals.keep("travel_at_record", travel_at_record);
    totals.keep("time_of_last_frame", last_frame);
    totals.keep("walls_are_requested", wants_walls);
    totals.keep("max_points_in_body", known.max_in_body);
    totals.sum("point_steps", point_steps);
    totals.keep("wall_time", wall_time);
    totals.keep("repartitions", known.n_repartitions);
    totals.keep("lid_is_touched", at_lid);
    totals.keep("has_reported_rest", has_reported_rest);
    totals.keep("has_reported_suction", has_reported_suction);
    totals.keep("last_depth", last_depth);
    totals.keep("last_suction", last_suction);
    totals.keep("fingerprint_of_history", files.history);
    totals.keep("fingerprint_of_observations", files.observations);
    totals.keep("fingerprint_of_frames", files.frames);
  }

  // ------------------------------------------------------------ set-up

  void
  Recorder::check_parameters()
  {
    observations.initialize(column_names());
  }

  Console::Verbosity
  Recorder::verbosity() const
  {
    if (!parts.grid.is_first_rank())
      return Console::Verbosity::silent;
    return terminal == Terminal::full  ? Console::Verbosity::full :
           terminal == Terminal::plain ? Console::Verbosity::plain :
                                         Console::Verbosity::silent;
  }

  void
  Recorder::set_output_directory(const std::string &of_command_line)
  {
    if (!of_command_line.empty())
      directory = of_command_line;
  }

  void
  Recorder::describe(const std::string          &scene_file,
                     const std::string          &command_words,
                     const std::string          &fingerprint,
                     const std::string          &installation,
                     const Kernels::KernelTable &kernels)
  {
    start_time         = std::chrono::steady_clock::now();
    known.scene_file   = scene_file;
    known.command      = command_words;
    known.fingerprint  = fingerprint;
    known.installation = installation;
    known.kernels      = kernels.name;
    n_lanes            = kernels.width;
    OutputDirectory::check(directory, parts.grid.communicator());
    console = std::make_unique<Console>(verbosity());
  }

  void
  Recorder::report_progress(const std::string &text)
  {
    console->header({{"setting up", text}});
  }

  void
  Recorder::try_observations() const
  {
    try
      {
        observed_values();
      }
    catch (const RunFailure &error)
      {
        throw BadInput(error.what());
      }
  }

  void
  Recorder::open()
  {
    locked_directory =
      std::make_unique<OutputDirectory>(directory, parts.grid.communicator());
    history =
      std::make_unique<RowFile>(directory + "/history.csv", column_names(), 10);
    if (auto names = observations.names(); !names.empty())
      {
        names.insert(names.begin(), "time_s");
        // all digits, so that a restart sees the same numbers
        observed =
          std::make_unique<RowFile>(directory + "/observations.csv", names, 17);
      }
    visualization = std::make_unique<Visualization>(directory);
    if (has_walls())
      wall_file = std::make_unique<WallFile>(
        directory,
        WallFile::Scene{parts.soil,
                        parts.body.shape().right(),
                        parts.body.shape().left() > 0.,
                        parts.water->shows_pressure()});
  }

  void
  Recorder::start(const bool overwrite)
  {
    const auto room =
      locked_directory->make_room(overwrite, parts.grid.communicator());
    if (room.n_removed > 0)
      console->header({{"removed",
                        to_text(room.n_removed) +
                          " files of an earlier run in " + directory}});
    if (!room.place.empty())
      console->header({{overwrite ? "kept" : "earlier run",
                        (overwrite ? "what is not as the program wrote it has" :
                                     "its results have") +
                          (" been moved to " + room.place)}});
    if (parts.grid.is_first_rank())
      {
        history->create();
        if (observed)
          observed->create();
        if (wall_file)
          wall_file->create();
      }
    begin();
  }

  namespace
  {
    void
    check_observations(const std::size_t n_of_history,
                       const std::size_t n_observed)
    {
      if (n_observed != n_of_history)
        throw BadInput("observations.csv has " + to_text(n_observed) +
                       " rows up to the checkpoint and history.csv " +
                       to_text(n_of_history) +
                       ", so that the run cannot continue them. Run without "
                       "--restart, or without Verification/Observations.");
    }
  } // namespace

  void
  Recorder::resume(const bool overwrite)
  {
    check_for_lost_rows(overwrite);
    if (parts.grid.is_first_rank())
      {
        const auto n_rows = history->resume(parts.clock.time).size();
        if (observed)
          check_observations(n_rows, observed->resume(parts.clock.time).size());
        if (wall_file)
          wall_file->resume(parts.clock.time);
      }
    visualization->resume(last_frame);
    warn_of_changed_files();
    start_time -=
      std::chrono::duration_cast<std::chrono::steady_clock::duration>(
        std::chrono::duration<double>(wall_time));
    begin();
  }

  std::vector<std::string>
  Recorder::prepare_checkpoint()
  {
    wall_time = seconds_running();
    std::vector<std::string> result;
    for (const Warning &warning : console->warnings())
      if (warning.rank == WarningRank::result)
        result.push_back(warning.text);
    return result;
  }

  void
  Recorder::store_file_hashes()
  {
    files = {history->fingerprint(),
             observed ? observed->fingerprint() : 0.,
             visualization->fingerprint()};
  }

  void
  Recorder::warn_of_changed_files()
  {
    const Files then = files;
    store_file_hashes();
    if (!parts.grid.is_first_rank())
      return;
    const auto compare = [&](const bool changed, const std::string &name) {
      if (changed)
        console->warning(directory + "/" + name +
                         " been changed since the checkpoint was written, and "
                         "stays as it is. Put back what the run had written");
    };
    compare(then.history != files.history, "history.csv has");
    compare(then.observations != files.observations &&
              then.observations * files.observations != 0., // both are there
            "observations.csv has");
    compare(then.frames != files.frames,
            "points.pvd, grid.pvd or body.pvd has");
  }

  void
  Recorder::check_for_lost_rows(const bool may_be_lost)
  {
    constexpr double tolerance    = 1e-6; // times are rounded in the file
    const MPI_Comm   communicator = parts.grid.communicator();
    double           found        = -1.; // no rows
    if (parts.grid.is_first_rank())
      if (const auto rows = history->rows_until(parts.clock.time);
          !rows.empty())
        found = rows.back()[0];
    found = Utilities::MPI::broadcast(communicator, found);
    if (std::abs(found - last_record) <= tolerance * last_record)
      return;
    const std::string text =
      directory + "/history.csv " +
      (found < 0. ? "has no rows" : "ends at t = " + to_text(found, 6) + " s") +
      ", and the run that wrote the checkpoint had come to t = " +
      to_text(last_record, 6) + " s: the rows between are lost";
    if (!may_be_lost)
      throw BadInput(text + ". Put the file back, begin without --restart, or "
                            "add --overwrite to resume without these rows.");
    console->warning(text);
  }

  void
  Recorder::begin()
  {
    first_step        = parts.clock.step;
    seconds_at_start  = wall_time;
    fraction_at_start = parts.schedule.fraction_done();
  }

  double
  Recorder::seconds_running() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                         start_time)
      .count();
  }

  void
  Recorder::message(const std::string &text)
  {
    console->message(text);
  }

  void
  Recorder::print_header(const ParameterOrigins &input)
  {
    known.assumed = input.assumed();
    const unsigned long n_points =
      Utilities::MPI::sum<unsigned long>(parts.points.n_points(),
                                         parts.grid.communicator());
    Console::Lines first = {
      {"caisson_mpm",
       std::string(program_version()) + ", deal.II " DEAL_II_PACKAGE_VERSION},
      {"scene", known.scene_file},
      {"output", directory},
      {"kernels", known.kernels + ", " + to_text(n_lanes) + " lanes"},
      {"ranks", to_text(parts.grid.n_ranks())},
      {"step limited by", parts.time_step.reason()}};
    if (const double n_steps = steps_left(); std::isfinite(n_steps))
      first.emplace_back("steps", "about " + rough(n_steps));
    if (!known.installation.empty())
      first.emplace_back("installation", known.installation);
    console->header(first);
    std::vector<std::pair<std::string, std::string>> lines = {
      {"title", known.title},
      {"grid", parts.grid.lines().description()},
      {"material points",
       to_text(n_points) + ", and " + to_text(parts.grid.n_body_cells()) +
         " of the body (" + to_text(parts.body.mass() / 1000., 6) + " t)"},
      {"method", parts.nodal_motion.settings().description()},
      {"time step",
       to_text(parts.clock.step_size, 6) + " s, mass scaling " +
         to_text(parts.soil.mass_scaling() * parts.time_step.inertia_at_tip(),
                 6) +
         (parts.time_step.has_inertia_tolerance() ? " at the start" : "")},
      {"end", parts.schedule.end_description()}};
    const auto more = parts.water->report(parts.materials).lines;
    lines.insert(lines.end(), more.begin(), more.end());
    for (const std::string &routine : parts.soil.user_routines())
      lines.emplace_back("user material", routine);
    console->summary(lines);
    for (const std::string &warning : input.warnings())
      console->warning(warning,
                       input.is_cosmetic(warning) ? WarningRank::cosmetic :
                                                    WarningRank::input);
    for (const std::string &warning : earlier_warnings)
      console->warning(warning);
  }

  // ------------------------------------------------------------ the end

  void
  Recorder::write_points()
  {
    if (observations.checked_quantities().empty())
      return;
    const AllPoints all_points(parts.points,
                               parts.water->pressure_in_stress(),
                               parts.grid.communicator());
    if (parts.grid.is_first_rank())
      observations.write_points(directory + "/points.csv",
                                all_points,
                                parts.clock.time);
  }

  RunFacts
  Recorder::facts(const std::string &status) const
  {
    RunFacts result = own_facts(status);
    result.point_steps =
      Utilities::MPI::sum(point_steps, parts.grid.communicator());
    return result;
  }

  RunFacts
  Recorder::own_facts(const std::string &status) const
  {
    RunFacts result  = known;
    result.status    = status;
    result.n_steps   = parts.clock.step;
    result.wall_time = seconds_running();
    result.warnings  = console->warnings();
    return result;
  }

  void
  Recorder::write_summary(const std::string &status)
  {
    parts.totals.bring_to_first_rank(parts.grid.communicator());
    write_run_summary(directory + "/run.json", parts, facts(status));
    record_files();
  }

  void
  Recorder::record_files() const
  {
    if (!parts.grid.is_first_rank())
      return;
    std::vector<std::string> names = {"history.csv", "run.json"};
    if (observed)
      names.emplace_back("observations.csv");
    if (wall_file)
      names.emplace_back("wall.csv");
    if (!observations.checked_quantities().empty())
      names.emplace_back("points.csv");
    for (const std::string series : {"points", "grid", "body"})
      for (const char *const end : {".pvd", "_by_penetration.pvd"})
        names.push_back(series + end);
    locked_directory->record(names);
  }

  void
  Recorder::write_progress(const double fraction_done,
                           const double eta_seconds) const
  {
    RunFacts facts = own_facts("running");
    facts.progress = {{"fraction_done", fraction_done},
                      {"remaining_s", eta_seconds}};
    write_early_summary(directory + "/run.json", parts, facts);
  }

  void
  Recorder::write_failure(const std::string &reason) noexcept
  {
    try
      {
        RunFacts facts = own_facts("failed");
        facts.failure  = reason;
        write_early_summary(directory + "/run.json", parts, facts);
        record_files();
      }
    catch (const std::exception &)
      {
        // the failure itself is what must be reported
      }
  }

  void
  Recorder::print_report()
  {
    print_run_report(*console, parts);
    warn_of_no_rest();
  }

  void
  Recorder::warn_of_no_rest()
  {
    const BodyMotion &motion = parts.body.motion();
    if (!motion.traits.follows_loads || motion.travel_at_rest())
      return;
    const LidCompartment *const lid    = parts.water->traits().lid;
    const std::string           weight = "Rigid body/Submerged weight (" +
                               to_text(parts.body.submerged_weight(), 3) +
                               " N)";
    console->warning(
      std::string("the body has not come to rest") +
      (lid != nullptr && !lid->is_sealed() ?
         ", so that the suction, which begins then, has not begun. " :
         ". ") +
      (parts.schedule.is_at_end_penetration() ?
         "Down to Time/End penetration the soil bears less than its loads: "
         "check " +
           weight + ", or set a deeper end" :
         "Set a later Time/End time, or finer cells at the tip, or check " +
           weight));
  }

  void
  Recorder::print_result()
  {
    Console::Lines lines = {{"finished",
                             "at t = " + to_text(parts.clock.time, 6) +
                               " s, after " + to_text(seconds_running(), 3) +
                               " s"}};
    if (const auto n_warnings = console->warnings().size())
      lines.emplace_back("warnings",
                         to_text(n_warnings) +
                           ", printed above and kept in run.json");
    lines.emplace_back("results",
                       directory +
                         ": history.csv, run.json, points.pvd, grid.pvd" +
                         (parts.body.shape().exists() ? ", body.pvd" : ""));
    console->header(lines);
    console->header(
      {{"next",
        "open " + directory +
          "/report.html, which scripts/run (of an installed program: caisson "
          "run) writes now, and scripts/caisson report " +
          directory +
          " at any time; --restart with a later end continues the run"}});
  }
} // namespace CaissonMPM
