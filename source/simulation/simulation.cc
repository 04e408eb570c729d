// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/declared_entries.h>
#include <caisson_mpm/output/run_summary.h>
#include <caisson_mpm/simulation/simulation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/revision.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <limits>
#include <sstream>

namespace CaissonMPM
{
  using namespace dealii;

  Simulation::Simulation(const MPI_Comm communicator)
    : ParameterAcceptor("/")
    , grid(communicator)
    , points(grid)
  {
    if (Utilities::MPI::n_mpi_processes(communicator) > 1)
      throw BadInput("this version runs on one rank; start it without mpirun.");
    const Patterns::Double not_negative(0.);
    add_parameter("Title", title, "What the scene is. Units: none.");
    enter_subsection("Method");
    add_parameter("Instruction set",
                  instruction_set,
                  "Of the kernels; auto: the widest of this CPU. Units: none.",
                  prm,
                  Patterns::Selection("auto|SSE2|AVX2|AVX-512"));
    leave_subsection();
    enter_subsection("Time");
    add_parameter("End time",
                  last_time,
                  "The run ends at this time; 0: see End penetration. Units: "
                  "s.",
                  prm,
                  not_negative);
    add_parameter("End penetration",
                  last_penetration,
                  "The run ends when the body's tip has come this deep; 0: see "
                  "End time. Units: m.",
                  prm,
                  not_negative);
    leave_subsection();
    enter_subsection("Output");
    add_parameter(
      "Directory",
      directory,
      "Where all files of the run go; made if missing. Units: none.");
    add_parameter("Terminal",
                  terminal,
                  "full; plain: nothing that differs from run to run; silent. "
                  "Units: none.",
                  prm,
                  Patterns::Selection("full|plain|silent"));
    add_parameter("Record interval",
                  record_interval,
                  "Time between rows of history.csv; forces are means over it; "
                  "0: a row for every step. Units: s.",
                  prm,
                  not_negative);
    add_parameter("Frame interval",
                  frame_interval,
                  "Time between frames (VTU); 0: first and last only. Units: "
                  "s.",
                  prm,
                  not_negative);
    add_parameter("Frame penetrations",
                  frame_penetrations,
                  "Penetrations at which further frames are written. Units: "
                  "m.",
                  prm,
                  Patterns::List(Patterns::Double(0.), 0, 1000));
    add_parameter("Checkpoint interval",
                  checkpoint_interval,
                  "Wall time between checkpoints; 0: only when stopped. Units: "
                  "s.",
                  prm,
                  not_negative);
    leave_subsection();
  }

  // ------------------------------------------------------------ set-up

  double
  Simulation::end_time() const
  {
    double end =
      last_time > 0. ? last_time : std::numeric_limits<double>::infinity();
    if (last_penetration > 0.)
      end =
        std::min(end,
                 body.time_of_travel(last_penetration - body.initial_depth()));
    return end;
  }

  void
  Simulation::validate()
  {
    soil.check_parameters();
    body.check_parameters();
    grid.check_parameters();
    generator.check_parameters();
    boundary_conditions.check_parameters(grid);
    loads.check_parameters();
    nodal_motion.check_parameters();
    observations.initialize(Records::names({}));
    verification.check_parameters(observations.names());
    if (last_penetration > 0. && last_penetration < body.initial_depth() &&
        !std::isfinite(end_time()))
      throw BadInput(
        "Time/End penetration = " + std::to_string(last_penetration) +
        " m is less than Rigid body/Initial penetration = " +
        std::to_string(body.initial_depth()) +
        " m. Push deeper, start higher, or pull with a negative velocity.");
    if (!std::isfinite(end_time()))
      throw BadInput(
        "the run has no end: set Time/End time, or Time/End penetration to a "
        "depth that the body reaches with its velocity.");
    if (Kernels::select_kernels(instruction_set.c_str()) == nullptr)
      throw BadInput("Method/Instruction set = " + instruction_set +
                     ": this CPU does not have it. Set auto.");
    const auto range = body.travel_range(end_time());
    grid.place_lines(body, soil, range.second, -range.first);
  }

