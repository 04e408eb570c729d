// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The pore pressure of undrained soil, one value p in each cell, in the force
// of the total stress sigma' - p I on the nodes,
//   f_I += p int (grad N_I + e_r kappa / r N_I) dV,
// over the whole of a cell, with a smaller p in one that is filled in part.
// This is conjugate to the mean volume change of the cell that strains its
// points. On a face of the body with the normal n out of the cell, the water
// there presses back with
//   f_I -= p int N_I n dA,
// so that contact finds the effective force between soil and body.
#ifndef caisson_mpm_kernels_cell_pressure_h
#define caisson_mpm_kernels_cell_pressure_h

#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/kernels/pressure_integrals.h>
#include <caisson_mpm/kernels/update_stress.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** The share of a cell in which its pressure acts: that of its height
     * which is filled, as a volume where points are its quadrature points. */
    [[gnu::always_inline]] inline double
    acting_share(const StepContext &step, const unsigned int cell)
    {
      const double filled =
        step.points.filled_volume[cell] /
        CellMap<>(step.grid.geometry[cell]).volume(step.grid.axisymmetric);
      const double full = step.moments[cell].full;
      return full + (1. - full) * (filled < 1. ? filled : 1.);
    }

    [[gnu::always_inline]] inline double
    acting_pressure(const StepContext &step, const unsigned int cell)
    {
      return acting_share(step, cell) * step.pore_pressure[cell];
    }

    /** The work on the water of a cell that grows by @p growth, div v dt, in
     * this step: of the mean of its pressures before and after, over the
     * volume in which its force acts. J per radian. */
    [[gnu::always_inline]] inline double
    work_on_water(const StepContext &step,
                  const unsigned int cell,
                  const double       growth)
    {
      // the water is the same in all materials
      const double modulus  = step.materials[0].water_modulus,
                   pressure = step.pore_pressure[cell] - .5 * modulus * growth;
      return -pressure * growth * acting_share(step, cell) *
             CellMap<>(step.grid.geometry[cell]).volume(step.grid.axisymmetric);
    }

    /** The same of the cells of a group in a step of @p dt (s). */
    template <typename Number>
    [[gnu::always_inline]] inline double
    work_on_water(const StepContext       &step,
                  const CellGroup<Number> &group,
                  const CellUpdate        *update,
                  const double             dt)
    {
      double work = 0.;
      for (int i = 0; i < group.n; ++i)
        work +=
          work_on_water(step, group.cell[i], update[i].mean_divergence * dt);
      return work;
    }

    /** Take the pressure of the cells of a group from the stress in their
     * sums for the internal force. */
    template <typename Number>
    [[gnu::always_inline]] inline void
    add_cell_pressure(const StepContext       &step,
                      const CellGroup<Number> &group,
                      const CellMap<Number>   &map,
                      LaneSums<Number, 16>    &internal)
    {
      const Number      stress[4] = {group.lanes([&](const unsigned int c) {
                                  return -acting_pressure(step, c);
                                }),
                                     Number(0.),
                                     Number(0.),
                                     Number(0.)};
      ForceSums<Number> sums;
      integrate_pressure_in_full_cells(map,
                                       step.grid.axisymmetric,
                                       stress,
                                       sums);
      for (int k = 0; k < ForceSums<Number>::stiffness; ++k)
        internal.sum[k] += sums.sum[k];
    }

    /** Add what the water at the faces of the body presses back with to the
     * nodes of a cell. */
    [[gnu::always_inline]] inline void
    add_pressure_of_body(const StepContext &step,
                         const unsigned int cell,
                         NodalSums         *nodes)
    {
      // sides left, right, below, above, and their corners
      constexpr int   corners[4][2] = {{0, 2}, {1, 3}, {0, 1}, {2, 3}};
      const CellMap<> map(step.grid.geometry[cell]);
      const double    axisymmetric = step.grid.axisymmetric;
      const double    pressure     = acting_pressure(step, cell);
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
          const double sign = side == 0 || side == 3 ? 1. : -1.;
          const double r_0  = map.left + is_right * map.width,
                       r[2] = {r_0, r_0 + along[0]};
          for (int i = 0; i < 2; ++i)
            {
              const double weight = axisymmetric * (2. * r[i] + r[1 - i]) / 6. +
                                    (1. - axisymmetric) * .5;
              double *const force =
                nodes[step.grid.nodes[cell].node[corners[side][i]]].force;
              force[0] += sign * pressure * weight * along[1];
              force[1] -= sign * pressure * weight * along[0];
            }
        }
    }
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
