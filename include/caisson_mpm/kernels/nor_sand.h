// SPDX-License-Identifier: LGPL-2.1-or-later
//
// NorSand (Jefferies 1993; Jefferies & Shuttle 2002; Jefferies & Been 2015):
// sand whose peak strength and dilatancy follow its state parameter psi, the
// void ratio above that of the critical state. With the mean effective stress
// p, the deviator q = sqrt(3 J2), eta = q / p and the void ratio e,
//
//   e_c(p)  = Gamma - lambda ln(p / 1 kPa),   psi_i = e - e_c(p_i),
//   f       = eta / M_i - 1 - ln(p_i / p) <= 0,   D = M_i - eta,
//   M_i     = M (1 - N |y|),   y = -chi_i psi_i / M_c,
//   dp_i    = p_i H (M / M_c) (p / p_i)^2 (r - p_i / p) dgamma,
//   r       = exp(y / (1 - N |y|)),   chi_i = chi / (1 - chi lambda / M_c),
//
// where M is that of critical_state.h, and M_c its value in triaxial
// compression, D the plastic compression over the plastic shear dgamma, and p_i
// the mean stress where D = 0. Where p_i has its largest value, r p, dilation
// is the fastest, D = chi_i psi_i, which is chi psi in triaxial compression. No
// stress exceeds eta = M_i (1 + max(ln r, 0)), which an unloaded soil reaches
// first: it flows there with the D of this eta, and p_i falls. At the start,
// p_i of each point is a multiple of that of the yield surface through its
// stress.
//
// The elasticity is that of stiffness_by_stress.h with a constant Poisson
// ratio, which also gives the stress below which e_c grows no further. y is
// kept between -0.45 and 1, and so low that no principal stress is in tension.
// The published M(theta) is another one with the same values in triaxial
// compression and extension. The hardening counts the shear strain that the
// flow rule would have beside an isotropic stress, where there is none: soil is
// thus compressible on the axis q = 0. Where p would be below 0 the soil has no
// stress.
//
// A step is explicit in e, psi_i, M and the stiffness. Where the elastic trial
// stress leaves the yield surface, plastic strain and p_i follow by the cutting
// plane algorithm (Ortiz & Simo 1986).
//
// References:
//   M. G. Jefferies (1993), Nor-Sand: a simple critical state model for sand.
//     Geotechnique 43, 91-103. doi:10.1680/geot.1993.43.1.91
//   M. G. Jefferies, D. A. Shuttle (2002), Dilatancy in general Cambridge-type
//     models. Geotechnique 52, 625-638. doi:10.1680/geot.2002.52.9.625
//   M. Jefferies, K. Been (2015), Soil liquefaction: a critical state approach,
//     2nd ed. CRC Press.
//   M. Ortiz, J. C. Simo (1986), An analysis of a new class of integration
//     algorithms for elastoplastic constitutive relations. Int. J. Numer.
//     Methods Eng. 23, 353-366.
#ifndef caisson_mpm_kernels_nor_sand_h
#define caisson_mpm_kernels_nor_sand_h

