// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The nodal forces of a pressure field,
//   f_I = int (grad N_I + e_r kappa N_I / r) p dV,   p = sum_J N_J p_J,
// kappa = 1 in axisymmetry and 0 in plane strain; per radian.
//
// The integral is made as that of the stress: over Gauss points in full cells,
// over the points in partly filled ones, with the same weights and gradients.
// So a stress sigma = p I with constant p and this pressure cancel at each node
// to round-off, in any mesh and with any points. Full cells need no point at
// all, which is why no volume moments are kept with the moments of a cell: only
// the points of partly filled cells are visited, and only if there is a
// pressure.
#ifndef caisson_mpm_kernels_pressure_force_h
#define caisson_mpm_kernels_pressure_force_h

#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/kernels/pressure_integrals.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** Add the integrals @p sums of ForceSums of a cell to its corners. */
    [[gnu::always_inline]] inline void
    add_to_corners(const double *sums, const CellNodes &cell, NodalVector *out)
    {
      double corner[4];
      moments_to_corners(sums, corner); // hoop
      for (int i = 0; i < 4; ++i)
        out[cell.node[i]].value[0] += corner[i];
      for (int c = 0; c < 2; ++c)
        {
          gradient_moments_to_corners(sums + 4 + 4 * c, corner);
          for (int i = 0; i < 4; ++i)
            out[cell.node[i]].value[c] += corner[i];
        }
    }

    /** See KernelTable. */
    template <typename Number>
    void
    pressure_force(const StepContext &step,
                   const double      *pressure,
                   NodalVector       *out)
    {
      constexpr int width = Number::width;
      for (unsigned int begin = 0; begin < step.points.n_active_cells;
           begin += width)
        {
          // 1. The pressure in the basis {1, xi, eta, xi eta}.
          const CellGroup<Number> group(step.points, begin);
          Number                  corner[4], c[4];
          for (int k = 0; k < 4; ++k)
            corner[k] = group.lanes([&](const unsigned int cell) {
              return pressure[step.grid.nodes[cell].node[k]];
            });
          coefficients(corner, c);

          // 2. Gauss points, as if all cells of the group were full.
          ForceSums<Number> sums;
          integrate_pressure_in_full_cells(group.map(step.grid.geometry),
                                           step.grid.axisymmetric,
                                           c,
                                           sums);
          double  of_cell[width][ForceSums<Number>::size];
          double *rows[width];
          for (int i = 0; i < width; ++i)
            rows[i] = of_cell[i];
          sums.store_lanes(group.n, rows);

          // 3. Points, as far as the stress is integrated over them.
          for (int i = 0; i < group.n; ++i)
            {
              const unsigned int cell   = group.cell[i];
              const double       full   = step.moments[cell].full;
              const double       own[4] = {c[0][i], c[1][i], c[2][i], c[3][i]};
              if (full < 1.)
                {
                  double at_points[ForceSums<Number>::size];
                  integrate_pressure_at_points<Number>(step,
                                                       cell,
                                                       own,
                                                       at_points);
                  for (int k = 0; k < ForceSums<Number>::size; ++k)
                    of_cell[i][k] =
                      full * of_cell[i][k] + (1. - full) * at_points[k];
                }
              add_to_corners(of_cell[i], step.grid.nodes[cell], out);
            }
        }
    }
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
