// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/simulation/simulation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/revision.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numeric>
#include <sstream>

namespace CaissonMPM
{
  using namespace dealii;

  Simulation::Simulation(const MPI_Comm communicator)
    : ParameterAcceptor("/")
    , grid(lines, communicator)
    , points(grid)
  {
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
      end = std::min(end,
                     body.motion()
                       .time_of_travel(last_penetration -
                                       body.shape().initial_depth())
                       .value());
    return end;
  }

  void
  Simulation::validate()
  {
    soil.check_parameters();
    body.check_parameters();
    lines.check_parameters();
    generator.check_parameters();
    boundary_conditions.check_parameters(lines);
    loads.check_parameters();
    nodal_motion.check_parameters();
    observations.initialize(Records::names({}));
    verification.check_parameters(observations.names());
    if (last_penetration > 0. &&
        last_penetration < body.shape().initial_depth() &&
        !std::isfinite(end_time()))
      throw BadInput(
        "Time/End penetration = " + to_text(last_penetration) +
        " m is less than Rigid body/Initial penetration = " +
        to_text(body.shape().initial_depth()) +
        " m. Push deeper, start higher, or pull with a negative velocity.");
    if (!std::isfinite(end_time()))
      throw BadInput(
        "the run has no end: set Time/End time, or Time/End penetration to a "
        "depth that the body reaches with its velocity.");
    if (Kernels::select_kernels(instruction_set.c_str()) == nullptr)
      throw BadInput("Method/Instruction set = " + instruction_set +
                     ": this CPU does not have it. Set auto.");
    const auto range = body.motion().travel_range(end_time()).value();
    lines.place(body.shape(), soil, range.second, -range.first);
  }

