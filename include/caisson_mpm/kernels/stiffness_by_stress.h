// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A stiffness that follows the mean effective stress p (Janbu 1963, for sand),
//
//   E = E_ref (max(p, p_min) / p_ref)^m,   p = -tr(sigma) / 3.
//
// Reference:
//   N. Janbu (1963), Soil compressibility as determined by oedometer and
//     triaxial tests. Proc. ECSMFE, Wiesbaden, vol. 1, 19-25.
#ifndef caisson_mpm_kernels_stiffness_by_stress_h
#define caisson_mpm_kernels_stiffness_by_stress_h

#include <caisson_mpm/kernels/material_law.h>
#include <caisson_mpm/kernels/simd_math.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      /** See the head of the file. */
      struct StiffnessByStress
      {
        double reference_stress, stiffness_exponent; // entries
        double smallest_stress_of_stiffness;         // an entry, Pa
        double inverse_stress;                       // 1/Pa
        bool   by_roots;                             // 4 m is a whole number

        void
        derive()
        {
          inverse_stress = 1. / reference_stress;
          by_roots       = has_quarter_power(stiffness_exponent);
        }

        /** E / E_ref. */
        template <typename Number>
        [[gnu::always_inline]] inline Number
        stiffening(const StressState<Number> &s) const
        {
          const Number ratio =
            Number(inverse_stress) *
            max(pressure(s), Number(smallest_stress_of_stiffness));
          return by_roots ? quarter_power(ratio, stiffness_exponent) :
                            pow(ratio, stiffness_exponent);
        }

        /** What is known against the stresses p_ref and p_min, or null. */
        const char *
        warning() const
        {
          if (reference_stress < 1e4 || reference_stress > 1e6)
            return "Reference stress is usually 1e5 Pa: check its unit, and "
                   "that Youngs modulus is that of this stress";
          if (smallest_stress_of_stiffness >= reference_stress)
            return "Smallest stress of stiffness is not below Reference "
                   "stress, so that the stiffness hardly depends on the stress";
          return nullptr;
        }
      };
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
