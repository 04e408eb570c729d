// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The memory layout of the material points (MPs), shared by the kernels and the
// class MaterialPoints.
//
// MPs lie in blocks of eight per cell (structure of arrays): a block belongs to
// one cell and one material. Lanes beyond the count of a block are padding:
// they repeat a valid point with mass and volume zero, so that kernels may
// compute on all lanes. A block is a particle of deal.II, with these
// properties: the BlockHeader; what every step needs, the PointBlock; what a
// step of most laws leaves alone, the PointHistory; and what a user's law
// keeps.
#ifndef caisson_mpm_kernels_blocks_h
#define caisson_mpm_kernels_blocks_h

#include <caisson_mpm/kernels/material.h>
#include <caisson_mpm/kernels/point_fields.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    constexpr int block_size = 8;

// the members of a block, from the list of fields
#define CAISSON_LANES(name, ...) double name[block_size];
#define CAISSON_LISTED_LANES(name, n, ...) double name[n][block_size];

    /** The state of up to eight MPs. SI units; volume and mass per radian. */
    struct PointBlock
    {
      CAISSON_BLOCK_FIELDS(CAISSON_LANES, CAISSON_LISTED_LANES, CAISSON_LANES)
    };

    /** What a block keeps of the past of its MPs. SI units, volume per
     * radian. */
    struct PointHistory
    {
      CAISSON_HISTORY_FIELDS(CAISSON_LANES, CAISSON_LISTED_LANES, CAISSON_LANES)
    };
#undef CAISSON_LANES
#undef CAISSON_LISTED_LANES

    /** What the MPs of a block have in common, as numbers of deal.II. */
    struct BlockHeader
    {
      double material;
      double count; // of the MPs, besides padding
    };
  } // namespace Kernels
} // namespace CaissonMPM

#endif
