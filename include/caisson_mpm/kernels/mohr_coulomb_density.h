// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Mohr-Coulomb sand whose strength follows from its present density and stress
// (Bolton 1986). With the relative density D and the mean effective stress p,
//
//   I = D (Q - ln(max(p, p_s) / kPa)) - 1,  D = (e_max - e) / (e_max - e_min),
//   phi = phi_c + A I,                      sin psi = 0.3 I / (2 + 0.3 I),
//
// I from 0 to 4. A is 3 degrees in triaxial and 5 in plane strain; 0.3 I is the
// rate of dilation -de_v / de_1 of both. Below p_s = 150 kPa tests show no
// further influence of p (Bolton 1987). As the void ratio e follows the volume,
// shearing of dense sand ends in the critical state, I = 0, with
// e_c = e_max - (e_max - e_min) / (Q - ln(max(p, p_s) / kPa)). Looser sand has
// the strength of that state, and shears at constant volume.
//
// Young's modulus follows the stress (Janbu 1963), and the density too if e_r,
// "Reference void ratio", is given (Hardin & Richart 1963):
//
//   E = E_ref (max(p, p_min) / p_ref)^m F(e) / F(e_r),
//   F = (2.17 - e)^2 / (1 + e).
//
// The step is explicit in stiffness and strength, which are those of the start
// of the step. A return to the yield surface depends on the ratios of the
// elastic constants only, so that it is that of mohr_coulomb_return.h with
// E_ref for a strain that is E / E_ref times as large; only the plastic strain
// must be scaled back. A point that is looser than e_max has a gap.
//
// References:
//   M.D. Bolton (1986), The strength and dilatancy of sands. Geotechnique 36,
//     65-78. doi:10.1680/geot.1986.36.1.65
//   M.D. Bolton (1987), Discussion: The strength and dilatancy of sands.
//     Geotechnique 37, 219-226. doi:10.1680/geot.1987.37.2.219
//   B.O. Hardin, F.E. Richart (1963), Elastic wave velocities in granular
//     soils. J. Soil Mech. Found. Div. ASCE 89(1), 33-65.
//   N. Janbu (1963), Soil compressibility as determined by oedometer and
//     triaxial tests. Proc. ECSMFE, Wiesbaden, vol. 1, 19-25.
#ifndef caisson_mpm_kernels_mohr_coulomb_density_h
#define caisson_mpm_kernels_mohr_coulomb_density_h

