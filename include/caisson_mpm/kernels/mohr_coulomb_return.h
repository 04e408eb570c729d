// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The return to the Mohr-Coulomb yield surface with a non-associated flow rule
// and a tension cut-off.
//
// With principal stresses s1 >= s2 >= s3 (Pa, tension positive) a stress is
// admissible where
//
//   f(s1, s3) = (1 + sin phi) s1 - (1 - sin phi) s3 - 2 c cos phi <= 0,
//   s1 <= T,    T = min(tension strength, c cot phi).
//
// Plastic strain follows Koiter's rule (Koiter 1953): it is a sum, with
// multipliers >= 0, of the flow directions of the active planes, which are
// (1 + sin psi) e_i - (1 - sin psi) e_j on the plane f(s_i, s_j) = 0 and e_i
// (associated) on s_i = T. The step is integrated by backward Euler: the new
// stress is the trial stress minus D times the plastic strain increment.
// Elastic isotropy lets the return happen in principal stresses, on the axes
// of the trial stress, and there it is exact and closed form:
//
// 1. On the cone f <= 0 alone: return to the plane. If that violates the order
//    s1 >= s2 (or s2 >= s3), the stress belongs to the edge s1 = s2 (s2 = s3).
//    Two planes are active there and the sum of both flow rules is the plane's
//    flow rule for the average of the two stresses, so that an edge costs no
//    more than a plane.
// 2. If the result has s1 > T, the cut-off is active. The return to the planes
//    s_i = T alone (plane, edge, corner) is valid if it satisfies f <= 0.
// 3. Otherwise both are active: s1 = T and s3 = t, the root of f(T, t) = 0.
//    Direction 2 has no plastic strain, hence
//    s2 = s2_trial - nu ((s1_trial - T) + (s3_trial - t)), whatever psi, cut
//    to the end points [t, T] of this line, in which more planes are active.
//
// The apex of the cone is the case T = c cot phi = t of 2 and 3: it is
// recognised by s1 > c cot phi, never by the sign of multipliers, which is
// round-off close to the apex. For psi = 0 the cone's own flow rule cannot
// change the mean stress and no return exists beyond the apex; the cut-off
// planes through the apex, always present here, supply one.
//
// References:
//   W.T. Koiter (1953), Stress-strain relations, uniqueness and variational
//     theorems for elastic-plastic materials with a singular yield surface.
//     Quart. Appl. Math. 11, 350-354.
//   J. Clausen, L. Damkilde, L. Andersen (2006), Efficient return algorithms
//     for associated plasticity with multiple yield planes. Int. J. Numer.
//     Meth. Engng 66, 1036-1059. doi:10.1002/nme.1595
//   J. Clausen, L. Damkilde, L. Andersen (2007), An efficient return algorithm
//     for non-associated plasticity with linear yield criteria in principal
//     stress space. Comput. Struct. 85, 1795-1807.
//     doi:10.1016/j.compstruc.2007.04.002
//   E.A. de Souza Neto, D. Peric, D.R.J. Owen (2008), Computational Methods
//     for Plasticity, chapter 8. Wiley.
#ifndef caisson_mpm_kernels_mohr_coulomb_return_h
#define caisson_mpm_kernels_mohr_coulomb_return_h