  void
  Simulation::set_up(const std::string &output_directory, const bool restart)
  {
    validate();
    if (!output_directory.empty())
      directory = output_directory;
    prepare_output_directory(directory);
    console = std::make_unique<Console>(
      terminal == "full"  ? Console::Verbosity::full :
      terminal == "plain" ? Console::Verbosity::plain :
                            Console::Verbosity::silent);
    records       = std::make_unique<Records>(directory, observations);
    visualization = std::make_unique<Visualization>(directory);
    stop_request.arm(directory);
    kernels = Kernels::select_kernels(instruction_set.c_str());

    grid.create_mesh();
    body_points = generate_body_points(grid, body);
    contact.initialize(grid, body);
    boundary_conditions.initialize(grid);
    loads.initialize(time_step.mass_scaling);
    nodal_motion.initialize(grid);
    materials = soil.kernel_materials(time_step.mass_scaling);

    wrong_error_bar = error_bar.read(scene, fingerprint_of(changed_physics()));
    schedule_frames();
    if (restart)
      resume();
    else
      start();
    while (next_frame < frame_times.size() &&
           frame_times[next_frame] <= time + 1e-9)
      ++next_frame;
    first_step   = step;
    start_of_run = time;
  }

  void
  Simulation::schedule_frames()
  {
    for (const double depth : frame_penetrations)
      frame_times.push_back(body.time_of_travel(depth - body.initial_depth()));
    for (unsigned int i = 1;
         frame_interval > 0. && i * frame_interval < end_time() - 1e-9;
         ++i)
      frame_times.push_back(i * frame_interval);
    frame_times.push_back(end_time());
    std::sort(frame_times.begin(), frame_times.end());
    frame_times.erase(std::unique(frame_times.begin(),
                                  frame_times.end(),
                                  [](const double a, const double b) {
                                    return b - a < 1e-9;
                                  }),
                      frame_times.end());
  }

  void
  Simulation::start()
  {
    generator.generate(grid, body, soil, time_step.mass_scaling, points);
    energy.start(point_energies());
    choose_step(); // refuses a fixed step that is too large
    records->create();
    next_record = record_interval;
  }

  void
  Simulation::resume()
  {
    const CheckpointState state =
      read_checkpoint(directory, grid, points, fingerprint());
    time      = state.time;
    step      = state.step;
    n_limited = state.limiter_count;
    points.set_n_held_back(state.held_back);
    resume_record(state.more);
    records->resume(time);
    visualization->resume(time);
  }

  void
  Simulation::print_header(const std::string &scene_file)
  {
    double mass = 0.;
    for (const BodyPoint &p : body_points)
      mass += p.mass;
    const auto text = [](const auto &value) {
      std::ostringstream s;
      s << value;
      return s.str();
    };
    choose_step();
    console->header(
      {{"caisson_mpm",
        CAISSON_MPM_VERSION ", deal.II " DEAL_II_PACKAGE_VERSION},
       {"scene", scene_file},
       {"output", directory},
       {"kernels",
        std::string(kernels->name) + ", " + text(kernels->width) + " lanes"},
       {"limit of the step", time_step.reason()}});
    console->summary(
      {{"title", title},
       {"grid", grid.description()},
       {"material points",
        text(points.n_points()) + ", and " + text(body_points.size()) +
          " of the body (" + text(mass / 1000.) + " t)"},
       {"method", nodal_motion.description()},
       {"time step",
        text(dt) + " s, mass scaling " + text(time_step.mass_scaling)},
       {"end", text(end_time()) + " s"}});
    if (!wrong_error_bar.empty())
      console->warning(wrong_error_bar);
    if (time_step.mass_scaling > 100.)
      console->warning(
        "Time/Mass scaling above 100 has been seen to change the "
        "tip force by more than 5 %");
  }

  // ------------------------------------------------------------ one step

