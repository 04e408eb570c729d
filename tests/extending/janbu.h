// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Elasticity whose modulus grows with the mean stress,
//   E = E_100 (p / 100 kPa)^m,
// and is larger below the largest mean stress so far. p is at least 1 kPa.
#ifndef caisson_mpm_kernels_janbu_h
#define caisson_mpm_kernels_janbu_h

#include <caisson_mpm/kernels/material_law.h>
#include <caisson_mpm/kernels/simd_math.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      /** Its state variable is the largest mean stress so far. */
      struct Janbu
      {
        static constexpr const char *name      = "Janbu";
        static constexpr LawEntry    entries[] = {
             Entries::youngs_modulus,
             Entries::poisson_ratio,
             {"Modulus exponent",
              "The exponent m of Janbu's law. Units: none.",
              0.5,
              0.,
              1.},
             {"Unloading factor",
              "The stiffness on unloading over that on loading. Units: none.",
              3.,
              1.,
              10.}};
        static constexpr int  friction_entry = -1, n_state = 1;
        static constexpr bool uses_void_ratio = false, stiffness_varies = true;

        struct Parameters
        {
          double lambda, mu, exponent, unloading;
        };

        /** @p v: the values of the entries, in their order. */
        static Parameters
        make(const double *v)
        {
          return {v[0] * v[1] / ((1. + v[1]) * (1. - 2. * v[1])),
                  .5 * v[0] / (1. + v[1]),
                  v[2],
                  v[3]};
        }

        static bool
        check(const double *v, const LawContext &, LawMessage &message)
        {
          if (v[1] <= 0.45)
            return true;
          __builtin_snprintf(message.text,
                             sizeof(message.text),
                             "Poisson ratio = %g is too large for Janbu's law. "
                             "Set it to at most 0.45.",
                             v[1]);
          return false;
        }

        static double
        earth_pressure_at_rest(const Parameters &p)
        {
          return p.lambda / (p.lambda + 2. * p.mu);
        }

        template <typename Number>
        [[gnu::always_inline]] static inline Number
        pressure(const StressState<Number> &s)
        {
          return max((-1. / 3.) * (s.rr + s.zz + s.tt), Number(1e3));
        }

        template <typename Number>
        [[gnu::always_inline]] static inline Number
        p_wave_modulus(const StressState<Number> &stress,
                       const Number /*void_ratio*/,
                       const Parameters &p)
        {
          return p.unloading * (p.lambda + 2. * p.mu) *
                 pow(1e-5 * pressure(stress), p.exponent);
        }

        static void
        start(const Parameters &, double *variable)
        {
          variable[0] = 0.;
        }

        template <typename Number>
        [[gnu::always_inline]] static inline void
        update(StressState<Number>           &sigma,
               const StrainIncrement<Number> &de,
               LawState<Number>              &state,
               const Parameters              &p)
        {
          const Number now       = pressure(sigma);
          const Number unloading = select(now < .999 * state.variable[0],
                                          Number(p.unloading),
                                          Number(1.));
          const Number factor    = unloading * pow(1e-5 * now, p.exponent);
          add_elastic_increment(sigma,
                                StrainIncrement<Number>{factor * de.rr,
                                                        factor * de.zz,
                                                        factor * de.tt,
                                                        factor * de.rz},
                                p.lambda,
                                p.mu);
          state.variable[0] = max(state.variable[0], now);
        }
      };

      template <>
      struct LawSlot<7>
      {
        using type = Janbu;
      };
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
