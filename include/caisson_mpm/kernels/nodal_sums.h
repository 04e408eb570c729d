// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the kernels add to the nodes, and the fields that they read from there.
#ifndef caisson_mpm_kernels_nodal_sums_h
#define caisson_mpm_kernels_nodal_sums_h

namespace CaissonMPM
{
  namespace Kernels
  {
    /** The nodal sums of points_to_grid, interleaved per node. */
    struct alignas(64) NodalSums
    {
      double mass;             // kg per radian
      double momentum[2];      // kg m/s per radian
      double force[2];         // internal + body force, N per radian
      double stiffness;        // bound of sum_J |K_IJ| over partly
                               // filled cells, N/m per radian
      double deformation_mass; // of selective mass scaling, kg per radian
      double padding;
    };

    /** A nodal vector field (r, z), interleaved per node. */
    struct NodalVector
    {
      double value[2];
    };
  } // namespace Kernels
} // namespace CaissonMPM

#endif
