// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Linear elastic, perfectly plastic Mohr-Coulomb law with a non-associated
// flow rule and a tension cut-off; Tresca is the case phi = psi = 0
// (mohr_coulomb_return.h).
#ifndef caisson_mpm_kernels_mohr_coulomb_h
#define caisson_mpm_kernels_mohr_coulomb_h

#include <caisson_mpm/kernels/mohr_coulomb_return.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      /** The law "Mohr-Coulomb": perfect plasticity, whose strength all points
       * of a material share. See the head of the file. */
      struct MohrCoulomb
      {
        static constexpr const char *name      = "Mohr-Coulomb";
        static constexpr LawEntry    entries[] = {Entries::youngs_modulus,
                                                  Entries::poisson_ratio,
                                                  Entries::friction_angle,
                                                  Entries::dilatancy_angle,
                                                  Entries::cohesion,
                                                  Entries::tension_cutoff,
                                                  Entries::largest_void_ratio};
        static constexpr int         friction_entry =
                               entry_named(entries, "Friction angle"),
                             n_state            = 0;
        static constexpr bool uses_void_ratio   = true;
        static constexpr bool stiffness_varies  = false;
        static constexpr bool has_yield_surface = true;

        static constexpr double no_cutoff =
          MohrCoulombStrength<double>::no_cutoff;

        struct Parameters
        {
          MohrCoulombElasticity       elastic;
          MohrCoulombStrength<double> strength;
          double                      largest_void_ratio; // of dilation
          double                      tension;

          /**
           * @param E       Young's modulus, > 0. Units: Pa.
           * @param nu      Poisson's ratio, 0 <= nu < 1/2.
           * @param phi     Friction angle, 0 <= phi < pi/2. Units: rad.
           * @param psi     Dilation angle, 0 <= psi <= phi. Units: rad.
           * @param cohesion >= 0. Units: Pa.
           * @param tension Tensile strength, >= 0; a huge value: no cut-off
           *                below the apex. Units: Pa.
           */
          static Parameters
          make(const double E,
               const double nu,
               const double phi,
               const double psi,
               const double cohesion,
               const double tension)
          {
            Parameters p;
            p.elastic            = MohrCoulombElasticity::make(E, nu);
            p.strength           = MohrCoulombStrength<double>::make(p.elastic,
                                                           __builtin_sin(phi),
                                                           __builtin_cos(phi),
                                                           __builtin_sin(psi),
                                                           cohesion,
                                                           tension);
            p.largest_void_ratio = no_limit;
            p.tension            = tension;
            return p;
          }
        };

        static Parameters
        make(const double *values)
        {
          const LawValues<MohrCoulomb> value{values};
          Parameters                   p =
            Parameters::make(value("Youngs modulus"),
                             value("Poisson ratio"),
                             value("Friction angle") * radians_per_degree,
                             value("Dilatancy angle") * radians_per_degree,
                             value("Cohesion"),
                             value("Tension cut-off"));
          p.largest_void_ratio = value("Largest void ratio");
          return p;
        }

        /** Whether the soil gains volume in plastic shear. */
        static bool
        dilates(const Parameters &p)
        {
          return p.strength.sin_psi > 0.;
        }

        /** Whether the strength is the same at all pressures. */
        static bool
        is_frictionless(const Parameters &p)
        {
          return p.strength.sin_phi == 0.;
        }

        /** Whether update() reads the void ratio. */
        static bool
        needs_void_ratio(const Parameters &p)
        {
          return dilates(p);
        }

        /**
         * e_max is that of unloaded soil. Under the pressure p it is denser by
         * the elastic strain: (1 + e) (1 + p / K) = 1 + e_max. Elastic steps
         * lead neither to this line nor away from it, and the soil that has
         * come to it dilates no more.
         */
        template <typename Number>
        [[gnu::always_inline]] static inline Number
        loosest_void_ratio(const StressState<Number> &sigma,
                           const Parameters          &p)
        {
          return Number(1. + p.largest_void_ratio) /
                   (Number(1.) + compression(sigma, p)) -
                 Number(1.);
        }

        template <typename Number>
        [[gnu::always_inline]] static inline typename Number::Mask
        is_loosest(const StressState<Number> &sigma,
                   const Number               volume,
                   const Number               volume_of_solids,
                   const Parameters          &p)
        {
          return is_loosest(compression(sigma, p), volume, volume_of_solids, p);
        }

        static bool
        check(const double *values, const LawContext &, LawMessage &);

        /** Whether the loosest state is looser than that at the start. */
        static bool
        check_loosest_state(const double     *values,
                            const double      compression,
                            const LawContext &context,
                            LawMessage       &message);

        static const char *
        warning(const double *values)
        {
          const LawValues<MohrCoulomb> value{values};
          return value("Dilatancy angle") > 0. ?
                   "Mohr-Coulomb sand with a dilatancy angle grows in volume at "
                   "the same rate up to Largest void ratio. A plug then heaves "
                   "two to three times as much as the wall displaces, and the "
                   "outer friction is too large. Set Law = Mohr-Coulomb by "
                   "density and stress, or the Largest void ratio of the "
                   "loosest state" :
                   nullptr;
        }

        /** 1 - sin phi (Jaky). */
        static double
        earth_pressure_at_rest(const Parameters &p)
        {
          return 1. - p.strength.sin_phi;
        }

        template <typename Number>
        [[gnu::always_inline]] static inline Number
        p_wave_modulus(const StressState<Number> & /*stress*/,
                       const Number /*void_ratio*/,
                       const Parameters &p)
        {
          return p.elastic.p_wave_modulus();
        }

        /** Add the elastic increment. Returns whether that is all; if not,
         * the old stress must go to update(). */
        template <typename Number>
        [[gnu::always_inline]] static inline bool
        update_elastic(StressState<Number>           &sigma,
                       const StrainIncrement<Number> &de,
                       const Parameters              &p)
        {
          add_elastic_increment(sigma, de, p.elastic.lambda, p.elastic.mu);
          return MohrCoulombReturn<Number, MohrCoulombStrength<double>>::
            is_surely_elastic(sigma, p.strength);
        }

        template <typename Number>
        [[gnu::always_inline]] static inline void
        update(StressState<Number>           &sigma,
               const StrainIncrement<Number> &de,
               LawState<Number>              &state,
               const Parameters              &p)
        {
          if (needs_void_ratio(p))
            {
              const auto loose =
                is_loosest(sigma, Number(1.) + state.void_ratio, Number(1.), p);
              if (any(loose))
                {
                  update_loose(sigma, de, state, p, loose);
                  const Number K(p.elastic.bulk);
                  return close_gap(sigma,
                                   loose,
                                   compression(sigma, p),
                                   K,
                                   grown(state.void_ratio, de),
                                   state,
                                   p);
                }
            }
          update_at_any_void_ratio(sigma, de, state, p);
        }

        /** update() where needs_void_ratio() is false. */
        template <typename Number>
        [[gnu::always_inline]] static inline void
        update_at_any_void_ratio(StressState<Number>           &sigma,
                                 const StrainIncrement<Number> &de,
                                 LawState<Number>              &state,
                                 const Parameters              &p)
        {
          MohrCoulombReturn<Number, MohrCoulombStrength<double>>::update(
            sigma, de, state, p.elastic, p.strength);
        }

        /** The elastic compression, 0 in tension. */
        template <typename Number>
        [[gnu::always_inline]] static inline Number
        compression(const StressState<Number> &s, const Parameters &p)
        {
          return max(pressure(s) * Number(1. / p.elastic.bulk), Number(0.));
        }

        template <typename Number>
        [[gnu::always_inline]] static inline typename Number::Mask
        is_loosest(const Number      compression,
                   const Number      volume,
                   const Number      volume_of_solids,
                   const Parameters &p)
        {
          return volume * (Number(1.) + compression) >
                 Number(at_loosest * (1. + p.largest_void_ratio)) *
                   volume_of_solids;
        }

        /** The void ratio after a strain. */
        template <typename Number>
        [[gnu::always_inline]] static inline Number
        grown(const Number void_ratio, const StrainIncrement<Number> &de)
        {
          return (Number(1.) + void_ratio) *
                   (Number(1.) + (de.rr + de.zz + de.tt)) -
                 Number(1.);
        }

        /** Take the pressure in the lanes @p loose that the soil cannot have at
         * this void ratio: all of it where there is a gap, whose closing is
         * plastic. @p compression: the elastic one of @p sigma. */
        template <typename Number>
        [[gnu::always_inline]] static inline void
        close_gap(StressState<Number>         &sigma,
                  const typename Number::Mask &loose,
                  const Number                 compression,
                  const Number                 bulk_modulus,
                  const Number                 void_ratio,
                  LawState<Number>            &state,
                  const Parameters            &p)
        {
          const Number excess = (Number(1.) + void_ratio) *
                                  Number(1. / (1. + p.largest_void_ratio)) *
                                  (Number(1.) + compression) -
                                Number(1.);
          const Number before = pressure(sigma),
                       after =
                         max(before - bulk_modulus * max(excess, Number(0.)),
                             Number(0.));
          const Number share = select(loose & (before > Number(0.)),
                                      after / max(before, Number(1e-30)),
                                      Number(1.));
          state.plastic_volumetric -=
            (Number(1.) - share) * before * Number(1. / p.elastic.bulk);
          sigma = {share * sigma.rr,
                   share * sigma.zz,
                   share * sigma.tt,
                   share * sigma.rz};
        }

        /** The update where soil in the lanes @p loose dilates no more. */
        template <typename Number>
        [[gnu::always_inline]] static inline void
        update_loose(StressState<Number>           &sigma,
                     const StrainIncrement<Number> &de,
                     LawState<Number>              &state,
                     const Parameters              &p,
                     const typename Number::Mask   &loose)
        {
          using Strength = MohrCoulombStrength<Number>;
          MohrCoulombReturn<Number, Strength>::update(
            sigma,
            de,
            state,
            p.elastic,
            Strength::make(
              p.elastic,
              Number(p.strength.sin_phi),
              Number(p.strength.cos_phi),
              select(loose, Number(0.), Number(p.strength.sin_psi)),
              Number(p.strength.cohesion),
              p.tension));
        }
      };

      template <>
      struct LawSlot<1>
      {
        using type = MohrCoulomb;
      };

      /** What check() of a law with these three entries looks at. */
      inline bool
      check_strength(const double      friction,
                     const double      dilatancy,
                     const double      cohesion,
                     const LawContext &context,
                     LawMessage       &message)
      {
        if (dilatancy > friction)
          {
            __builtin_snprintf(
              message.text,
              sizeof(message.text),
              "Dilatancy angle = %g exceeds Friction angle = %g degrees: "
              "plastic flow would create energy. Lower the dilatancy angle.",
              dilatancy,
              friction);
            return false;
          }
        const double s       = __builtin_sin(friction * radians_per_degree);
        const double passive = (1. + s) / (1. - s); // largest stress ratio
        const double k       = context.earth_pressure_at_rest;
        if (cohesion == 0. &&
            (k > passive * (1. + 1e-9) || k < (1. - 1e-9) / passive))
          {
            __builtin_snprintf(
              message.text,
              sizeof(message.text),
              "K0 = %g lies outside what Friction angle = %g degrees without "
              "cohesion can carry (%g to %g). Change one of them.",
              k,
              friction,
              1. / passive,
              passive);
            return false;
          }
        return true;
      }

      inline bool
      MohrCoulomb::check(const double     *values,
                         const LawContext &context,
                         LawMessage       &message)
      {
        const LawValues<MohrCoulomb> value{values};
        if (value("Dilatancy angle") > 0. &&
            value("Largest void ratio") <= context.void_ratio)
          {
            __builtin_snprintf(
              message.text,
              sizeof(message.text),
              "Largest void ratio = %g does not exceed the void ratio %g at the "
              "start, so that soil with Dilatancy angle = %g degrees cannot "
              "dilate. Raise it, or set the dilatancy angle to 0.",
              value("Largest void ratio"),
              context.void_ratio,
              value("Dilatancy angle"));
            return false;
          }
        const double compression =
          context.mean_stress / make(values).elastic.bulk;
        return check_loosest_state(values, compression, context, message) &&
               check_strength(value("Friction angle"),
                              value("Dilatancy angle"),
                              value("Cohesion"),
                              context,
                              message);
      }

      inline bool
      MohrCoulomb::check_loosest_state(const double     *values,
                                       const double      compression,
                                       const LawContext &context,
                                       LawMessage       &message)
      {
        const LawValues<MohrCoulomb> value{values};
        const double                 unloaded =
          (1. + context.void_ratio) * (1. + compression) - 1.;
        if (value("Dilatancy angle") == 0. ||
            value("Largest void ratio") > unloaded)
          return true;
        __builtin_snprintf(
          message.text,
          sizeof(message.text),
          "Largest void ratio = %g: soil with the void ratio %g below a mean "
          "stress of %g Pa at the start would have %g, unloaded. Raise it, or "
          "set the dilatancy angle to 0.",
          value("Largest void ratio"),
          context.void_ratio,
          context.mean_stress,
          unloaded);
        return false;
      }
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
