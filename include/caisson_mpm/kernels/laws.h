// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The list of material laws that the kernels know, and the choice among them
// once per block. A new law is a header like mohr_coulomb.h and one more entry
// of Laws (see doc/developer.md).
#ifndef caisson_mpm_kernels_laws_h
#define caisson_mpm_kernels_laws_h

#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/kernels/linear_elastic.h>
#include <caisson_mpm/kernels/mohr_coulomb.h>

#define CAISSON_LAMBDA __attribute__((always_inline))

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      template <typename... Law>
      struct LawList
      {};

      /** The position in this list is Material::law. */
      using Laws = LawList<LinearElastic, MohrCoulomb>;

      template <typename Wanted, typename... Law>
      constexpr int
      index_in(LawList<Law...>)
      {
        int index = 0, found = -1;
        ((__is_same(Wanted, Law) ? (found = index++) : index++), ...);
        return found;
      }

      /** Material::law of a law. */
      template <typename Law>
      constexpr int law_id = index_in<Law>(Laws());

      template <typename Action, typename... Law>
      CAISSON_INLINE void
      with_law_of(const Material &material,
                  const Action   &action,
                  LawList<Law...>)
      {
        (void)((material.law == law_id<Law> ?
                  (action(Law(),
                          reinterpret_cast<const typename Law::Parameters &>(
                            material.parameters)),
                   true) :
                  false) ||
               ...);
      }

      /** Call action(law, parameters) with the law of the material. */
      template <typename Action>
      CAISSON_INLINE void
      with_law(const Material &material, const Action &action)
      {
        with_law_of(material, action, Laws());
      }

      /** Write the parameters of a law into a material. */
      template <typename Law>
      inline void
      set_law(Material &material, const typename Law::Parameters &parameters)
      {
        static_assert(sizeof(parameters) <= sizeof(material.parameters),
                      "enlarge Material::parameters");
        material.law = law_id<Law>;
        __builtin_memcpy(material.parameters, &parameters, sizeof(parameters));
      }
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
