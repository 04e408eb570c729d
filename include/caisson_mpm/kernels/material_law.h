// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a material law consists of, apart from its equations. A law is one
// header with one struct, here called Law, and is registered by including that
// header in laws.h. It has
//
//   static constexpr const char *name;          // the value of the entry "Law"
//   static constexpr LawEntry    entries[];     // what it asks of the user
//   static constexpr int         friction_entry;// its friction angle; -1: none
//   static constexpr bool        uses_void_ratio;
//   static constexpr bool        stiffness_varies; // with stress, void ratio
//   static constexpr bool        has_yield_surface; // optional: overstress.h
//   static constexpr bool        is_packed; // optional, for a law that
//                                   // takes long: packed_points.h
//   static constexpr int         n_state; // of LawState::variable in use
//   static constexpr bool        state_is_a_tensor; // optional: the first four
//                                   // variables turn with the soil
//   static constexpr bool        is_external; // optional: has no update(), but
//                                   // is called point by point: user_points.h
//   struct Parameters;                              // plain data
//
//   static Parameters make(const double *values);
//   static bool check(const double *values, const LawContext &, LawMessage &);
//   template <typename Number> // optional, with the next: loosest_state.h
//   static Number loosest_void_ratio(const StressState<Number> &,
//                                    const Parameters &);
//   template <typename Number> // the same without a division, for each step
//   static typename Number::Mask is_loosest(const StressState<Number> &,
//                                           const Number volume,
//                                           const Number volume_of_solids,
//                                           const Parameters &);
//   static const char *warning(const double *values); // optional; null: none
//   static double earth_pressure_at_rest(const Parameters &);
//   template <typename Number>
//   static Number p_wave_modulus(const StressState<Number> &,
//                                Number void_ratio, const Parameters &);
//   static void start(const Parameters &, double *variable); // if n_state > 0
//   template <typename Number> // optional: what frames call yield_stress, with
//                              // the first variable of the point; in Pa
//   static Number yield_stress(const StressState<Number> &,
//                              const Number void_ratio, const Number variable,
//                              const Parameters &);
//   template <typename Number>
//   static void update(StressState<Number> &, const StrainIncrement<Number> &,
//                      LawState<Number> &, const Parameters &);
//
// and, below the struct, the number by which the kernels know it:
//
//   template <> struct LawSlot<7> { using type = Law; };
//
// Values stand in the order of the entries and in their units (angles in
// degrees). update() may not branch on single lanes: select(), any().
#ifndef caisson_mpm_kernels_material_law_h
#define caisson_mpm_kernels_material_law_h