  double
  Simulation::choose_step()
  {
    dt = time_step.choose(grid, points, soil, materials);
    // do not step over the next event; share what is left evenly
    double event = end_time();
    if (record_interval > 0.)
      event = std::min(event, next_record);
    if (next_frame < frame_times.size())
      event = std::min(event, frame_times[next_frame]);
    const double left = event - time;
    if (left > 0.)
      dt = left / std::ceil(left / dt * (1. - 1e-9));
    return dt;
  }

  void
  Simulation::advance()
  {
    const auto view = grid.view();
    NodalWork  work;
    choose_step();
    timed("points to grid", [&]() {
      nodal_motion.collect(*kernels, points, grid, materials, loads, time);
    });
    timed("nodal motion", [&]() { nodal_motion.accelerate(dt, contact); });
    timed("contact", [&]() {
      boundary_conditions.prepare(grid, time, dt);
      nodal_motion.constrain(dt, body_velocity(), boundary_conditions, contact);
    });
    timed("transfer", [&]() {
      nodal_motion.prepare_transfer(
        *kernels, points.view(), view, boundary_conditions, contact);
      work = nodal_motion.work_of_step(dt, boundary_conditions, contact);
    });
    timed("move mesh", [&]() { grid.prepare_motion(body.travel(time + dt)); });
    timed("grid to points", [&]() { update_points(view); });
    timed("relocate", [&]() {
      grid.advance();
      points.relocate();
    });
    energy.add(work, circumference() * points.leaving().stress_work);
    time += dt;
    ++step;
  }

  template <typename Action>
  void
  Simulation::timed(const char *section, const Action &action)
  {
    SectionTimer::Scope scope(timer, timer.section(section));
    action();
  }

  Vector2
  Simulation::body_velocity() const
  {
    // of the whole step, so that body and mesh move alike
    return (body.travel(time + dt) - body.travel(time)) / dt * body.direction();
  }

  void
  Simulation::update_points(const Kernels::GridView &view)
  {
    if (!nodal_motion.is_finite)
      report_not_finite();
    auto &leaving = points.leaving();
    kernels->grid_to_points(points.view(),
                            view,
                            grid.next(),
                            materials.data(),
                            nodal_motion.cell_moments(),
                            nodal_motion.update_settings(dt),
                            nodal_motion.fields(),
                            leaving);
    n_limited += leaving.n_limited;
    point_steps += points.n_points();
  }

  void
  Simulation::report_not_finite() const
  {
    std::ostringstream s;
    s << "the state is not finite in step " << step << " at t = " << time
      << " s";
    bool found = false;
    points.for_each([&](const MaterialPoint &p, const unsigned int) {
      double sum = p.position[0] + p.position[1] + p.velocity[0] +
                   p.velocity[1] + p.mass + p.volume;
      for (const double component : p.stress)
        sum += component;
      if (!found && !std::isfinite(sum))
        {
          found = true;
          s << ": the first is material point " << static_cast<long>(p.id)
            << ", which began at r = " << p.initial_position[0]
            << " m, z = " << p.initial_position[1] << " m";
        }
    });
    s << ". Likely causes: a time step too large for the deformed mesh (reduce "
         "Time/Courant number), an unstable choice in section Method (the "
         "defaults are MUSL, blend and Mass floor = true), or a parameter of "
         "the soil that is out of any range. The files written so far are "
         "kept.";
    throw RunFailure(s.str());
  }

  // ------------------------------------------------------------ the run

  ExitStatus
  Simulation::run(const std::string &scene_file,
                  const std::string &output_directory,
                  const bool         restart)
  {
    start_time = std::chrono::steady_clock::now();
    scene      = scene_file;
    set_up(output_directory, restart);
    print_header(scene_file);
    if (!restart)
      {
        write_frame();
        record();
      }
    const double end = end_time();
    while (time < end - 1e-9 * std::max(1., end))
      {
        advance();
        output();
        const std::string reason = stop_request.reason();
        if (!reason.empty())
          {
            save_checkpoint();
            write_summary("stopped");
            console->message("stopped: " + reason + "; go on with --restart");
            return ExitStatus::stopped;
          }
      }
    const bool passed =
      verification.empty() ||
      verification.run(points, *records, time, directory, *console);
    write_summary(passed ? "finished" : "verification failed");
    print_counts();
    print_energies();
    print_times();
    return passed ? ExitStatus::success : ExitStatus::failure;
  }

