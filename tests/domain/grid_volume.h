// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The volume of the cells of a grid.
#ifndef caisson_mpm_tests_grid_volume_h
#define caisson_mpm_tests_grid_volume_h

#include <caisson_mpm/domain/background_grid.h>

/** Return the volume of all cells, or of the rigid ones. Units: m3. */
inline double
volume_of(const BackgroundGrid &grid, const bool rigid_only)
{
  double volume = 0.;
  for (unsigned int c = 0; c < grid.n_cells(); ++c)
    if (grid.is_rigid(c) || !rigid_only)
      {
        const auto  &g = grid.geometry(c);
        const double r = g.left + .5 * g.width;
        volume += 2. * pi * g.width *
                  (r * .5 * (g.height_left + g.height_right) +
                   g.width * (g.height_right - g.height_left) / 12.);
      }
  return volume;
}

#endif
