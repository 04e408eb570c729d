// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/domain/all_points.h>
#include <caisson_mpm/simulation/recorder.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/revision.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace CaissonMPM
{
  using namespace dealii;

  Recorder::Recorder(const RecordedParts &parts)
    : ParameterAcceptor("/")
    , parts(parts)
  {
    add_parameter("Title",
                  title,
                  "The title says what the scene is. Units: none.");
    enter_subsection("Output");
    add_parameter("Directory",
                  directory,
                  "All files of the run go to this directory, which is made if "
                  "it is missing. Units: none.");
    add_choice(*this,
               "Terminal",
               terminal,
               {{"full", Terminal::full},
                {"plain", Terminal::plain},
                {"silent", Terminal::silent}},
               "The program prints everything (full), only what does not "
               "differ from run to run (plain), or nothing (silent). Units: "
               "none.");
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
    totals.sum("impulse_on_soil_r", impulse_on_soil[radial]);
    totals.sum("impulse_on_soil_z", impulse_on_soil[vertical]);
    totals.keep("last_record", last_record);
    totals.keep("travel_at_record", travel_at_record);
    totals.keep("max_points_in_body", max_in_body);
    totals.keep("fingerprint_of_history", files.history);
    totals.keep("fingerprint_of_observations", files.observations);
    totals.keep("fingerprint_of_frames", files.frames);
  }

  // ------------------------------------------------------------ set-up

  void
  Recorder::check_parameters()
  {
    const auto counts = count_names();
    observations.initialize(Records::names(counts, {}));
    verification.check_parameters(Records::names(counts, observations.names()));
  }

  std::vector<std::string>
  Recorder::count_names() const
  {
    auto names = parts.totals.count_names();
    for (const std::string &name : parts.water.column_names())
      names.push_back(name);
    return names;
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
                     const std::string          &fingerprint,
                     const std::string          &installation,
                     const Kernels::KernelTable &kernels)
  {
    start_time         = std::chrono::steady_clock::now();
    scene              = scene_file;
    this->fingerprint  = fingerprint;
    this->installation = installation;
    this->kernels      = &kernels;
    wrong_error_bar_   = error_bar.read(scene, fingerprint);
    OutputDirectory::check(directory, parts.grid.communicator());
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
    console = std::make_unique<Console>(verbosity());
    records = std::make_unique<Records>(directory, observations, count_names());
    visualization = std::make_unique<Visualization>(directory);
  }

  void
  Recorder::start()
  {
    if (parts.grid.is_first_rank())
      {
        if (const unsigned int n_files = locked_directory->clear())
          console->header(
            {{"removed",
              to_text(n_files) + " files of an earlier run in " + directory}});
        records->create();
      }
    begin();
  }

  void
  Recorder::resume()
  {
    if (parts.grid.is_first_rank())
      records->resume(parts.clock.time);
    visualization->resume(parts.clock.time);
    warn_of_lost_rows();
    warn_of_changed_files();
    begin();
  }

  void
  Recorder::note_files()
  {
    files = {records->history_fingerprint(),
             records->observations_fingerprint(),
             visualization->fingerprint()};
  }

  void
  Recorder::warn_of_changed_files()
  {
    const Files then = files;
    note_files();
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
    compare(then.frames != files.frames, "points.pvd or grid.pvd has");
  }

  void
  Recorder::warn_of_lost_rows()
  {
    constexpr double tolerance = 1e-6; // times are rounded in the file
    const double     found     = records->last_time();
    if (!parts.grid.is_first_rank() ||
        std::abs(found - last_record) <= tolerance * last_record)
      return;
    console->warning(
      directory + "/history.csv " +
      (found < 0. ? "has no rows" : "ends at t = " + to_text(found, 6) + " s") +
      ", and the run that wrote the checkpoint had come to t = " +
      to_text(last_record, 6) +
      " s: the rows between are lost. Put the file back, or begin without "
      "--restart");
  }

  void
  Recorder::begin()
  {
    first_step        = parts.clock.step;
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
  Recorder::print_header(const std::vector<std::string> &warnings)
  {
    double own_mass = 0.;
    for (const BodyPoint &p : parts.body_points)
      own_mass += p.mass;
    const MPI_Comm communicator = parts.grid.communicator();
    const double   mass         = Utilities::MPI::sum(own_mass, communicator);
    const auto     sum          = [communicator](const unsigned long value) {
      return to_text(Utilities::MPI::sum(value, communicator));
    };
    const std::string n_points      = sum(parts.points.n_points()),
                      n_body_points = sum(parts.body_points.size());
    Console::Lines first            = {
                 {"caisson_mpm", CAISSON_MPM_VERSION ", deal.II " DEAL_II_PACKAGE_VERSION},
                 {"scene", scene},
                 {"output", directory},
                 {"kernels",
                  std::string(kernels->name) + ", " + to_text(kernels->width) + " lanes"},
                 {"ranks", to_text(parts.grid.n_ranks())},
                 {"step limited by", parts.time_step.reason()}};
    if (!installation.empty())
      first.emplace_back("installation", installation);
    console->header(first);
    std::vector<std::pair<std::string, std::string>> lines = {
      {"title", title},
      {"grid", parts.grid.lines().description()},
      {"material points",
       n_points + ", and " + n_body_points + " of the body (" +
         to_text(mass / 1000., 6) + " t)"},
      {"method", parts.nodal_motion.settings().description()},
      {"time step",
       to_text(parts.clock.step_size, 6) + " s, mass scaling " +
         to_text(parts.soil.mass_scaling(), 6)},
      {"end", parts.schedule.end_description()}};
    const auto of_water = parts.water.description(parts.materials);
    lines.insert(lines.end(), of_water.begin(), of_water.end());
    console->summary(lines);
    for (const std::string &warning : warnings)
      console->warning(warning);
  }

  // ------------------------------------------------------------ records

  void
  Recorder::add_step(const SurfaceForces &on_body,
                     const Vector2       &on_prescribed_soil)
  {
    for (unsigned int s = 0; s < n_surfaces; ++s)
      impulse_on_body[s] += on_body[s];
    impulse_on_soil += on_prescribed_soil;
    point_steps += parts.points.n_points();
  }

  void
  Recorder::record()
  {
    const MPI_Comm communicator = parts.grid.communicator();
    parts.totals.bring_to_first_rank(communicator);
    HistoryRow row;
    row.time        = parts.clock.time;
    row.penetration = parts.body.penetration();
    row.step        = parts.clock.step;
    row.time_step   = parts.clock.step_size;
    row.contact_nodes =
      Utilities::MPI::sum(parts.nodal_motion.reactions().contact.n_touching,
                          communicator);
    row.sticking_nodes =
      Utilities::MPI::sum(parts.nodal_motion.reactions().contact.n_sticking,
                          communicator);
    row.counts = parts.totals.counts();
    for (const auto &column : parts.water.columns())
      row.counts.push_back(column);
    add_forces(row);
    add_sums_over_points(row);
    const std::vector<double> observed = observed_values();
    if (parts.grid.is_first_rank())
      records->append(row, observed);
    print_record(row);
    warn_of_lid(row);
    for (const std::string &warning : parts.water.take_warnings())
      console->warning(warning);
    tell_of_rest();
    note_files();
  }

  void
  Recorder::add_forces(HistoryRow &row)
  {
    const double  interval = parts.clock.time - last_record;
    double *const forces[] = {
      &row.tip, &row.inner, &row.outer, &row.top, &row.lid};
    for (unsigned int s = 0; s < n_surfaces; ++s)
      {
        if (interval > 0.)
          recorded_forces[s] = impulse_on_body[s][vertical] / interval;
        *forces[s] = recorded_forces[s];
        row.total += *forces[s];
      }
    if (interval > 0.)
      {
        row.cavity       = cavity_pressure(interval);
        row.prescribed_r = impulse_on_soil[radial] / interval;
        row.prescribed_z = impulse_on_soil[vertical] / interval;
      }
    impulse_on_body  = {};
    impulse_on_soil  = Vector2();
    last_record      = parts.clock.time;
    travel_at_record = parts.body.motion().travel();
  }

  double
  Recorder::cavity_pressure(const double interval) const
  {
    if (!parts.body.shape().expands())
      return 0.;
    const GridLines &lines = parts.grid.lines();
    const double     travel =
      .5 * (parts.body.motion().travel() + travel_at_record);
    const double around = lines.axisymmetric() ?
                            2. * pi * (parts.body.shape().right() + travel) :
                            1.;
    return -impulse_on_body[outer_wall][radial] /
           (interval * around * lines.depth());
  }

  void
  Recorder::add_sums_over_points(HistoryRow &row)
  {
    const double travel     = parts.body.motion().travel();
    double       max_square = 0.;
    parts.points.for_each_motion([&](const Point<2> &position,
                                     const Vector2  &velocity,
                                     const double,
                                     const unsigned int) {
      max_square = std::max(max_square, velocity.norm_square());
      row.points_in_body += parts.body.shape().contains(position, travel);
    });
    const MPI_Comm communicator = parts.grid.communicator();
    row.max_speed = Utilities::MPI::max(std::sqrt(max_square), communicator);
    row.points_in_body = Utilities::MPI::sum(row.points_in_body, communicator);
    max_in_body        = std::max(max_in_body, row.points_in_body);

    const PointEnergies energies =
      find_point_energies(parts.points, parts.materials, parts.grid);
    parts.energy.close(energies);
    row.kinetic_energy = energies.kinetic;
    row.external_work  = parts.energy.work_of_body;
    row.energy         = parts.energy;
    row.added_mass =
      parts.grid.circumference() *
      Utilities::MPI::sum(parts.nodal_motion.added_inertia(), communicator);
  }

  std::vector<double>
  Recorder::observed_values() const
  {
    if (observations.names().empty())
      return {};
    const AllPoints all_points(parts.points, parts.grid.communicator());
    return parts.grid.is_first_rank() ?
             observations.values(all_points, parts.clock.time) :
             std::vector<double>();
  }

  void
  Recorder::warn_of_lid(const HistoryRow &row)
  {
    if (at_lid || row.lid == 0.)
      return;
    at_lid = true;
    console->warning("the soil plug touches the lid at a penetration of " +
                     to_text(row.penetration, 6) +
                     " m: from here on the lid carries load, and the mesh "
                     "allows no more heave");
  }

  void
  Recorder::tell_of_rest()
  {
    const auto travel = parts.body.motion().travel_at_rest();
    if (has_told_of_rest || !travel)
      return;
    has_told_of_rest = true;
    console->message("the body came to rest at a penetration of " +
                     to_text(parts.body.shape().initial_depth() + *travel, 5) +
                     " m");
  }

  void
  Recorder::print_record(const HistoryRow &row)
  {
    const double all_steps =
      Utilities::MPI::sum(point_steps, parts.grid.communicator());
    // where records are dense, not all of them: a line for each percent
    const double done     = parts.schedule.fraction_done();
    const bool   is_first = parts.clock.step == first_step;
    if (!is_first && !parts.schedule.is_finished() &&
        done - fraction_printed < .01 * (1. - 1e-9))
      return;
    fraction_printed = done;
    RecordLine line;
    line.time                   = row.time;
    line.has_body               = parts.body.shape().exists();
    line.penetration            = row.penetration;
    line.tip                    = row.tip;
    line.inner                  = row.inner;
    line.outer                  = row.outer;
    line.total                  = row.total;
    line.kinetic_energy         = row.kinetic_energy;
    line.max_speed              = row.max_speed;
    line.fraction_done          = done;
    line.point_steps_per_second = all_steps / seconds_running();
    line.eta_seconds =
      is_first ? std::numeric_limits<double>::quiet_NaN() :
                 seconds_running() * (1. - done) / (done - fraction_at_start);
    console->record(line);
  }

  void
  Recorder::write_frame()
  {
    visualization->write_frame(parts.grid,
                               parts.points,
                               parts.body,
                               parts.soil,
                               parts.body_points,
                               parts.water.acts(),
                               parts.clock.time);
    note_files();
  }

  // ------------------------------------------------------------ the end

  bool
  Recorder::verify()
  {
    if (verification.empty())
      return true;
    const MPI_Comm  communicator = parts.grid.communicator();
    const AllPoints all_points(parts.points, communicator);
    const bool      passed =
      !parts.grid.is_first_rank() || verification.run(all_points,
                                                      *records,
                                                      parts.clock.time,
                                                      directory,
                                                      *console);
    return Utilities::MPI::min(passed ? 1 : 0, communicator) == 1;
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
    RunFacts result;
    result.status         = status;
    result.scene_file     = scene;
    result.title          = title;
    result.fingerprint    = fingerprint;
    result.installation   = installation;
    result.kernels        = kernels->name;
    result.n_repartitions = n_repartitions;
    result.max_in_body    = max_in_body;
    result.n_steps        = parts.clock.step - first_step;
    result.wall_time      = seconds_running();
    result.warnings       = console->warnings();
    return result;
  }

  void
  Recorder::write_summary(const std::string &status)
  {
    parts.totals.bring_to_first_rank(parts.grid.communicator());
    if (parts.grid.is_first_rank())
      error_bar.write(directory);
    write_run_summary(directory + "/run.json", parts, facts(status));
  }

  void
  Recorder::write_failure(const std::string &reason) noexcept
  {
    try
      {
        RunFacts known = own_facts("failed");
        known.failure  = reason;
        write_failure_summary(directory + "/run.json", parts, known);
      }
    catch (const std::exception &)
      {
        // the failure itself is what must be told
      }
  }

  void
  Recorder::print_report()
  {
    print_run_report(*console, parts, facts(""));
    warn_of_no_rest();
  }

  void
  Recorder::warn_of_no_rest()
  {
    const BodyMotion &motion = parts.body.motion();
    if (!motion.follows_loads() || motion.travel_at_rest())
      return;
    const std::string weight = "Rigid body/Submerged weight (" +
                               to_text(parts.body.submerged_weight(), 3) +
                               " N)";
    console->warning(
      std::string("the body has not come to rest") +
      (parts.water.has_suction() ?
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
    if (parts.grid.is_first_rank() && parts.body.shape().exists() &&
        !parts.body.shape().expands())
      {
        constexpr double always = std::numeric_limits<double>::max();
        const auto force = records->series("total_force_N", 0., always).value,
                   depth = records->series("penetration_m", 0., always).value;
        const auto largest =
          std::max_element(force.begin(),
                           force.end(),
                           [](const double a, const double b) {
                             return std::abs(a) < std::abs(b);
                           }) -
          force.begin();
        lines.emplace_back("largest force",
                           to_text(1e-3 * force[largest], 5) +
                             " kN at a penetration of " +
                             to_text(depth[largest], 5) + " m");
      }
    lines.emplace_back("results",
                       directory +
                         ": history.csv, run.json, points.pvd, grid.pvd");
    lines.emplace_back("next",
                       "scripts/plot " + directory +
                         " draws the results (of an installed program: "
                         "caisson plot); --restart with a later end continues "
                         "the run");
    console->header(lines);
  }
} // namespace CaissonMPM
