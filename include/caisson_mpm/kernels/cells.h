// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The geometry and the nodes of the cells, as the kernels see them.
//
// A cell is a trapezoid whose two sides are vertical: r depends on xi only,
//   r = left + width xi,   z = bottom(xi) + height(xi) eta,
// with bottom and height linear in xi. Its inverse map is closed form.
#ifndef caisson_mpm_kernels_cells_h
#define caisson_mpm_kernels_cells_h

namespace CaissonMPM
{
  namespace Kernels
  {
    /** A trapezoid with vertical sides; heights of its left and right side. */
    struct alignas(64) CellGeometry
    {
      double left, width;
      double bottom_left, bottom_right;
      double height_left, height_right;
      double padding[2] = {}; // a cache line
    };

    /** The dofs of a cell's corners (0,0), (1,0), (0,1), (1,1). */
    struct CellNodes
    {
      unsigned int node[4];
    };

    /** How many cells may lie beyond a face of a cell, and beyond all four. */
    constexpr int neighbors_per_face = 2,
                  neighbors_per_cell = 4 * neighbors_per_face;

    /** Options of the kernels for a cell. */
    enum CellFlags : unsigned char
    {
      next_to_body      = 1,
      at_corner_of_body = 2, // where just one cell of the body meets a node
      // sides that are faces of the body, but for the lid, in the order of
      // GridView::neighbors
      body_to_the_left  = 4,
      body_to_the_right = 8,
      body_below        = 16,
      body_above        = 32
    };
  } // namespace Kernels
} // namespace CaissonMPM

#endif
