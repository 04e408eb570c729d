// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Plain views of the points, of the grid and of the corners, which the kernels
// take instead of the classes that own the memory.
#ifndef caisson_mpm_kernels_views_h
#define caisson_mpm_kernels_views_h

#include <caisson_mpm/kernels/blocks.h>
#include <caisson_mpm/kernels/forward.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    /** Objects at equal distances in memory. */
    template <typename Object>
    struct Rows
    {
      char *begin    = nullptr;
      long  distance = 0; // bytes

      Rows() = default;
      Rows(Object *const array, const long distance = sizeof(Object))
        : begin(reinterpret_cast<char *>(array))
        , distance(distance)
      {}

      Object &
      operator[](const int i) const
      {
        return *reinterpret_cast<Object *>(begin + i * distance);
      }
    };

    /**
     * All MPs of a rank. The view belongs to MaterialPoints::view() and is out
     * of date as soon as points are added, taken out or moved to other cells.
     */
    struct PointsView
    {
      Rows<PointBlock>   blocks;
      Rows<PointHistory> histories; // of the blocks
      Rows<BlockHeader>  headers;   // of the blocks
      const int         *next;      // block of the cell, -1 at the end
      // [n_cells], -1: none. For a ghost cell this is only a flag: 0 = its
      // owner has MPs there, -1 = none
      const int          *first_block;
      const unsigned int *active_cells; // [n_active_cells] cells with MPs
      unsigned int        n_active_cells;
      double             *filled_volume; // [n_cells], of the MPs in it
      unsigned char *changed; // [n_cells], whether MPs came or went: the cell's
                              // moments are not those of its MPs
      // [n_cells], blocks that the return to a yield surface took time for in
      // the last step
      unsigned short *n_yielding;
      // of the blocks [block_size][n_user_state]: what the user's law keeps
      // (user_point.h), if there is one
      Rows<double> user_state   = {};
      int          n_user_state = 0;

      int
      count(const int block) const
      {
        return static_cast<int>(headers[block].count);
      }
      int
      material(const int block) const
      {
        return static_cast<int>(headers[block].material);
      }
    };

    /** The cells that a rank knows, at one position of the moving grid. */
    struct GridView
    {
      const CellGeometry  *geometry; // [n_cells]
      const CellNodes     *nodes;    // [n_cells]
      const unsigned char *flags;    // [n_cells]
      // [n_cells][4][neighbors_per_face] soil cells left, right, below and
      // above; -1: none
      const int *neighbors;
      double     axisymmetric; // 1, or 0 in plane strain
    };

    /** A corner at which a cell sees another velocity than that of its node:
     * v' = V + (v - V)[free] q, with the velocity V of the body. */
    struct CornerView
    {
      unsigned int cell, corner, free;
      double       q[2], velocity[2];
    };
  } // namespace Kernels
} // namespace CaissonMPM

#endif