#include <caisson_mpm/kernels/material.h>
#include <caisson_mpm/kernels/stress_state.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      /**
       * An entry of the section "Soil/Layer k". Laws that ask for the same
       * name share the entry: it must then be the same in all of them.
       */
      struct LawEntry
      {
        const char *name;
        const char *text; // one sentence, and "Units: ...."
        double      value, smallest, largest;
      };

      /** The position of the entry with this name; -1: there is none. */
      template <int n>
      constexpr int
      entry_named(const LawEntry (&entries)[n], const char *name)
      {
        for (int i = 0; i < n; ++i)
          {
            const char *a = entries[i].name, *b = name;
            while (*a != 0 && *a == *b)
              ++a, ++b;
            if (*a == *b)
              return i;
          }
        return -1;
      }

      /** The values of a law, by the names of its entries. */
      template <typename Law>
      struct LawValues
      {
        const double *values; // in the order of Law::entries

        double
        operator()(const char *name) const
        {
          const int i = entry_named(Law::entries, name);
          if (i < 0)
            __builtin_trap(); // the law has no such entry
          return values[i];
        }
      };

      /** The largest value of an entry that has no upper limit. */
      constexpr double no_limit = __DBL_MAX__;

      constexpr double radians_per_degree = 3.14159265358979323846 / 180.;

      /** What check() of a law may hold its entries against. */
      struct LawContext
      {
        double earth_pressure_at_rest; // horizontal over vertical stress
        double void_ratio;             // at the start
        double mean_stress = 0.;       // the largest at the start, Pa
      };

      /** Room for the answer of check() to what the user gave. */
      struct LawMessage
      {
        char text[512];
      };

      /** Of each MP, besides its stress. */
      template <typename Number>
      struct LawState
      {
        // accumulated sqrt(2/3 e:e) of the deviator, and trace; what a law
        // without plastic strain keeps here is its own choice
        Number plastic_deviatoric, plastic_volumetric;

        // at the start of the step; set where Law::uses_void_ratio
        Number void_ratio;

        // the first Law::n_state are the law's own
        Number variable[n_state_variables];
      };

      /** Scale the plastic strain of a step, that since @p before. */
      template <typename Number>
      [[gnu::always_inline]] inline void
      scale_plastic_strain(const Number            factor,
                           const LawState<Number> &before,
                           LawState<Number>       &state)
      {
        const auto scale = [&](const Number &old, Number &now) {
          now = old + factor * (now - old);
        };
        scale(before.plastic_deviatoric, state.plastic_deviatoric);
        scale(before.plastic_volumetric, state.plastic_volumetric);
      }

      /** Soil is in its loosest state if the ratio of its volume to that of its
       * solids has this share of the largest one: but for round-off. */
      constexpr double at_loosest = 1. - 1e-7;

      /** Entries that several laws share. */
      namespace Entries
      {
        constexpr LawEntry youngs_modulus = {
          "Youngs modulus",
          "Young's modulus is that of the drained soil. Units: Pa.",
          5e6,
          1e-12,
          no_limit};
        constexpr LawEntry poisson_ratio = {
          "Poisson ratio",
          "Poisson's ratio is that of the drained soil. Units: none.",
          0.3,
          0.,
          0.4999};
        constexpr LawEntry friction_angle = {
          "Friction angle",
          "The effective friction angle phi is the peak value where the law "
          "softens. Units: degrees.",
          30.,
          0.,
          60.};
        constexpr LawEntry dilatancy_angle = {
          "Dilatancy angle",
          "The dilatancy angle psi, at most phi, is the peak value where the "
          "law softens. Units: degrees.",
          0.,
          0.,
          60.};
        constexpr LawEntry cohesion = {
          "Cohesion",
          "The effective cohesion c is the peak value where the law softens. "
          "Units: Pa.",
          0.,
          0.,
          no_limit};
        constexpr LawEntry largest_void_ratio = {
          "Largest void ratio",
          "Dilatant soil is nowhere looser than this, unloaded: it shears at "
          "constant volume from then on, and a gap must close before it bears. "
          "Units: none.",
          2.,
          0.,
          no_limit};
        constexpr LawEntry tension_cutoff = {
          "Tension cut-off",
          "No principal stress exceeds this tension. Units: Pa.",
          0.,
          0.,
          no_limit};
        constexpr LawEntry critical_friction_angle = {
          "Critical friction angle",
          "The friction angle phi_c is that of the critical state. Units: "
          "degrees.",
          30.,
          10.,
          60.};
        constexpr LawEntry minimum_void_ratio = {
          "Minimum void ratio",
          "The void ratio e_min of the relative density 1. Units: none.",
          0.,
          0.,
          19.};
        constexpr LawEntry maximum_void_ratio = {
          "Maximum void ratio",
          "The void ratio e_max of the relative density 0. Units: none.",
          0.,
          0.,
          19.};
        constexpr LawEntry yield_stress_ratio = {
          "Yield stress ratio",
          "The size of the yield surface of a point at the start over that of "
          "the one through its stress: 1 in normally consolidated soil. Units: "
          "none.",
          1.,
          1.,
          1e3};
        constexpr LawEntry reference_stress = {
          "Reference stress",
          "Young's modulus is that of this mean effective stress. Units: Pa.",
          1e5,
          1e-3,
          no_limit};
        constexpr LawEntry stiffness_exponent = {
          "Stiffness exponent",
          "Young's modulus grows with this power of the mean effective "
          "stress. Units: none.",
          0.5,
          0.,
          1.};
        constexpr LawEntry smallest_stress_of_stiffness = {
          "Smallest stress of stiffness",
          "Below this mean effective stress Young's modulus falls no further. "
          "Units: Pa.",
          1e3,
          1e-3,
          no_limit};
      } // namespace Entries

      /** The law of this number, Material::law; void: none. */
      template <int slot>
      struct LawSlot
      {
        using type = void;
      };
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
