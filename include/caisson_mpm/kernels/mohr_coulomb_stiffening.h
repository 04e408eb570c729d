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
      /** The law "Mohr-Coulomb with stiffness by stress": the strength is that
       * of Mohr-Coulomb, the stiffness of each point follows from its stress.
       * See the head of the file. */
      struct MohrCoulombStiffening : MohrCoulomb
      {
        static constexpr const char *name =
          "Mohr-Coulomb with stiffness by stress";
        static constexpr bool stiffness_varies  = true,
                              has_yield_surface = false;

        /** The elasticity is that at the reference stress. */
        struct Parameters : MohrCoulomb::Parameters, StiffnessByStress
        {
          /** Of the elastic compression by the pressure p: that strain over p
           * over the bulk modulus at p, 1 / (1 - m). */
          double compression;

          void
          derive()
          {
            MohrCoulomb::Parameters::derive();
            StiffnessByStress::derive();
            compression =
              1. / (1. - (stiffness_exponent < .9 ? stiffness_exponent : .9));
          }
        };

        static constexpr auto entries = joined<Parameters>(
          MohrCoulomb::entries,
          {{&Parameters::reference_stress, Entries::reference_stress},
           {&Parameters::stiffness_exponent, Entries::stiffness_exponent},
           {&Parameters::smallest_stress_of_stiffness,
            Entries::smallest_stress_of_stiffness}});

        /** That of MohrCoulomb with the integral of dp / K. */
        template <typename Number>
        [[gnu::always_inline]] static inline Number
        loosest_void_ratio(const StressState<Number> &sigma,
                           const Parameters          &p)
        {
          return Number(1. + p.largest_void_ratio) /
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
                                         p);
        }

        static bool
        check(const Parameters &p,
              const LawContext &context,
              LawMessage       &message)
        {
          const StressState<Lanes<1>> s{-context.mean_stress,
                                        -context.mean_stress,
                                        -context.mean_stress,
                                        0.};
          const LawContext unstressed = {context.earth_pressure_at_rest,
                                         context.void_ratio};
          return MohrCoulomb::check(p, unstressed, message) &&
                 check_loosest_state(p,
                                     compression(s, bulk_modulus(s, p), p)[0],
                                     context,
                                     message);
        }

        static const char *
        warning(const Parameters &p)
        {
          const char *const text = p.StiffnessByStress::warning();
          return text != nullptr ? text : MohrCoulomb::warning(p);
        }

        template <typename Number>
        [[gnu::always_inline]] static inline Number
        bulk_modulus(const StressState<Number> &s, const Parameters &p)
        {
          return Number(p.bulk) * p.stiffening(s);
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
          return p.stiffening(stress) *
                 MohrCoulomb::p_wave_modulus(stress, void_ratio, p);
        }

        template <typename Number>
        [[gnu::always_inline]] static inline void
        update(StressState<Number>           &sigma,
               const StrainIncrement<Number> &de,
               LawState<Number>              &state,
               const Parameters              &p)
        {
          const Number                  factor  = p.stiffening(sigma);
          const LawState<Number>        before  = state;
          const StrainIncrement<Number> stiffer = scaled(factor, de);
          if (needs_void_ratio(p))
            update_dilatant(sigma, stiffer, de, state, p);
          else
            update_at_any_void_ratio(sigma, stiffer, state, p);
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
            return update_at_any_void_ratio(sigma, stiffer, state, p);
          update_loose(sigma, stiffer, state, p, loose);
          const Number K = bulk_modulus(sigma, p);
          close_gap(sigma,
                    loose,
                    compression(sigma, K, p),
                    K,
                    grown(state.void_ratio, de),
                    state,
                    p);
        }
      };
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
