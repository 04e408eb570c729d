// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/water/tip_integral.h>

namespace CaissonMPM
{
  void
  TipIntegral::reinit(const BackgroundGrid &grid,
                      const BodyShape      &shape,
                      const Mudline        &mudline)
  {
    cells.clear();
    of_cylinder = shape.expands();
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      {
        const int beyond = grid.neighbor(cell, of_cylinder ? 0 : 3);
        if (grid.is_owned(cell) && !grid.is_rigid(cell) && beyond >= 0 &&
            grid.is_rigid(beyond) &&
            (of_cylinder || mudline.side_of(cell) == Mudline::Side::body))
          cells.push_back(cell);
      }
  }

  std::array<double, 2>
  TipIntegral::areas_at_tip(const BackgroundGrid &grid,
                            const unsigned int    cell) const
  {
    const Kernels::CellGeometry &g        = grid.geometry(cell);
    const bool                   is_round = grid.axisymmetric();
    if (!of_cylinder)
      return areas_of_side(g, is_round);
    const double half = .5 * (is_round ? g.left : 1.) * g.height_left;
    return {{half, half}};
  }
} // namespace CaissonMPM
