// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Linear elastic, perfectly plastic Mohr-Coulomb law with a non-associated
// flow rule and a tension cut-off; Tresca is the case phi = psi = 0.
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
#ifndef caisson_mpm_kernels_mohr_coulomb_h
#define caisson_mpm_kernels_mohr_coulomb_h

#include <caisson_mpm/kernels/stress_state.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      struct MohrCoulomb
      {
        /** The largest tension_cutoff; larger values mean no cut-off. */
        static constexpr double no_cutoff = 1e30;

        /** The law's constants and what follows from them, made by make(). */
        struct Parameters
        {
          /** Elastic constants. Units: Pa, poisson: none. */
          double lambda, mu, bulk, poisson;

          double sin_phi, cos_phi, sin_psi;

          /** Units: Pa. */
          double cohesion;

          /** T, the largest tensile stress that is admissible. Units: Pa. */
          double tension_cutoff;

          /** t, where the cone meets the cut-off: f(T, t) = 0. Units: Pa. */
          double minor_at_cutoff;

          /**
           * D times the flow direction of the plane (s1, s3), by component,
           * and the averages of two of them, which the edges need. Units: Pa.
           */
          double flow_major, flow_middle, flow_minor;
          double flow_major_edge, flow_minor_edge;

          /** 1 / (grad f . D . flow direction). Units: 1/Pa. */
          double inverse_plane, inverse_major_edge, inverse_minor_edge;

          /** nu / (1 - nu), the elastic earth pressure at rest. */
          double oedometric;

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
               const double tension);
        };

        /**
         * Advance @p sigma, the old stress rotated with the material, by the
         * strain increment @p de. Add to @p plastic_strain_deviatoric the
         * equivalent sqrt(2/3 e:e) of the deviator e of the plastic strain
         * increment, and to @p plastic_strain_volumetric its trace.
         */
        template <typename Number>
        static CAISSON_INLINE void
        update(StressState<Number>           &sigma,
               const StrainIncrement<Number> &de,
               Number                        &plastic_strain_deviatoric,
               Number                        &plastic_strain_volumetric,
               const Parameters              &parameters);

      private:
        /** f of the major and the minor stress. Units: Pa. */
        template <typename Number>
        static CAISSON_INLINE Number
        yield_function(const Number      major,
                       const Number      minor,
                       const Parameters &p)
        {
          return (1. + p.sin_phi) * major - (1. - p.sin_phi) * minor -
                 2. * p.cohesion * p.cos_phi;
        }

        /** Step 1 of the file's head. Admissible stresses do not change. */
        template <typename Number>
        static CAISSON_INLINE PrincipalStresses<Number>
        return_to_cone(const PrincipalStresses<Number> &trial,
                       const Number                     yield,
                       const Parameters                &parameters);

        /** Steps 2 and 3, for trial stresses that step 1 leaves above T. */
        template <typename Number>
        static CAISSON_INLINE PrincipalStresses<Number>
        return_to_cutoff(const PrincipalStresses<Number> &trial,
                         const Parameters                &parameters);

        /** Add the plastic strain that took @p trial to @p final_stress. */
        template <typename Number>
        static CAISSON_INLINE void
        accumulate(Number                          &plastic_strain_deviatoric,
                   Number                          &plastic_strain_volumetric,
                   const PrincipalStresses<Number> &trial,
                   const PrincipalStresses<Number> &final_stress,
                   const Parameters                &parameters);
      };



      inline MohrCoulomb::Parameters
      MohrCoulomb::Parameters::make(const double E,
                                    const double nu,
                                    const double phi,
                                    const double psi,
                                    const double cohesion,
                                    const double tension)
      {
        Parameters p;
        p.lambda     = E * nu / ((1. + nu) * (1. - 2. * nu));
        p.mu         = 0.5 * E / (1. + nu);
        p.bulk       = E / (3. * (1. - 2. * nu));
        p.poisson    = nu;
        p.oedometric = nu / (1. - nu);
        p.sin_phi    = __builtin_sin(phi);
        p.cos_phi    = __builtin_cos(phi);
        p.sin_psi    = __builtin_sin(psi);
        p.cohesion   = cohesion;

        const double s = p.sin_phi, c = cohesion * p.cos_phi;
        // c cot phi without a division by sin phi = 0
        const double apex = c < no_cutoff * s ? c / s : no_cutoff;
        p.tension_cutoff  = tension < apex ? tension : apex;
        const double t    = ((1. + s) * p.tension_cutoff - 2. * c) / (1. - s);
        p.minor_at_cutoff = t < p.tension_cutoff ? t : p.tension_cutoff;

        const double trace = 2. * p.sin_psi;
        p.flow_major       = p.lambda * trace + 2. * p.mu * (1. + p.sin_psi);
        p.flow_middle      = p.lambda * trace;
        p.flow_minor       = p.lambda * trace - 2. * p.mu * (1. - p.sin_psi);
        p.flow_major_edge  = 0.5 * (p.flow_major + p.flow_middle);
        p.flow_minor_edge  = 0.5 * (p.flow_middle + p.flow_minor);

        const auto inverse = [s](const double major, const double minor) {
          return 1. / ((1. + s) * major - (1. - s) * minor);
        };
        p.inverse_plane      = inverse(p.flow_major, p.flow_minor);
        p.inverse_major_edge = inverse(p.flow_major_edge, p.flow_minor);
        p.inverse_minor_edge = inverse(p.flow_major, p.flow_minor_edge);
        return p;
      }



      template <typename Number>
      CAISSON_INLINE void
      MohrCoulomb::update(StressState<Number>           &sigma,
                          const StrainIncrement<Number> &de,
                          Number           &plastic_strain_deviatoric,
                          Number           &plastic_strain_volumetric,
                          const Parameters &parameters)
      {
        add_elastic_increment(sigma, de, parameters.lambda, parameters.mu);

        const PrincipalFrame<Number>    frame(sigma);
        const PrincipalStresses<Number> trial = frame.principal_stresses();
        const Number                    yield =
          yield_function(trial.major, trial.minor, parameters);
        const Number cutoff(parameters.tension_cutoff);
        if (!any((yield > Number(0.)) | (trial.major > cutoff)))
          return;

        PrincipalStresses<Number> s = return_to_cone(trial, yield, parameters);
        const typename Number::Mask torn = s.major > cutoff;
        if (any(torn))
          s = select(torn, return_to_cutoff(trial, parameters), s);

        accumulate(plastic_strain_deviatoric,
                   plastic_strain_volumetric,
                   trial,
                   s,
                   parameters);
        sigma = frame.with_principal_stresses(s);
      }



      template <typename Number>
      CAISSON_INLINE PrincipalStresses<Number>
      MohrCoulomb::return_to_cone(const PrincipalStresses<Number> &trial,
                                  const Number                     yield,
                                  const Parameters                &p)
      {
        using Mask = typename Number::Mask;

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
        return select(
          major_edge | minor_edge,
          PrincipalStresses<Number>{edge_major,
                                    select(major_edge, edge_major, edge_minor),
                                    edge_minor},
          PrincipalStresses<Number>{major, middle, minor});
      }



      template <typename Number>
      CAISSON_INLINE PrincipalStresses<Number>
      MohrCoulomb::return_to_cutoff(const PrincipalStresses<Number> &trial,
                                    const Parameters                &p)
      {
        using Mask = typename Number::Mask;

        const Number T(p.tension_cutoff), t(p.minor_at_cutoff);
        const Number excess_major  = trial.major - T;
        const Number excess_middle = trial.middle - T;

        // on s1 = T alone, or on s1 = s2 = T
        const Number plane_middle = trial.middle - p.oedometric * excess_major;
        const Mask   edge         = plane_middle > T;
        const Number fall         = select(edge,
                                   p.poisson * (excess_major + excess_middle),
                                   p.oedometric * excess_major);
        const Number minor        = min(trial.minor - fall, T);

        // on s1 = T and the cone
        const Number line_middle =
          trial.middle - p.poisson * (excess_major + (trial.minor - t));
        const Mask on_cone = minor < t;
        return {T,
                select(on_cone,
                       max(min(line_middle, T), t),
                       min(plane_middle, T)),
                max(minor, t)};
      }



      template <typename Number>
      CAISSON_INLINE void
      MohrCoulomb::accumulate(Number &plastic_strain_deviatoric,
                              Number &plastic_strain_volumetric,
                              const PrincipalStresses<Number> &trial,
                              const PrincipalStresses<Number> &final_stress,
                              const Parameters                &p)
      {
        const Number major  = trial.major - final_stress.major;
        const Number middle = trial.middle - final_stress.middle;
        const Number minor  = trial.minor - final_stress.minor;
        const Number mean   = (1. / 3.) * (major + middle + minor);
        const Number square = (major - mean) * (major - mean) +
                              (middle - mean) * (middle - mean) +
                              (minor - mean) * (minor - mean);
        // sqrt(2/3 e:e) with e = deviator of the fall in stress / (2 mu)
        plastic_strain_deviatoric += (0.5 / p.mu) * sqrt((2. / 3.) * square);
        plastic_strain_volumetric += (1. / p.bulk) * mean;
      }
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
