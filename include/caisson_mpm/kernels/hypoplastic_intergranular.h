// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Hypoplastic sand with the intergranular strain of Niemunis & Herle (1997),
// so that sand is stiff after a reversal of its strain and where it has hardly
// been strained. hypoplastic_integration.h has the equations. The defaults of
// its own entries are those of Niemunis & Herle for Hochstetten sand.
//
// At the start, h points to vertical compression and has a share of the length
// R: 0 for sand at rest for long, 1 right after it was laid down.
#ifndef caisson_mpm_kernels_hypoplastic_intergranular_h
#define caisson_mpm_kernels_hypoplastic_intergranular_h

#include <caisson_mpm/kernels/hypoplastic_integration.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      /** The law "hypoplastic sand with intergranular strain". Its state is the
       * intergranular strain: rr, zz, tt, rz. */
      struct HypoplasticIntergranular : HypoplasticIntegration<true>
      {
        static constexpr const char *name =
          "hypoplastic sand with intergranular strain";
        static constexpr LawEntry entries[] = {
          Entries::critical_friction_angle,
          HypoplasticEntries::granulate_hardness,
          HypoplasticEntries::compression_exponent,
          HypoplasticEntries::densest_void_ratio,
          HypoplasticEntries::critical_void_ratio,
          HypoplasticEntries::loosest_void_ratio,
          HypoplasticEntries::density_exponent_of_strength,
          HypoplasticEntries::density_exponent_of_stiffness,
          HypoplasticEntries::smallest_mean_stress,
          {"Elastic range of strain",
           "The intergranular strain has the length R at most; sand is nearly "
           "elastic for strains that are small beside it. Units: none.",
           1e-4,
           1e-7,
           1e-2},
          {"Stiffness factor of reversals",
           "The stiffness after a reversal of the strain, and of sand at rest, "
           "is m_R times that of the linear part of the law. Units: none.",
           5.,
           1.,
           100.},
          {"Stiffness factor of turns",
           "The stiffness after a turn of the strain path by 90 degrees is m_T "
           "times that of the linear part of the law. Units: none.",
           2.,
           1.,
           100.},
          {"Evolution exponent",
           "The intergranular strain approaches its largest length with the "
           "exponent beta_r. Units: none.",
           0.5,
           0.01,
           10.},
          {"Stiffness decay exponent",
           "The additional stiffness decays with the power chi of the "
           "intergranular strain. Units: none.",
           6.,
           0.1,
           100.},
          {"Intergranular strain at the start",
           "At the start the intergranular strain is this share of R, in "
           "vertical compression: 0 for sand long at rest, 1 for sand just laid "
           "down. Units: none.",
           0.,
           0.,
           1.}};
        static constexpr int friction_entry =
                               entry_named(entries, "Critical friction angle"),
                             n_state            = 4;
        static constexpr bool state_is_a_tensor = true;

        static Parameters
        make(const double *values)
        {
          const LawValues<HypoplasticIntergranular> value{values};
          Parameters p = Hypoplasticity::make(values);
          p.range      = value("Elastic range of strain");
          p.reversed   = value("Stiffness factor of reversals");
          p.turned     = value("Stiffness factor of turns");
          p.evolution  = value("Evolution exponent");
          p.decay      = value("Stiffness decay exponent");
          p.start      = value("Intergranular strain at the start");
          p.by_roots =
            has_quarter_power(p.evolution) && has_quarter_power(p.decay);
          return p;
        }

        static bool
        check(const double     *values,
              const LawContext &context,
              LawMessage       &message)
        {
          const LawValues<HypoplasticIntergranular> value{values};
          if (value("Stiffness factor of turns") >
              value("Stiffness factor of reversals"))
            {
              __builtin_snprintf(
                message.text,
                sizeof(message.text),
                "Stiffness factor of turns = %g exceeds "
                "Stiffness factor of reversals = %g. Lower it.",
                value("Stiffness factor of turns"),
                value("Stiffness factor of reversals"));
              return false;
            }
          return Hypoplasticity::check(values, context, message);
        }

        static void
        start(const Parameters &p, double *variable)
        {
          variable[1] = -p.start * p.range;
        }
      };

      template <>
      struct LawSlot<5>
      {
        using type = HypoplasticIntergranular;
      };
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