#include <caisson_mpm/kernels/mohr_coulomb.h>
#include <caisson_mpm/kernels/simd_math.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** The law "Mohr-Coulomb by density and stress": strength, dilatancy and
     * stiffness of each point follow from its void ratio and mean stress. See
     * the head of the file. */
    struct MohrCoulombDensity : MaterialLaw
    {
      static constexpr const char *name = "Mohr-Coulomb by density and stress";
      static constexpr bool uses_void_ratio = true, stiffness_varies = true,
                            has_loosest_state = true;

      /** Those of the critical state, with the elasticity at the reference
       * stress: the largest void ratio is e_max. */
      struct Parameters : MohrCoulomb::Parameters
      {
        double minimum_void_ratio, bolton_q, degrees_per_index; // entries
        double smallest_stress, reference_void_ratio;           // entries
        double reference_stress, stiffness_exponent;            // entries
        double smallest_stress_of_stiffness;                    // an entry, Pa

        double phi_c;           // rad
        double critical_volume; // 1 + e_c below p_s
        double inverse_range;   // 1 / (e_max - e_min)
        double ln_crushing;     // of 1 kPa exp(Q), in Pa
        double angle_per_index; // rad
        double per_reference;   // 1 / F(e_r); 0: density has no influence
        double inverse_stress;  // 1 / p_ref
        bool   by_roots;        // 4 m is a whole number

        void
        derive()
        {
          MohrCoulomb::Parameters::derive();
          shear_strength          = no_number;
          densest                 = minimum_void_ratio;
          loosest                 = largest_void_ratio;
          constexpr double ln_kPa = 6.907755278982137; // ln 1000
          const double     e_max  = largest_void_ratio,
                       range      = e_max - minimum_void_ratio;
          phi_c                   = friction_angle * radians_per_degree;
          inverse_range           = 1. / range;
          ln_crushing             = bolton_q + ln_kPa;
          critical_volume =
            1. + e_max - range / (ln_crushing - __builtin_log(smallest_stress));
          angle_per_index = degrees_per_index * radians_per_degree;
          per_reference   = reference_void_ratio > 0. ?
                              1. / hardin(Lanes<1>(reference_void_ratio))[0] :
                              0.;
          inverse_stress  = 1. / reference_stress;
          by_roots        = has_quarter_power(stiffness_exponent);
        }
      };

      static constexpr LawEntry<Parameters> entries[] = {
        {&Parameters::youngs_modulus, Entries::youngs_modulus},
        {&Parameters::poisson_ratio, Entries::poisson_ratio},
        {&Parameters::friction_angle, Entries::critical_friction_angle},
        {&Parameters::minimum_void_ratio, Entries::minimum_void_ratio},
        {&Parameters::largest_void_ratio, Entries::maximum_void_ratio},
        {&Parameters::bolton_q,
         {"Bolton Q",
          "",
          "Q of Bolton's dilatancy index stands for the strength of the "
          "grains: 10 for quartz and feldspar, 8 for limestone, 5.5 for "
          "chalk.",
          10.,
          4.,
          15.}},
        {&Parameters::degrees_per_index,
         {"Degrees per dilatancy index",
          "degrees",
          "The friction angle exceeds the critical one by this times "
          "Bolton's dilatancy index: 3 in triaxial and 5 in plane strain.",
          3.,
          0.,
          5.}},
        {&Parameters::smallest_stress,
         {"Smallest stress of strength",
          "Pa",
          "Below this mean effective stress Bolton's dilatancy index rises "
          "no further.",
          1.5e5,
          1.,
          no_limit}},
        {&Parameters::reference_stress, Entries::reference_stress},
        {&Parameters::stiffness_exponent, Entries::stiffness_exponent},
        {&Parameters::smallest_stress_of_stiffness,
         Entries::smallest_stress_of_stiffness},
        {&Parameters::reference_void_ratio,
         {"Reference void ratio",
          "",
          "Young's modulus is that of this void ratio, and follows the "
          "density by Hardin's (2.17 - e)2/(1 + e); with 0 it does not "
          "depend on the density.",
          0.,
          0.,
          2.}}};

      static VolumeInShear
      volume_in_shear(const Parameters &)
      {
        return VolumeInShear::gained;
      }

      template <typename Number>
      [[gnu::always_inline]] static inline Number
      loosest_void_ratio(const StressState<Number> & /*sigma*/,
                         const Parameters &p)
      {
        return Number(p.largest_void_ratio);
      }

      /** Whether sand is as loose as in its critical state below p_s, and
       * takes no growth of its cell from denser points. */
      template <typename Number>
      [[gnu::always_inline]] static inline typename Number::Mask
      is_loosest(const StressState<Number> & /*sigma*/,
                 const Number      volume,
                 const Number      volume_of_solids,
                 const Parameters &p)
      {
        return volume > Number(p.critical_volume) * volume_of_solids;
      }

      static bool
      check(const Parameters &p, const LawContext &context, LawMessage &message)
      {
        const double e_min = p.minimum_void_ratio, e_max = p.largest_void_ratio,
                     phi =
                       p.friction_angle + largest_index * p.degrees_per_index,
                     psi = __builtin_asin(
                             sine_of_dilatancy(Lanes<1>(largest_index))[0]) /
                           radians_per_degree;
        if (!(e_min > 0. && e_min < e_max))
          return message.refuse(
            "The law needs Minimum void ratio = %g above 0 and below "
            "Maximum void ratio = %g. Set both.",
            e_min,
            e_max);
        if (psi > phi)
          return message.refuse(
            "Critical friction angle = %g and Degrees per dilatancy index = "
            "%g give a friction angle of %g degrees to sand with a "
            "dilatancy angle of %.3g: plastic flow would create energy. "
            "Raise one of them.",
            p.friction_angle,
            p.degrees_per_index,
            phi,
            psi);
        return check_density(p, context, message);
      }

      static const char *
      warning(const Parameters &p)
      {
        if (p.smallest_stress < 1e3)
          return "Smallest stress of strength is usually 1.5e5 Pa: check its "
                 "unit";
        if (p.reference_stress < 1e4 || p.reference_stress > 1e6)
          return "Reference stress is usually 1e5 Pa: check its unit, and "
                 "that Youngs modulus is that of this stress";
        if (p.smallest_stress_of_stiffness >= p.reference_stress)
          return "Smallest stress of stiffness is not below Reference "
                 "stress, so that the stiffness hardly depends on the stress";
        return nullptr;
      }

      template <typename Number>
      [[gnu::always_inline]] static inline Number
      p_wave_modulus(const StressState<Number> &stress,
                     const Number               void_ratio,
                     const Parameters          &p)
      {
        return stiffening(stress, void_ratio, p) * Number(p.p_wave_modulus());
      }

      template <typename Number>
      [[gnu::always_inline]] static inline void
      update(StressState<Number>           &sigma,
             const StrainIncrement<Number> &de,
             LawState<Number>              &state,
             const Parameters              &p)
      {
        const Number factor = stiffening(sigma, state.void_ratio, p);
        const StrainIncrement<Number> stiffer = scaled(factor, de);
        // most sand is far from yield even with its critical strength
        StressState<Number> trial = sigma;
        const bool is_elastic = MohrCoulomb::update_elastic(trial, stiffer, p);
        const auto has_gap    = state.void_ratio > Number(p.largest_void_ratio);
        if (is_elastic && !any(has_gap))
          {
            sigma = trial;
            return;
          }
        const LawState<Number> before = state;
        MohrCoulombReturn<Number, MohrCoulombStrength<Number>>::update(
          sigma, stiffer, state, p, strength(sigma, state.void_ratio, p));
        if (any(has_gap))
          MohrCoulomb::close_gap(sigma,
                                 has_gap,
                                 Number(0.),
                                 factor * Number(p.bulk),
                                 MohrCoulomb::grown(state.void_ratio, de),
                                 state,
                                 p);
        scale_plastic_strain(Number(1.) / factor, before, state);
      }

    private:
      static constexpr double largest_index = 4., dilation_per_index = .3,
                              densest = 1.3, largest_critical_density = .8;

      /** Whether the void ratios, and Bolton's numbers, are those of a sand.
       */
      static bool
      check_density(const Parameters &p,
                    const LawContext &context,
                    LawMessage       &message)
      {
        const double e_min = p.minimum_void_ratio, e_max = p.largest_void_ratio;
        const double density   = (e_max - context.void_ratio) / (e_max - e_min),
                     reference = p.reference_void_ratio,
                     of_reference = (e_max - reference) / (e_max - e_min),
                     critical     = 1. / (p.bolton_q -
                                      __builtin_log(p.smallest_stress / 1e3));
        if (density < -1e-9 || density > densest)
          return message.refuse(
            "The void ratio at the start, %g, is a relative density of %.3g "
            "with Minimum void ratio = %g and Maximum void ratio = %g. It "
            "must be from 0 to %g: change one of them.",
            context.void_ratio,
            density,
            e_min,
            e_max,
            densest);
        if (reference > 0. && (of_reference < 0. || of_reference > densest))
          return message.refuse(
            "Reference void ratio = %g is a relative density of %.3g with "
            "Minimum void ratio = %g and Maximum void ratio = %g. Set the "
            "void ratio that Youngs modulus belongs to, or 0.",
            reference,
            of_reference,
            e_min,
            e_max);
        if (!(critical > 0. && critical < largest_critical_density))
          return message.refuse(
            "Bolton Q = %g and Smallest stress of strength = %g Pa leave "
            "the sand no critical state below a relative density of %g. "
            "Raise the one or reduce the other.",
            p.bolton_q,
            p.smallest_stress,
            largest_critical_density);
        return true;
      }

      /** F. */
      template <typename Number>
      [[gnu::always_inline]] static inline Number
      hardin(const Number void_ratio)
      {
        // empty lanes have no void ratio; F falls to 0 at 2.17, far looser
        // than any sand
        const Number e    = max(void_ratio, Number(0.)),
                     left = max(Number(2.17) - e, Number(.1));
        return left * left / (Number(1.) + e);
      }

      /** E / E_ref. */
      template <typename Number>
      [[gnu::always_inline]] static inline Number
      stiffening(const StressState<Number> &s,
                 const Number               void_ratio,
                 const Parameters          &p)
      {
        const Number ratio =
          Number(p.inverse_stress) *
          max(pressure(s), Number(p.smallest_stress_of_stiffness));
        const Number by_stress = p.by_roots ?
                                   quarter_power(ratio, p.stiffness_exponent) :
                                   pow(ratio, p.stiffness_exponent);
        return p.per_reference > 0. ?
                 Number(p.per_reference) * hardin(void_ratio) * by_stress :
                 by_stress;
      }

      /** sin psi. */
      template <typename Number>
      [[gnu::always_inline]] static inline Number
      sine_of_dilatancy(const Number index)
      {
        const Number rate = Number(dilation_per_index) * index;
        return rate / (Number(2.) + rate);
      }

      /** Of sand with the stress @p s. */
      template <typename Number>
      [[gnu::always_inline]] static inline MohrCoulombStrength<Number>
      strength(const StressState<Number> &s,
               const Number               void_ratio,
               const Parameters          &p)
      {
        const Number p_mean = max(pressure(s), Number(p.smallest_stress));
        const Number density =
          (Number(p.largest_void_ratio) - void_ratio) * Number(p.inverse_range);
        const Number index =
          min(max(density * (Number(p.ln_crushing) - log(p_mean)) - Number(1.),
                  Number(0.)),
              Number(largest_index));
        const Number sin_phi =
          sin(Number(p.phi_c) + Number(p.angle_per_index) * index);
        return MohrCoulombStrength<Number>::make(p,
                                                 sin_phi,
                                                 sqrt(Number(1.) -
                                                      sin_phi * sin_phi),
                                                 sine_of_dilatancy(index),
                                                 Number(0.),
                                                 0.);
      }
    };
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
