// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The moments of a cell, which the kernels keep from one step to the next.
#ifndef caisson_mpm_kernels_cell_moments_h
#define caisson_mpm_kernels_cell_moments_h

namespace CaissonMPM
{
  namespace Kernels
  {
    /** The sums over the MPs of a cell, and what follows from them. */
    struct alignas(64) CellMoments
    {
      // integrals of 1, xi, eta, xi eta, xi2, eta2, xi2 eta, xi eta2, xi2 eta2
      // over the mass: the consistent mass matrix in nine numbers
      double mass[9];
      // integrals of 1, xi, eta, xi eta over the momentum in r, then in z
      double momentum[8];
      union
      {
        // sums for the internal force (kernels/moments.h), which
        // points_to_grid replaces by
        double internal[16];
        // the fit of a full cell: per component value, slope in x, slope in y
        double fit[12];
      };
      double full;    // share of the Gauss points in the integration
      double bounded; // share to which the fit is bounded
      bool   several_materials;
      short  material; // of the first MP
    };
  } // namespace Kernels
} // namespace CaissonMPM

#endif
