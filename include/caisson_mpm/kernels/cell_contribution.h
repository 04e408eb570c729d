// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What one cell has added to its corners in points_to_grid: for the few cells
// whose corners do not simply follow their node (operators/contact_corners.h).
#ifndef caisson_mpm_kernels_cell_contribution_h
#define caisson_mpm_kernels_cell_contribution_h

#include <caisson_mpm/kernels/points_to_grid.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      /** The internal force sums of a cell, mixed as in points_to_grid. */
      template <typename Number>
      void
      mix_internal_sums(const StepContext      &step,
                        const unsigned int      cell,
                        LaneSums<Lanes<1>, 16> &sums)
      {
        using One                  = Lanes<1>;
        const CellMoments &moments = step.moments[cell];
        const double       full    = moments.full;
        ForceSums<One>     gauss;
        gauss.clear();
        if (full > 0.)
          {
            One fit[12];
            for (int i = 0; i < 12; ++i)
              fit[i] = One(moments.fit[i]);
            integrate_full_cells(CellMap<One>(step.grid.geometry[cell]),
                                 step.grid.axisymmetric,
                                 fit,
                                 gauss);
          }
        double at_points[ForceSums<One>::size] = {};
        if (full < 1.)
          sum_forces<Number>(step, cell, at_points);
        for (int k = 0; k < sums.size; ++k)
          sums.sum[k] =
            One(full) * gauss.sum[k] + One((1. - full) * at_points[k]);
      }

      /** See KernelTable. */
      template <typename Number>
      void
      cell_contribution(const StepContext &step,
                        const unsigned int cell,
                        NodalSums         *corners)
      {
        using One                  = Lanes<1>;
        const CellMoments &moments = step.moments[cell];
        LaneSums<One, 17>  sums;
        for (int k = 0; k < 9; ++k)
          sums.sum[k] = One(moments.mass[k]);
        for (int k = 0; k < 8; ++k)
          sums.sum[9 + k] = One(moments.momentum[k]);
        const Material       &material      = step.materials[moments.material];
        const One             body_force[2] = {One(material.body_force[0]),
                                               One(material.body_force[1])};
        CellContribution<One> contribution(sums, body_force);
        LaneSums<One, 16>     internal;
        mix_internal_sums<Number>(step, cell, internal);
        contribution.add_forces(internal);
        for (int k = 0; k < 4; ++k)
          {
            corners[k]      = NodalSums();
            corners[k].mass = contribution.mass[k][0];
            for (int d = 0; d < 2; ++d)
              {
                corners[k].momentum[d] = contribution.momentum[d][k][0];
                corners[k].force[d]    = contribution.force[d][k][0];
              }
          }
      }
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
