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
        static constexpr int  n_state           = 4;
        static constexpr bool state_is_a_tensor = true;

        static constexpr auto entries = joined<Parameters>(
          Hypoplasticity::entries,
          {{&Parameters::range,
            {"Elastic range of strain",
             "",
             "The intergranular strain has the length R at most; sand is "
             "nearly elastic for strains that are small beside it.",
             1e-4,
             1e-7,
             1e-2}},
           {&Parameters::reversed,
            {"Stiffness factor of reversals",
             "",
             "The stiffness after a reversal of the strain, and of sand at "
             "rest, is m_R times that of the linear part of the law.",
             5.,
             1.,
             100.}},
           {&Parameters::turned,
            {"Stiffness factor of turns",
             "",
             "The stiffness after a turn of the strain path by 90 degrees is "
             "m_T times that of the linear part of the law.",
             2.,
             1.,
             100.}},
           {&Parameters::evolution,
            {"Evolution exponent",
             "",
             "The intergranular strain approaches its largest length with the "
             "exponent beta_r.",
             0.5,
             0.01,
             10.}},
           {&Parameters::decay,
            {"Stiffness decay exponent",
             "",
             "The additional stiffness decays with the power chi of the "
             "intergranular strain.",
             6.,
             0.1,
             100.}},
           {&Parameters::start,
            {"Intergranular strain at the start",
             "",
             "At the start the intergranular strain is this share of R, in "
             "vertical compression: 0 for sand long at rest, 1 for sand just "
             "laid down.",
             0.,
             0.,
             1.}}});

        static bool
        check(const Parameters &p,
              const LawContext &context,
              LawMessage       &message)
        {
          if (p.turned > p.reversed)
            return message.refuse(
              "Stiffness factor of turns = %g exceeds "
              "Stiffness factor of reversals = %g. Lower it.",
              p.turned,
              p.reversed);
          return Hypoplasticity::check(p, context, message);
        }

        static void
        start(const Parameters &p, double *variable)
        {
          variable[1] = -p.start * p.range;
        }
      };
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
