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
      struct MohrCoulombSoftening
      {
        static constexpr const char *name      = "Mohr-Coulomb with softening";
        static constexpr LawEntry    entries[] = {
             Entries::youngs_modulus,
             Entries::poisson_ratio,
             Entries::friction_angle,
             Entries::dilatancy_angle,
             Entries::cohesion,
             Entries::tension_cutoff,
             {"Residual friction angle",
              "The residual friction angle is that after much plastic strain. "
                 "Units: degrees.",
              30.,
              0.,
              60.},
             {"Residual dilatancy angle",
              "The residual dilatancy angle is that after much plastic strain. "
                 "Units: degrees.",
              0.,
              0.,
              60.},
             {"Residual cohesion",
              "The residual cohesion is that after much plastic strain. Units: Pa.",
              0.,
              0.,
              no_limit},
             {"Softening shape factor",
              "The strength falls from its peak to its residual value with "
                 "exp(-eta e), where eta is this factor and e the accumulated "
                 "deviatoric plastic strain. Units: none.",
              10.,
              0.,
              no_limit}};
        static constexpr int friction_entry =
                               entry_named(entries, "Friction angle"),
                             n_state            = 0;
        static constexpr bool uses_void_ratio   = false;
        static constexpr bool stiffness_varies  = false;
        static constexpr bool has_yield_surface = true;

        /** Angles in rad, stresses in Pa. */
        struct Parameters
        {
          MohrCoulombElasticity elastic;
          double                phi, psi, cohesion; // residual
          double phi_lost, psi_lost, cohesion_lost; // peak - residual
          double rate, tension;
        };

        static Parameters
        make(const double *values)
        {
          const LawValues<MohrCoulombSoftening> value{values};
          const auto angle = [value](const char *name) {
            return value(name) * radians_per_degree;
          };
          return {MohrCoulombElasticity::make(value("Youngs modulus"),
                                              value("Poisson ratio")),
                  angle("Residual friction angle"),
                  angle("Residual dilatancy angle"),
                  value("Residual cohesion"),
                  angle("Friction angle") - angle("Residual friction angle"),
                  angle("Dilatancy angle") - angle("Residual dilatancy angle"),
                  value("Cohesion") - value("Residual cohesion"),
                  value("Softening shape factor"),
                  value("Tension cut-off")};
        }

        static const char *
        warning(const double * /*values*/)
        {
          return "softening needs an Internal length: without it, shear bands "
                 "are about a cell wide, so compare meshes: see "
                 "doc/limitations.md";
        }

        static bool
        check(const double     *values,
              const LawContext &context,
              LawMessage       &message)
        {
          const LawValues<MohrCoulombSoftening> value{values};
          static constexpr const char          *softening[][2] = {
                     {"Friction angle", "Residual friction angle"},
                     {"Dilatancy angle", "Residual dilatancy angle"},
                     {"Cohesion", "Residual cohesion"}};
          for (const auto &[peak, residual] : softening)
            if (value(residual) > value(peak))
              {
                __builtin_snprintf(message.text,
                                   sizeof(message.text),
                                   "%s = %g exceeds %s = %g: the law softens. "
                                   "Lower the residual value.",
                                   residual,
                                   value(residual),
                                   peak,
                                   value(peak));
                return false;
              }
          if (value("Residual dilatancy angle") >
              value("Residual friction angle"))
            {
              __builtin_snprintf(
                message.text,
                sizeof(message.text),
                "Residual dilatancy angle = %g exceeds Residual friction "
                "angle = %g degrees: plastic flow would create energy. Lower "
                "the dilatancy angle.",
                value("Residual dilatancy angle"),
                value("Residual friction angle"));
              return false;
            }
          return check_strength(value("Friction angle"),
                                value("Dilatancy angle"),
                                value("Cohesion"),
                                context,
                                message);
        }

        /** Whether the soil gains volume in plastic shear. */
        static bool
        dilates(const Parameters &p)
        {
          return p.psi + p.psi_lost > 0.;
        }

        static bool
        is_frictionless(const Parameters &p)
        {
          return p.phi == 0. && p.phi_lost == 0.;
        }

        /** 1 - sin phi of the peak (Jaky). */
        static double
        earth_pressure_at_rest(const Parameters &p)
        {
          return 1. - __builtin_sin(p.phi + p.phi_lost);
        }

        template <typename Number>
        [[gnu::always_inline]] static inline Number
        p_wave_modulus(const StressState<Number> & /*stress*/,
                       const Number /*void_ratio*/,
                       const Parameters &p)
        {
          return p.elastic.p_wave_modulus();
        }

        template <typename Number>
        [[gnu::always_inline]] static inline void
        update(StressState<Number>           &sigma,
               const StrainIncrement<Number> &de,
               LawState<Number>              &state,
               const Parameters              &p)
        {
          using Strength    = MohrCoulombStrength<Number>;
          const Number left = exp(Number(-p.rate) * state.plastic_deviatoric);
          const Number phi  = p.phi + p.phi_lost * left;
          const Number psi  = p.psi + p.psi_lost * left;
          MohrCoulombReturn<Number, Strength>::update(
            sigma,
            de,
            state,
            p.elastic,
            Strength::make(p.elastic,
                           sin(phi),
                           cos(phi),
                           sin(psi),
                           p.cohesion + p.cohesion_lost * left,
                           p.tension));
        }
      };

      template <>
      struct LawSlot<2>
      {
        using type = MohrCoulombSoftening;
      };
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
