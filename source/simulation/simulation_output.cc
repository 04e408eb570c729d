// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a run writes: records, frames, checkpoints, its summary.
#include <caisson_mpm/base/declared_entries.h>
#include <caisson_mpm/output/run_summary.h>
#include <caisson_mpm/simulation/simulation.h>

#include <deal.II/base/revision.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numeric>
#include <set>
#include <sstream>

namespace CaissonMPM
{
  using namespace dealii;

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
    if (checkpoint_is_due())
      {
        save_checkpoint();
        next_checkpoint = seconds_running();
      }
  }

  bool
  Simulation::checkpoint_is_due()
  {
    const bool due = checkpoint_interval > 0. &&
                     seconds_running() - next_checkpoint > checkpoint_interval;
    if (grid.n_ranks() == 1 || checkpoint_interval == 0.)
      return due;
    // clocks differ
    return step % 20 == 0 &&
           Utilities::MPI::max(due ? 1 : 0, grid.communicator()) == 1;
  }

  void
  Simulation::bring_sums_to_first_rank()
  {
    if (grid.n_ranks() == 1)
      return;
    SurfaceForces on_body = contact.impulse();
    Vector2       on_soil = boundary_conditions.impulse();
    double        limited = n_limited, held_back = points.n_held_back();

    std::vector<double *> sums;
    for (const auto work : EnergyBalance::works())
      sums.push_back(&(energy.*work));
    for (Vector2 &impulse : on_body)
      sums.insert(sums.end(), {&impulse[0], &impulse[1]});
    sums.insert(sums.end(),
                {&on_soil[0], &on_soil[1], &limited, &held_back, &point_steps});
    std::vector<double> values;
    for (const double *sum : sums)
      values.push_back(*sum);
    Utilities::MPI::sum(values, grid.communicator(), values);
    for (std::size_t i = 0; i < sums.size(); ++i)
      *sums[i] = grid.is_first_rank() ? values[i] : 0.;

    contact.reset_impulse(on_body);
    boundary_conditions.reset_impulse(on_soil);
    n_limited = limited;
    points.set_n_held_back(held_back);
  }

  void
  Simulation::record()
  {
    bring_sums_to_first_rank();
    HistoryRow row;
    row.time          = time;
    row.penetration   = body.penetration();
    row.step          = step;
    row.time_step     = dt;
    row.limiter_count = n_limited;
    row.held_back     = points.n_held_back();
    row.contact_nodes =
      Utilities::MPI::sum(contact.n_touching, grid.communicator());
    row.sticking_nodes =
      Utilities::MPI::sum(contact.n_sticking, grid.communicator());
    add_forces(row);
    add_sums_over_points(row);
    std::vector<double> observed;
    if (!observations.names().empty())
      {
        const AllPoints all_points(points, grid.communicator());
        if (grid.is_first_rank())
          observed = observations.values(all_points, time);
      }
    if (grid.is_first_rank())
      records->append(row, observed);
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
    if (body.shape().expands() && interval > 0.)
      {
        const double travel =
          .5 * (body.motion().travel() + travel_of_last_record);
        const double around =
          lines.axisymmetric() ? 2. * pi * (body.shape().right() + travel) : 1.;
        row.cavity = -contact.impulse()[outer_wall][radial] /
                     (interval * around * lines.depth());
      }
    if (interval > 0.)
      {
        row.prescribed_r = boundary_conditions.impulse()[radial] / interval;
        row.prescribed_z = boundary_conditions.impulse()[vertical] / interval;
      }
    contact.reset_impulse();
    boundary_conditions.reset_impulse();
    last_record           = time;
    travel_of_last_record = body.motion().travel();
  }

  void
  Simulation::add_sums_over_points(HistoryRow &row)
  {
    const double        travel     = body.motion().travel();
    const PointEnergies energies   = point_energies();
    double              max_square = 0.;
    points.for_each_motion([&](const Point<2> &position,
                               const Vector2  &velocity,
                               const double,
                               const unsigned int) {
      max_square = std::max(max_square, velocity.norm_square());
      row.points_in_body += body.shape().contains(position, travel);
    });
    row.max_speed               = std::sqrt(max_square);
    const MPI_Comm communicator = grid.communicator();
    row.max_speed      = Utilities::MPI::max(row.max_speed, communicator);
    row.points_in_body = Utilities::MPI::sum(row.points_in_body, communicator);
    energy.close(energies);
    row.kinetic_energy = energies.kinetic;
    row.external_work  = energy.work_of_body;
    row.energy         = energy;
    row.added_mass     = grid.circumference() *
                     Utilities::MPI::sum(nodal_motion.added_mass, communicator);
    max_in_body = std::max(max_in_body, row.points_in_body);
  }

  PointEnergies
  Simulation::point_energies() const
  {
    PointEnergies result;
    points.for_each_motion([&](const Point<2>    &position,
                               const Vector2     &velocity,
                               const double       mass,
                               const unsigned int material) {
      const double *const force   = materials[material].body_force;
      const double        rise[2] = {-mass * force[0] * position[0],
                                     -mass * force[1] * position[1]};
      result.kinetic += .5 * mass * velocity.norm_square();
      result.potential += rise[0] + rise[1];
      result.weight += std::abs(rise[0]) + std::abs(rise[1]);
    });
    for (double *sum : {&result.kinetic, &result.potential, &result.weight})
      *sum =
        grid.circumference() * Utilities::MPI::sum(*sum, grid.communicator());
    return result;
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
    line.has_body               = body.shape().exists();
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
    visualization->write_frame(grid, points, body, soil, body_points, time);
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
    // defaults are left out, so that a new entry changes nothing, and the
    // order of declaration does not count
    const DeclaredEntries entries(prm);
    std::set<std::string> lines;
    for (const DeclaredEntry &entry : entries.all())
      if (!is_not_physics(entry) && entry.value != entry.default_value &&
          entry.path != "Title" && entry.path != "Method/Instruction set")
        lines.insert(entry.path + " = " + entry.value + "\n");
    return std::accumulate(lines.begin(), lines.end(), std::string());
  }

  void
  Simulation::save_checkpoint()
  {
    bring_sums_to_first_rank();
    CheckpointState state;
    state.time          = time;
    state.travel        = body.motion().travel();
    state.step          = step;
    state.limiter_count = n_limited;
    state.held_back     = points.n_held_back();
    state.external_work = energy.work_of_body;
    state.more          = {next_record, last_record, travel_of_last_record};
    RunTotals motion;
    body.motion().register_totals(motion);
    for (const auto &entry : motion.state())
      state.more.push_back(entry.second);
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
  Simulation::resume_sums(const CheckpointState &state)
  {
    n_limited = state.limiter_count;
    points.set_n_held_back(state.held_back);
    const std::vector<double> &numbers = state.more;
    SurfaceForces              impulse;
    for (unsigned int i = 0; i < 2 * n_surfaces; ++i)
      impulse[i / 2][i % 2] = numbers.at(6 + i);
    contact.reset_impulse(impulse);
    boundary_conditions.reset_impulse(Vector2(
      {numbers.at(6 + 2 * n_surfaces), numbers.at(7 + 2 * n_surfaces)}));
    energy.resume({numbers.begin() + 8 + 2 * n_surfaces, numbers.end()});
  }

  void
  Simulation::write_summary(const std::string &status)
  {
    bring_sums_to_first_rank();
    const auto sum = [this](const auto value) {
      return Utilities::MPI::sum(value, grid.communicator());
    };
    RunSummary s;
    s.fingerprint        = fingerprint_of(changed_physics());
    s.version            = CAISSON_MPM_VERSION;
    s.dealii_version     = DEAL_II_PACKAGE_VERSION;
    s.scene_file         = scene;
    s.instruction_set    = kernels->name;
    s.status             = status;
    s.ranks              = grid.n_ranks();
    s.repartitions       = n_repartitions;
    s.material_points    = Utilities::MPI::sum<unsigned long>(points.n_points(),
                                                           grid.communicator());
    s.cells              = grid.n_global_cells();
    s.body_points        = sum(body_points.size());
    s.steps              = step - first_step;
    s.limiter_count      = n_limited;
    s.held_back          = points.n_held_back();
    s.points_lost        = 0; // a lost point ends the run
    s.max_points_in_body = max_in_body;
    s.points_split       = sum(points.n_split);
    s.points_merged      = sum(points.n_merged);
    s.point_steps        = point_steps;
    s.wall_time_s        = seconds_running();
    s.point_steps_per_second = point_steps / seconds_running();
    s.peak_memory_bytes      = sum(peak_memory_bytes());
    s.body_mass_kg           = 0.;
    for (const BodyPoint &p : body_points)
      s.body_mass_kg += p.mass;
    s.body_mass_kg = sum(s.body_mass_kg);
    points.for_each([&](const MaterialPoint &p, const unsigned int) {
      s.soil_mass_kg += grid.circumference() * p.mass;
    });
    s.soil_mass_kg    = sum(s.soil_mass_kg);
    s.time_step_s     = dt;
    s.time_step_limit = time_step.reason();
    s.zone_limits     = time_step.zone_limits();
    s.energies        = energy.entries();
    s.energies.insert(s.energies.begin(),
                      {"external_work_J", energy.work_of_body});
    s.energies.insert(s.energies.begin() + 1,
                      {"kinetic_energy_gain_J", energy.kinetic_gain});
    s.sections = timer.seconds();
    s.scene    = body.shape().dimensions();
    if (!s.scene.empty())
      s.scene.insert(s.scene.end(),
                     {{"submerged_unit_weight_N_m3", soil.unit_weight(0)},
                      {"friction_angle_deg", soil.layer(0).friction_angle()},
                      {"wall_friction_angle_deg",
                       body.surface().friction_angle[outer_wall]},
                      {"K0", soil.layer(0).earth_pressure_at_rest()}});
    if (grid.is_first_rank())
      {
        error_bar.write(directory);
        write_run_summary(directory + "/run.json", s);
      }
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
