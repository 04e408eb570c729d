// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/domain/cell_geometry.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/water/pressure_projection.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    // The residual is carried into the next step.
    constexpr double accuracy = .1;

    // Where soil fills a cell by less than the first share, its velocities say
    // nothing of its volume; from the second one on they do.
    constexpr double hardly_filled = .25, well_filled = .75;

    /** Return what the cell at a corner adds to the velocity of the node. */
    std::array<double, 2>
    change_at(const Kernels::CornerView &corner, const Kernels::NodalVector &v)
    {
      const double free = v.value[corner.free] - corner.velocity[corner.free];
      std::array<double, 2> change;
      for (unsigned int d = 0; d < 2; ++d)
        change[d] = corner.velocity[d] + free * corner.q[d] - v.value[d];
      return change;
    }

    /** Return how much the pressure of a cell follows from its own change of
     * volume, and not from the pressures around it. */
    double
    share_of_own(const double filled)
    {
      return std::clamp(
        (filled - hardly_filled) / (well_filled - hardly_filled), 0., 1.);
    }

    /** Return whether cells are the same but for their height and rounding. */
    bool
    have_same_shape(const Kernels::CellGeometry &a,
                    const Kernels::CellGeometry &b)
    {
      const auto same = [&a](const double x, const double y) {
        return std::abs(x - y) <= 1e-10 * (a.width + a.height_left);
      };
      return same(a.left, b.left) && same(a.width, b.width) &&
             same(a.height_left, b.height_left) &&
             same(a.height_right, b.height_right) &&
             same(a.bottom_right - a.bottom_left,
                  b.bottom_right - b.bottom_left);
    }
  } // namespace

  void
  PressureProjection::initialize(const BackgroundGrid &grid_of_run)
  {
    grid = &grid_of_run;
    solver_.initialize(*grid);
    for (CellData *v : {&pressure_,
                        &remainder_,
                        &wet_,
                        &source,
                        &mobility[0],
                        &mobility[1],
                        &inverse_density})
      solver_.reinit(*v);
    for (NodalData *v : {&at_nodes.outflow,
                         &at_nodes.pressure,
                         &at_nodes.conductance,
                         &at_nodes.volume,
                         &at_nodes.specific_volume})
      grid->reinit(*v, 1);
    shapes.assign(grid->n_cells(), {});
    divergence.assign(grid->n_cells(), {});
    force_of.assign(grid->n_cells(), {});
    shares.assign(grid->n_cells(), {});
    volumes.assign(grid->n_cells(), 0.);
    wet_ = -1.;
    wet_.update_ghost_values();
    acting.assign(grid->n_cells(), 0.);
  }

  void
  PressureProjection::register_totals(RunTotals &totals)
  {
    totals.keep("water_step", step);
    totals.carry("water_known_in_plug", known_.plug);
    totals.carry("water_known_at_bottom", known_.bottom);
  }

  void
  PressureProjection::subtract_pressure_of_body(const unsigned int cell,
                                                OfCorners         &of) const
  {
    // sides left, right, below, above, and their corners
    constexpr int corners[4][2] = {{0, 2}, {1, 3}, {0, 1}, {2, 3}};
    const auto   &g             = grid->geometry(cell);
    const double  round         = grid->axisymmetric() ? 1. : 0.;
    for (int side = 0; side < 4; ++side)
      {
        const int other = grid->neighbor(cell, side);
        if (other < 0 || !grid->is_rigid(other))
          continue;
        const bool   is_right = side == 1;
        const double rise     = side == 3 ? g.bottom_right + g.height_right -
                                          g.bottom_left - g.height_left :
                                            g.bottom_right - g.bottom_left;
        const double along[2] = {side < 2 ? 0. : g.width,
                                 side < 2 ?
                                   (is_right ? g.height_right : g.height_left) :
                                   rise};
        const double sign = side == 0 || side == 3 ? 1. : -1.;
        const double r_0  = g.left + is_right * g.width,
                     r[2] = {r_0, r_0 + along[0]};
        for (int i = 0; i < 2; ++i)
          {
            const double weight =
              round * (2. * r[i] + r[1 - i]) / 6. + (1. - round) * .5;
            const int j = corners[side][i];
            of[2 * j] += sign * weight * along[1];
            of[2 * j + 1] -= sign * weight * along[0];
          }
      }
  }

  void
  PressureProjection::find_integrals(const unsigned int cell,
                                     CellIntegrals     &integrals)
  {
    const Kernels::CellGeometry &now = grid->geometry(cell);
    if (have_same_shape(now, shapes[cell]))
      return;
    shapes[cell] = now;
    integrals.reinit(cell);
    volumes[cell]    = integrals.volume();
    shares[cell]     = integrals.shares();
    divergence[cell] = integrals.divergence();
    force_of[cell]   = divergence[cell];
    subtract_pressure_of_body(cell, force_of[cell]);
  }

  void
  PressureProjection::set_up(const BackgroundGrid &grid,
                             const SoilColumns    &soil_columns_now,
                             const std::vector<WaterProperties> &properties,
                             const OpenSides                    &sides,
                             const BoundaryConditions           &conditions,
                             const double                        dt)
  {
    // In a step that is shorter than the last one, the pressure need not do at
    // once what a whole step would do.
    long_step       = std::max(dt, step);
    step            = dt;
    soil_columns    = &soil_columns_now;
    at_nodes.beyond = soil_columns->find_beyond(grid, sides);
    solver_.find_faces(*soil_columns, sides, conditions);
    CellIntegrals integrals(grid);
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      if (!grid.is_rigid(cell))
        find_integrals(cell, integrals);
    begin_in_new_cells();
    find_conductances(properties);
    find_volume_of_nodes();
    find_acting();
  }

  void
  PressureProjection::begin_in_new_cells()
  {
    for (unsigned int cell = 0; cell < grid->n_cells(); ++cell)
      {
        const bool         is_wet  = soil_columns->filled()[cell] > 0.;
        const unsigned int place   = solver_.place(cell);
        double            &was_wet = wet_.local_element(place);
        if (is_wet && was_wet == 0.)
          pressure_.local_element(place) = pressure_above(cell);
        was_wet = is_wet ? 1. : 0.;
      }
  }

  double
  PressureProjection::pressure_above(const unsigned int cell) const
  {
    return soil_columns->side_of(cell) == SoilColumns::Side::plug ?
             known_.plug :
             0.;
  }

  void
  PressureProjection::find_acting()
  {
    for (unsigned int cell = 0; cell < grid->n_cells(); ++cell)
      {
        if (grid->is_rigid(cell))
          continue;
        const double filled = soil_columns->filled()[cell];
        const double above  = pressure_above(cell);
        acting[cell]        = filled > 0. ?
                                filled * pressure_in(cell) + (1. - filled) * above :
                                above;
      }
  }

  void
  PressureProjection::add_force(Kernels::NodalVector *force) const
  {
    for (unsigned int cell = 0; cell < grid->n_cells(); ++cell)
      if (acting[cell] != 0. && grid->is_owned(cell))
        {
          const OfCorners &of = force_of[cell];
          for (unsigned int j = 0; j < 4; ++j)
            for (unsigned int d = 0; d < 2; ++d)
              force[grid->cell_nodes(cell).node[j]].value[d] +=
                acting[cell] * of[2 * j + d];
        }
  }

  void
  PressureProjection::solve(const Kernels::NodalVector             *velocity,
                            const std::vector<Kernels::CornerView> &corners,
                            const std::vector<double>              &mass,
                            const KnownPressures                   &known)
  {
    raise_inertia(mass);
    // 1. div v* of the predicted velocity, which contains the old pressure p'.
    find_volume_rates(velocity, corners);
    const KnownPressures before = known_;
    begin_with(known);

    // 2. Solve sum_f (F_f + dt I_f) (p_c - p_f) = right side.
    compute_source(before);
    source *= 1. / scale;
    solver_.solve(source, known_, accuracy, pressure_);

    // 3. Carry what the solver left of each equation into the next step, with
    //    the share of a whole step that this one was.
    CellData &left_now = source;
    left_now.zero_out_ghost_values();
    left_now.copy_locally_owned_data_from(solver_.residual());
    shift_pressures(left_now);
    remainder_.zero_out_ghost_values();
    remainder_.sadd(1. - step / long_step, scale * step, left_now);
    pressure_.update_ghost_values();
    find_acting();
    find_flow(left_now);
  }

  void
  PressureProjection::compute_source(const KnownPressures &before)
  {
    // dt sum_f I_f (p'_c - p'_f): v* has had the force of p' already
    source            = 0.;
    const auto &faces = solver_.faces();
    for (std::size_t f = 0; f < faces.size(); ++f)
      {
        const auto  &face  = faces[f];
        const double other = face.beyond == Beyond::cell ?
                               pressure_.local_element(face.other_place) :
                               before[face.beyond];
        const double drive = long_step * inertia[f] *
                             (pressure_.local_element(face.place) - other);
        source.local_element(face.place) += drive;
        if (face.beyond == Beyond::cell)
          source.local_element(face.other_place) -= drive;
      }
    // Less the volume change of the soil below the mudline, and what the solver
    // left of the last step. In hardly filled cells it fades out: their
    // pressure follows from those around them.
    for (const unsigned int cell : solver_.cells())
      {
        const unsigned int i = solver_.place(cell);
        const double       x = soil_columns->filled()[cell];
        source.local_element(i) += remainder_.local_element(i) / long_step -
                                   x * volumes[cell] * volume_rates_[cell];
        source.local_element(i) *= share_of_own(x);
      }
    source.zero_out_ghost_values();
  }

  void
  PressureProjection::shift_pressures(CellData &left_now)
  {
    double sum = 0.;
    for (const unsigned int cell : solver_.cells())
      sum += solver_.residual().local_element(solver_.place(cell));
    sum = Utilities::MPI::sum(sum, grid->communicator());
    if (open_conductance <= 0.)
      return;
    const double rise = sum * scale / open_conductance;
    for (const unsigned int cell : solver_.cells())
      pressure_.local_element(solver_.place(cell)) += rise;
    for (std::size_t f = 0; f < solver_.faces().size(); ++f)
      if (solver_.faces()[f].beyond != Beyond::cell)
        left_now.local_element(solver_.faces()[f].place) -=
          rise * solver_.conductances()[f];
  }

  void
  PressureProjection::find_flow(const CellData &left_now)
  {
    // out of the plug, out elsewhere, and what is left of the equations
    std::array<double, 3> sums = {};
    for (std::size_t f = 0; f < solver_.faces().size(); ++f)
      {
        const Beyond beyond = solver_.faces()[f].beyond;
        if (beyond != Beyond::cell)
          sums[beyond != Beyond::plug] += outflow_through(f);
      }
    for (const unsigned int cell : solver_.cells())
      sums[2] += scale * left_now.local_element(solver_.place(cell));
    Utilities::MPI::sum(ArrayView<const double>(sums.data(), sums.size()),
                        grid->communicator(),
                        ArrayView<double>(sums.data(), sums.size()));
    flow_.out  = sums[0] * grid->circumference();
    flow_.in   = -sums[1] * grid->circumference();
    flow_.left = sums[2] * grid->circumference();
  }

  void
  PressureProjection::find_faces_below()
  {
    const auto                     &faces = solver_.faces();
    const std::vector<int>          none(grid->n_cells(), -1);
    std::array<std::vector<int>, 2> below = {{none, none}};
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (faces[f].is_horizontal && faces[f].beyond == Beyond::cell)
        {
          const auto &face     = faces[f];
          const bool  is_upper = grid->geometry(face.cell).bottom_left >
                                grid->geometry(face.other).bottom_left;
          const unsigned int upper = is_upper ? face.cell : face.other;
          below[below[0][upper] >= 0][upper] = f;
        }
    faces_below.assign(faces.size(), {{-1, -1}});
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (faces[f].is_horizontal && faces[f].beyond != Beyond::cell &&
          soil_columns->is_top(faces[f].cell) &&
          soil_columns->filled()[faces[f].cell] < well_filled)
        faces_below[f] = {{below[0][faces[f].cell], below[1][faces[f].cell]}};
  }

  double
  PressureProjection::outflow_through(const std::size_t side) const
  {
    const auto  &face  = solver_.faces()[side];
    const double known = known_[face.beyond];
    if (faces_below[side][0] < 0)
      return seepage[side] * (pressure_.local_element(face.place) - known);
    // what comes through all faces below the cell leaves through the one above
    double through = 0., drive = 0.;
    for (const int f : faces_below[side])
      if (f >= 0)
        {
          const auto        &below = solver_.faces()[f];
          const unsigned int from =
            below.cell == face.cell ? below.other_place : below.place;
          through += seepage[f];
          drive += seepage[f] * (pressure_.local_element(from) - known);
        }
    return seepage[side] / (seepage[side] + through) * drive;
  }

  const NodalData &
  PressureProjection::find_outflow()
  {
    at_nodes.outflow  = 0.;
    const auto &faces = solver_.faces();
    for (std::size_t f = 0; f < faces.size(); ++f)
      {
        const auto &face = faces[f];
        if (face.beyond == Beyond::cell || !face.is_open)
          continue;
        const double out = outflow_through(f);
        const auto  &g   = grid->geometry(face.cell);
        const auto  &n   = grid->cell_nodes(face.cell).node;
        if (!face.is_horizontal)
          {
            at_nodes.outflow.local_element(n[1]) += .5 * out;
            at_nodes.outflow.local_element(n[3]) += .5 * out;
            continue;
          }
        const unsigned int first = face.beyond == Beyond::bottom ? 0 : 2;
        const double       left =
          grid->axisymmetric() ?
                  (3. * g.left + g.width) / (3. * (2. * g.left + g.width)) :
                  .5;
        at_nodes.outflow.local_element(n[first]) += left * out;
        at_nodes.outflow.local_element(n[first + 1]) += (1. - left) * out;
      }
    grid->hanging_nodes().distribute(at_nodes.outflow, 1);
    at_nodes.outflow.compress(VectorOperation::add);
    return at_nodes.outflow;
  }

  std::optional<double>
  PressureProjection::known_at(const unsigned int node) const
  {
    const Beyond beyond = at_nodes.beyond[node];
    if (beyond == Beyond::cell)
      return std::nullopt;
    return known_[beyond];
  }

  const NodalData &
  PressureProjection::find_nodal_pressure()
  {
    for (NodalData *v : {&at_nodes.pressure, &at_nodes.conductance})
      *v = 0.;
    // As much flows to a node from one side as flows from it to the other, so
    // that the pressure of the center that is nearer, or from which water flows
    // with less resistance, counts more. A hanging node follows later.
    for (const unsigned int cell : solver_.cells())
      {
        const Kernels::CellGeometry &g    = grid->geometry(cell);
        const double                 size = std::sqrt(g.width * height_of(g));
        const double                 conductance =
          mobility[1].local_element(solver_.place(cell)) /
          (soil_columns->filled()[cell] * size);
        for (const unsigned int node : grid->cell_nodes(cell).node)
          {
            at_nodes.pressure.local_element(node) +=
              conductance * pressure_in(cell);
            at_nodes.conductance.local_element(node) += conductance;
          }
      }
    for (NodalData *v : {&at_nodes.pressure, &at_nodes.conductance})
      v->compress(VectorOperation::add);
    for (unsigned int node = 0; node < grid->n_owned_nodes(); ++node)
      {
        double &p = at_nodes.pressure.local_element(node);
        if (at_nodes.conductance.local_element(node) > 0.)
          p /= at_nodes.conductance.local_element(node);
        p = known_at(node).value_or(p);
      }
    at_nodes.pressure.update_ghost_values();
    grid->hanging_nodes().interpolate(at_nodes.pressure, 1);
    return at_nodes.pressure;
  }

  const std::vector<double> &
  PressureProjection::find_volume_rates(
    const Kernels::NodalVector             *velocity,
    const std::vector<Kernels::CornerView> &corners)
  {
    volume_rates_.assign(grid->n_cells(),
                         std::numeric_limits<double>::quiet_NaN());
    for (const unsigned int cell : solver_.cells())
      {
        const OfCorners          &of   = divergence[cell];
        const unsigned int *const node = grid->cell_nodes(cell).node;
        double                    sum  = 0.;
        for (unsigned int j = 0; j < 4; ++j)
          sum += of[2 * j] * velocity[node[j]].value[0] +
                 of[2 * j + 1] * velocity[node[j]].value[1];
        volume_rates_[cell] = sum / volumes[cell];
      }
    for (const Kernels::CornerView &corner : corners)
      {
        const auto change = change_at(
          corner, velocity[grid->cell_nodes(corner.cell).node[corner.corner]]);
        const OfCorners &of = divergence[corner.cell];
        volume_rates_[corner.cell] += (of[2 * corner.corner] * change[0] +
                                       of[2 * corner.corner + 1] * change[1]) /
                                      volumes[corner.cell];
      }
    return volume_rates_;
  }
} // namespace CaissonMPM
