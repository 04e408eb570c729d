// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Hypoplastic sand of von Wolffersdorff (1996); hypoplasticity.h has its
// equations, hypoplastic_integration.h their integration. The defaults are the
// Karlsruhe sand of Herle & Gudehus (1999).
#ifndef caisson_mpm_kernels_hypoplastic_h
#define caisson_mpm_kernels_hypoplastic_h

#include <caisson_mpm/kernels/hypoplastic_integration.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      /** The law "hypoplastic sand". */
      struct HypoplasticSand : HypoplasticIntegration<false>
      {
        static constexpr const char *name = "hypoplastic sand";

        static const char *
        warning(const Parameters &)
        {
          return "hypoplastic sand has no elastic range, and the smallest "
                 "vibrations weaken it: dense sand bore two thirds of the "
                 "force with intergranular strain. Set Law = hypoplastic sand "
                 "with intergranular strain";
        }
      };
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
