// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The material laws that the kernels know, the choice among them once per
// block, and what the rest of the program asks of them. A new law is a header
// as described in material_law.h and one more line among the next ones.
#ifndef caisson_mpm_kernels_laws_h
#define caisson_mpm_kernels_laws_h

#include <caisson_mpm/kernels/for_each_block.h>
#include <caisson_mpm/kernels/hypoplastic.h>
#include <caisson_mpm/kernels/hypoplastic_intergranular.h>
#include <caisson_mpm/kernels/linear_elastic.h>
#include <caisson_mpm/kernels/material.h>
#include <caisson_mpm/kernels/modified_cam_clay.h>
#include <caisson_mpm/kernels/mohr_coulomb.h>
#include <caisson_mpm/kernels/mohr_coulomb_density.h>
#include <caisson_mpm/kernels/mohr_coulomb_softening.h>
#include <caisson_mpm/kernels/mohr_coulomb_stiffening.h>
#include <caisson_mpm/kernels/ngi_adp.h>
#include <caisson_mpm/kernels/nor_sand.h>
#include <caisson_mpm/kernels/overstress.h>
#include <caisson_mpm/kernels/user_material.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      template <int slot>
      struct SlotNumber
      {
        using Law = typename LawSlot<slot>::type;

        static constexpr bool is_taken = !__is_same(Law, void);
      };

      template <int... slot>
      struct SlotList
      {};

      using Slots =
        SlotList<0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15>;

      // ------------------------------------------------------ parameters

      /** Call action(law, parameters) if the material's law is this one. */
      template <int slot, typename Action>
      [[gnu::always_inline]] inline void
      with_slot(const Material &material, const Action &action)
      {
        if constexpr (SlotNumber<slot>::is_taken)
          if (material.law == slot)
            {
              using Law = typename SlotNumber<slot>::Law;
              action(Law(),
                     reinterpret_cast<const typename Law::Parameters &>(
                       material.parameters));
            }
      }

      template <typename Action, int... slot>
      [[gnu::always_inline]] inline void
      with_law(const Material &material,
               const Action   &action,
               SlotList<slot...>)
      {
        (with_slot<slot>(material, action), ...);
      }

      /** Call action(law, parameters) with the law of the material. */
      template <typename Action>
      [[gnu::always_inline]] inline void
      with_law(const Material &material, const Action &action)
      {
        with_law(material, action, Slots());
      }

      template <typename Law, int... slot>
      constexpr int
      slot_of(SlotList<slot...>)
      {
        int result = -1;
        ((__is_same(Law, typename LawSlot<slot>::type) ? (void)(result = slot) :
                                                         (void)0),
         ...);
        return result;
      }

      /** Material::law of a law. */
      template <typename Law>
      constexpr int law_id = slot_of<Law>(Slots());

      /** Write a law and its parameters into a material. */
      template <typename Law>
      inline void
      set_law(Material &material, const typename Law::Parameters &parameters)
      {
        static_assert(sizeof(parameters) <= sizeof(material.parameters),
                      "enlarge Material::parameters (material.h)");
        material.law             = law_id<Law>;
        material.volume_in_shear = Law::volume_in_shear(parameters);
        material.is_frictionless = Law::is_frictionless(parameters);
        material.has_loosest_state =
          Law::has_loosest_state && Law::needs_void_ratio(parameters);
        material.overstress_time = 0.;
        __builtin_memcpy(material.parameters, &parameters, sizeof(parameters));
      }

      // ------------------------------------------------------ descriptions

      /** A law for code that is not compiled for each law. */
      struct LawDescription
      {
        const char *name; // null: the slot is free
        int         n_entries;
        bool        stiffness_varies;
        bool        has_yield_surface;
        bool        has_yield_stress;

        const Entry &(*entry)(const int i);

        /** Whether the values fit together; if not, why. */
        bool (*check)(const double *values, const LawContext &, LawMessage &);

        /** What the law is known not to describe with these values, or null. */
        const char *(*warning)(const double *values);

        /** Write the law and its parameters into the material. */
        void (*set)(Material &, const double *values);

        double (*earth_pressure_at_rest)(const Material &);

        /** @p stress: rr, zz, tt, rz. Units: Pa. */
        double (*p_wave_modulus)(const Material &,
                                 const double *stress,
                                 const double  void_ratio);

        /** The void ratio of the soil itself: what is more is a gap. */
        double (*void_ratio_of_soil)(const Material &,
                                     const double *stress,
                                     const double  void_ratio);

        /** The variables of a point at the start [n_state_variables]. */
        void (*start)(const Material &, double *variable);

        /** Units: Pa. */
        double (*yield_stress)(const Material &,
                               const double *stress,
                               const double  void_ratio,
                               const double *variable);
      };

      /** The functions of a description. */
      template <int slot>
      struct LawFunctions
      {
        using Law        = typename SlotNumber<slot>::Law;
        using Parameters = typename Law::Parameters;

        static_assert(Law::n_state <= n_state_variables,
                      "enlarge n_state_variables (material.h)");

        static const Parameters &
        parameters(const Material &material)
        {
          return reinterpret_cast<const Parameters &>(material.parameters);
        }

        static constexpr const Entry &
        entry(const int i)
        {
          return Law::entries[i].entry;
        }

        static bool
        check(const double     *values,
              const LawContext &context,
              LawMessage       &message)
        {
          return Law::check(read_parameters<Law>(values), context, message);
        }

        static const char *
        warning(const double *values)
        {
          return Law::warning(read_parameters<Law>(values));
        }

        static void
        set(Material &material, const double *values)
        {
          set_law<Law>(material, read_parameters<Law>(values));
        }

        static double
        earth_pressure_at_rest(const Material &material)
        {
          return Law::earth_pressure_at_rest(parameters(material));
        }

        static double
        p_wave_modulus(const Material &material,
                       const double   *stress,
                       const double    void_ratio)
        {
          return Law::p_wave_modulus(
            StressState<Lanes<1>>{stress[0], stress[1], stress[2], stress[3]},
            Lanes<1>(void_ratio),
            parameters(material))[0];
        }

        static double
        void_ratio_of_soil(const Material &material,
                           const double   *stress,
                           const double    void_ratio)
        {
          if constexpr (Law::has_loosest_state)
            if (material.has_loosest_state)
              {
                const double loosest =
                  Law::loosest_void_ratio(StressState<Lanes<1>>{stress[0],
                                                                stress[1],
                                                                stress[2],
                                                                stress[3]},
                                          parameters(material))[0];
                return void_ratio < loosest ? void_ratio : loosest;
              }
          (void)material;
          (void)stress;
          return void_ratio;
        }

        static void
        start(const Material &material, double *variable)
        {
          for (int i = 0; i < n_state_variables; ++i)
            variable[i] = 0.;
          Law::start(parameters(material), variable);
        }

        static double
        yield_stress(const Material &material,
                     const double   *stress,
                     const double    void_ratio,
                     const double   *variable)
        {
          if constexpr (Law::has_yield_stress)
            return Law::yield_stress(
              StressState<Lanes<1>>{stress[0], stress[1], stress[2], stress[3]},
              Lanes<1>(void_ratio),
              Lanes<1>(variable[0]),
              parameters(material))[0];
          (void)material, (void)stress, (void)void_ratio, (void)variable;
          return 0.;
        }
      };

      template <int slot>
      constexpr LawDescription
      describe()
      {
        if constexpr (SlotNumber<slot>::is_taken)
          {
            using Law = typename SlotNumber<slot>::Law;
            using F   = LawFunctions<slot>;
            return {Law::name,
                    n_entries<Law>,
                    Law::stiffness_varies,
                    Law::has_yield_surface,
                    Law::has_yield_stress,
                    &F::entry,
                    &F::check,
                    &F::warning,
                    &F::set,
                    &F::earth_pressure_at_rest,
                    &F::p_wave_modulus,
                    &F::void_ratio_of_soil,
                    &F::start,
                    &F::yield_stress};
          }
        else
          return {};
      }

      /** All slots, the free ones without a name. */
      template <int n>
      struct LawTable
      {
        LawDescription law[n];
      };

      template <int... slot>
      constexpr LawTable<sizeof...(slot)>
      describe_all(SlotList<slot...>)
      {
        return {{describe<slot>()...}};
      }

      inline constexpr LawTable law_table = describe_all(Slots());

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
                      !(same_text(x.text, y.text) &&
                        same_text(x.unit, y.unit) && x.value == y.value &&
                        x.smallest == y.smallest && x.largest == y.largest))
                    return false;
                }
        return true;
      }

      static_assert(entries_agree(law_table),
                    "two laws have different entries of the same name");
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
