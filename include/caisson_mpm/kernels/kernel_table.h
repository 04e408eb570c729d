// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The kernels of one instruction set, as the rest of the program calls them.
#ifndef caisson_mpm_kernels_kernel_table_h
#define caisson_mpm_kernels_kernel_table_h

#include <caisson_mpm/kernels/layout.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    /** The kernels, compiled for one instruction set. */
    struct KernelTable
    {
      const char *name;
      int         width;

      /**
       * Add mass, momentum, internal and body force of all MPs to the nodes.
       * @p sums [n_nodes] must be zero on entry. The moments are those left by
       * grid_to_points but in changed cells; on return they are up to date, and
       * say how full the cells are.
       */
      void (*points_to_grid)(const StepContext &, NodalSums *sums);

      /**
       * Add the nodal forces of a pressure to @p out [n_nodes],
       *   out_I += int (grad N_I + e_r kappa N_I / r) p dV,
       * with p = sum_J N_J p_J of the nodal values @p pressure [n_nodes] in Pa,
       * integrated as the stress is: call it after points_to_grid. Units: N per
       * radian.
       */
      void (*pressure_force)(const StepContext &,
                             const double *pressure,
                             NodalVector  *out);

      /**
       * Add the nodal forces of a pore pressure, at the points of all cells, to
       * @p out [n_nodes],
       *   out_I -= sum_p V_p N_I(x_p) grad p(x_p),
       * with the nodal values @p pressure [n_nodes] in Pa. @p filled [n_cells]
       * is the share of the height below the free surface of the water, whose
       * pressure the upper corners of a cut cell have; cells with 0 have no
       * part in it. Units: N per radian.
       */
      void (*pressure_gradient_force)(const StepContext &,
                                      const double *pressure,
                                      const double *filled,
                                      NodalVector  *out);

      /**
       * out += M x with the consistent mass matrix of the MPs, out and x
       * [n_nodes].
       */
      void (*apply_mass)(const StepContext &,
                         const NodalVector *x,
                         NodalVector       *out);

      /**
       * Update velocity, stress, volume and position of all MPs, list those
       * outside their cell of the moved grid, and renew the moments for the
       * next step.
       */
      void (*grid_to_points)(const StepContext &,
                             const PointUpdate &,
                             UpdateResult &);

      /**
       * Raise @p largest to the p-wave modulus of the points of each material
       * whose stiffness varies, without the water. Units: Pa.
       */
      void (*largest_moduli)(const PointsView &,
                             const Material *materials,
                             double         *largest);
    };
  } // namespace Kernels
} // namespace CaissonMPM

#endif
