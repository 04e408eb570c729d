// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Linear elastic, perfectly plastic Mohr-Coulomb law with a non-associated
// flow rule and a tension cut-off; Tresca is the case phi = psi = 0
// (mohr_coulomb_return.h).
#ifndef caisson_mpm_kernels_mohr_coulomb_h
#define caisson_mpm_kernels_mohr_coulomb_h

#include <caisson_mpm/kernels/mohr_coulomb_return.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** The law "Mohr-Coulomb": perfect plasticity, whose strength all points
     * of a material share. See the head of the file. */
    struct MohrCoulomb : ElasticLaw
    {
      static constexpr const char *name            = "Mohr-Coulomb";
      static constexpr bool        uses_void_ratio = true, //
        has_loosest_state                          = true;

      struct Parameters : Elasticity
      {
        double cohesion           = 0.;       // Pa
        double largest_void_ratio = no_limit; // of dilation
        MohrCoulombStrength<double> strength;

        void
        derive()
        {
          Elasticity::derive();
          shear_strength   = cohesion;
          const double phi = friction_angle * radians_per_degree,
                       psi = dilatancy_angle * radians_per_degree;
          strength         = MohrCoulombStrength<double>::make(*this,
                                                       __builtin_sin(phi),
                                                       __builtin_cos(phi),
                                                       __builtin_sin(psi),
                                                       cohesion,
                                                       tension_cutoff);
        }
      };

      static constexpr LawEntry<Parameters> entries[] = {
        {&Parameters::youngs_modulus, Entries::youngs_modulus},
        {&Parameters::poisson_ratio, Entries::poisson_ratio},
        {&Parameters::friction_angle, Entries::friction_angle},
        {&Parameters::dilatancy_angle, Entries::dilatancy_angle},
        {&Parameters::cohesion, Entries::cohesion},
        {&Parameters::tension_cutoff, Entries::tension_cutoff},
        {&Parameters::largest_void_ratio, Entries::largest_void_ratio}};

      static VolumeInShear
      volume_in_shear(const Parameters &p)
      {
        return p.strength.sin_psi > 0. ? VolumeInShear::gained :
                                         VolumeInShear::kept;
      }

      /** Whether update() reads the void ratio. */
      static bool
      needs_void_ratio(const Parameters &p)
      {
        return p.strength.sin_psi > 0.;
      }

      /**
       * e_max is that of unloaded soil. Under the pressure p it is denser by
       * the elastic strain: (1 + e) (1 + p / K) = 1 + e_max. Elastic steps
       * lead neither to this line nor away from it, and the soil that has
       * come to it dilates no more.
       */
      template <typename Number>
      [[gnu::always_inline]] static inline Number
      loosest_void_ratio(const StressState<Number> &sigma, const Parameters &p)
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
        return volume * (Number(1.) + compression(sigma, p)) >
               Number(at_loosest * (1. + p.largest_void_ratio)) *
                 volume_of_solids;
      }

      /** Whether the angles fit together, and the loosest state is looser
       * than that at the start. */
      static bool
      check(const Parameters &p, const LawContext &context, LawMessage &message)
      {
        const double psi      = p.dilatancy_angle,
                     unloaded = (1. + context.void_ratio) *
                                  (1. + context.mean_stress / p.bulk) -
                                1.;
        if (psi > 0. && p.largest_void_ratio <= context.void_ratio)
          return message.refuse(
            "Largest void ratio = %g does not exceed the void ratio %g at the "
            "start, so that soil with Dilatancy angle = %g degrees cannot "
            "dilate. Raise it, or set the dilatancy angle to 0.",
            p.largest_void_ratio,
            context.void_ratio,
            psi);
        if (psi > 0. && p.largest_void_ratio <= unloaded)
          return message.refuse(
            "Largest void ratio = %g: soil with the void ratio %g below a "
            "mean stress of %g Pa at the start would have %g, unloaded. "
            "Raise it, or set the dilatancy angle to 0.",
            p.largest_void_ratio,
            context.void_ratio,
            context.mean_stress,
            unloaded);
        return psi <= p.friction_angle ||
               message.refuse("Dilatancy angle = %g exceeds Friction angle = "
                              "%g degrees: plastic flow would create energy. "
                              "Lower the dilatancy angle.",
                              psi,
                              p.friction_angle);
      }

      static const char *
      warning(const Parameters &p)
      {
        return p.dilatancy_angle > 0. ?
                 "Mohr-Coulomb sand with a dilatancy angle grows in volume "
                 "at the same rate up to Largest void ratio. A plug then heaves "
                 "two to three times as much as the wall displaces, and the "
                 "outer friction is too large. Set Law = Mohr-Coulomb by "
                 "density and stress, or the Largest void ratio of the "
                 "loosest state" :
                 nullptr;
      }

      /** Add the elastic increment. Returns whether that is all; if not,
       * the old stress must go to update(). */
      template <typename Number>
      [[gnu::always_inline]] static inline bool
      update_elastic(StressState<Number>           &sigma,
                     const StrainIncrement<Number> &de,
                     const Parameters              &p)
      {
        add_elastic_increment(sigma, de, p.lambda, p.mu);
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
                const Number K(p.bulk);
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
          sigma, de, state, p, p.strength);
      }

      /** The elastic compression, 0 in tension. */
      template <typename Number>
      [[gnu::always_inline]] static inline Number
      compression(const StressState<Number> &s, const Parameters &p)
      {
        return max(pressure(s) * Number(1. / p.bulk), Number(0.));
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
          (Number(1.) - share) * before * Number(1. / p.bulk);
        sigma = scaled(share, sigma);
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
          p,
          Strength::make(p,
                         Number(p.strength.sin_phi),
                         Number(p.strength.cos_phi),
                         select(loose, Number(0.), Number(p.strength.sin_psi)),
                         Number(p.cohesion),
                         p.tension_cutoff));
      }
    };
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
