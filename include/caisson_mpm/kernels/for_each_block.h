// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The loop over the blocks of points of a cell.
#ifndef caisson_mpm_kernels_for_each_block_h
#define caisson_mpm_kernels_for_each_block_h

#include <caisson_mpm/kernels/layout.h>

/** The attribute of a lambda that is to be inlined into the function that it
 * is passed to. */
#define CAISSON_LAMBDA __attribute__((always_inline))

namespace CaissonMPM::Kernels
{
  /** Call action(block) for the number of each block of a cell. */
  template <typename Action>
  [[gnu::always_inline]] inline void
  for_each_block(const PointsView  &points,
                 const unsigned int cell,
                 const Action      &action)
  {
    int block = points.first_block[cell];
    for (; block >= 0; block = points.next[block])
      action(block);
  }

  /** A number that is known to the compiler. */
  template <int n>
  struct LaneCount
  {
    constexpr operator int() const
    {
      return n;
    }
  };

  /** Call action(n) for the first n lanes of a block with @p count points:
   * those of one register where they hold all of its points, else all. The
   * loop over the registers is unrolled, so that they share what is the same
   * in all lanes. */
  template <typename Number, typename Action>
  [[gnu::always_inline]] inline void
  with_lanes(const int count, const Action &action)
  {
    if (Number::width < block_size && count <= Number::width)
      action(LaneCount<Number::width>());
    else
      action(LaneCount<block_size>());
  }
} // namespace CaissonMPM::Kernels

#endif
