// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Mohr-Coulomb whose Young's modulus follows the mean effective stress
// (stiffness_by_stress.h), with a constant Poisson ratio. For m = 0 stresses
// are those of Mohr-Coulomb.
//
// The step is explicit in the stiffness, which is that of the stress at its
// start. A return to the yield surface depends on the ratios of the elastic
// constants only, so that it is that of mohr_coulomb_return.h with E_ref for a
// strain that is E / E_ref times as large; only the plastic strain must be
// scaled back. The elasticity has no potential: a closed path of stress in the
// elastic range gives or takes some work.
#ifndef caisson_mpm_kernels_mohr_coulomb_stiffening_h
#define caisson_mpm_kernels_mohr_coulomb_stiffening_h

#include <caisson_mpm/kernels/mohr_coulomb.h>
#include <caisson_mpm/kernels/stiffness_by_stress.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      template <typename Number>
      [[gnu::always_inline]] inline StrainIncrement<Number>
      scaled(const Number factor, const StrainIncrement<Number> &de)
      {
        return {factor * de.rr, factor * de.zz, factor * de.tt, factor * de.rz};
      }

      /** The law "Mohr-Coulomb with stiffness by stress": the strength is that
       * of Mohr-Coulomb, the stiffness of each point follows from its stress.
       * See the head of the file. */
      struct MohrCoulombStiffening
      {
        static constexpr const char *name =
          "Mohr-Coulomb with stiffness by stress";
        static constexpr LawEntry entries[] = {
          Entries::youngs_modulus,
          Entries::poisson_ratio,
          Entries::friction_angle,
          Entries::dilatancy_angle,
          Entries::cohesion,
          Entries::tension_cutoff,
          Entries::largest_void_ratio,
          Entries::reference_stress,
          Entries::stiffness_exponent,
          Entries::smallest_stress_of_stiffness};
        static constexpr int friction_entry    = MohrCoulomb::friction_entry,
                             n_state           = 0;
        static constexpr bool uses_void_ratio  = MohrCoulomb::uses_void_ratio,
                              stiffness_varies = true;

        struct Parameters
        {
          MohrCoulomb::Parameters reference; // at the reference stress
          StiffnessByStress       stiffness;

          /** Of the elastic compression by the pressure p: that strain over p
           * over the bulk modulus at p, 1 / (1 - m). */
          double compression;
        };

        static Parameters
        make(const double *values)
        {
          const LawValues<MohrCoulombStiffening> value{values};
          return {MohrCoulomb::make(values),
                  StiffnessByStress::make(value("Reference stress"),
                                          value("Stiffness exponent"),
                                          value(
                                            "Smallest stress of stiffness")),
                  1. / (1. - (value("Stiffness exponent") < .9 ?
                                value("Stiffness exponent") :
                                .9))};
        }

        static bool
        dilates(const Parameters &p)
        {
          return MohrCoulomb::dilates(p.reference);
        }

        static bool
        is_frictionless(const Parameters &p)
        {
          return MohrCoulomb::is_frictionless(p.reference);
        }

        static bool
        needs_void_ratio(const Parameters &p)
        {
          return MohrCoulomb::needs_void_ratio(p.reference);
        }

        /** That of MohrCoulomb with the integral of dp / K. */
        template <typename Number>
        [[gnu::always_inline]] static inline Number
        loosest_void_ratio(const StressState<Number> &sigma,
                           const Parameters          &p)
        {
          return Number(1. + p.reference.largest_void_ratio) /
                   (Number(1.) +
                    compression(sigma, bulk_modulus(sigma, p), p)) -
                 Number(1.);
        }

        template <typename Number>
        [[gnu::always_inline]] static inline typename Number::Mask
        is_loosest(const StressState<Number> &sigma,
                   const Number               volume,
                   const Number               volume_of_solids,
                   const Parameters          &p)
        {
          return MohrCoulomb::is_loosest(compression(sigma,
                                                     bulk_modulus(sigma, p),
                                                     p),
                                         volume,
                                         volume_of_solids,
                                         p.reference);
        }

        static bool
        check(const double     *values,
              const LawContext &context,
              LawMessage       &message)
        {
          const Parameters            p = make(values);
          const StressState<Lanes<1>> s{-context.mean_stress,
                                        -context.mean_stress,
                                        -context.mean_stress,
                                        0.};
          const LawContext unstressed = {context.earth_pressure_at_rest,
                                         context.void_ratio};
          return MohrCoulomb::check(values, unstressed, message) &&
                 MohrCoulomb::check_loosest_state(
                   values,
                   compression(s, bulk_modulus(s, p), p)[0],
                   context,
                   message);
        }

        static const char *
        warning(const double *values)
        {
          const LawValues<MohrCoulombStiffening> value{values};
          const char *const                      text =
            warning_of_stiffness(value("Reference stress"),
                                 value("Smallest stress of stiffness"));
          return text != nullptr ? text : MohrCoulomb::warning(values);
        }

        static double
        earth_pressure_at_rest(const Parameters &p)
        {
          return MohrCoulomb::earth_pressure_at_rest(p.reference);
        }

        /** E / E_ref. */
        template <typename Number>
        [[gnu::always_inline]] static inline Number
        stiffening(const StressState<Number> &s, const Parameters &p)
        {
          return p.stiffness(s);
        }

        template <typename Number>
        [[gnu::always_inline]] static inline Number
        bulk_modulus(const StressState<Number> &s, const Parameters &p)
        {
          return Number(p.reference.elastic.bulk) * stiffening(s, p);
        }

        /** The elastic compression by a stress that has this bulk modulus. */
        template <typename Number>
        [[gnu::always_inline]] static inline Number
        compression(const StressState<Number> &s,
                    const Number               bulk_modulus,
                    const Parameters          &p)
        {
          return Number(p.compression) * max(pressure(s), Number(0.)) /
                 bulk_modulus;
        }

        template <typename Number>
        [[gnu::always_inline]] static inline Number
        p_wave_modulus(const StressState<Number> &stress,
                       const Number               void_ratio,
                       const Parameters          &p)
        {
          return stiffening(stress, p) *
                 MohrCoulomb::p_wave_modulus(stress, void_ratio, p.reference);
        }

        template <typename Number>
        [[gnu::always_inline]] static inline void
        update(StressState<Number>           &sigma,
               const StrainIncrement<Number> &de,
               LawState<Number>              &state,
               const Parameters              &p)
        {
          const Number                  factor  = stiffening(sigma, p);
          const LawState<Number>        before  = state;
          const StrainIncrement<Number> stiffer = scaled(factor, de);
          if (needs_void_ratio(p))
            update_dilatant(sigma, stiffer, de, state, p);
          else
            MohrCoulomb::update_at_any_void_ratio(sigma,
                                                  stiffer,
                                                  state,
                                                  p.reference);
          scale_plastic_strain(Number(1.) / factor, before, state);
        }

      private:
        /** The update with the strain increment @p de, which is @p stiffer
         * where it multiplies the elasticity at the reference stress. */
        template <typename Number>
        [[gnu::always_inline]] static inline void
        update_dilatant(StressState<Number>           &sigma,
                        const StrainIncrement<Number> &stiffer,
                        const StrainIncrement<Number> &de,
                        LawState<Number>              &state,
                        const Parameters              &p)
        {
          const auto loose =
            is_loosest(sigma, Number(1.) + state.void_ratio, Number(1.), p);
          if (!any(loose))
            return MohrCoulomb::update_at_any_void_ratio(sigma,
                                                         stiffer,
                                                         state,
                                                         p.reference);
          MohrCoulomb::update_loose(sigma, stiffer, state, p.reference, loose);
          const Number K = bulk_modulus(sigma, p);
          MohrCoulomb::close_gap(sigma,
                                 loose,
                                 compression(sigma, K, p),
                                 K,
                                 MohrCoulomb::grown(state.void_ratio, de),
                                 state,
                                 p.reference);
        }
      };

      template <>
      struct LawSlot<4>
      {
        using type = MohrCoulombStiffening;
      };
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
