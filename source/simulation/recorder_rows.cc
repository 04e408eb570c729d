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
#include <numeric>

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

  std::vector<Recorder::Column>
  Recorder::columns() const
  {
    const BodyShape &shape = parts.body.shape();
    const bool       body = shape.exists(), expands = body && shape.expands(),
               caisson =
                 number_named("skirt_length_m", shape.dimensions()).has_value(),
               water = body && !expands && parts.water->traits().resists_body,
               prescribed = parts.boundary_conditions.prescribe_a_region();
    const auto force      = [this](const Surface surface) {
      return [=]() { return recorded_forces[surface]; };
    };
    const auto on_soil = [this](const unsigned int component) {
      return [=]() { return force_on_soil[component]; };
    };
    const auto total = [this]() {
      return std::accumulate(recorded_forces.begin(),
                             recorded_forces.end(),
                             0.);
    };
    const auto sum = [this](const auto of_rank) {
      return Utilities::MPI::sum(of_rank, parts.grid.communicator());
    };
    const auto &contact = parts.nodal_motion.reactions().contact;

    std::vector<Column> all = {
      {"time_s", true, [=]() { return parts.clock.time; }},
      {"penetration_m", true, [=]() { return parts.body.penetration(); }},
      {"tip_force_N", body, force(tip)},
      {"inner_friction_N", body, force(inner_wall)},
      {"outer_friction_N", body, force(outer_wall)},
      {"total_force_N", body, total},
      {"total_force_with_water_N",
       water,
       [=]() { return total() + recorded_force_of_water; }},
      {"top_force_N", body, force(top)},
      {"kinetic_energy_J", true, [=]() { return energies.kinetic; }},
      {"external_work_J", true, [=]() { return parts.energy.work_of_body; }},
      {"water_work_J", water, [=]() { return parts.energy.work_on_water; }},
      {"added_mass_kg",
       true,
       [=]() {
         return parts.grid.circumference() *
                sum(parts.nodal_motion.added_inertia());
       }},
      {"max_speed_m_s", true, [=]() { return max_speed; }},
      {"time_step_s", true, [=]() { return parts.clock.step_size; }},
      {"points_in_body", body, [=]() { return n_in_body; }},
      {"contact_nodes", body, [&, sum]() { return sum(contact.n_touching); }},
      {"sticking_nodes", body, [&, sum]() { return sum(contact.n_sticking); }},
      {"step", true, [=]() { return parts.clock.step; }},
      {"lid_force_N", caisson, force(lid)},
      {"ring_force_N", shape.has_ledges(), force(ring)},
      {"cavity_pressure_Pa", expands, [=]() { return pressure_of_cavity; }},
      {"prescribed_force_r_N", prescribed, on_soil(radial)},
      {"prescribed_force_z_N", prescribed, on_soil(vertical)}};
    for (const EnergyBalance::Term &term : EnergyBalance::terms())
      all.push_back(
        {term.name, true, [=]() { return parts.energy.*term.value; }});
    return all;
  }

  bool
  Recorder::has_count(const std::string &name) const
  {
    if (name == "points_split" || name == "points_merged")
      return parts.generator.splits_and_merges();
    return parts.body.shape().exists() ||
           (name != "soil_into_body_m3" && name != "held_back_count");
  }

  NamedNumbers
  Recorder::find_row() const
  {
    NamedNumbers row;
    for (const Column &column : columns())
      if (column.is_present)
        row.emplace_back(column.name, column.value());
    for (const auto &count : parts.totals.counts())
      if (has_count(count.first))
        row.push_back(count);
    for (const auto &column : parts.water->columns())
      row.push_back(column);
    return row;
  }

  std::vector<std::string>
  Recorder::column_names() const
  {
    std::vector<std::string> names;
    for (const Column &column : columns())
      if (column.is_present)
        names.push_back(column.name);
    for (const std::string &name : parts.totals.count_names())
      if (has_count(name))
        names.push_back(name);
    for (const std::string &name : parts.water->column_names())
      names.push_back(name);
    return names;
  }

  void
  Recorder::record()
  {
    parts.totals.bring_to_first_rank(parts.grid.communicator());
    record_walls();
    find_forces();
    find_sums_over_points();
    const NamedNumbers  row         = find_row();
    std::vector<double> observation = observed_values();
    if (parts.grid.is_first_rank())
      {
        std::vector<double> values;
        for (const auto &column : row)
          values.push_back(column.second);
        history->append(values);
        if (observed)
          {
            observation.insert(observation.begin(), parts.clock.time);
            observed->append(observation);
          }
      }
    report_suction(row);
    print_record(row);
    warn_of_lid();
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
  Recorder::find_forces()
  {
    const double interval = parts.clock.time - last_record;
    pressure_of_cavity    = 0.;
    force_on_soil         = Vector2();
    if (interval > 0.)
      {
        for (unsigned int s = 0; s < n_surfaces; ++s)
          recorded_forces[s] = impulse_on_body[s][vertical] / interval;
        recorded_force_of_water = impulse_of_water / interval;
        pressure_of_cavity      = cavity_pressure(interval);
        for (unsigned int d = 0; d < 2; ++d)
          force_on_soil[d] = impulse_on_soil[d] / interval;
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
  Recorder::find_sums_over_points()
  {
    const double travel     = parts.body.motion().travel();
    double       max_square = 0.;
    n_in_body               = 0;
    parts.points.for_each_motion([&](const Point<2> &position,
                                     const Vector2  &velocity,
                                     const double,
                                     const unsigned int,
                                     const unsigned int) {
      max_square = std::max(max_square, velocity.norm_square());
      n_in_body += parts.body.shape().contains(position, travel);
    });
    const MPI_Comm communicator = parts.grid.communicator();
    max_speed = Utilities::MPI::max(std::sqrt(max_square), communicator);
    n_in_body = Utilities::MPI::sum(n_in_body, communicator);
    known.max_in_body = std::max(known.max_in_body, n_in_body);
    energies          = compute_point_energies(parts.points,
                                      parts.materials,
                                      parts.grid,
                                      parts.time_step.inertia_of_translation());
    parts.energy.close(energies);
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
  Recorder::warn_of_lid()
  {
    if (at_lid || recorded_forces[lid] == 0.)
      return;
    at_lid = true;
    console->warning("the soil plug touches the lid at a penetration of " +
                     to_text(parts.body.penetration(), 6) +
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
  Recorder::report_suction(const NamedNumbers &row)
  {
    const auto suction = number_named("suction_Pa", row);
    // beneath a sealed lid, it has nothing to do with the weight
    if (!suction || number_named("lid_growth_m3", row))
      return;
    if (!has_reported_suction && *suction > 0. && last_suction <= 0.)
      {
        has_reported_suction = true;
        console->header(
          {{"suction",
            "begins at a penetration of " + to_text(last_depth, 4) +
              " m, where the weight no longer suffices"}});
      }
    last_depth   = parts.body.penetration();
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
  Recorder::print_record(const NamedNumbers &row)
  {
    // where records are dense, not all of them: a line for each percent
    const double done     = parts.schedule.fraction_done();
    const bool   is_first = parts.clock.step == first_step;
    if (!is_first && !parts.schedule.is_finished() &&
        done - fraction_printed < .01 * (1. - 1e-9))
      return;
    fraction_printed       = done;
    const BodyShape &shape = parts.body.shape();
    const double     eta =
      is_first ? std::numeric_limits<double>::quiet_NaN() : seconds_left(done);
    const bool has_length = shape.exists() && !shape.expands();
    console->record(
      {row, done, eta, has_length ? shape.top() - shape.bottom() : 1.});
    // the text of the file has the whole scene, and takes as long as many steps
    constexpr double interval = 2.; // s of wall time
    const double     now      = seconds_running();
    if (parts.grid.is_first_rank() && now - last_progress >= interval)
      {
        write_progress(done, eta);
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
