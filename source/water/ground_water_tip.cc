// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the pressure of the pore water does to the tip of the body.
#include <caisson_mpm/water/ground_water.h>
#include <caisson_mpm/water/seepage.h>

#include <deal.II/base/mpi.h>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    /** Return the areas of the left side of a cell that belong to its lower and
     * its upper node. Units: m2 per radian (m in plane strain). */
    std::array<double, 2>
    areas_of_left_side(const Kernels::CellGeometry &g, const bool axisymmetric)
    {
      const double half = .5 * (axisymmetric ? g.left : 1.) * g.height_left;
      return {{half, half}};
    }
  } // namespace

  template <typename Function>
  std::array<double, 2>
  GroundWater::integrate_over_tip(const Function &value) const
  {
    std::array<double, 2> sums        = {{0., 0.}};
    const bool            of_cylinder = body.shape().expands();
    for (const unsigned int cell : cells_at_tip)
      {
        const auto &geometry = grid.geometry(cell);
        const bool  is_round = grid.axisymmetric();
        const auto area = of_cylinder ? areas_of_left_side(geometry, is_round) :
                                        areas_of_side(geometry, is_round);
        for (unsigned int i = 0; i < 2; ++i)
          {
            sums[0] += area[i] * value(cell, of_cylinder ? 2 * i : 2 + i);
            sums[1] += area[i];
          }
      }
    Utilities::MPI::sum(ArrayView<const double>(sums.data(), sums.size()),
                        grid.communicator(),
                        ArrayView<double>(sums.data(), sums.size()));
    for (double &sum : sums)
      sum *= grid.circumference();
    return sums;
  }

  void
  GroundWater::find_cells_at_tip()
  {
    cells_at_tip.clear();
    const bool of_cylinder = body.shape().expands();
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      {
        const int beyond = grid.neighbor(cell, of_cylinder ? 0 : 3);
        if (grid.is_owned(cell) && !grid.is_rigid(cell) && beyond >= 0 &&
            grid.is_rigid(beyond) &&
            (of_cylinder || mudline.side_of(cell) == Mudline::Side::body))
          cells_at_tip.push_back(cell);
      }
  }

  void
  GroundWater::find_undrained_pressure()
  {
    undrained.find(bulk_modulus, points);
    tip_integral =
      integrate_over_tip([this](const unsigned int cell, const unsigned int) {
        return undrained.pressure()[cell];
      })[0];
  }

  void
  GroundWater::find_tip_integral()
  {
    const auto over_tip = integrate_over_tip(
      [this](const unsigned int cell, const unsigned int corner) {
        return is_coupled() ? projection.pressure_in(cell) :
                              seepage.field().local_element(
                                grid.cell_nodes(cell).node[corner]);
      });
    tip_integral = over_tip[0];
    tip_area     = over_tip[1];
  }
} // namespace CaissonMPM
