// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The loop over the blocks of points of a cell.
#ifndef caisson_mpm_kernels_for_each_block_h
#define caisson_mpm_kernels_for_each_block_h

#include <caisson_mpm/kernels/layout.h>

/** The attribute of a lambda that is to be inlined into the function that it
 * is passed to. */
#define CAISSON_LAMBDA __attribute__((always_inline))

namespace CaissonMPM
{
  namespace Kernels
  {
    /** Call action(block) for the number of each block of a cell. */
    template <typename Action>
    [[gnu::always_inline]] inline void
    for_each_block(const PointsView  &points,
                   const unsigned int cell,
                   const Action      &action)
    {
      int block = points.first_block[cell];
      for (; block >= 0; block = points.headers[block].next)
        action(block);
    }
  } // namespace Kernels
} // namespace CaissonMPM

#endif