#include <caisson_mpm/kernels/critical_state.h>
#include <caisson_mpm/kernels/mohr_coulomb_return.h>
#include <caisson_mpm/kernels/stiffness_by_stress.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      /** The law "NorSand". See the head of the file. */
      struct NorSand : MaterialLaw
      {
        static constexpr const char *name     = "NorSand";
        static constexpr int         n_state  = 1;
        static constexpr bool uses_void_ratio = true, stiffness_varies = true,
                              has_yield_stress    = true,
                              knows_what_it_bears = true;

        /** The elasticity is that at the reference stress. */
        struct Parameters : Elasticity, StiffnessByStress
        {
          double friction_angle, critical_void_ratio; // entries
          double slope_of_line;                       // an entry: lambda
          double coupling, chi, H;                    // entries
          double at_start; // an entry: the yield stress ratio

          CriticalStateSlope slope;
          double             Gamma;         // e_c at 1 Pa
          double             dilatancy;     // chi_i / M_c
          double             hardening;     // H / M_c
          double             most_dilatant; // the largest y

          void
          derive()
          {
            Elasticity::derive();
            StiffnessByStress::derive();
            slope          = CriticalStateSlope::make(friction_angle);
            const double M = slope.M;
            Gamma          = critical_void_ratio + slope_of_line * log_of_1_kPa;
            dilatancy      = chi / (M - chi * slope_of_line);
            hardening      = H / M;
            // in extension a principal stress vanishes at eta = 3 / 2
            const double limit =
              (.95 * .5 * (3. + M) / M - 1.) / (1. - coupling);
            most_dilatant = limit < 1. ? limit : 1.;
          }
        };

        static constexpr LawEntry<Parameters> entries[] = {
          {&Parameters::youngs_modulus, Entries::youngs_modulus},
          {&Parameters::poisson_ratio, Entries::poisson_ratio},
          {&Parameters::friction_angle, Entries::critical_friction_angle},
          {&Parameters::critical_void_ratio,
           {"Critical void ratio at 1 kPa",
            "",
            "The void ratio Gamma of the critical state at a mean effective "
            "stress of 1 kPa.",
            0.816,
            0.1,
            19.}},
          {&Parameters::slope_of_line,
           {"Slope of the critical state",
            "",
            "The slope lambda of the critical state line, -de / d(ln p); that "
            "of decades over 2.3.",
            0.0135,
            1e-4,
            1.}},
          {&Parameters::coupling,
           {"Volumetric coupling",
            "",
            "The parameter N by which the stress ratio of zero dilatancy falls "
            "off the critical state.",
            0.3,
            0.,
            0.9}},
          {&Parameters::chi,
           {"State dilatancy",
            "",
            "The parameter chi, the largest dilatancy in triaxial compression "
            "over the state parameter there.",
            3.5,
            0.,
            10.}},
          {&Parameters::H,
           {"Plastic hardening",
            "",
            "The modulus H of plastic hardening.",
            100.,
            1.,
            1e4}},
          {&Parameters::at_start, Entries::yield_stress_ratio},
          {&Parameters::reference_stress, Entries::reference_stress},
          {&Parameters::stiffness_exponent, Entries::stiffness_exponent},
          {&Parameters::smallest_stress_of_stiffness,
           Entries::smallest_stress_of_stiffness}};

        static bool
        check(const Parameters &p,
              const LawContext &context,
              LawMessage       &message)
        {
          const double M = p.slope.M;
          if (p.chi * p.slope_of_line > .5 * M)
            return message.refuse(
              "State dilatancy = %g times Slope of the critical state = %g "
              "exceeds %g, half of M. Reduce one of them.",
              p.chi,
              p.slope_of_line,
              .5 * M);
          if (context.void_ratio <= 0.)
            return message.refuse("Void ratio is 0 at the start. Set it.");
          return context.mean_stress <= 0. || check_state(p, context, message);
        }

        /** Up to the peak strength of its state. */
        template <typename Number>
        static bool
        bears(const StressState<Number> &sigma,
              const Number               void_ratio,
              const Parameters          &p)
        {
          const CriticalStateInvariants<Number> at_rest(sigma, p.slope);
          const double y = dilatant_state(at_rest.p[0], void_ratio[0], p);
          return at_rest.share()[0] < 1. - p.coupling * (y > 0. ? y : -y) + y;
        }

        /** Where it is dense. */
        static VolumeInShear
        volume_in_shear(const Parameters &)
        {
          return VolumeInShear::gained;
        }

        static const char *
        warning(const Parameters &p)
        {
          return p.StiffnessByStress::warning();
        }

        template <typename Number>
        [[gnu::always_inline]] static inline Number
        p_wave_modulus(const StressState<Number> &stress,
                       const Number /*void_ratio*/,
                       const Parameters &p)
        {
          return Number(p.p_wave_modulus()) * p.stiffening(stress);
        }

        /** p_i, also before the first step, until which it is 0. */
        template <typename Number>
        [[gnu::always_inline]] static inline Number
        yield_stress(const StressState<Number> &sigma,
                     const Number               void_ratio,
                     const Number               variable,
                     const Parameters          &p)
        {
          const auto fresh = variable <= Number(0.);
          if (!any(fresh))
            return variable;
          const CriticalStateInvariants<Number> at_start(sigma, p.slope);
          return select(fresh,
                        Number(p.at_start) *
                          image_through(at_start, void_ratio, p),
                        variable);
        }

        template <typename Number>
        [[gnu::always_inline]] static inline void
        update(StressState<Number>           &sigma,
               const StrainIncrement<Number> &de,
               LawState<Number>              &state,
               const Parameters              &p)
        {
          using Invariants    = CriticalStateInvariants<Number>;
          const Number e      = state.void_ratio;
          const Number image  = yield_stress(sigma, e, state.variable[0], p);
          const Number factor = p.stiffening(sigma);
          add_elastic_increment(sigma, scaled(factor, de), p.lambda, p.mu);
          const Invariants    trial(sigma, p.slope);
          const State<Number> now(image, e, p);
          Return<Number>      back{max(trial.p, Number(least_stress)),
                              trial.q,
                              max(image, Number(least_image(p)))};
          back.to_surface(now, sqrt(trial.inverse_M2) / now.less, factor, p);
          const auto   torn = trial.p <= Number(least_stress);
          const Number share =
            select(torn, Number(0.), back.q / max(trial.q, Number(1e-30)));
          sigma = trial.changed(sigma, share, select(torn, Number(0.), back.p));
          state.variable[0] = select(torn, Number(least_image(p)), back.image);
          state.plastic_volumetric -=
            back.compression +
            select(torn, trial.p / (factor * Number(p.bulk)), Number(0.));
          state.plastic_deviatoric += back.shear;
        }

      private:
        /** What follows from the state parameter. */
        template <typename Number>
        struct State
        {
          Number less;         // M_i / M
          Number log_of_ratio; // ln r
          Number limit;        // of ln(p_i / p) in the criterion

          [[gnu::always_inline]] inline State(const Number      image,
                                              const Number      void_ratio,
                                              const Parameters &p)
          {
            const Number state =
              void_ratio - Number(p.Gamma) +
              Number(p.slope_of_line) *
                log(max(image, Number(p.smallest_stress_of_stiffness)));
            const Number y =
              min(max(Number(-p.dilatancy) * state, Number(least_dilatant)),
                  Number(p.most_dilatant));
            less         = Number(1.) - Number(p.coupling) * abs(y);
            log_of_ratio = y / less;
            limit        = max(log_of_ratio, Number(0.));
          }
        };

        /** p_i of the yield surface through a stress. */
        template <typename Number>
        [[gnu::always_inline]] static inline Number
        image_through(const CriticalStateInvariants<Number> &s,
                      const Number                           e,
                      const Parameters                      &p)
        {
          const Number pressure = max(s.p, Number(least_stress)),
                       ratio    = s.q * sqrt(s.inverse_M2) / pressure;
          Number image          = pressure;
          for (int i = 0; i < 10; ++i)
            image = pressure *
                    exp(ratio / State<Number>(image, e, p).less - Number(1.));
          return max(image, Number(least_image(p)));
        }

        /** The return from a trial stress to the yield surface. */
        template <typename Number>
        struct Return
        {
          Number p, q, image;
          Number compression = Number(0.), shear = Number(0.); // plastic strain

          [[gnu::always_inline]] inline void
          to_surface(const State<Number> &state,
                     const Number         inverse_M, // 1 / M_i
                     const Number         factor,    // of the stiffness
                     const Parameters    &parameters)
          {
            const Number K       = Number(parameters.bulk) * factor,
                         three_G = Number(3. * parameters.mu) * factor,
                         least   = least_image(parameters);
            Number ratio(0.), hardening(0.); // r, H / (M_c (1 - N |y|))
            for (int i = 0; i < most_iterations; ++i)
              {
                // f is multiplied by p
                const Number size = log(image / p), w = min(size, state.limit),
                             f     = q * inverse_M - p * (Number(1.) + w);
                const auto outside = f > Number(1e-9) * p + Number(1e-6);
                if (!any(outside))
                  return;
                if (i == 0)
                  {
                    ratio     = exp(state.log_of_ratio);
                    hardening = Number(parameters.hardening) / state.less;
                  }
                const auto   at_limit = size > state.limit;
                const Number part     = p / image,
                             rate =
                               hardening * part * (ratio * part - Number(1.)),
                             // on the limit, f does not depend on p_i
                  elastic = K * w * select(at_limit, Number(1.) + w, w) +
                            three_G * inverse_M * inverse_M,
                             harder = select(at_limit, Number(0.), p * rate),
                             multiplier    = select(outside,
                                                 f / max(elastic + harder,
                                                         Number(.1) * elastic),
                                                 Number(0.)),
                             d_shear       = multiplier * inverse_M,
                             d_compression = -multiplier * w,
                             grown    = min(max(rate * multiplier, Number(-.5)),
                                         Number(1.));
                const Number possible = min(d_shear, q / three_G);
                compression += d_compression;
                shear += possible;
                p = max(p - K * d_compression, Number(least_stress));
                q -= three_G * possible;
                // exp(grown), of which the next iteration corrects the rest
                image = max(image * (Number(1.) +
                                     grown * (Number(1.) + Number(.5) * grown)),
                            least);
              }
            // what is left, at low stress
            q = min(q,
                    p * (Number(1.) + min(log(image / p), state.limit)) /
                      inverse_M);
            q = max(q, Number(0.));
          }
        };

        /** Whether the state parameter is in the range of the law. */
        static bool
        check_state(const Parameters &p,
                    const LawContext &context,
                    LawMessage       &message)
        {
          const double y =
            dilatant_state(context.mean_stress, context.void_ratio, p);
          return (y >= least_dilatant && y <= p.most_dilatant) ||
                 message.refuse(
                   "Void ratio = %g makes a state parameter of %g at a mean "
                   "stress of %g Pa, and the law holds from %g to %g. Correct "
                   "it, or Critical void ratio at 1 kPa.",
                   context.void_ratio,
                   -y / slope_of_state(p),
                   context.mean_stress,
                   -p.most_dilatant / slope_of_state(p),
                   -least_dilatant / slope_of_state(p));
        }

        /** y over the state parameter, with the sign changed: of p_i = r p in
         * triaxial compression. */
        static double
        slope_of_state(const Parameters &p)
        {
          return p.dilatancy / (1. + p.dilatancy * p.slope_of_line);
        }

        /** y at a mean stress (Pa). */
        static double
        dilatant_state(const double      mean_stress,
                       const double      void_ratio,
                       const Parameters &p)
        {
          return -slope_of_state(p) *
                 (void_ratio - p.Gamma +
                  p.slope_of_line * __builtin_log(mean_stress));
        }

        /** The smallest p_i. Units: Pa. */
        [[gnu::always_inline]] static inline double
        least_image(const Parameters &p)
        {
          return .05 * p.smallest_stress_of_stiffness;
        }

        static constexpr int    most_iterations = 12;
        static constexpr double least_stress    = 1e-3; // Pa
        static constexpr double least_dilatant  = -.45; // y
        static constexpr double log_of_1_kPa    = 6.907755278982137;
      };
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
