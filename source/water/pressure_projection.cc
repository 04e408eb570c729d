// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/water/pressure_projection.h>
#include <caisson_mpm/water/seepage.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    // What is left is made good in the next step.
    constexpr PressureSolver::Accuracy accuracy = {1e-8, 1e-1};

    // The equations of a cell are found anew when its shape or its filled share
    // have changed by this.
    constexpr double largest_change = 1e-3;

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
  } // namespace

  void
  PressureProjection::initialize(const BackgroundGrid &grid_of_run,
                                 const unsigned int    n_layers_of_run)
  {
    grid     = &grid_of_run;
    n_layers = n_layers_of_run;
    solver_.initialize(*grid);
    for (NodalData *v : {&pressure_,
                         &kept_,
                         &outflow_,
                         &remainder_,
                         &source,
                         &rate,
                         &uniform,
                         &of_uniform})
      grid->reinit(*v, 1);
    grid->reinit(of_nodes, n_layers + 1);
    grid->reinit(gradient, 2 * n_layers);
    const unsigned int n_cells = grid->n_cells();
    shapes.assign(n_cells, Shape());
    flow.resize(n_cells);
    inertia.resize(n_cells);
    divergence.resize(n_cells);
    gradients.resize(n_cells);
    volume_rates_.assign(grid->n_cells(),
                         std::numeric_limits<double>::quiet_NaN());
  }

  void
  PressureProjection::find_equations(const unsigned int           cell,
                                     const Kernels::CellGeometry &geometry,
                                     const double                 filled,
                                     const WaterProperties       &properties)
  {
    Shape       &shape   = shapes[cell];
    const double rise    = geometry.bottom_right - geometry.bottom_left;
    const auto   differs = [](const double a, const double b, const double of) {
      return std::abs(a - b) > largest_change * of;
    };
    if (!differs(shape.width, geometry.width, geometry.width) &&
        !differs(shape.left, geometry.left, geometry.width) &&
        !differs(shape.heights[0],
                 geometry.height_left,
                 geometry.height_left) &&
        !differs(shape.heights[1],
                 geometry.height_right,
                 geometry.height_right) &&
        !differs(shape.rise, rise, geometry.height_left) &&
        !differs(shape.filled, filled, filled) &&
        shape.properties.mobility == properties.mobility &&
        shape.properties.specific_volume == properties.specific_volume &&
        shape.properties.layer == properties.layer)
      return;
    shape = {geometry.width,
             geometry.left,
             {geometry.height_left, geometry.height_right},
             rise,
             filled,
             properties};

    const CellIntegrals integrals(geometry, grid->axisymmetric() ? 1. : 0.);
    const double        per_mass = properties.specific_volume;
    flow[cell] =
      integrals.stiffness(of_lower_part(properties.mobility, filled));
    inertia[cell] =
      integrals.stiffness(of_lower_part({per_mass, per_mass}, filled));
    divergence[cell] = integrals.divergence();
    gradients[cell]  = {integrals.mean_gradient(),
                        integrals.volumes(),
                        per_mass,
                        properties.layer};
    for (unsigned int i = 0; i < 4; ++i)
      {
        gradients[cell].volumes[i] *= filled;
        gradients[cell].mean[1][i] /= filled;
        for (auto &b : divergence[cell])
          b[i] *= filled;
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
    has_water.assign(grid.n_cells(), 0);
    for (const unsigned int cell : solver_.cells())
      {
        const WaterProperties &p = properties[cell];
        has_water[cell]          = 1;
        find_equations(cell, grid.geometry(cell), mudline.filled()[cell], p);
        largest = std::max({largest,
                            p.mobility.horizontal + dt * p.specific_volume,
                            p.mobility.vertical + dt * p.specific_volume});
      }
    scale = Utilities::MPI::max(largest, grid.communicator());
    for (std::size_t i = 0; i < solver_.cells().size(); ++i)
      {
        const unsigned int cell   = solver_.cells()[i];
        auto              &matrix = solver_.matrices()[i];
        for (std::size_t k = 0; k < matrix.size(); ++k)
          matrix[k] = (flow[cell][k] + dt * inertia[cell][k]) / scale;
      }
    find_volumes();
    find_uniform();
  }

  template <typename Action>
  void
  PressureProjection::sum_cells(NodalData         &to,
                                const unsigned int n_components,
                                const Action      &add) const
  {
    to = 0.;
    to.zero_out_ghost_values();
    for (const unsigned int cell : solver_.cells())
      add(cell, grid->cell_nodes(cell).node, to.begin());
    add_up(to, n_components);
  }

  void
  PressureProjection::add_up(NodalData         &of_cells,
                             const unsigned int n_components) const
  {
    grid->hanging_nodes().distribute(of_cells, n_components);
    of_cells.compress(VectorOperation::add);
  }

  void
  PressureProjection::find_divergence(
    const Kernels::NodalVector             *velocity,
    const std::vector<Kernels::CornerView> &corners,
    NodalData                              &to) const
  {
    // what velocity v at the corner j of a cell drives out at its nodes
    const auto add = [this](const unsigned int cell,
                            const unsigned int j,
                            const double      *v,
                            double            *of_cell) {
      const Divergence &of = divergence[cell];
      for (unsigned int i = 0; i < 4; ++i)
        of_cell[i] += of[2 * j][i] * v[0] + of[2 * j + 1][i] * v[1];
    };
    to = 0.;
    to.zero_out_ghost_values();
    double *const sums = to.begin();
    for (const unsigned int cell : solver_.cells())
      {
        const unsigned int *const node       = grid->cell_nodes(cell).node;
        double                    of_cell[4] = {};
        for (unsigned int j = 0; j < 4; ++j)
          add(cell, j, velocity[node[j]].value, of_cell);
        for (unsigned int i = 0; i < 4; ++i)
          sums[node[i]] += of_cell[i];
      }
    for (const Kernels::CornerView &corner : corners)
      if (has_water[corner.cell])
        {
          const unsigned int *const node = grid->cell_nodes(corner.cell).node;
          double                    of_cell[4] = {};
          add(corner.cell,
              corner.corner,
              change_at(corner, velocity[node[corner.corner]]).data(),
              of_cell);
          for (unsigned int i = 0; i < 4; ++i)
            sums[node[i]] += of_cell[i];
        }
    add_up(to, 1);
  }

  void
  PressureProjection::find_gradient()
  {
    const double *const p = pressure_.begin();
    sum_cells(gradient,
              2 * n_layers,
              [&](const unsigned int        cell,
                  const unsigned int *const node,
                  double *const             sums) {
                const Gradient &of = gradients[cell];
                for (unsigned int d = 0; d < 2; ++d)
                  {
                    double mean = 0.;
                    for (unsigned int j = 0; j < 4; ++j)
                      mean += of.mean[d][j] * p[node[j]];
                    for (unsigned int j = 0; j < 4; ++j)
                      sums[2 * (node[j] * n_layers + of.layer) + d] +=
                        of.volumes[j] * mean;
                  }
              });
    double       *values = gradient.begin();
    const double *volume = of_nodes.begin();
    for (unsigned int node = 0; node < grid->n_owned_nodes(); ++node, ++volume)
      for (unsigned int layer = 0; layer < n_layers; ++layer, ++volume)
        for (unsigned int d = 0; d < 2; ++d, ++values)
          if (*volume > 0.)
            *values /= *volume;
    gradient.update_ghost_values();
    grid->hanging_nodes().interpolate(gradient, 2 * n_layers);
  }

  void
  PressureProjection::find_kept(const double smoothing)
  {
    find_gradient();
    find_product(inertia, pressure_, source);
    const double *const at_nodes = gradient.begin();
    sum_cells(rate,
              1,
              [&](const unsigned int        cell,
                  const unsigned int *const node,
                  double *const             sums) {
                const Gradient &of = gradients[cell];
                for (unsigned int d = 0; d < 2; ++d)
                  {
                    double mean = 0.;
                    for (unsigned int j = 0; j < 4; ++j)
                      mean += of.volumes[j] *
                              at_nodes[2 * (node[j] * n_layers + of.layer) + d];
                    mean *= of.specific_volume;
                    for (unsigned int i = 0; i < 4; ++i)
                      sums[node[i]] += of.mean[d][i] * mean;
                  }
              });
    kept_.zero_out_ghost_values();
    kept_.copy_locally_owned_data_from(pressure_);
    for (unsigned int node = 0; node < grid->n_owned_nodes(); ++node)
      {
        const double diagonal =
          of_nodes.local_element(node * (n_layers + 1) + n_layers);
        if (solver_.state(node) == PressureSolver::unknown && diagonal > 0.)
          kept_.local_element(node) -=
            smoothing *
            (source.local_element(node) - rate.local_element(node)) / diagonal;
      }
    kept_.update_ghost_values();
    grid->hanging_nodes().interpolate(kept_, 1);
  }

  void
  PressureProjection::solve(const Kernels::NodalVector             *velocity,
                            const std::vector<Kernels::CornerView> &corners,
                            const KnownPressures                   &known)
  {
    find_divergence(velocity, corners, rate);
    find_product(inertia, kept_, source);
    source.sadd(step / scale, -1. / scale, rate);
    // A step that is shorter than the last one makes good its share of what
    // that one left: all of it at once would be a flood.
    const double share = std::min(1., step / std::max(step_before, step));
    step_before        = step;
    source.add(share / (step * scale), remainder_);

    pressure_.zero_out_ghost_values();
    for (unsigned int node = 0; node < grid->n_owned_nodes(); ++node)
      if (solver_.state(node) == PressureSolver::plug)
        pressure_.local_element(node) = known.plug;
      else if (solver_.state(node) == PressureSolver::open)
        pressure_.local_element(node) =
          grid->is_at(node, GridLines::Side::bottom) ? known.bottom : 0.;
    solver_.solve(source, accuracy, pressure_);
    solver_.apply(pressure_, outflow_);
    outflow_.sadd(-1., 1., source);
    close_balance();
    outflow_ *= scale;
    remainder_.zero_out_ghost_values();
    remainder_.sadd(1. - share, step, outflow_);
    solver_.keep_unknown(remainder_);
  }

  void
  PressureProjection::close_balance()
  {
    // What the solver left of each equation is small, but adds up. A uniform
    // pressure where it is not known takes the sum away.
    if (conductance <= 0.)
      return;
    const double rise =
      solver_.sums_by_state(outflow_)[PressureSolver::unknown] / conductance;
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
    find_product(flow, pressure_, flux);
    flux *= -1.;
  }

  void
  PressureProjection::find_product(
    const std::vector<PressureSolver::CellMatrix> &matrices,
    const NodalData                               &p,
    NodalData                                     &to) const
  {
    const double *const value = p.begin();
    sum_cells(to,
              1,
              [&](const unsigned int        cell,
                  const unsigned int *const node,
                  double *const             sums) {
                const auto &k          = matrices[cell];
                double      of_cell[4] = {};
                for (unsigned int j = 0; j < 4; ++j)
                  for (unsigned int i = 0; i < 4; ++i)
                    of_cell[i] += k[4 * j + i] * value[node[j]];
                for (unsigned int i = 0; i < 4; ++i)
                  sums[node[i]] += of_cell[i];
              });
  }

  void
  PressureProjection::find_volumes()
  {
    sum_cells(of_nodes,
              n_layers + 1,
              [&](const unsigned int        cell,
                  const unsigned int *const node,
                  double *const             sums) {
                for (unsigned int i = 0; i < 4; ++i)
                  {
                    double *const of_node = sums + node[i] * (n_layers + 1);
                    of_node[gradients[cell].layer] +=
                      gradients[cell].volumes[i];
                    of_node[n_layers] += inertia[cell][5 * i];
                  }
              });
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
    conductance = solver_.sums_by_state(of_uniform)[PressureSolver::unknown];
  }

  void
  PressureProjection::find_volume_rates(
    const Kernels::NodalVector             *velocity,
    const std::vector<Kernels::CornerView> &corners)
  {
    find_divergence(velocity, corners, rate);
    const double *of_node = of_nodes.begin();
    for (unsigned int node = 0; node < grid->n_owned_nodes(); ++node)
      {
        const double volume = std::accumulate(of_node, of_node + n_layers, 0.);
        if (volume > 0.)
          rate.local_element(node) /= volume;
        of_node += n_layers + 1;
      }
    rate.update_ghost_values();
    grid->hanging_nodes().interpolate(rate, 1);

    volume_rates_.assign(grid->n_cells(),
                         std::numeric_limits<double>::quiet_NaN());
    for (const unsigned int cell : solver_.cells())
      {
        double sum = 0., of_cell = 0.;
        for (unsigned int i = 0; i < 4; ++i)
          {
            const double own = gradients[cell].volumes[i];
            sum += own * rate.local_element(grid->cell_nodes(cell).node[i]);
            of_cell += own;
          }
        volume_rates_[cell] = sum / of_cell;
      }
  }
} // namespace CaissonMPM
