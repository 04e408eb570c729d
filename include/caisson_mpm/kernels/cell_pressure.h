// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The pore pressure of undrained soil, one value p in each cell, in the force
// of the total stress sigma' - p I on the nodes,
//   f_I += p int (grad N_I + e_r kappa / r N_I) dV,
// which is conjugate to the mean volume change of the cell that strains its
// points. On a face of the body with the normal n out of the cell, the water
// there presses back with
//   f_I -= p int N_I n dA,
// so that contact finds the effective force between soil and body.
#ifndef caisson_mpm_kernels_cell_pressure_h
#define caisson_mpm_kernels_cell_pressure_h

#include <caisson_mpm/kernels/pressure_integrals.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      /** Take the pressure of the cells of a group from the stress in their
       * sums for the internal force. */
      template <typename Number>
      void
      add_cell_pressure(const StepContext       &step,
                        const CellGroup<Number> &group,
                        const CellMap<Number>   &map,
                        LaneSums<Number, 16>    &internal)
      {
        constexpr int     width     = Number::width;
        const Number      stress[4] = {group.lanes([&](const unsigned int c) {
                                    return -step.pore_pressure[c];
                                  }),
                                       Number(0.),
                                       Number(0.),
                                       Number(0.)};
        ForceSums<Number> in_full_cells;
        integrate_pressure_in_full_cells(map,
                                         step.grid.axisymmetric,
                                         stress,
                                         in_full_cells);
        double        at_points[width][ForceSums<Number>::size] = {};
        const double *rows[width];
        for (int i = 0; i < width; ++i)
          {
            rows[i] = at_points[i];
            if (step.moments[group.cell[i]].full == 1.)
              continue;
            const double of_cell[4] = {stress[0][i], 0., 0., 0.};
            integrate_pressure_at_points<Number>(step,
                                                 group.cell[i],
                                                 of_cell,
                                                 at_points[i]);
          }
        LaneSums<Number, 16> partial;
        partial.load_lanes(rows);
        const Number full = group.lanes(
          [&](const unsigned int c) { return step.moments[c].full; });
        for (int k = 0; k < ForceSums<Number>::stiffness; ++k)
          internal.sum[k] +=
            full * in_full_cells.sum[k] + (Number(1.) - full) * partial.sum[k];
      }

      /** Add what the water at the faces of the body presses back with to the
       * nodes of a cell. */
      CAISSON_INLINE void
      add_pressure_of_body(const StepContext &step,
                           const unsigned int cell,
                           NodalSums         *nodes)
      {
        // sides left, right, below, above, and their corners
        constexpr int   corners[4][2] = {{0, 2}, {1, 3}, {0, 1}, {2, 3}};
        const CellMap<> map(step.grid.geometry[cell]);
        const double    axisymmetric = step.grid.axisymmetric;
        const double    full         = step.moments[cell].full;
        const double    filled =
          step.points.filled_volume[cell] / map.volume(axisymmetric);
        const double wet = full + (1. - full) * (filled < 1. ? filled : 1.);
        for (int side = 0; side < 4; ++side)
          {
            if (!(step.grid.flags[cell] & (body_to_the_left << side)))
              continue;
            // from one corner to the other
            const bool   is_right = side == 1, is_upper = side == 3;
            const double height   = map.height + is_right * map.height_slope;
            const double along[2] = {side < 2 ? 0. : map.width,
                                     side < 2 ? height :
                                                map.bottom_slope +
                                                  is_upper * map.height_slope};
            const double sign     = side == 0 || side == 3 ? 1. : -1.;
            const double r_0      = map.left + is_right * map.width,
                         r[2]     = {r_0, r_0 + along[0]};
            const double pressure = wet * step.pore_pressure[cell];
            for (int i = 0; i < 2; ++i)
              {
                const double weight =
                  axisymmetric * (2. * r[i] + r[1 - i]) / 6. +
                  (1. - axisymmetric) * .5;
                double *const force =
                  nodes[step.grid.nodes[cell].node[corners[side][i]]].force;
                force[0] += sign * pressure * weight * along[1];
                force[1] -= sign * pressure * weight * along[0];
              }
          }
      }
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
