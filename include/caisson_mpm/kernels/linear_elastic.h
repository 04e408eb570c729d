// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Isotropic linear elasticity in rate form:
//
//   sigma_new = sigma_old + lambda tr(de) I + 2 mu de,
//
// where sigma_old has been rotated with the material (Jaumann rate) by the
// caller. Stresses in Pa, tension positive, see stress_state.h.
#ifndef caisson_mpm_kernels_linear_elastic_h
#define caisson_mpm_kernels_linear_elastic_h

#include <caisson_mpm/kernels/stress_state.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      struct LinearElastic
      {
        struct Parameters
        {
          /** Lame's constants. Units: Pa. */
          double lambda, mu;

          /**
           * From Young's modulus @p E [Pa] and Poisson's ratio @p nu, which
           * must be below 1/2.
           */
          static Parameters
          make(const double E, const double nu)
          {
            Parameters p;
            p.lambda = E * nu / ((1. + nu) * (1. - 2. * nu));
            p.mu     = 0.5 * E / (1. + nu);
            return p;
          }
        };

        /**
         * Advance @p sigma by the strain increment @p de. The plastic strains
         * stay as they are: they are here so that all laws are called alike.
         */
        template <typename Number>
        static CAISSON_INLINE void
        update(StressState<Number>           &sigma,
               const StrainIncrement<Number> &de,
               Number & /*plastic_strain_deviatoric*/,
               Number & /*plastic_strain_volumetric*/,
               const Parameters &parameters)
        {
          add_elastic_increment(sigma, de, parameters.lambda, parameters.mu);
        }
      };
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