  void
  Simulation::output()
  {
    SectionTimer::Scope scope(timer, timer.section("output"));
    if (time >= next_record - 1e-9 || time >= end_time() - 1e-9)
      {
        record();
        next_record += record_interval;
      }
    if (next_frame < frame_times.size() &&
        time >= frame_times[next_frame] - 1e-9)
      {
        write_frame();
        ++next_frame;
      }
    if (checkpoint_interval > 0. &&
        seconds_running() - next_checkpoint > checkpoint_interval)
      {
        save_checkpoint();
        next_checkpoint = seconds_running();
      }
  }

  void
  Simulation::record()
  {
    HistoryRow row;
    row.time           = time;
    row.penetration    = body.initial_depth() + body.travel(time);
    row.step           = step;
    row.time_step      = dt;
    row.limiter_count  = n_limited;
    row.held_back      = points.n_held_back();
    row.contact_nodes  = contact.n_touching;
    row.sticking_nodes = contact.n_sticking;
    add_forces(row);
    add_sums_over_points(row);
    records->append(row, points);
    print_record(row);
    warn_of_lid(row);
  }

  void
  Simulation::warn_of_lid(const HistoryRow &row)
  {
    if (at_lid || row.lid == 0.)
      return;
    at_lid = true;
    std::ostringstream s;
    s << "the soil plug touches the lid at a penetration of " << row.penetration
      << " m: from here on the lid carries load, and the mesh allows no more "
         "heave";
    console->warning(s.str());
  }

  void
  Simulation::add_forces(HistoryRow &row)
  {
    const double interval = time - last_record;
    double *forces[] = {&row.tip, &row.inner, &row.outer, &row.top, &row.lid};
    for (unsigned int s = 0; s < n_surfaces && interval > 0.; ++s)
      {
        *forces[s] = contact.impulse()[s][vertical] / interval;
        row.total += *forces[s];
      }
    if (body.kind() == RigidBody::Kind::cylinder && interval > 0.)
      {
        const double travel =
          .5 * (body.travel(time) + body.travel(last_record));
        const double around =
          grid.axisymmetric() ? 2. * pi * (body.right() + travel) : 1.;
        row.cavity = -contact.impulse()[outer_wall][radial] /
                     (interval * around * grid.depth());
      }
    if (interval > 0.)
      {
        row.prescribed_r = boundary_conditions.impulse()[radial] / interval;
        row.prescribed_z = boundary_conditions.impulse()[vertical] / interval;
      }
    contact.reset_impulse();
    boundary_conditions.reset_impulse();
    last_record = time;
  }

  void
  Simulation::add_sums_over_points(HistoryRow &row)
  {
    const double        travel   = body.travel(time);
    const PointEnergies energies = point_energies();
    points.for_each([&](const MaterialPoint &p, const unsigned int) {
      row.max_speed =
        std::max(row.max_speed, std::hypot(p.velocity[0], p.velocity[1]));
      row.points_in_body += body.contains(p.position, travel);
    });
    energy.close(energies);
    row.kinetic_energy = energies.kinetic;
    row.external_work  = energy.work_of_body;
    row.energy         = energy;
    row.added_mass     = circumference() * nodal_motion.added_mass;
    max_in_body        = std::max(max_in_body, row.points_in_body);
  }

  PointEnergies
  Simulation::point_energies() const
  {
    PointEnergies result;
    points.for_each([&](const MaterialPoint &p, const unsigned int) {
      for (unsigned int d = 0; d < 2; ++d)
        {
          result.kinetic +=
            .5 * circumference() * p.mass * p.velocity[d] * p.velocity[d];
          const double term = -circumference() * p.mass *
                              materials[p.material].body_force[d] *
                              p.position[d];
          result.potential += term;
          result.weight += std::abs(term);
        }
    });
    return result;
  }