  void
  Simulation::set_up(const std::string &output_directory, const bool restart)
  {
    validate();
    if (!output_directory.empty())
      directory = output_directory;
    prepare_output_directory(directory);
    console = std::make_unique<Console>(
      !grid.is_first_rank() ? Console::Verbosity::silent :
      terminal == "full"    ? Console::Verbosity::full :
      terminal == "plain"   ? Console::Verbosity::plain :
                              Console::Verbosity::silent);
    records       = std::make_unique<Records>(directory, observations);
    visualization = std::make_unique<Visualization>(directory);
    stop_request.arm(directory);
    kernels = Kernels::select_kernels(instruction_set.c_str());

    grid.create_mesh();
    set_up_part();
    loads.initialize(time_step.mass_scaling);
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
  Simulation::set_up_part()
  {
    body_points = generate_body_points(grid, body);
    contact.initialize(grid, body.surface());
    boundary_conditions.initialize(grid);
    nodal_motion.initialize(grid);
    grid.move_to(body.motion().travel());
  }

  void
  Simulation::balance()
  {
    if (grid.n_ranks() == 1)
      return;
    const auto imbalance = [this](const std::vector<unsigned int> &costs) {
      const auto work = Utilities::MPI::min_max_avg(
        std::accumulate(costs.begin(), costs.end(), 0.), grid.communicator());
      return work.max / work.avg;
    };
    const auto costs = points.cell_costs();
    if (imbalance(costs) <= accepted_imbalance)
      return;
    const auto traveling = points.take_all();
    grid.repartition(costs);
    set_up_part();
    points.redistribute(traveling);
    // a part is made of whole cells: it may be impossible to do better
    ++n_repartitions;
    accepted_imbalance = std::max(1.1, 1.05 * imbalance(points.cell_costs()));
  }

  void
  Simulation::schedule_frames()
  {
    for (const double depth : frame_penetrations)
      frame_times.push_back(
        body.motion()
          .time_of_travel(depth - body.shape().initial_depth())
          .value());
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
    generator.generate(
      grid, body.shape(), soil, time_step.mass_scaling, points);
    balance();
    body.motion().start();
    energy.start(point_energies());
    choose_step(); // refuses a fixed step that is too large
    if (grid.is_first_rank())
      records->create();
    next_record = record_interval;
  }

  void
  Simulation::resume()
  {
    const CheckpointState state =
      read_checkpoint(directory, grid, points, fingerprint());
    time                  = state.time;
    step                  = state.step;
    next_record           = state.more.at(0);
    last_record           = state.more.at(1);
    travel_of_last_record = state.more.at(2);
    RunTotals motion;
    body.motion().register_totals(motion);
    NamedNumbers motion_state = motion.state();
    for (unsigned int i = 0; i < 3; ++i)
      motion_state[i].second = state.more.at(3 + i);
    motion.resume(motion_state, grid.is_first_rank());
    balance();
    if (grid.is_first_rank())
      {
        resume_sums(state);
        records->resume(time);
      }
    visualization->resume(time);
  }

  void
  Simulation::print_header(const std::string &scene_file)
  {
    double own_mass = 0.;
    for (const BodyPoint &p : body_points)
      own_mass += p.mass;
    const MPI_Comm      communicator = grid.communicator();
    const double        mass = Utilities::MPI::sum(own_mass, communicator);
    const unsigned long n_points =
      Utilities::MPI::sum<unsigned long>(points.n_points(), communicator);
    const unsigned long n_body_points =
      Utilities::MPI::sum<unsigned long>(body_points.size(), communicator);
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
       {"ranks", text(grid.n_ranks())},
       {"limit of the step", time_step.reason()}});
    console->summary(
      {{"title", title},
       {"grid", lines.description()},
       {"material points",
        text(n_points) + ", and " + text(n_body_points) + " of the body (" +
          text(mass / 1000.) + " t)"},
       {"method", nodal_motion.description()},
       {"time step",
        text(dt) + " s, mass scaling " + text(time_step.mass_scaling)},
       {"end", text(end_time()) + " s"}});
    if (!wrong_error_bar.empty())
      console->warning(wrong_error_bar);
    for (const auto &limits : {soil.known_limits(),
                               nodal_motion.known_limits(),
                               generator.known_limits(body.shape()),
                               time_step.known_limits()})
      for (const std::string &limit : limits)
        console->warning(limit);
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
    body.motion().advance(dt, 0.);
    timed("points to grid", [&]() {
      nodal_motion.collect(*kernels, points, grid, materials, loads, time);
    });
    timed("nodal motion", [&]() { nodal_motion.accelerate(dt, contact); });
    timed("contact", [&]() {
      boundary_conditions.prepare(grid, time, dt);
      nodal_motion.constrain(dt,
                             body.mean_velocity(),
                             boundary_conditions,
                             contact);
    });
    timed("transfer", [&]() {
      nodal_motion.prepare_transfer(
        *kernels, points.view(), view, boundary_conditions, contact);
      work = nodal_motion.work_of_step(dt, boundary_conditions, contact);
    });
    timed("move mesh", [&]() { grid.prepare_motion(body.motion().travel()); });
    timed("grid to points", [&]() { update_points(view); });
    timed("relocate", [&]() {
      grid.advance();
      points.relocate();
    });
    if (generator.splits_and_merges() && step % steps_between_adaptions == 0)
      timed("split and merge", [&]() { adapt_points(); });
    energy.add(work, grid.circumference() * points.leaving().stress_work);
    time += dt;
    ++step;
  }

  void
  Simulation::adapt_points()
  {
    const double travel = lines.total_travel();
    points.adapt([&](const unsigned int cell) {
      return generator.wanted_size(grid.geometry(cell), body.shape(), travel);
    });
  }

  template <typename Action>
  void
  Simulation::timed(const char *section, const Action &action)
  {
    SectionTimer::Scope scope(timer, timer.section(section));
    action();
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
                            nodal_motion.update_settings(dt),
                            nodal_motion.integration_settings(
                              loads.surrounding_pressure(time + dt)),
                            nodal_motion.fields(),
                            nodal_motion.cell_moments(),
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

  std::string
  Simulation::reason_to_stop()
  {
    if (grid.n_ranks() == 1)
      return stop_request.reason();
    if (step % 20 != 0)
      return "";
    const std::string  reason = stop_request.reason();
    const unsigned int rank =
      Utilities::MPI::min(reason.empty() ? grid.n_ranks() :
                                           Utilities::MPI::this_mpi_process(
                                             grid.communicator()),
                          grid.communicator());
    return rank == grid.n_ranks() ?
             "" :
             Utilities::MPI::broadcast(grid.communicator(), reason, rank);
  }

  bool
  Simulation::verify()
  {
    const AllPoints all_points(points, grid.communicator());
    const bool      passed =
      !grid.is_first_rank() ||
      verification.run(all_points, *records, time, directory, *console);
    return Utilities::MPI::min(passed ? 1 : 0, grid.communicator()) == 1;
  }

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
        if (grid.n_ranks() > 1 && step % 200 == 0)
          timed("balance", [this]() { balance(); });
        const std::string reason = reason_to_stop();
        if (!reason.empty())
          {
            save_checkpoint();
            write_summary("stopped");
            console->message("stopped: " + reason + "; go on with --restart");
            return ExitStatus::stopped;
          }
      }
    const bool passed = verification.empty() || verify();
    write_summary(passed ? "finished" : "verification failed");
    print_counts();
    print_energies();
    print_times();
    return passed ? ExitStatus::success : ExitStatus::failure;
  }
} // namespace CaissonMPM
