// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/conventions.h>
#include <caisson_mpm/domain/body_points.h>
#include <caisson_mpm/domain/cell_geometry.h>

namespace CaissonMPM
{
  using namespace dealii;

  std::vector<BodyPoint>
  generate_body_points(const BackgroundGrid &grid, const RigidBody &body)
  {
    std::vector<BodyPoint> points;
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      if (grid.is_rigid(cell) && grid.is_owned(cell))
        {
          const auto  &g           = grid.geometry(cell);
          const double r           = g.left + .5 * g.width;
          const double mean_height = height_of(g);
          BodyPoint    p;
          p.position =
            Point<2>(r, .5 * (g.bottom_left + g.bottom_right + mean_height));
          p.volume =
            (grid.axisymmetric() ? 2. * pi * r : 1.) * g.width * mean_height;
          p.mass = body.density * p.volume;
          p.cell = cell;
          points.push_back(p);
        }
    return points;
  }
} // namespace CaissonMPM
