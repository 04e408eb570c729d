// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/water/seepage.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <vector>

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
    const double  scale = largest_conductance(grid, permeability);
    CellIntegrals integrals(grid);
    for (std::size_t i = 0; i < solver_.cells().size(); ++i)
      {
        const unsigned int cell = solver_.cells()[i];
        const Conductance  k =
          of_lower_part(permeability[cell], mudline.filled()[cell]);
        integrals.reinit(cell);
        solver_.matrices()[i] =
          integrals.stiffness({k.horizontal / scale, k.vertical / scale});
      }
    phi.zero_out_ghost_values();
    for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
      if (solver_.state(node) == PressureSolver::plug)
        phi.local_element(node) = 1.;
      else if (solver_.state(node) == PressureSolver::open)
        phi.local_element(node) = 0.;
    solver_.solve(no_source, tolerance, phi);
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

    /** A part of the mudline of the plug; extensive values per radian. */
    struct Outlet
    {
      double r            = 0.; // m
      double flow         = 0.; // out of the soil, m2/s or that over a pressure
      double conductivity = 0.; // permeability times area, m3/s

      bool
      operator<(const Outlet &other) const
      {
        return r < other.r;
      }

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &r &flow &conductivity;
      }
    };

    /** Fit i = a + b d^2 over the distance d < @p width from @p wall, each
     * outlet weighted with its conductivity times 1 - (d / width)^2, and return
     * a. Units: m. */
    double
    gradient_at_wall(const std::vector<Outlet> &outlets,
                     const double               wall,
                     const double               width)
    {
      double one = 0., x = 0., xx = 0., i = 0., ix = 0.;
      for (const Outlet &o : outlets)
        {
          const double d = (wall - o.r) / width, square = d * d,
                       share = std::max(0., 1. - square);
          one += share * o.conductivity;
          x += share * o.conductivity * square;
          xx += share * o.conductivity * square * square;
          i += share * o.flow;
          ix += share * o.flow * square;
        }
      const double determinant = one * xx - x * x;
      // no other node within the width
      if (determinant <= 1e-9 * one * one)
        return outlets.back().flow / outlets.back().conductivity;
      return (i * xx - ix * x) / determinant;
    }
  } // namespace

  ExitGradient
  exit_gradient(const BackgroundGrid           &grid,
                const Mudline                  &mudline,
                const std::vector<Conductance> &permeability,
                const NodalData                &outflow,
                const double                    wall,
                const double                    width)
  {
    const NodalData conductivity =
      conductivity_of_plug(grid, mudline, permeability);
    std::vector<Outlet> own;
    for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
      if (conductivity.local_element(node) > 0.)
        own.push_back({grid.r_of(node),
                       outflow.local_element(node),
                       conductivity.local_element(node)});
    std::vector<Outlet> outlets;
    for (const auto &of_rank :
         Utilities::MPI::all_gather(grid.communicator(), own))
      outlets.insert(outlets.end(), of_rank.begin(), of_rank.end());
    std::sort(outlets.begin(), outlets.end());
    ExitGradient result;
    if (outlets.empty())
      return result;
    result.axis = outlets.front().flow / outlets.front().conductivity;
    result.wall = gradient_at_wall(outlets, wall, width);
    return result;
  }
} // namespace CaissonMPM
