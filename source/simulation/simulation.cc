// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/guarded_call.h>
#include <caisson_mpm/base/intervals.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/domain/cell_geometry.h>
#include <caisson_mpm/kernels/dispatch.h>
#include <caisson_mpm/restart/checkpoint.h>
#include <caisson_mpm/simulation/physics_text.h>
#include <caisson_mpm/simulation/simulation.h>
#include <caisson_mpm/water/pore_water.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace CaissonMPM
{
  using namespace dealii;

  Simulation::Simulation(const MPI_Comm communicator)
    : Section("/", Influence::none)
    , SimulationParts(communicator)
    , recorder(*this)
  {
    water_settings.parse_parameters_call_back.connect(
      [this]() { choose_water(); });
    grid.signals.after_change.connect([this]() {
      contact.initialize(grid, body.surface());
      recorder.find_walls();
      boundary_conditions.initialize(grid);
      nodal_motion.initialize(grid);
      time_step.forget_cells();
    });
    time_step.follow_tip(
      [this]() { return stress_over_inertia_at_tip(body.motion().travel()); });
    recorder.follow_steps([this]() { return number_of_steps(); });
    enter_subsection("Method");
    add_parameter(
      "Instruction set",
      instruction_set,
      "",
      "The kernels use this instruction set; with auto, the widest of this "
      "processor.",
      Patterns::Selection(std::string("auto|") + Kernels::instruction_sets))
      .influence = Influence::motion;
    leave_subsection();
    enter_subsection("Output");
    add_word_or_number(
      *this,
      "Checkpoint interval",
      checkpoint_interval,
      "never",
      0.,
      "s",
      "Checkpoints are written this wall time apart, and when the run is "
      "stopped or finished.",
      Patterns::Double(0.));
    leave_subsection();
    register_totals();
  }

  void
  Simulation::choose_water()
  {
    AssertThrow(!water, ExcMessage("Parameters must be parsed once only."));
    water = make_pore_water(
      {grid, points, soil, body, water_settings, totals, nodal_forces});
  }

  // ------------------------------------------------------------ one step

  void
  Simulation::advance()
  {
    timer.time("choose step", [&]() { choose_step(); });
    timer.time("pore water", [&]() {
      water->begin_step(clock.step_size, boundary_conditions, contact);
    });
    timer.time("move body", [&]() { move_body_by_itself(); });
    timer.time("contact", [&]() { set_strength_of_walls(); });
    timer.time("points to grid", [&]() {
      nodal_motion.collect(soil_on_grid(), nodal_forces, clock.time);
    });
    timer.time("nodal motion", [&]() {
      nodal_motion.accelerate(size_of_step(),
                              nodal_forces,
                              body.mean_velocity(),
                              contact);
    });
    timer.time("move body", [&]() { move_body_with_soil(); });
    timer.time("implicit forces", [&]() { correct_velocities(); });
    timer.time("contact", [&]() { constrain_velocities(); });
    timer.time("transfer", [&]() { prepare_transfer(); });
    timer.time("move mesh",
               [&]() { grid.prepare_motion(body.motion().travel()); });
    timer.time("grid to points", [&]() { update_points(); });
    timer.time("relocate", [&]() {
      grid.advance();
      relocate_points();
    });
    timer.time("split and merge", [&]() { adapt_points(); });
    finish_step();
  }

  double
  Simulation::stress_over_inertia_at_tip(const double travel) const
  {
    const double depth   = body.penetration() + travel - body.motion().travel();
    const double tip     = -std::max(depth, 0.);
    const double density = soil.inertial_density(soil.material_at(tip)),
                 speed   = body.motion().usual_velocity();
    // a stiff layer must not make the weak one above it heavy
    constexpr double widths = 4.;
    const double     stress =
      soil.stress_borne_above(tip, widths * body.shape().width_of_tip());
    // The waves of the start must decay before the soil gets heavy.
    constexpr double first_share = .15;
    const double     way         = body.shape().right() / 3.,
                 share = std::clamp(std::abs(travel) / way, first_share, 1.);
    return share * stress / (density * speed * speed);
  }

  void
  Simulation::choose_step()
  {
    clock.step_size = schedule.shorten(
      time_step.choose(*kernels, grid, points, soil, materials));
    boundary_conditions.prepare(grid, clock.time, clock.step_size);
  }

  StepSize
  Simulation::size_of_step() const
  {
    return {clock.step_size, time_step.courant_number_of_soil(clock.step_size)};
  }

  void
  Simulation::set_strength_of_walls()
  {
    if (soil.has_walls())
      contact.set_strength(
        [this](const ContactFace &face) { return strength_of_face(face); });
  }

  void
  Simulation::move_body()
  {
    body.motion().surroundings.load = body.submerged_weight() +
                                      body.applied_force(clock.time) +
                                      water->load_on_body();
    body.motion().advance(clock.step_size, force_on_body);
  }

  void
  Simulation::move_body_by_itself()
  {
    if (!body.motion().traits.needs_response)
      move_body();
  }

  void
  Simulation::move_body_with_soil()
  {
    if (!body.motion().traits.needs_response)
      return;
    auto sums = nodal_motion.respond(contact).along(body.shape().direction());
    Utilities::MPI::sum(sums, grid.communicator(), sums);
    body.motion().surroundings.response = {sums[0] / clock.step_size, sums[1]};
    move_body();
    nodal_motion.replace_body_velocity(body.mean_velocity(), contact);
  }

  void
  Simulation::finish_step()
  {
    const NodalReactions &reactions = nodal_motion.reactions();
    const SurfaceForces  &on_body   = reactions.contact.impulse;
    inflow += reactions.contact.inflow;
    recorder.add_step(on_body, reactions.prescribed.impulse);
    if (needs_force_on_body())
      force_on_body = find_force_on_body();
    const double travel = body.mean_velocity() * body.shape().direction() *
                          clock.step_size,
                 work_on_water = water->resistance_to_body() * travel,
                 work_at_tip   = water->end_step(clock.time,
                                               clock.step_size,
                                               force_on_body,
                                               travel);
    if (grid.is_first_rank())
      {
        work_of_step.load += work_at_tip;
        work_of_step.water = work_on_water;
      }
    energy.add(work_of_step,
               grid.circumference() * points.update_result().stress_work);
    clock.time += clock.step_size;
    ++clock.step;
  }

  double
  Simulation::find_force_on_body() const
  {
    const SurfaceForces &on_body = nodal_motion.reactions().contact.impulse;
    const Vector2        impulse =
      std::accumulate(on_body.begin(), on_body.end(), Vector2());
    return Utilities::MPI::sum(impulse * body.shape().direction(),
                               grid.communicator()) /
           clock.step_size;
  }

  std::array<double, 2>
  Simulation::wanted_size_of_points(const unsigned int cell) const
  {
    auto size = generator.wanted_size(grid.geometry(cell),
                                      body.shape(),
                                      lines.total_travel());
    // Rows move through the soil. One that is much thinner than the points of
    // the soil that it comes to would be empty there, and bear nothing.
    constexpr double much_thinner = .75;
    for (const unsigned int face : {2, 3})
      if (const int beyond = grid.neighbor(cell, face);
          beyond >= 0 && !grid.is_rigid(beyond))
        if (const double height = height_of(grid.geometry(beyond));
            height < much_thinner * size[vertical])
          size[vertical] = height;
    return size;
  }

  void
  Simulation::adapt_points()
  {
    const StepSize size = size_of_step();
    since_adaptation += size.n_reference_steps();
    if (!generator.splits_and_merges() ||
        since_adaptation < Intervals::adaptation)
      return;
    const double interval =
      since_adaptation * size.seconds / size.n_reference_steps();
    since_adaptation  = 0.;
    const auto wanted = [this](const unsigned int cell) {
      return wanted_size_of_points(cell);
    };
    points.stretch(
      [&](const unsigned int cell, const Point<2> &place) {
        auto strain = nodal_motion.rate_of_stretch(grid, cell, place);
        for (double &s : strain)
          s *= interval;
        return strain;
      },
      wanted);
    points.adapt(wanted);
  }

  NodalConstraints
  Simulation::constraints_of_nodes()
  {
    return {contact, boundary_conditions, grid.hanging_nodes()};
  }

  SoilOnGrid
  Simulation::soil_on_grid()
  {
    return {*kernels,
            points,
            grid,
            materials,
            water->cell_pressure(),
            time_step.inertia_of_translation(),
            time_step.inertia_of_deformation()};
  }

  void
  Simulation::correct_velocities()
  {
    NodalConstraints constraints = constraints_of_nodes();
    nodal_motion.correct(soil_on_grid(),
                         nodal_forces,
                         clock.time,
                         body.mean_velocity(),
                         constraints,
                         contact);
  }

  void
  Simulation::constrain_velocities()
  {
    NodalConstraints constraints = constraints_of_nodes();
    nodal_motion.constrain(body.mean_velocity(), constraints);
  }

  void
  Simulation::prepare_transfer()
  {
    const NodalConstraints constraints = constraints_of_nodes();
    nodal_motion.prepare_transfer(constraints);
    work_of_step = nodal_motion.work_of_step(nodal_forces, constraints);
  }

  void
  Simulation::update_points()
  {
    if (!nodal_motion.is_finite())
      report_not_finite();
    soil.begin_step(clock.time, clock.step_size, clock.step);
    auto &result = points.update_result();
    nodal_motion.update_points(grid.next(),
                               water->volume_rates(nodal_motion.new_velocity(),
                                                   contact.corners().views()),
                               result);
    soil.check_user_materials();
    n_limited += result.n_limited;
  }

  void
  Simulation::relocate_points()
  {
    try
      {
        points.relocate();
      }
    catch (const RunFailure &error)
      {
        const std::string when = " t = " + to_text(clock.time, 6) + " s.";
        throw RunFailure(error.what() + when + soil.cause_in_user_materials());
      }
  }

  void
  Simulation::report_not_finite() const
  {
    std::string text = "the state is not finite in step " +
                       to_text(clock.step) +
                       " at t = " + to_text(clock.time, 6) + " s";
    bool found = false;
    points.for_each([&](const MaterialPoint &p, const unsigned int) {
      double sum = p.position[0] + p.position[1] + p.velocity[0] +
                   p.velocity[1] + p.mass + p.volume;
      for (const double component : p.stress)
        sum += component;
      if (!found && !std::isfinite(sum))
        {
          found = true;
          text += ": the first is material point " +
                  to_text(static_cast<long>(p.id)) +
                  ", which began at r = " + to_text(p.initial_position[0], 6) +
                  " m, z = " + to_text(p.initial_position[1], 6) + " m";
        }
    });
    throw RunFailure(
      text +
      ". Likely causes: a time step too large for the deformed mesh (reduce "
      "Time/Courant number), an unstable choice in section Method (the "
      "defaults are MUSL, blend and Mass floor = true), or a parameter of "
      "the soil that is out of any range. The files written so far are "
      "kept." +
      soil.cause_in_user_materials());
  }

  // ------------------------------------------------------------ the run

  void
  Simulation::output()
  {
    const Schedule::Due due = schedule.take_due();
    if (due.record || due.frame)
      water->write_pressure_to_points();
    if (due.frame)
      recorder.request_walls();
    if (due.record)
      recorder.record();
    if (due.frame)
      recorder.write_frame();
    if (checkpoint_is_due())
      {
        save_checkpoint();
        last_checkpoint = recorder.seconds_running();
      }
  }

  bool
  Simulation::rebuild_is_due() const
  {
    return clock.step > 0 && clock.step % Intervals::rebuild == 0;
  }

  void
  Simulation::rebuild_caches()
  {
    grid.rebuild();
    grid.move_to(body.motion().travel());
    points.rebuild_sums();
    time_step.initialize(*kernels, grid, points, soil, materials);
  }

  bool
  Simulation::checkpoint_is_due()
  {
    if (!checkpoint_interval || !rebuild_is_due())
      return false;
    const bool due =
      recorder.seconds_running() - last_checkpoint > *checkpoint_interval;
    if (grid.n_ranks() == 1)
      return due;
    // clocks differ
    return clock.step % Intervals::agreement == 0 &&
           Utilities::MPI::max(due ? 1 : 0, grid.communicator()) == 1;
  }

  void
  Simulation::save_checkpoint()
  {
    if (!needs_force_on_body()) // but a run that continues this one may
      force_on_body = find_force_on_body();
    totals.bring_to_first_rank(grid.communicator());
    const auto   warnings = recorder.prepare_checkpoint();
    NamedNumbers state = totals.state(), seconds = timer.state();
    state.emplace_back("mesh_uplift", lines.total_uplift());
    state.emplace_back("mesh_travel", lines.total_travel());
    state.insert(state.end(), seconds.begin(), seconds.end());
    write_checkpoint(recorder.output_directory(),
                     grid,
                     points,
                     gather(grid, water->fields()),
                     state,
                     warnings,
                     physics() + soil.checksums_of_libraries());
  }

  std::string
  Simulation::request_of_any_rank()
  {
    const std::string reason = stop_request.reason();
    if (grid.n_ranks() == 1)
      return reason;
    const unsigned int rank =
      Utilities::MPI::min(reason.empty() ? grid.n_ranks() :
                                           Utilities::MPI::this_mpi_process(
                                             grid.communicator()),
                          grid.communicator());
    return rank == grid.n_ranks() ?
             "" :
             Utilities::MPI::broadcast(grid.communicator(), reason, rank);
  }

  std::string
  Simulation::reason_to_stop()
  {
    // A search for factors of the inertia would come in other steps after a
    // restart, unless the stop waits for the step of one.
    if ((grid.n_ranks() > 1 || time_step.has_inertia_tolerance()) &&
        clock.step % Intervals::agreement != 0)
      return "";
    const std::string reason = request_of_any_rank();
    if (reason.empty() || rebuild_is_due() ||
        Utilities::MPI::max(stop_request.seconds_since(), grid.communicator()) >
          Intervals::longest_wait)
      return reason;
    if (!std::exchange(is_stopping, true))
      recorder.message(reason + ": the run stops within " +
                       to_text(Intervals::longest_wait) + " s");
    return "";
  }

  ExitStatus
  Simulation::stop(const std::string &reason)
  {
    save_checkpoint();
    // for pictures of the last state: the run that goes on removes it
    water->write_pressure_to_points();
    recorder.write_frame();
    recorder.write_summary("stopped");
    recorder.message("stopped: " + reason + "; resume with --restart");
    return ExitStatus::stopped;
  }

  ExitStatus
  Simulation::nothing_left()
  {
    recorder.message(
      "nothing is left to compute: the checkpoint in " +
      recorder.output_directory() + " is at t = " + to_text(clock.time) +
      " s, where this run ends. To continue it, set a later end in section "
      "Time.");
    recorder.write_points();
    return ExitStatus::success;
  }

  ExitStatus
  Simulation::finish()
  {
    // so that the run can be continued to a later end
    save_checkpoint();
    recorder.write_points();
    recorder.print_report();
    recorder.write_summary("finished");
    recorder.print_result();
    return ExitStatus::success;
  }

  ExitStatus
  Simulation::run(const ParameterOrigins &input)
  {
    recorder.open();
    begin_run_with_foreign_code();
    try
      {
        return run_to_end(input);
      }
    catch (const BadInput &)
      {
        throw;
      }
    catch (const std::exception &error)
      {
        recorder.write_failure(error.what());
        throw;
      }
  }

  ExitStatus
  Simulation::run_to_end(const ParameterOrigins &input)
  {
    stop_request.arm(recorder.output_directory());
    stop_request.refuse_file_of_user(grid.communicator());
    if (is_restart)
      recorder.resume(overwrites);
    else
      recorder.start(overwrites);
    last_checkpoint = recorder.seconds_running();
    if (is_restart && schedule.is_finished())
      return nothing_left();
    recorder.print_header(input);
    if (!is_restart)
      {
        for (const std::string &text :
             installation.messages(body.penetration()))
          recorder.message(text);
        recorder.write_frame();
        recorder.record();
      }
    while (!schedule.is_finished() && water->reason_to_end().empty())
      {
        if (rebuild_is_due())
          timer.time("rebuild caches", [this]() { rebuild_caches(); });
        advance();
        timer.time("output", [this]() { output(); });
        if (grid.n_ranks() > 1 && clock.step % Intervals::balance == 0)
          timer.time("balance", [this]() { balance(); });
        const std::string reason = reason_to_stop();
        if (!reason.empty())
          return stop(reason);
      }
    if (!schedule.is_finished())
      end_early();
    return finish();
  }

  void
  Simulation::end_early()
  {
    recorder.request_walls();
    recorder.record();
    recorder.write_frame();
    recorder.message("ended at a penetration of " +
                     to_text(body.penetration(), 5) +
                     " m: " + water->reason_to_end());
  }
} // namespace CaissonMPM
