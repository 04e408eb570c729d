// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/water/pressure_projection.h>
#include <caisson_mpm/water/seepage.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    constexpr double tolerance = 1e-6;

    // The equations of a cell are found anew when its shape or its filled share
    // have changed by this.
    constexpr double largest_change = 1e-3;
  } // namespace

  void
  PressureProjection::initialize(const BackgroundGrid &grid_of_run)
  {
    grid = &grid_of_run;
    solver_.initialize(*grid);
    for (NodalData *v : {&pressure_,
                         &outflow_,
                         &source,
                         &volume,
                         &rate,
                         &uniform,
                         &of_uniform})
      grid->reinit(*v, 1);
    equations.assign(grid->n_cells(), Cell());
    volume_rates_.assign(grid->n_cells(),
                         std::numeric_limits<double>::quiet_NaN());
  }

  void
  PressureProjection::find_equations(const Kernels::CellGeometry &geometry,
                                     const double                 filled,
                                     const WaterProperties       &properties,
                                     Cell                        &cell) const
  {
    const double rise    = geometry.bottom_right - geometry.bottom_left;
    const auto   differs = [](const double a, const double b, const double of) {
      return std::abs(a - b) > largest_change * of;
    };
    if (!differs(cell.width, geometry.width, geometry.width) &&
        !differs(cell.left, geometry.left, geometry.width) &&
        !differs(cell.heights[0], geometry.height_left, geometry.height_left) &&
        !differs(cell.heights[1],
                 geometry.height_right,
                 geometry.height_right) &&
        !differs(cell.rise, rise, geometry.height_left) &&
        !differs(cell.filled, filled, filled) &&
        cell.properties.mobility == properties.mobility &&
        cell.properties.specific_volume == properties.specific_volume)
      return;
    cell.width      = geometry.width;
    cell.left       = geometry.left;
    cell.heights[0] = geometry.height_left;
    cell.heights[1] = geometry.height_right;
    cell.rise       = rise;
    cell.filled     = filled;
    cell.properties = properties;

    const CellIntegrals integrals(geometry, grid->axisymmetric() ? 1. : 0.);
    const double        per_mass = properties.specific_volume;
    cell.flow = integrals.stiffness(of_lower_part(properties.mobility, filled));
    cell.inertia =
      integrals.stiffness(of_lower_part({per_mass, per_mass}, filled));
    cell.divergence = integrals.divergence();
    cell.volumes    = integrals.volumes();
    for (unsigned int i = 0; i < 4; ++i)
      {
        cell.volumes[i] *= filled;
        for (double &b : cell.divergence[i])
          b *= filled;
      }
  }

  void
  PressureProjection::set_up(const BackgroundGrid               &grid,
                             const Mudline                      &mudline,
                             const std::vector<WaterProperties> &properties,
                             const PressureSolver::OpenSides    &sides,
                             const double                        dt)
  {
    step = dt;
    solver_.find_states(grid, mudline, sides);
    double largest = 0.;
    for (const unsigned int cell : solver_.cells())
      {
        const WaterProperties &p = properties[cell];
        find_equations(grid.geometry(cell),
                       mudline.filled()[cell],
                       p,
                       equations[cell]);
        largest = std::max({largest,
                            p.mobility.horizontal + dt * p.specific_volume,
                            p.mobility.vertical + dt * p.specific_volume});
      }
    scale = Utilities::MPI::max(largest, grid.communicator());
    for (std::size_t i = 0; i < solver_.cells().size(); ++i)
      {
        const Cell &cell   = equations[solver_.cells()[i]];
        auto       &matrix = solver_.matrices()[i];
        for (std::size_t k = 0; k < matrix.size(); ++k)
          matrix[k] = (cell.flow[k] + dt * cell.inertia[k]) / scale;
      }
    find_volumes();
    find_uniform();
  }

  void
  PressureProjection::find_divergence(
    const Kernels::NodalVector             *velocity,
    const std::vector<Kernels::CornerView> &corners,
    NodalData                              &to) const
  {
    to = 0.;
    to.zero_out_ghost_values();
    for (const unsigned int cell : solver_.cells())
      {
        const unsigned int *const node = grid->cell_nodes(cell).node;
        double                    v[8];
        for (unsigned int j = 0; j < 4; ++j)
          for (unsigned int d = 0; d < 2; ++d)
            v[2 * j + d] = velocity[node[j]].value[d];
        for (const Kernels::CornerView &corner : corners)
          if (corner.cell == cell)
            {
              double *const at_corner = v + 2 * corner.corner;
              const double  free =
                at_corner[corner.free] - corner.velocity[corner.free];
              for (unsigned int d = 0; d < 2; ++d)
                at_corner[d] = corner.velocity[d] + free * corner.q[d];
            }
        for (unsigned int i = 0; i < 4; ++i)
          {
            double sum = 0.;
            for (unsigned int k = 0; k < 8; ++k)
              sum += equations[cell].divergence[i][k] * v[k];
            to.local_element(node[i]) += sum;
          }
      }
    grid->hanging_nodes().distribute(to, 1);
    to.compress(VectorOperation::add);
  }

  void
  PressureProjection::solve(const Kernels::NodalVector             *velocity,
                            const std::vector<Kernels::CornerView> &corners,
                            const double                            kept,
                            const KnownPressures                   &known)
  {
    find_divergence(velocity, corners, outflow_);
    find_product(&Cell::inertia, source);
    source.sadd(kept * step / scale, -1. / scale, outflow_);

    pressure_.zero_out_ghost_values();
    for (unsigned int node = 0; node < grid->n_owned_nodes(); ++node)
      if (solver_.state(node) == PressureSolver::plug)
        pressure_.local_element(node) = known.plug;
      else if (solver_.state(node) == PressureSolver::open)
        pressure_.local_element(node) =
          grid->is_at(node, GridLines::Side::bottom) ? known.bottom : 0.;
    solver_.solve(source, tolerance, pressure_);
    solver_.apply(pressure_, outflow_);
    outflow_.sadd(-1., 1., source);
    close_balance();
    outflow_ *= scale;
  }

  void
  PressureProjection::close_balance()
  {
    // What the solver left of each equation is small, but adds up. A uniform
    // pressure where it is not known takes the sum away.
    if (conductance <= 0.)
      return;
    const double rise =
      solver_.sum_at(outflow_, PressureSolver::unknown) / conductance;
    pressure_.zero_out_ghost_values();
    pressure_.add(rise, uniform);
    pressure_.update_ghost_values();
    grid->hanging_nodes().interpolate(pressure_, 1);
    outflow_.add(-rise, of_uniform);
  }

  void
  PressureProjection::find_flux(NodalData &flux) const
  {
    grid->reinit(flux, 1);
    find_product(&Cell::flow, flux);
    flux *= -1.;
  }

  void
  PressureProjection::find_product(PressureSolver::CellMatrix Cell::*matrix,
                                   NodalData                        &to) const
  {
    to = 0.;
    to.zero_out_ghost_values();
    for (const unsigned int cell : solver_.cells())
      {
        const unsigned int *const node = grid->cell_nodes(cell).node;
        const auto               &k    = equations[cell].*matrix;
        for (unsigned int i = 0; i < 4; ++i)
          {
            double sum = 0.;
            for (unsigned int j = 0; j < 4; ++j)
              sum += k[4 * i + j] * pressure_.local_element(node[j]);
            to.local_element(node[i]) += sum;
          }
      }
    grid->hanging_nodes().distribute(to, 1);
    to.compress(VectorOperation::add);
  }

  void
  PressureProjection::find_volumes()
  {
    volume = 0.;
    volume.zero_out_ghost_values();
    for (const unsigned int cell : solver_.cells())
      for (unsigned int i = 0; i < 4; ++i)
        volume.local_element(grid->cell_nodes(cell).node[i]) +=
          equations[cell].volumes[i];
    grid->hanging_nodes().distribute(volume, 1);
    volume.compress(VectorOperation::add);
  }

  void
  PressureProjection::find_uniform()
  {
    for (unsigned int node = 0; node < grid->n_owned_nodes(); ++node)
      uniform.local_element(node) =
        solver_.state(node) == PressureSolver::unknown ? 1. : 0.;
    uniform.update_ghost_values();
    grid->hanging_nodes().interpolate(uniform, 1);
    solver_.apply(uniform, of_uniform);
    conductance = solver_.sum_at(of_uniform, PressureSolver::unknown);
  }

  void
  PressureProjection::find_volume_rates(
    const Kernels::NodalVector             *velocity,
    const std::vector<Kernels::CornerView> &corners)
  {
    find_divergence(velocity, corners, rate);
    for (unsigned int node = 0; node < grid->n_owned_nodes(); ++node)
      if (volume.local_element(node) > 0.)
        rate.local_element(node) /= volume.local_element(node);
    rate.update_ghost_values();
    grid->hanging_nodes().interpolate(rate, 1);

    volume_rates_.assign(grid->n_cells(),
                         std::numeric_limits<double>::quiet_NaN());
    for (const unsigned int cell : solver_.cells())
      {
        double sum = 0., of_cell = 0.;
        for (unsigned int i = 0; i < 4; ++i)
          {
            const double own = equations[cell].volumes[i];
            sum += own * rate.local_element(grid->cell_nodes(cell).node[i]);
            of_cell += own;
          }
        volume_rates_[cell] = sum / of_cell;
      }
  }
} // namespace CaissonMPM
