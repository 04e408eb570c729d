// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Modified Cam clay (Roscoe & Burland 1968). With the mean effective stress p,
// the deviator q = sqrt(3 J2), the void ratio e and v = 1 + e,
//
//   f = q^2 / M^2 + p (p - p_c) <= 0,
//   K = v p / kappa,  G = K 3 (1 - 2 nu) / (2 (1 + nu)),
//   dp_c = p_c v / (lambda - kappa) d(plastic compression).
//
// M is that of critical_state.h. The flow is associated, but for the deviator,
// which is radial: it takes M as that of the stress. p_c of each point at the
// start is a multiple of that of the yield surface through its stress.
//
// The elastic part of a step is exact in p. Where it leaves the yield surface,
// the plastic strain is found by the cutting plane algorithm (Ortiz & Simo
// 1986), with the Lode angle and the moduli of the trial stress. Where p would
// be below 0 the soil has no stress.
//
// References:
//   K. H. Roscoe, J. B. Burland (1968), On the generalized stress-strain
//     behaviour of wet clay. Engineering Plasticity, Cambridge, 535-609.
//   M. Ortiz, J. C. Simo (1986), An analysis of a new class of integration
//     algorithms for elastoplastic constitutive relations. Int. J. Numer.
//     Methods Eng. 23, 353-366.
#ifndef caisson_mpm_kernels_modified_cam_clay_h
#define caisson_mpm_kernels_modified_cam_clay_h

