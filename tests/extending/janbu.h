// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Elasticity whose modulus grows with the mean stress,
//   E = E_100 (p / 100 kPa)^m,
// and is larger below the largest mean stress so far. p is at least 1 kPa.
#ifndef caisson_mpm_kernels_janbu_h
#define caisson_mpm_kernels_janbu_h

#include <caisson_mpm/kernels/material_law.h>
#include <caisson_mpm/kernels/simd_math.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** Its state variable is the largest mean stress so far. */
    struct Janbu : MaterialLaw
    {
      static constexpr const char *name             = "Janbu";
      static constexpr bool        stiffness_varies = true;
      static constexpr int         n_state          = 1;

      struct Parameters : Elasticity
      {
        double exponent, unloading;
      };

      static constexpr LawEntry<Parameters> entries[] = {
        {&Parameters::youngs_modulus, Entries::youngs_modulus},
        {&Parameters::poisson_ratio, Entries::poisson_ratio},
        {&Parameters::exponent,
         {"Modulus exponent",
          "",
          "The exponent m of Janbu's law.",
          0.5,
          0.,
          1.}},
        {&Parameters::unloading,
         {"Unloading factor",
          "",
          "The stiffness on unloading over that on loading.",
          3.,
          1.,
          10.}}};

      static bool
      check(const Parameters &p, const LawContext &, LawMessage &message)
      {
        return p.poisson_ratio <= 0.45 ||
               message.refuse("Poisson ratio = %g is too large for Janbu's "
                              "law. Set it to at most 0.45.",
                              p.poisson_ratio);
      }

      static double
      earth_pressure_at_rest(const Parameters &p)
      {
        return p.oedometric;
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
        return p.unloading * p.p_wave_modulus() *
               pow(1e-5 * pressure(stress), p.exponent);
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
        add_elastic_increment(sigma, scaled(factor, de), p.lambda, p.mu);
        state.variable[0] = max(state.variable[0], now);
      }
    };
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