  double
  Simulation::circumference() const
  {
    return grid.axisymmetric() ? 2. * pi : 1.;
  }

  void
  Simulation::print_record(const HistoryRow &row)
  {
    // where records are dense, not all of them: a line for each percent
    const bool at_end = time >= end_time() * (1. - 1e-9);
    if (time > start_of_run && !at_end &&
        time - last_printed < .01 * end_time() * (1. - 1e-9))
      return;
    last_printed = time;
    RecordLine line;
    line.time                   = time;
    line.has_body               = body.kind() != RigidBody::Kind::none;
    line.penetration            = row.penetration;
    line.tip                    = row.tip;
    line.inner                  = row.inner;
    line.outer                  = row.outer;
    line.total                  = row.total;
    line.kinetic_energy         = row.kinetic_energy;
    line.max_speed              = row.max_speed;
    line.fraction_done          = time / end_time();
    line.point_steps_per_second = point_steps / seconds_running();
    line.eta_seconds =
      time > start_of_run ?
        seconds_running() * (end_time() - time) / (time - start_of_run) :
        0.;
    console->record(line);
  }

  void
  Simulation::write_frame()
  {
    visualization->write_frame(
      grid, points, body, soil, body_points, body.travel(time), time);
  }

  double
  Simulation::seconds_running() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                         start_time)
      .count();
  }

  namespace
  {
    /** Whether an entry has no influence on the state at a given time. */
    bool
    is_not_physics(const DeclaredEntry &entry)
    {
      for (const std::string free :
           {"Output/", "Run control/", "Verification/", "Time/End"})
        if (entry.path.compare(0, free.size(), free) == 0)
          return true;
      return false;
    }
  } // namespace

  std::string
  Simulation::fingerprint() const
  {
    const DeclaredEntries entries(prm);
    std::string           result;
    for (const DeclaredEntry &entry : entries.all())
      if (!is_not_physics(entry))
        result += entry.path + " = " + entry.value + "\n";
    return result;
  }

  std::string
  Simulation::changed_physics() const
  {
    // defaults are left out, so that a new entry changes nothing
    const DeclaredEntries entries(prm);
    std::string           result;
    for (const DeclaredEntry &entry : entries.all())
      if (!is_not_physics(entry) && entry.value != entry.default_value &&
          entry.path != "Title" && entry.path != "Method/Instruction set")
        result += entry.path + " = " + entry.value + "\n";
    return result;
  }

  void
  Simulation::save_checkpoint()
  {
    CheckpointState state;
    state.time          = time;
    state.travel        = body.travel(time);
    state.step          = step;
    state.limiter_count = n_limited;
    state.held_back     = points.n_held_back();
    state.external_work = energy.work_of_body;
    state.more          = {next_record, last_record};
    for (const Vector2 &impulse : contact.impulse())
      for (unsigned int d = 0; d < 2; ++d)
        state.more.push_back(impulse[d]);
    for (unsigned int d = 0; d < 2; ++d)
      state.more.push_back(boundary_conditions.impulse()[d]);
    for (const double value : energy.state())
      state.more.push_back(value);
    write_checkpoint(directory, grid, points, state, fingerprint());
  }

  void
  Simulation::resume_record(const std::vector<double> &numbers)
  {
    next_record = numbers.at(0);
    last_record = numbers.at(1);
    SurfaceForces impulse;
    for (unsigned int i = 0; i < 2 * n_surfaces; ++i)
      impulse[i / 2][i % 2] = numbers.at(2 + i);
    contact.reset_impulse(impulse);
    boundary_conditions.reset_impulse(Vector2(
      {numbers.at(2 + 2 * n_surfaces), numbers.at(3 + 2 * n_surfaces)}));
    energy.resume({numbers.begin() + 4 + 2 * n_surfaces, numbers.end()});
  }

  void
  Simulation::write_summary(const std::string &status)
  {
    error_bar.write(directory);
    RunSummary s;
    s.fingerprint            = fingerprint_of(changed_physics());
    s.version                = CAISSON_MPM_VERSION;
    s.dealii_version         = DEAL_II_PACKAGE_VERSION;
    s.scene_file             = scene;
    s.instruction_set        = kernels->name;
    s.status                 = status;
    s.ranks                  = 1;
    s.material_points        = points.n_points();
    s.cells                  = grid.n_cells();
    s.body_points            = body_points.size();
    s.steps                  = step - first_step;
    s.limiter_count          = n_limited;
    s.held_back              = points.n_held_back();
    s.points_lost            = 0; // a lost point ends the run
    s.max_points_in_body     = max_in_body;
    s.wall_time_s            = seconds_running();
    s.point_steps_per_second = point_steps / seconds_running();
    s.peak_memory_bytes      = peak_memory_bytes();
    s.body_mass_kg           = 0.;
    for (const BodyPoint &p : body_points)
      s.body_mass_kg += p.mass;
    points.for_each([&](const MaterialPoint &p, const unsigned int) {
      s.soil_mass_kg += circumference() * p.mass;
    });
    s.time_step_s     = dt;
    s.time_step_limit = time_step.reason();
    s.energies        = energy.entries();
    s.energies.insert(s.energies.begin(),
                      {"external_work_J", energy.work_of_body});
    s.energies.insert(s.energies.begin() + 1,
                      {"kinetic_energy_gain_J", energy.kinetic_gain});
    s.sections = timer.seconds();
    if (body.kind() == RigidBody::Kind::caisson)
      s.scene = {{"diameter_m", body.outer_diameter},
                 {"wall_thickness_m", body.wall_thickness},
                 {"skirt_length_m", body.skirt_length},
                 {"initial_penetration_m", body.initial_depth()},
                 {"submerged_unit_weight_N_m3", soil.unit_weight(0)},
                 {"friction_angle_deg", soil.layer(0).friction_angle()},
                 {"wall_friction_angle_deg", body.friction_angle[outer_wall]},
                 {"K0", soil.layer(0).earth_pressure_at_rest()}};
    write_run_summary(directory + "/run.json", s);
  }

  void
  Simulation::print_counts()
  {
    console->header(
      {{"points lost", "0"}, // one ends the run
       {"points in the body", std::to_string(max_in_body) + " at any record"},
       {"held back",
        std::to_string(points.n_held_back()) + " times at the body's surface"},
       {"limiter fired", std::to_string(n_limited) + " times"}});
  }

  void
  Simulation::print_energies()
  {
    const auto percent = [](const double part) {
      std::ostringstream s;
      s << std::setprecision(3) << 100. * part << " %";
      return s.str();
    };
    const auto joule = [&](const double value) {
      std::ostringstream s;
      s << std::setprecision(6) << value << " J";
      return s.str();
    };
    console->header({{"work of the body", joule(energy.work_of_body)},
                     {"work of gravity", joule(energy.gravity_work)},
                     {"work of loads", joule(energy.load_work)},
                     {"stress work", joule(energy.stress_work)},
                     {"friction heat", joule(energy.friction_heat)},
                     {"kinetic energy", joule(energy.kinetic_gain)},
                     {"damping, mass floor",
                      joule(energy.damping) + ", " + joule(energy.floor)},
                     {"lost in the transfer", joule(energy.dissipation)},
                     {"energy residual",
                      joule(energy.residual) + ", " + percent(energy.relative) +
                        " of the work"}});
    if (std::abs(energy.relative) > .01)
      console->warning("the energy residual is " + percent(energy.relative) +
                       " of the work: see doc/limitations.md, Energy");
  }

  void
  Simulation::print_times()
  {
    std::vector<TableRow> rows;
    const double          total = seconds_running();
    double                sum   = 0.;
    for (const auto &section : timer.seconds())
      {
        rows.push_back(
          {section.first, section.second, 100. * section.second / total});
        sum += section.second;
      }
    rows.push_back({"set-up and rest", total - sum, 100. * (1. - sum / total)});
    rows.push_back({"total", total, 100.});
    console->table("wall time", rows);
  }
} // namespace CaissonMPM