#include <caisson_mpm/kernels/critical_state.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      /** The law "modified Cam clay". See the head of the file. */
      struct ModifiedCamClay : MaterialLaw
      {
        static constexpr const char *name     = "modified Cam clay";
        static constexpr int         n_state  = 1;
        static constexpr bool uses_void_ratio = true, stiffness_varies = true,
                              has_yield_stress    = true,
                              knows_what_it_bears = true;

        struct Parameters
        {
          double lambda, kappa, poisson_ratio, friction_angle; // entries
          double at_start;        // an entry: the yield stress ratio
          double smallest_stress; // an entry

          double             shear; // G / K
          CriticalStateSlope slope;

          void
          derive()
          {
            shear = 1.5 * (1. - 2. * poisson_ratio) / (1. + poisson_ratio);
            slope = CriticalStateSlope::make(friction_angle);
          }
        };

        static constexpr LawEntry<Parameters> entries[] = {
          {&Parameters::lambda,
           {"Slope of compression",
            "",
            "The slope lambda of the normal compression line, -de / d(ln p); "
            "the compression index over 2.3.",
            0.2,
            1e-4,
            10.}},
          {&Parameters::kappa,
           {"Slope of swelling",
            "",
            "The slope kappa of the lines of swelling, -de / d(ln p); the "
            "swelling index over 2.3.",
            0.04,
            1e-5,
            10.}},
          {&Parameters::poisson_ratio, Entries::poisson_ratio},
          {&Parameters::friction_angle, Entries::critical_friction_angle},
          {&Parameters::at_start, Entries::yield_stress_ratio},
          {&Parameters::smallest_stress,
           Entries::smallest_stress_of_stiffness}};

        static bool
        check(const Parameters &p,
              const LawContext &context,
              LawMessage       &message)
        {
          if (p.kappa >= p.lambda)
            return message.refuse(
              "Slope of swelling is not below Slope of compression. Reduce "
              "it.");
          if (context.void_ratio <= 0.)
            return message.refuse(
              "the void ratio at the start is 0. Set Void ratio.");
          return true;
        }

        /** Up to the critical state. */
        template <typename Number>
        static bool
        bears(const StressState<Number> &sigma,
              const Number /*void_ratio*/,
              const Parameters &p)
        {
          return CriticalStateInvariants<Number>(sigma, p.slope).share()[0] <
                 1.;
        }

        /** The bulk modulus at the mean stress @p pressure (Pa). */
        template <typename Number>
        [[gnu::always_inline]] static inline Number
        bulk_modulus(const Number      pressure,
                     const Number      void_ratio,
                     const Parameters &p)
        {
          return Number(1. / p.kappa) * (Number(1.) + void_ratio) *
                 max(pressure, Number(p.smallest_stress));
        }

        template <typename Number>
        [[gnu::always_inline]] static inline Number
        p_wave_modulus(const StressState<Number> &stress,
                       const Number               void_ratio,
                       const Parameters          &p)
        {
          return Number(1. + 4. / 3. * p.shear) *
                 bulk_modulus(pressure(stress), max(void_ratio, Number(0.)), p);
        }

        /** p_c, also before the first step, until which it is 0. */
        template <typename Number>
        [[gnu::always_inline]] static inline Number
        yield_stress(const StressState<Number> &sigma,
                     const Number /*void_ratio*/,
                     const Number      variable,
                     const Parameters &p)
        {
          return select(variable > Number(0.),
                        variable,
                        Number(p.at_start) *
                          yield_stress_through(
                            CriticalStateInvariants<Number>(sigma, p.slope)));
        }

        template <typename Number>
        [[gnu::always_inline]] static inline void
        update(StressState<Number>           &sigma,
               const StrainIncrement<Number> &de,
               LawState<Number>              &state,
               const Parameters              &p)
        {
          const Number e   = max(state.void_ratio, Number(0.));
          const Number p_c = yield_stress(sigma, e, state.variable[0], p);
          const Number K   = add_elastic_increment(sigma, de, e, p);
          const CriticalStateInvariants<Number> trial(sigma, p.slope);
          Return<Number>                        back{trial.p, trial.q, p_c};
          back.to_surface(trial.inverse_M2, K, e, p);
          const auto   torn = back.p < Number(0.);
          const Number share =
            select(torn, Number(0.), back.q / max(trial.q, Number(1e-30)));
          sigma = trial.changed(sigma, share, max(back.p, Number(0.)));
          state.variable[0] = back.yield_stress;
          state.plastic_volumetric -= back.compression;
          state.plastic_deviatoric += back.shear;
        }

      private:
        /** p_c of the yield surface through a stress. */
        template <typename Number>
        [[gnu::always_inline]] static inline Number
        yield_stress_through(const CriticalStateInvariants<Number> &s)
        {
          const Number p = max(s.p, Number(least_stress));
          return p + s.q * s.q * s.inverse_M2 / p;
        }

        /** The elastic part of the step. Return the mean bulk modulus. */
        template <typename Number>
        [[gnu::always_inline]] static inline Number
        add_elastic_increment(StressState<Number>           &sigma,
                              const StrainIncrement<Number> &de,
                              const Number                   e,
                              const Parameters              &p)
        {
          const Number volume = de.rr + de.zz + de.tt;
          // p grows with exp(x); beyond this x no step of a run goes
          const Number x =
            max(min(Number(-1. / p.kappa) * (Number(1.) + e) * volume,
                    Number(1.)),
                Number(-1.));
          const Number grown =
            Number(1.) +
            x * (Number(1. / 2.) +
                 x * (Number(1. / 6.) +
                      x * (Number(1. / 24.) + x * Number(1. / 120.))));
          const Number pressure_now = pressure(sigma);
          const Number K =
            bulk_modulus(pressure_now, e, p) *
            select(pressure_now > Number(p.smallest_stress), grown, Number(1.));
          const Number two_G = Number(2. * p.shear) * K;
          const Number mean  = (K - Number(1. / 3.) * two_G) * volume;
          sigma.rr += mean + two_G * de.rr;
          sigma.zz += mean + two_G * de.zz;
          sigma.tt += mean + two_G * de.tt;
          sigma.rz += two_G * de.rz;
          return K;
        }

        /** The return from a trial stress to the yield surface. */
        template <typename Number>
        struct Return
        {
          Number p, q, yield_stress;
          Number compression = Number(0.), shear = Number(0.); // plastic strain

          [[gnu::always_inline]] inline void
          to_surface(const Number      inverse_M2,
                     const Number      K,
                     const Number      e,
                     const Parameters &parameters)
          {
            const Number hardening =
              Number(1. / (parameters.lambda - parameters.kappa)) *
              (Number(1.) + e);
            const Number three_G = Number(3. * parameters.shear) * K;
            const Number tolerance =
              Number(1e-9) * yield_stress * yield_stress + Number(1e-6);
            for (int i = 0; i < most_iterations; ++i)
              {
                const Number f = q * q * inverse_M2 + p * (p - yield_stress);
                const auto   outside = f > tolerance;
                if (!any(outside))
                  return;
                const Number f_p        = Number(2.) * p - yield_stress,
                             f_q        = Number(2.) * q * inverse_M2,
                             elastic    = K * f_p * f_p + three_G * f_q * f_q,
                             harder     = hardening * p * yield_stress * f_p,
                             multiplier = select(outside,
                                                 f / max(elastic + harder,
                                                         Number(.1) * elastic),
                                                 Number(0.)),
                             d_compression = multiplier * f_p,
                             d_shear       = min(multiplier * f_q, q / three_G),
                             x             = hardening * d_compression;
                compression += d_compression;
                shear += d_shear;
                p -= K * d_compression;
                q -= three_G * d_shear;
                // exp(x), of which the next iteration corrects the rest
                yield_stress =
                  max(yield_stress *
                        (Number(1.) + x * (Number(1.) + Number(.5) * x)),
                      Number(least_stress));
              }
          }
        };

        static constexpr int    most_iterations = 8;
        static constexpr double least_stress    = 1.; // Pa
      };
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
