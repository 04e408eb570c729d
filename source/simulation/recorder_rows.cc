// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The rows and frames of a run.
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/domain/all_points.h>
#include <caisson_mpm/simulation/recorder.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace CaissonMPM
{
  using namespace dealii;

  void
  Recorder::add_step(const SurfaceForces &on_body,
                     const Vector2       &on_prescribed_soil)
  {
    for (unsigned int s = 0; s < n_surfaces; ++s)
      impulse_on_body[s] += on_body[s];
    impulse_of_water +=
      parts.clock.step_size * parts.water->resistance_to_body();
    impulse_on_soil += on_prescribed_soil;
    if (has_walls())
      walls.add_step(parts.contact);
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
    for (const auto &column : parts.water->columns())
      row.counts.push_back(column);
    record_walls();
    add_forces(row);
    add_sums_over_points(row);
    const std::vector<double> observed = observed_values();
    if (parts.grid.is_first_rank())
      records->append(row, observed);
    report_suction(row);
    print_record(row);
    warn_of_lid(row);
    for (const std::string &warning : parts.water->take_warnings())
      console->warning(warning);
    report_rest();
    store_file_hashes();
  }

  bool
  Recorder::has_walls() const
  {
    return parts.body.shape().exists() && !parts.body.shape().expands();
  }

  void
  Recorder::find_walls()
  {
    if (has_walls())
      walls.initialize(parts.grid, parts.contact);
  }

  void
  Recorder::register_walls(RunTotals &totals)
  {
    walls.register_totals(totals);
  }

  void
  Recorder::request_walls()
  {
    wants_walls = has_walls();
  }

  void
  Recorder::record_walls()
  {
    const double interval = parts.clock.time - last_record;
    if (has_walls() && (wants_walls || walls_at_each_record) && interval > 0.)
      {
        const double tip_area =
          WallForces::area_of_tip(parts.grid, parts.contact);
        const WallRecord record = {
          parts.clock.time,
          parts.body.penetration(),
          parts.body.motion().travel(),
          interval,
          impulse_on_body[tip][vertical] / (interval * tip_area),
          walls.rows(parts.grid,
                     parts.contact,
                     parts.points,
                     parts.water->pressure_in_stress())};
        if (parts.grid.is_first_rank())
          wall_file->append(record);
        wants_walls = false;
      }
    walls.clear();
  }

  void
  Recorder::add_forces(HistoryRow &row)
  {
    const double  interval = parts.clock.time - last_record;
    double *const forces[] = {
      &row.tip, &row.inner, &row.outer, &row.top, &row.lid, &row.ring};
    for (unsigned int s = 0; s < n_surfaces; ++s)
      {
        if (interval > 0.)
          recorded_forces[s] = impulse_on_body[s][vertical] / interval;
        *forces[s] = recorded_forces[s];
        row.total += *forces[s];
      }
    if (interval > 0.)
      recorded_force_of_water = impulse_of_water / interval;
    row.with_water = row.total + recorded_force_of_water;
    if (interval > 0.)
      {
        row.cavity       = cavity_pressure(interval);
        row.prescribed_r = impulse_on_soil[radial] / interval;
        row.prescribed_z = impulse_on_soil[vertical] / interval;
      }
    impulse_on_body  = {};
    impulse_of_water = 0.;
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
                                     const unsigned int,
                                     const unsigned int) {
      max_square = std::max(max_square, velocity.norm_square());
      row.points_in_body += parts.body.shape().contains(position, travel);
    });
    const MPI_Comm communicator = parts.grid.communicator();
    row.max_speed = Utilities::MPI::max(std::sqrt(max_square), communicator);
    row.points_in_body = Utilities::MPI::sum(row.points_in_body, communicator);
    max_in_body        = std::max(max_in_body, row.points_in_body);

    const PointEnergies energies =
      compute_point_energies(parts.points,
                             parts.materials,
                             parts.grid,
                             parts.time_step.inertia_of_translation());
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
    const AllPoints all_points(parts.points,
                               parts.water->pressure_in_stress(),
                               parts.grid.communicator());
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
  Recorder::report_rest()
  {
    const auto travel = parts.body.motion().travel_at_rest();
    if (has_reported_rest || !travel)
      return;
    has_reported_rest = true;
    console->message("the body came to rest at a penetration of " +
                     to_text(parts.body.shape().initial_depth() + *travel, 5) +
                     " m");
  }

  void
  Recorder::report_suction(const HistoryRow &row)
  {
    const auto suction = number_named("suction_Pa", row.counts);
    // beneath a sealed lid, it has nothing to do with the weight
    if (!suction || number_named("lid_growth_m3", row.counts))
      return;
    if (!has_reported_suction && *suction > 0. && last_suction <= 0.)
      {
        has_reported_suction = true;
        console->header(
          {{"suction",
            "begins at a penetration of " + to_text(last_depth, 4) +
              " m, where the weight no longer suffices"}});
      }
    last_depth   = row.penetration;
    last_suction = *suction;
  }

  double
  Recorder::seconds_left(const double fraction_done) const
  {
    const double n = steps_left(), n_made = parts.clock.step - first_step;
    return (seconds_running() - seconds_at_start) *
           (std::isfinite(n) ?
              std::max(n, 0.) / n_made :
              (1. - fraction_done) / (fraction_done - fraction_at_start));
  }

  void
  Recorder::print_record(const HistoryRow &row)
  {
    // where records are dense, not all of them: a line for each percent
    const double done     = parts.schedule.fraction_done();
    const bool   is_first = parts.clock.step == first_step;
    if (!is_first && !parts.schedule.is_finished() &&
        done - fraction_printed < .01 * (1. - 1e-9))
      return;
    fraction_printed = done;
    RecordLine line;
    line.time        = row.time;
    line.has_body    = parts.body.shape().exists();
    line.penetration = row.penetration;
    if (const BodyShape &shape = parts.body.shape();
        line.has_body && !shape.expands())
      line.length = shape.top() - shape.bottom();
    line.tip   = row.tip;
    line.inner = row.inner;
    line.outer = row.outer;
    line.total = row.total;
    if (scene_parts().water_on_body)
      line.with_water = row.with_water;
    line.kinetic_energy = row.kinetic_energy;
    line.max_speed      = row.max_speed;
    const auto column   = [&row](const std::string &name) {
      return number_named(name, row.counts).value_or(0.);
    };
    line.has_suction = number_named("suction_Pa", row.counts).has_value();
    line.suction     = column("suction_Pa");
    if (const auto critical = number_named("critical_gradient", row.counts))
      line.gradient_ratio =
        *critical > 0. ?
          std::max(column("exit_gradient_wall"), column("exit_gradient_axis")) /
            *critical :
          0.;
    line.fraction_done = done;
    line.eta_seconds =
      is_first ? std::numeric_limits<double>::quiet_NaN() : seconds_left(done);
    console->record(line);
    // the text of the file has the whole scene, and takes as long as many steps
    constexpr double interval = 2.; // s of wall time
    const double     now      = seconds_running();
    if (parts.grid.is_first_rank() && now - last_progress >= interval)
      {
        write_progress(done, line.eta_seconds);
        last_progress = now;
      }
  }

  void
  Recorder::write_frame()
  {
    visualization->write_frame(parts.grid,
                               parts.points,
                               parts.body,
                               parts.soil,
                               *parts.water,
                               parts.clock.time);
    last_frame = parts.clock.time;
    store_file_hashes();
  }
} // namespace CaissonMPM
