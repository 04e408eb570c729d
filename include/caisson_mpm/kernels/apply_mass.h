// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The consistent mass matrix of the points, M_IJ = sum_p m_p N_I N_J, without
// the matrix: with N_I a combination of {1, xi, eta, xi eta} a cell's part of
// it follows from the nine moments of mass up to xi2 eta2.
#ifndef caisson_mpm_kernels_apply_mass_h
#define caisson_mpm_kernels_apply_mass_h

#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/kernels/simd.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** out += M x; both components of a node are the two lanes. */
    inline void
    apply_mass(const StepContext &step, const NodalVector *x, NodalVector *out)
    {
      using Pair = Lanes<2>;
      for (unsigned int i = 0; i < step.points.n_active_cells; ++i)
        {
          const unsigned int        cell = step.points.active_cells[i];
          const unsigned int *const node = step.grid.nodes[cell].node;
          const double *const       m    = step.moments[cell].mass;
          const Pair                inertia(inertia_in(step, cell));
          const auto                load = [&](const int k) {
            return inertia * Pair::load(x[node[k]].value);
          };
          // x in the basis {1, xi, eta, xi eta}: coefficients v0, c1, c2, c3
          const Pair v0 = load(0), v1 = load(1), v2 = load(2), v3 = load(3);
          const Pair c1 = v1 - v0, c2 = v2 - v0, c3 = v3 - v2 - c1;
          // its integrals against the same basis: sum m_p x(x_p) {1, ...}
          const auto row = [&](int a, int b, int c, int d) {
            return Pair(m[a]) * v0 + Pair(m[b]) * c1 + Pair(m[c]) * c2 +
                   Pair(m[d]) * c3;
          };
          const Pair t0 = row(0, 1, 2, 3), t1 = row(1, 4, 3, 6),
                     t2 = row(2, 3, 5, 7), t3 = row(3, 6, 7, 8);
          // and from these back to the corners, as in moments_to_corners()
          const auto add = [&](const int k, const Pair y) {
            (Pair::load(out[node[k]].value) + y).store(out[node[k]].value);
          };
          add(0, t0 - t1 - t2 + t3);
          add(1, t1 - t3);
          add(2, t2 - t3);
          add(3, t3);
        }
    }
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
