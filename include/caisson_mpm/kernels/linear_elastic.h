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

#include <caisson_mpm/kernels/material_law.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** The law "linear elastic": Hooke's law for increments. See the head of
     * the file. */
    struct LinearElastic : ElasticLaw
    {
      static constexpr const char *name = "linear elastic";

      using Parameters = Elasticity;

      static constexpr LawEntry<Parameters> entries[] = {
        {&Parameters::youngs_modulus, Entries::youngs_modulus},
        {&Parameters::poisson_ratio, Entries::poisson_ratio}};

      /** nu / (1 - nu). */
      static double
      earth_pressure_at_rest(const Parameters &p)
      {
        return p.lambda / (p.lambda + 2. * p.mu);
      }

      /** Advance @p sigma by the strain increment @p de. */
      template <typename Number>
      [[gnu::always_inline]] static inline void
      update(StressState<Number>           &sigma,
             const StrainIncrement<Number> &de,
             LawState<Number> & /*state*/,
             const Parameters &parameters)
      {
        add_elastic_increment(sigma, de, parameters.lambda, parameters.mu);
      }
    };
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
