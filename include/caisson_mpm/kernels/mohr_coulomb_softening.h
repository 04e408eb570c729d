// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Mohr-Coulomb whose strength falls from peak to residual values with plastic
// shearing (Yerro Colom 2015; Yerro, Alonso & Pinyol 2016):
//
//   x = x_res + (x_peak - x_res) exp(-eta eps),   x = c, phi, psi,
//
// eps the accumulated equivalent deviatoric plastic strain sqrt(2/3 e:e). For
// eta = 0 the law is Mohr-Coulomb with the peak values.
//
// The step is explicit in the strength: the return map is that of
// mohr_coulomb.h with the strength at the start of the step, lane by lane, and
// eps grows by what it did. A stress is thus outside the new yield surface by
// what the strength loses in one step, O(eta deps), and the next step brings
// it back, even without strain. Softening gives shear bands a width of about
// one cell, and eta must be scaled with it, unless overstress.h gives them one
// of their own.
//
// References:
//   A. Yerro Colom (2015), MPM modelling of landslides in brittle and
//     unsaturated soils. PhD thesis, Universitat Politecnica de Catalunya.
//   A. Yerro, E.E. Alonso, N.M. Pinyol (2016), Run-out of landslides in brittle
//     soils. Comput. Geotech. 80, 427-439. doi:10.1016/j.compgeo.2016.03.001
#ifndef caisson_mpm_kernels_mohr_coulomb_softening_h
#define caisson_mpm_kernels_mohr_coulomb_softening_h

#include <caisson_mpm/kernels/mohr_coulomb.h>
#include <caisson_mpm/kernels/simd_math.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      /** The law "Mohr-Coulomb with softening": the strength of each point
       * follows from its plastic strain. See the head of the file. */
      struct MohrCoulombSoftening : ElasticLaw
      {
        static constexpr const char *name = "Mohr-Coulomb with softening";
        static constexpr bool        has_yield_surface = true;

        struct Parameters : MohrCoulombEntries
        {
          double residual_friction, residual_dilatancy, residual_cohesion;
          double shape_factor;

          double phi, psi;                          // residual, rad
          double phi_lost, psi_lost, cohesion_lost; // peak - residual

          void
          derive()
          {
            Elasticity::derive();
            phi           = residual_friction * radians_per_degree;
            psi           = residual_dilatancy * radians_per_degree;
            phi_lost      = friction_angle * radians_per_degree - phi;
            psi_lost      = dilatancy_angle * radians_per_degree - psi;
            cohesion_lost = cohesion - residual_cohesion;
          }
        };

        static constexpr auto entries = joined<Parameters>(
          mohr_coulomb_entries,
          {{&Parameters::residual_friction,
            {"Residual friction angle",
             "degrees",
             "The residual friction angle is that after much plastic strain.",
             30.,
             0.,
             60.}},
           {&Parameters::residual_dilatancy,
            {"Residual dilatancy angle",
             "degrees",
             "The residual dilatancy angle is that after much plastic strain.",
             0.,
             0.,
             60.}},
           {&Parameters::residual_cohesion,
            {"Residual cohesion",
             "Pa",
             "The residual cohesion is that after much plastic strain.",
             0.,
             0.,
             no_limit}},
           {&Parameters::shape_factor,
            {"Softening shape factor",
             "",
             "The strength falls from its peak to its residual value with "
             "exp(-eta e), where eta is this factor and e the accumulated "
             "deviatoric plastic strain.",
             10.,
             0.,
             no_limit}}});

        static const char *
        warning(const Parameters &)
        {
          return "softening needs an Internal length: without it, shear bands "
                 "are about a cell wide, so compare meshes: see "
                 "doc/limitations.md";
        }

        static bool
        check(const Parameters &p,
              const LawContext & /*context*/,
              LawMessage &message)
        {
          const struct
          {
            const char *peak, *residual;
            double      at_peak, at_residual;
          } softening[] = {
            {"Friction angle",
             "Residual friction angle",
             p.friction_angle,
             p.residual_friction},
            {"Dilatancy angle",
             "Residual dilatancy angle",
             p.dilatancy_angle,
             p.residual_dilatancy},
            {"Cohesion", "Residual cohesion", p.cohesion, p.residual_cohesion}};
          for (const auto &s : softening)
            if (s.at_residual > s.at_peak)
              return message.refuse("%s = %g exceeds %s = %g: the law softens. "
                                    "Lower the residual value.",
                                    s.residual,
                                    s.at_residual,
                                    s.peak,
                                    s.at_peak);
          if (p.residual_dilatancy > p.residual_friction)
            return message.refuse(
              "Residual dilatancy angle = %g exceeds Residual friction "
              "angle = %g degrees: plastic flow would create energy. Lower "
              "the dilatancy angle.",
              p.residual_dilatancy,
              p.residual_friction);
          return check_dilatancy(p.friction_angle, p.dilatancy_angle, message);
        }

        static VolumeInShear
        volume_in_shear(const Parameters &p)
        {
          return p.dilatancy_angle > 0. ? VolumeInShear::gained :
                                          VolumeInShear::kept;
        }

        static bool
        is_frictionless(const Parameters &p)
        {
          return p.friction_angle == 0.;
        }

        /** 1 - sin phi of the peak (Jaky). */
        static double
        earth_pressure_at_rest(const Parameters &p)
        {
          return 1. - __builtin_sin(p.phi + p.phi_lost);
        }

        template <typename Number>
        [[gnu::always_inline]] static inline void
        update(StressState<Number>           &sigma,
               const StrainIncrement<Number> &de,
               LawState<Number>              &state,
               const Parameters              &p)
        {
          using Strength = MohrCoulombStrength<Number>;
          const Number left =
            exp(Number(-p.shape_factor) * state.plastic_deviatoric);
          const Number phi = p.phi + p.phi_lost * left;
          const Number psi = p.psi + p.psi_lost * left;
          MohrCoulombReturn<Number, Strength>::update(
            sigma,
            de,
            state,
            p,
            Strength::make(p,
                           sin(phi),
                           cos(phi),
                           sin(psi),
                           p.residual_cohesion + p.cohesion_lost * left,
                           p.tension_cutoff));
        }
      };
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
