// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/fingerprint.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/domain/cell_geometry.h>
#include <caisson_mpm/kernels/dispatch.h>
#include <caisson_mpm/restart/checkpoint.h>
#include <caisson_mpm/simulation/physics_text.h>
#include <caisson_mpm/simulation/simulation.h>
#include <caisson_mpm/water/pore_pressure_force.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    // Between two of these the mesh moves by less than the finest cell.
    constexpr double steps_between_adaptations = 25.; // of reference
    // Ranks agree on what each sees for itself; rarely, since that is
    // collective.
    constexpr unsigned int steps_between_agreements = 20;
    constexpr unsigned int steps_between_balances   = 200;
    // As often a run begins anew, as a restart does, and only then it writes
    // checkpoints by itself: a restart then repeats it to the last bit.
    constexpr unsigned int steps_between_beginnings = 400;
    // To cut the mesh into other parts takes about as long as this many steps.
    constexpr double steps_of_a_cut = 30.;
  } // namespace

  Simulation::Simulation(const MPI_Comm communicator)
    : ParameterAcceptor("/")
    , grid(lines, communicator)
    , water(grid, points, soil, body)
    , points(grid)
    , schedule(body, clock)
    , recorder({clock,
                schedule,
                soil,
                body,
                time_step,
                nodal_motion,
                points,
                body_points,
                materials,
                timer,
                grid,
                energy,
                totals,
                water})
  {
    nodal_forces.add(std::make_unique<PorePressureForce>(water));
    enter_subsection("Method");
    add_parameter("Instruction set",
                  instruction_set,
                  "The kernels use this instruction set; with auto, the widest "
                  "of this processor. Units: none.",
                  prm,
                  Patterns::Selection(std::string("auto|") +
                                      Kernels::instruction_sets));
    leave_subsection();
    enter_subsection("Output");
    add_word_or_number(*this,
                       "Checkpoint interval",
                       checkpoint_interval,
                       "never",
                       0.,
                       "Checkpoints are written this wall time apart, and when "
                       "the run is stopped or finished. Units: s.",
                       Patterns::Double(0.));
    leave_subsection();
    register_totals();
  }

  void
  Simulation::register_totals()
  {
    totals.keep("time", clock.time);
    totals.keep("step", clock.step);
    totals.carry("force_on_body", force_on_body);
    totals.carry("since_adaptation", since_adaptation);
    totals.count("limiter_count", n_limited);
    totals.count("soil_into_body_m3", inflow);
    points.register_totals(totals);
    energy.register_totals(totals);
    water.register_totals(totals);
    schedule.register_totals(totals);
    recorder.register_totals(totals);
  }

  // ------------------------------------------------------------ one step

  void
  Simulation::advance()
  {
    NodalWork work;
    if (begins_anew())
      timed("begin anew", [&]() { begin_anew(); });
    timed("choose step", [&]() { choose_step(); });
    boundary_conditions.prepare(grid, clock.time, clock.step_size);
    timed("ground water",
          [&]() { water.update(clock.step_size, boundary_conditions); });
    if (const auto *const filled = water.filled_beneath_lid())
      contact.open_lid(*filled, Mudline::touching);
    if (!body.motion().needs_response())
      timed("move body", [&]() { move_body(); });
    if (soil.has_walls())
      timed("contact", [&]() {
        contact.set_strength(
          [this](const ContactFace &face) { return strength_of_face(face); });
      });
    const StepSize size = {clock.step_size,
                           time_step.courant_number_of_soil(clock.step_size)};
    timed("points to grid", [&]() {
      nodal_motion.collect(soil_on_grid(), nodal_forces, clock.time);
    });
    timed("nodal motion", [&]() {
      nodal_motion.accelerate(size,
                              nodal_forces,
                              body.mean_velocity(),
                              contact);
    });
    if (body.motion().needs_response())
      timed("move body", [&]() { move_body_with_soil(); });
    if (water.is_coupled())
      timed("pore pressure", [&]() { find_pore_pressure(); });
    timed("contact", [&]() {
      NodalConstraints constraints = constraints_of_nodes();
      nodal_motion.constrain(body.mean_velocity(), constraints);
    });
    timed("transfer", [&]() {
      const NodalConstraints constraints = constraints_of_nodes();
      nodal_motion.prepare_transfer(constraints);
      work = nodal_motion.work_of_step(nodal_forces, constraints);
    });
    timed("move mesh", [&]() { grid.prepare_motion(body.motion().travel()); });
    timed("grid to points", [&]() { update_points(); });
    timed("relocate", [&]() {
      grid.advance();
      points.relocate();
    });
    since_adaptation += size.n_reference_steps();
    if (generator.splits_and_merges() &&
        since_adaptation >= steps_between_adaptations)
      timed("split and merge", [&]() {
        adapt_points(since_adaptation * size.seconds /
                     size.n_reference_steps());
      });
    add_step(work);
    clock.time += size.seconds;
    ++clock.step;
  }

  template <typename Action>
  void
  Simulation::timed(const char *section, const Action &action)
  {
    SectionTimer::Scope scope(timer, timer.section(section));
    action();
  }

  void
  Simulation::choose_step()
  {
    clock.step_size =
      schedule.shorten(time_step.choose(grid, points, soil, materials));
  }

  void
  Simulation::move_body()
  {
    body.motion().set_load(body.submerged_weight() + water.load_on_body());
    body.motion().advance(clock.step_size, force_on_body);
  }

  void
  Simulation::move_body_with_soil()
  {
    auto sums = nodal_motion.respond(contact).along(body.shape().direction());
    Utilities::MPI::sum(sums, grid.communicator(), sums);
    body.motion().set_response({sums[0] / clock.step_size, sums[1]});
    move_body();
    nodal_motion.replace_body_velocity(body.mean_velocity(), contact);
  }

  void
  Simulation::add_step(NodalWork work)
  {
    if (grid.is_first_rank())
      work.load += water.work_at_tip(
        body.mean_velocity() * body.shape().direction() * clock.step_size);
    energy.add(work, grid.circumference() * points.update_result().stress_work);
    const NodalReactions &reactions = nodal_motion.reactions();
    const SurfaceForces  &on_body   = reactions.contact.impulse;
    inflow += reactions.contact.inflow;
    recorder.add_step(on_body, reactions.prescribed.impulse);
    if (needs_force_on_body())
      force_on_body = find_force_on_body();
    water.advance(clock.time, clock.step_size, force_on_body);
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
        {
          const double height = height_of(grid.geometry(beyond));
          if (height < much_thinner * size[vertical])
            size[vertical] = height;
        }
    return size;
  }

  void
  Simulation::adapt_points(const double interval)
  {
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
    return {*kernels, points, grid, materials, water.cell_pressure()};
  }

  void
  Simulation::find_pore_pressure()
  {
    NodalConstraints constraints = constraints_of_nodes();
    const NodalData &predicted =
      nodal_motion.predict(body.mean_velocity(), constraints);
    water.correct(nodal_vectors(predicted), contact.corners().views());
    nodal_motion.correct(
      soil_on_grid(), nodal_forces, clock.time, body.mean_velocity(), contact);
  }

  void
  Simulation::update_points()
  {
    if (!nodal_motion.is_finite())
      report_not_finite();
    auto &result = points.update_result();
    nodal_motion.update_points(grid.next(),
                               water.volume_rates(nodal_motion.new_velocity(),
                                                  contact.corners().views()),
                               result);
    n_limited += result.n_limited;
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
      "kept.");
  }

  // ------------------------------------------------------------ the run

  void
  Simulation::balance()
  {
    const auto costs = points.cell_costs();
    // A part is made of whole cells: it may be impossible to do better than
    // after the last cut.
    lost_steps +=
      steps_between_balances * std::max(0., imbalance(costs) - least_imbalance);
    if (lost_steps > steps_of_a_cut)
      cut_into_parts(costs);
  }

  void
  Simulation::output()
  {
    SectionTimer::Scope scope(timer, timer.section("output"));
    const Schedule::Due due = schedule.take_due();
    if (due.record || due.frame)
      water.write_pressure_to_points();
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
  Simulation::begins_anew() const
  {
    return clock.step > 0 && clock.step % steps_between_beginnings == 0;
  }

  void
  Simulation::begin_anew()
  {
    water.keep_field();
    grid.move_to(0.); // where the parts are set up
    set_up_part();
    points.begin_anew();
    time_step.initialize(grid, points, soil, materials);
  }

  bool
  Simulation::checkpoint_is_due()
  {
    if (!checkpoint_interval || !begins_anew())
      return false;
    const bool due =
      recorder.seconds_running() - last_checkpoint > *checkpoint_interval;
    if (grid.n_ranks() == 1)
      return due;
    // clocks differ
    return clock.step % steps_between_agreements == 0 &&
           Utilities::MPI::max(due ? 1 : 0, grid.communicator()) == 1;
  }

  void
  Simulation::save_checkpoint()
  {
    if (!needs_force_on_body()) // but a run that goes on after this one may
      force_on_body = find_force_on_body();
    totals.bring_to_first_rank(grid.communicator());
    NamedNumbers       state    = totals.state();
    const NamedNumbers of_water = water.field_state();
    state.insert(state.end(), of_water.begin(), of_water.end());
    state.emplace_back("mesh_uplift", lines.total_uplift());
    state.emplace_back("mesh_travel", lines.total_travel());
    write_checkpoint(
      recorder.output_directory(), grid, points, state, physics(prm));
  }

  std::string
  Simulation::reason_to_stop()
  {
    if (grid.n_ranks() == 1)
      return stop_request.reason();
    if (clock.step % steps_between_agreements != 0)
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

  ExitStatus
  Simulation::stop(const std::string &reason)
  {
    save_checkpoint();
    recorder.review_run();
    recorder.write_summary("stopped");
    recorder.message("stopped: " + reason + "; go on with --restart");
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
    return recorder.verify() ? ExitStatus::success : ExitStatus::failure;
  }

  ExitStatus
  Simulation::finish()
  {
    // so that the run can be continued to a later end
    save_checkpoint();
    const bool passed = recorder.verify();
    recorder.print_report();
    recorder.review_run();
    recorder.write_summary(passed ? "finished" : "verification failed");
    recorder.print_result();
    return passed ? ExitStatus::success : ExitStatus::failure;
  }

  ExitStatus
  Simulation::run(const std::vector<std::string> &warnings)
  {
    recorder.open();
    try
      {
        return run_to_end(warnings);
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
  Simulation::run_to_end(const std::vector<std::string> &warnings)
  {
    stop_request.arm(recorder.output_directory());
    if (is_restart)
      recorder.resume(overwrites);
    else
      recorder.start(overwrites);
    if (is_restart && schedule.is_finished())
      return nothing_left();
    recorder.print_header(warnings);
    if (!is_restart)
      {
        if (installation.is_given())
          recorder.message("goes on at a penetration of " +
                           to_text(body.penetration(), 6) + " m" +
                           installation.changes_in_words());
        recorder.write_frame();
        recorder.record();
      }
    while (!schedule.is_finished() && water.reason_to_end().empty())
      {
        advance();
        output();
        if (grid.n_ranks() > 1 && clock.step % steps_between_balances == 0)
          timed("balance", [this]() { balance(); });
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
    recorder.record();
    recorder.write_frame();
    recorder.message("ended at a penetration of " +
                     to_text(body.penetration(), 5) +
                     " m: " + water.reason_to_end());
  }
} // namespace CaissonMPM