#include <caisson_mpm/kernels/material_law.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /**
     * The strength and what follows from it. Real is double where all MPs
     * share it, or a number of lanes where each has its own.
     */
    template <typename Real>
    struct MohrCoulombStrength
    {
      /** The largest tension_cutoff; larger values mean no cut-off. */
      static constexpr double no_cutoff = 1e30;

      Real sin_phi, cos_phi, sin_psi;

      /** Units: Pa. */
      Real cohesion;

      /** T, the largest tensile stress that is admissible. Units: Pa. */
      Real tension_cutoff;

      /** t, where the cone meets the cut-off: f(T, t) = 0. Units: Pa. */
      Real minor_at_cutoff;

      /**
       * D times the flow direction of the plane (s1, s3), by component,
       * and the averages of two of them, which the edges need. Units: Pa.
       */
      Real flow_major, flow_middle, flow_minor;
      Real flow_major_edge, flow_minor_edge;

      /** 1 / (grad f . D . flow direction). Units: 1/Pa. */
      Real inverse_plane, inverse_major_edge, inverse_minor_edge;

      /** The sines and cosines suit 0 <= psi <= phi < pi/2. */
      [[gnu::always_inline]] static inline MohrCoulombStrength
      make(const Elasticity &elastic,
           const Real        sin_phi,
           const Real        cos_phi,
           const Real        sin_psi,
           const Real        cohesion,
           const double      tension)
      {
        MohrCoulombStrength p;
        p.sin_phi  = sin_phi;
        p.cos_phi  = cos_phi;
        p.sin_psi  = sin_psi;
        p.cohesion = cohesion;

        const Real s = sin_phi, c = cohesion * cos_phi;
        // c cot phi without a division by sin phi = 0
        const Real apex   = apex_of(c, s);
        p.tension_cutoff  = smaller(Real(tension), apex);
        const Real t      = ((1. + s) * p.tension_cutoff - 2. * c) / (1. - s);
        p.minor_at_cutoff = smaller(t, p.tension_cutoff);

        const Real trace = 2. * sin_psi;
        p.flow_major =
          elastic.lambda * trace + 2. * elastic.mu * (1. + sin_psi);
        p.flow_middle = elastic.lambda * trace;
        p.flow_minor =
          elastic.lambda * trace - 2. * elastic.mu * (1. - sin_psi);
        p.flow_major_edge = 0.5 * (p.flow_major + p.flow_middle);
        p.flow_minor_edge = 0.5 * (p.flow_middle + p.flow_minor);

        const auto inverse = [s](const Real major, const Real minor) {
          return 1. / ((1. + s) * major - (1. - s) * minor);
        };
        p.inverse_plane      = inverse(p.flow_major, p.flow_minor);
        p.inverse_major_edge = inverse(p.flow_major_edge, p.flow_minor);
        p.inverse_minor_edge = inverse(p.flow_major, p.flow_minor_edge);
        return p;
      }

    private:
      [[gnu::always_inline]] static inline double
      smaller(const double a, const double b)
      {
        return a < b ? a : b;
      }

      template <int n>
      [[gnu::always_inline]] static inline Lanes<n>
      smaller(const Lanes<n> a, const Lanes<n> b)
      {
        return min(a, b);
      }

      /** min(c / s, no_cutoff) without a division by s = 0. */
      [[gnu::always_inline]] static inline double
      apex_of(const double c, const double s)
      {
        return c < no_cutoff * s ? c / s : no_cutoff;
      }

      template <int n>
      [[gnu::always_inline]] static inline Lanes<n>
      apex_of(const Lanes<n> c, const Lanes<n> s)
      {
        const Lanes<n> none(no_cutoff);
        const auto     exists = c < none * s;
        return select(exists, c / select(exists, s, Lanes<n>(1.)), none);
      }
    };

    /**
     * The return of elastic trial stresses. Strength is a
     * MohrCoulombStrength of double or of Number.
     */
    template <typename Number, typename Strength>
    struct MohrCoulombReturn
    {
      using Mask   = typename Number::Mask;
      using Stress = PrincipalStresses<Number>;

      /**
       * Advance @p sigma, the old stress rotated with the material, by the
       * strain increment @p de. Add to plastic_deviatoric the equivalent
       * sqrt(2/3 e:e) of the deviator e of the plastic strain increment, and
       * to plastic_volumetric its trace.
       */
      [[gnu::always_inline]] static inline void
      update(StressState<Number>           &sigma,
             const StrainIncrement<Number> &de,
             LawState<Number>              &state,
             const Elasticity              &elastic,
             const Strength                &strength)
      {
        add_elastic_increment(sigma, de, elastic.lambda, elastic.mu);
        if (is_surely_elastic(sigma, strength))
          return;

        const PrincipalFrame<Number> frame(sigma);
        const Stress                 trial = frame.principal_stresses();
        const Number yield = yield_function(trial.major, trial.minor, strength);
        const Number cutoff(strength.tension_cutoff);
        if (!any((yield > Number(0.)) | (trial.major > cutoff)))
          return;

        Stress     s    = to_cone(trial, yield, strength);
        const Mask torn = s.major > cutoff;
        if (any(torn))
          s = select(torn, to_cutoff(trial, elastic, strength), s);

        accumulate(state, trial, s, elastic);
        sigma = frame.with_principal_stresses(s);
      }

      /**
       * Whether no lane yields, even with a bound for the radius of Mohr's
       * circle in its place: most soil is far from yield, and this spares it
       * the square root. @p sigma: with the elastic increment.
       */
      [[gnu::always_inline]] static inline bool
      is_surely_elastic(const StressState<Number> &sigma,
                        const Strength            &strength)
      {
        const Number center = 0.5 * (sigma.rr + sigma.zz),
                     bound  = abs(0.5 * (sigma.rr - sigma.zz)) + abs(sigma.rz);
        const Number major  = max(sigma.tt, center + bound),
                     minor  = min(sigma.tt, center - bound);
        return !any((yield_function(major, minor, strength) > Number(0.)) |
                    (major > Number(strength.tension_cutoff)));
      }

      /** Steps 2 and 3, for trial stresses that step 1 leaves above T. */
      [[gnu::always_inline]] static inline Stress
      to_cutoff(const Stress     &trial,
                const Elasticity &elastic,
                const Strength   &p)
      {
        const Number T(p.tension_cutoff), t(p.minor_at_cutoff);
        const Number excess_major  = trial.major - T;
        const Number excess_middle = trial.middle - T;

        // on s1 = T alone, or on s1 = s2 = T
        const Number plane_middle =
          trial.middle - elastic.oedometric * excess_major;
        const Mask   edge = plane_middle > T;
        const Number fall =
          select(edge,
                 elastic.poisson_ratio * (excess_major + excess_middle),
                 elastic.oedometric * excess_major);
        const Number minor = min(trial.minor - fall, T);

        // on s1 = T and the cone
        const Number line_middle =
          trial.middle -
          elastic.poisson_ratio * (excess_major + (trial.minor - t));
        const Mask on_cone = minor < t;
        return {T,
                select(on_cone,
                       max(min(line_middle, T), t),
                       min(plane_middle, T)),
                max(minor, t)};
      }

    private:
      /** f of the major and the minor stress. Units: Pa. */
      [[gnu::always_inline]] static inline Number
      yield_function(const Number major, const Number minor, const Strength &s)
      {
        return (1. + s.sin_phi) * major - (1. - s.sin_phi) * minor -
               2. * s.cohesion * s.cos_phi;
      }

      /** Step 1 of the file's head. Admissible stresses do not change. */
      [[gnu::always_inline]] static inline Stress
      to_cone(const Stress &trial, const Number yield, const Strength &p)
      {
        const Number on_plane = max(yield, Number(0.)) * p.inverse_plane;
        const Number major    = trial.major - on_plane * p.flow_major;
        const Number middle   = trial.middle - on_plane * p.flow_middle;
        const Number minor    = trial.minor - on_plane * p.flow_minor;

        // s1 = s2: triaxial compression; s2 = s3: triaxial extension
        const Mask major_edge = middle > major;
        const Mask minor_edge = (!major_edge) & (minor > middle);

        const Number trial_major =
          select(major_edge, 0.5 * (trial.major + trial.middle), trial.major);
        const Number trial_minor =
          select(minor_edge, 0.5 * (trial.middle + trial.minor), trial.minor);
        const Number on_edge =
          max(yield_function(trial_major, trial_minor, p), Number(0.)) *
          select(major_edge,
                 Number(p.inverse_major_edge),
                 Number(p.inverse_minor_edge));
        const Number edge_major =
          trial_major - on_edge * select(major_edge,
                                         Number(p.flow_major_edge),
                                         Number(p.flow_major));
        const Number edge_minor =
          trial_minor - on_edge * select(minor_edge,
                                         Number(p.flow_minor_edge),
                                         Number(p.flow_minor));
        return select(major_edge | minor_edge,
                      Stress{edge_major,
                             select(major_edge, edge_major, edge_minor),
                             edge_minor},
                      Stress{major, middle, minor});
      }

      /** Add the plastic strain that took @p trial to @p final_stress. */
      [[gnu::always_inline]] static inline void
      accumulate(LawState<Number> &state,
                 const Stress     &trial,
                 const Stress     &final_stress,
                 const Elasticity &elastic)
      {
        const Number major  = trial.major - final_stress.major;
        const Number middle = trial.middle - final_stress.middle;
        const Number minor  = trial.minor - final_stress.minor;
        const Number mean   = (1. / 3.) * (major + middle + minor);
        const Number square = (major - mean) * (major - mean) +
                              (middle - mean) * (middle - mean) +
                              (minor - mean) * (minor - mean);
        // sqrt(2/3 e:e) with e = deviator of the fall in stress / (2 mu)
        state.plastic_deviatoric +=
          (0.5 / elastic.mu) * sqrt((2. / 3.) * square);
        state.plastic_volumetric += (1. / elastic.bulk) * mean;
      }
    };

  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
