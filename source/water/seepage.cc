// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/water/seepage.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <utility>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    constexpr double tolerance = 1e-11;
  }

  void
  Seepage::initialize(const BackgroundGrid &grid)
  {
    solver_.initialize(grid);
    for (NodalData *v : {&phi, &no_source, &residual_})
      grid.reinit(*v, 1);
  }

  void
  Seepage::solve(const BackgroundGrid            &grid,
                 const Mudline                   &mudline,
                 const std::vector<Conductance>  &permeability,
                 const PressureSolver::OpenSides &sides)
  {
    solver_.find_states(grid, mudline, sides);
    const double scale = largest_conductance(grid, permeability);
    for (std::size_t i = 0; i < solver_.cells().size(); ++i)
      {
        const unsigned int cell = solver_.cells()[i];
        const Conductance  k =
          of_lower_part(permeability[cell], mudline.filled()[cell]);
        solver_.matrices()[i] =
          CellIntegrals(grid.geometry(cell), grid.axisymmetric() ? 1. : 0.)
            .stiffness({k.horizontal / scale, k.vertical / scale});
      }
    phi.zero_out_ghost_values();
    for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
      if (solver_.state(node) == PressureSolver::plug)
        phi.local_element(node) = 1.;
      else if (solver_.state(node) == PressureSolver::open)
        phi.local_element(node) = 0.;
    solver_.solve(no_source, {tolerance, 0.}, phi);
    solver_.apply(phi, residual_);
    residual_ *= scale;
  }

  Conductance
  of_lower_part(const Conductance &c, const double filled)
  {
    return {c.horizontal * filled, c.vertical / filled};
  }

  double
  largest_conductance(const BackgroundGrid           &grid,
                      const std::vector<Conductance> &conductance)
  {
    double largest = 0.;
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      if (grid.is_owned(cell))
        largest = std::max(
          {largest, conductance[cell].horizontal, conductance[cell].vertical});
    return Utilities::MPI::max(largest, grid.communicator());
  }

  namespace
  {
    /** Return the permeability times the area of the mudline of the plug that
     * belongs to each node. [n_nodes], m3/s per radian */
    NodalData
    conductivity_of_plug(const BackgroundGrid           &grid,
                         const Mudline                  &mudline,
                         const std::vector<Conductance> &permeability)
    {
      NodalData conductivity;
      grid.reinit(conductivity, 1);
      for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
        {
          if (!grid.is_owned(cell) || !mudline.is_top(cell) ||
              mudline.side_of(cell) != Mudline::Side::plug)
            continue;
          const auto &node = grid.cell_nodes(cell).node;
          const auto  area =
            areas_of_side(grid.geometry(cell), grid.axisymmetric());
          for (unsigned int i = 0; i < 2; ++i)
            conductivity.local_element(node[2 + i]) +=
              permeability[cell].vertical * area[i];
        }
      conductivity.compress(VectorOperation::add);
      return conductivity;
    }
  } // namespace

  ExitGradient
  exit_gradient(const BackgroundGrid           &grid,
                const Mudline                  &mudline,
                const std::vector<Conductance> &permeability,
                const NodalData                &outflow)
  {
    const NodalData conductivity =
      conductivity_of_plug(grid, mudline, permeability);
    using Place = std::pair<double, double>; // r, gradient
    std::vector<Place> own;
    for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
      if (conductivity.local_element(node) > 0.)
        own.emplace_back(grid.r_of(node),
                         outflow.local_element(node) /
                           conductivity.local_element(node));
    std::vector<Place> places;
    for (const auto &of_rank :
         Utilities::MPI::all_gather(grid.communicator(), own))
      places.insert(places.end(), of_rank.begin(), of_rank.end());
    std::sort(places.begin(), places.end());
    ExitGradient result;
    if (places.empty())
      return result;
    result.axis = places.front().second;
    result.wall = places.back().second;
    return result;
  }
} // namespace CaissonMPM
