// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Places in a cell, which is a trapezoid with two vertical sides:
//   r = left + width xi,   z = bottom(xi) + height(xi) eta,
// with bottom and height linear in xi.
#ifndef caisson_mpm_domain_cell_geometry_h
#define caisson_mpm_domain_cell_geometry_h

#include <caisson_mpm/kernels/layout.h>

#include <deal.II/base/point.h>

#include <algorithm>
#include <array>

namespace CaissonMPM
{
  /** Return the coordinates xi and eta of a place, 0 to 1 inside the cell. */
  inline dealii::Point<2>
  to_reference(const Kernels::CellGeometry &g, const dealii::Point<2> &p)
  {
    const double xi     = (p[0] - g.left) / g.width;
    const double bottom = g.bottom_left + (g.bottom_right - g.bottom_left) * xi;
    const double height = g.height_left + (g.height_right - g.height_left) * xi;
    return dealii::Point<2>(xi, (p[1] - bottom) / height);
  }

  /** Return the place of the coordinates xi and eta. */
  inline dealii::Point<2>
  to_position(const Kernels::CellGeometry &g, const dealii::Point<2> &x)
  {
    const double bottom =
      g.bottom_left + (g.bottom_right - g.bottom_left) * x[0];
    const double height =
      g.height_left + (g.height_right - g.height_left) * x[0];
    return dealii::Point<2>(g.left + g.width * x[0], bottom + height * x[1]);
  }

  /** Return the mean height of a cell, in m. */
  inline double
  height_of(const Kernels::CellGeometry &g)
  {
    return .5 * (g.height_left + g.height_right);
  }

  /** Return the part of a cell below a height; without height where the cell
   * lies above it. Units: m. */
  inline Kernels::CellGeometry
  part_below(Kernels::CellGeometry g, const double z)
  {
    g.height_left  = std::clamp(z - g.bottom_left, 0., g.height_left);
    g.height_right = std::clamp(z - g.bottom_right, 0., g.height_right);
    return g;
  }

  /** Return the areas of the upper or lower side of a cell, seen from above,
   * that belong to its left and right node: the integrals of their shape
   * functions. Units: m2 per radian (m in plane strain). */
  inline std::array<double, 2>
  areas_of_side(const Kernels::CellGeometry &g, const bool axisymmetric)
  {
    const double right = g.left + g.width;
    if (!axisymmetric)
      return {{.5 * g.width, .5 * g.width}};
    return {{(2. * g.left + right) * g.width / 6.,
             (g.left + 2. * right) * g.width / 6.}};
  }
} // namespace CaissonMPM

#endif
