// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The material laws that the kernels know, the choice among them once per
// block, and what the rest of the program asks of them. A new law is a header
// as described in material_law.h, included here, and one more name in Laws.
#ifndef caisson_mpm_kernels_laws_h
#define caisson_mpm_kernels_laws_h

#include <caisson_mpm/kernels/for_each_block.h>
#include <caisson_mpm/kernels/hypoplastic_intergranular.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/kernels/linear_elastic.h>
#include <caisson_mpm/kernels/mohr_coulomb.h>
#include <caisson_mpm/kernels/mohr_coulomb_density.h>
#include <caisson_mpm/kernels/ngi_adp.h>
#include <caisson_mpm/kernels/user_material.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    template <typename... Law>
    struct LawList
    {};

    /** All laws, in the order of the manual. */
    using Laws = LawList<LinearElastic,
                         MohrCoulomb,
                         HypoplasticIntergranular,
                         MohrCoulombDensity,
                         NgiAdp,
                         UserMaterial>;

    template <typename Law, typename... All>
    constexpr int
    place_of(LawList<All...>)
    {
      int result = -1, place = 0;
      ((__is_same(Law, All) ? result = place : 0, ++place), ...);
      return result;
    }

    /** Material::law of a law: its place among Laws. */
    template <typename Law>
    constexpr int law_id = place_of<Law>(Laws());

    // ------------------------------------------------------ parameters

    template <typename Action, typename... Law>
    [[gnu::always_inline]] inline void
    with_law(const Material &material, const Action &action, LawList<Law...>)
    {
      ((material.law == law_id<Law> ?
          action(Law(),
                 reinterpret_cast<const typename Law::Parameters &>(
                   material.parameters)) :
          void()),
       ...);
    }

    /** Call action(law, parameters) with the law of the material. */
    template <typename Action>
    [[gnu::always_inline]] inline void
    with_law(const Material &material, const Action &action)
    {
      with_law(material, action, Laws());
    }

    /** Write a law and its parameters into a material. */
    template <typename Law>
    inline void
    set_law(Material &material, const typename Law::Parameters &parameters)
    {
      static_assert(sizeof(parameters) <= sizeof(material.parameters),
                    "enlarge Material::parameters (layout.h)");
      static_assert(Law::n_state <= n_state_variables,
                    "enlarge n_state_variables (layout.h)");
      material.law             = law_id<Law>;
      material.volume_in_shear = Law::volume_in_shear(parameters);
      material.is_frictionless =
        parameters.shear_strength >= 0. && !(parameters.friction_angle > 0.);
      material.has_loosest_state =
        Law::has_loosest_state && Law::needs_void_ratio(parameters);
      __builtin_memcpy(material.parameters, &parameters, sizeof(parameters));
    }

    // ------------------------------------------------------ descriptions

    /** A law for code that is not compiled for each law. */
    struct LawDescription
    {
      const char *name;
      int         n_entries;
      bool        stiffness_varies;

      const Entry &(*entry)(const int i);

      LawNumbers (*numbers)(const double *values);

      /** Write the law and its parameters into the material. */
      void (*set)(Material &, const double *values);
    };

    template <typename Law>
    constexpr LawDescription
    describe()
    {
      return {Law::name,
              n_entries<Law>,
              Law::stiffness_varies,
              [](const int i) -> const Entry & {
                return Law::entries[i].entry;
              },
              [](const double *values) -> LawNumbers {
                return read_parameters<Law>(values);
              },
              [](Material &material, const double *values) {
                set_law<Law>(material, read_parameters<Law>(values));
              }};
    }

    template <int n>
    struct LawTable
    {
      LawDescription law[n];
    };

    template <typename... Law>
    constexpr LawTable<sizeof...(Law)>
    describe_all(LawList<Law...>)
    {
      return {{describe<Law>()...}};
    }

    inline constexpr LawTable law_table = describe_all(Laws());

    // ------------------------------------------------------ shared entries

    constexpr bool
    same_text(const char *a, const char *b)
    {
      for (; *a == *b; ++a, ++b)
        if (*a == 0)
          return true;
      return false;
    }

    /** Whether entries of the same name are the same in all laws. */
    template <int n>
    constexpr bool
    entries_agree(const LawTable<n> &table)
    {
      for (const LawDescription &a : table.law)
        for (const LawDescription &b : table.law)
          for (int i = 0; i < a.n_entries; ++i)
            for (int j = 0; j < b.n_entries; ++j)
              {
                const Entry &x = a.entry(i), &y = b.entry(j);
                if (same_text(x.name, y.name) &&
                    !(same_text(x.text, y.text) && same_text(x.unit, y.unit) &&
                      x.value == y.value && x.smallest == y.smallest &&
                      x.largest == y.largest))
                  return false;
              }
      return true;
    }

    static_assert(entries_agree(law_table),
                  "two laws have different entries of the same name");
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
