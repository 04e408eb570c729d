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

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      /** The law "linear elastic": Hooke's law for increments. See the head of
       * the file. */
      struct LinearElastic
      {
        static constexpr const char *name           = "linear elastic";
        static constexpr LawEntry    entries[]      = {Entries::youngs_modulus,
                                                       Entries::poisson_ratio};
        static constexpr int         friction_entry = -1, n_state = 0;
        static constexpr bool        uses_void_ratio  = false;
        static constexpr bool        stiffness_varies = false;

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

        static Parameters
        make(const double *values)
        {
          const LawValues<LinearElastic> value{values};
          return Parameters::make(value("Youngs modulus"),
                                  value("Poisson ratio"));
        }

        static bool
        check(const double * /*values*/, const LawContext &, LawMessage &)
        {
          return true;
        }

        /** nu / (1 - nu). */
        static double
        earth_pressure_at_rest(const Parameters &p)
        {
          return p.lambda / (p.lambda + 2. * p.mu);
        }

        template <typename Number>
        [[gnu::always_inline]] static inline Number
        p_wave_modulus(const StressState<Number> & /*stress*/,
                       const Number /*void_ratio*/,
                       const Parameters &p)
        {
          return p.lambda + 2. * p.mu;
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

      template <>
      struct LawSlot<0>
      {
        using type = LinearElastic;
      };
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
