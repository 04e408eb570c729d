// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a material law consists of, apart from its equations. A law is one
// header with one struct, here called Law, and is registered by two lines in
// laws.h. It derives from MaterialLaw, which has a default of all but
//
//   static constexpr const char *name;   // the value of the entry "Law"
//   struct Parameters;                   // plain data: the values of the
//                                        // entries, and what follows from them
//     void derive();                     // sets what follows from the entries
//   static constexpr Entry<Parameters> entries[]; // what it asks of the user
//   template <typename Number>
//   static Number p_wave_modulus(const StressState<Number> &,
//                                Number void_ratio, const Parameters &);
//   template <typename Number>
//   static void update(StressState<Number> &, const StrainIncrement<Number> &,
//                      LawState<Number> &, const Parameters &);
//
// update() may not branch on single lanes: select(), any().
#ifndef caisson_mpm_kernels_material_law_h
#define caisson_mpm_kernels_material_law_h

#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/kernels/stress_state.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /**
     * An entry of the section "Soil/Layer k". Laws that ask for the same
     * name share the entry: it must then be the same in all of them.
     */
    struct Entry
    {
      const char *name, *unit; // "": none
      const char *text;        // full sentences
      double      value, smallest, largest;
    };

    /** An entry, and where the parameters of a law keep its value, in the
     * unit of the entry (angles in degrees). */
    template <typename Parameters>
    struct LawEntry
    {
      double Parameters::*value;
      Entry               entry;
    };

    template <typename Law>
    constexpr int n_entries = sizeof(Law::entries) / sizeof(Law::entries[0]);

    /** The parameters of a law for values in the order of its entries. */
    template <typename Law>
    inline typename Law::Parameters
    read_parameters(const double *values)
    {
      typename Law::Parameters parameters;
      for (int i = 0; i < n_entries<Law>; ++i)
        parameters.*Law::entries[i].value = values[i];
      parameters.derive();
      return parameters;
    }

    /** The largest value of an entry that has no upper limit. */
    constexpr double no_limit = __DBL_MAX__;

    constexpr double radians_per_degree = 3.14159265358979323846 / 180.;

    constexpr double no_number = __builtin_nan("");

    /**
     * What reports, reviews and walls ask of a law: its parameters begin with
     * these, and entries or derive() set what the law has. The friction angle
     * is the peak or the critical one, the strength that at no pressure, and
     * the void ratios are those of the densest and the loosest packing.
     */
    struct LawNumbers
    {
      double youngs_modulus = no_number, poisson_ratio = no_number;
      double friction_angle = no_number, dilatancy_angle = 0.; // degrees
      double shear_strength = no_number, tension_cutoff = 0.;  // Pa
      double densest = no_number, loosest = no_number;
    };

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

      /** Write the text as printf() does; returns false. */
      [[gnu::format(printf, 2, 3)]] bool
      refuse(const char *format, ...)
      {
        __builtin_va_list arguments;
        __builtin_va_start(arguments, format);
        __builtin_vsnprintf(text, sizeof(text), format, arguments);
        __builtin_va_end(arguments);
        return false;
      }
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
      constexpr Entry youngs_modulus = {
        "Youngs modulus",
        "Pa",
        "Young's modulus is that of the drained soil.",
        5e6,
        1e-12,
        no_limit};
      constexpr Entry poisson_ratio = {
        "Poisson ratio",
        "",
        "Poisson's ratio is that of the drained soil.",
        0.3,
        0.,
        0.4999};
      constexpr Entry friction_angle  = {"Friction angle",
                                         "degrees",
                                         "The effective friction angle phi.",
                                         30.,
                                         0.,
                                         60.};
      constexpr Entry dilatancy_angle = {
        "Dilatancy angle",
        "degrees",
        "The dilatancy angle psi, at most phi.",
        0.,
        0.,
        60.};
      constexpr Entry cohesion =
        {"Cohesion", "Pa", "The effective cohesion c.", 0., 0., no_limit};
      constexpr Entry largest_void_ratio = {
        "Largest void ratio",
        "",
        "Dilatant soil is nowhere looser than this, unloaded: it shears at "
        "constant volume from then on, and a gap must close before it bears.",
        2.,
        0.,
        no_limit};
      constexpr Entry tension_cutoff = {
        "Tension cut-off",
        "Pa",
        "No principal stress exceeds this tension. With 0 the soil bears "
        "none, and clay stays at a wall; clay that bears tension may come "
        "off it.",
        0.,
        0.,
        no_limit};
      constexpr Entry critical_friction_angle = {
        "Critical friction angle",
        "degrees",
        "The friction angle phi_c is that of the critical state.",
        30.,
        10.,
        60.};
      constexpr Entry minimum_void_ratio = {
        "Minimum void ratio",
        "",
        "The void ratio e_min of the relative density 1.",
        0.,
        0.,
        19.};
      constexpr Entry maximum_void_ratio = {
        "Maximum void ratio",
        "",
        "The void ratio e_max of the relative density 0.",
        0.,
        0.,
        19.};
      constexpr Entry reference_stress = {
        "Reference stress",
        "Pa",
        "Young's modulus is that of this mean effective stress.",
        1e5,
        1e-3,
        no_limit};
      constexpr Entry stiffness_exponent = {
        "Stiffness exponent",
        "",
        "Young's modulus grows with this power of the mean effective stress.",
        0.5,
        0.,
        1.};
      constexpr Entry smallest_stress_of_stiffness = {
        "Smallest stress of stiffness",
        "Pa",
        "Below this mean effective stress Young's modulus falls no further.",
        1e3,
        1e-3,
        no_limit};
    } // namespace Entries

    /** What a law has that says nothing else. */
    struct MaterialLaw
    {
      static constexpr bool uses_void_ratio  = false;
      static constexpr bool stiffness_varies = false; // with stress, density
      static constexpr bool is_packed = false; // takes long: packed_points.h

      /** Has no update(), but is called point by point: user_points.h. */
      static constexpr bool is_external = false;

      /** How many of LawState::variable are in use, and whether the first
       * four turn with the soil. */
      static constexpr int  n_state           = 0;
      static constexpr bool state_is_a_tensor = false;

      /** Has, with the types of p_wave_modulus(),
       *   Number loosest_void_ratio(stress, parameters);
       *   Mask is_loosest(stress, volume, volume_of_solids, parameters);
       * the second without a division, for each step: loosest_state.h. */
      static constexpr bool has_loosest_state = false;

      /** Has bool bears(stress, void_ratio, parameters), with the types of
       * p_wave_modulus(): whether its strength holds a stress at rest. A law
       * without it bears what an update without strain leaves as it is. */
      static constexpr bool knows_what_it_bears = false;

      /** Whether the parameters fit together and to the soil. */
      template <typename Parameters>
      static bool
      check(const Parameters &, const LawContext &, LawMessage &)
      {
        return true;
      }

      /** What the law is known not to describe, or null. */
      template <typename Parameters>
      static const char *
      warning(const Parameters &)
      {
        return nullptr;
      }

      template <typename Parameters>
      static VolumeInShear
      volume_in_shear(const Parameters &)
      {
        return VolumeInShear::by_state;
      }

      /** Whether a law with uses_void_ratio reads it with these parameters.
       */
      template <typename Parameters>
      static bool
      needs_void_ratio(const Parameters &)
      {
        return true;
      }

      /** K0: 1 - sin(phi) (Jaky 1948). */
      template <typename Parameters>
      static double
      earth_pressure_at_rest(const Parameters &p)
      {
        return 1. - __builtin_sin(p.friction_angle * radians_per_degree);
      }

      /** Set the variables of a point at the start, which are 0. */
      template <typename Parameters>
      static void
      start(const Parameters &, double * /*variable*/)
      {}
    };

    /** The elasticity of the law of Hooke: Lame's constants, the bulk modulus
     * (Pa), and nu / (1 - nu), the earth pressure at rest. */
    struct Elasticity : LawNumbers
    {
      double lambda, mu, bulk, oedometric;

      void
      derive()
      {
        const double E = youngs_modulus, nu = poisson_ratio;
        lambda     = E * nu / ((1. + nu) * (1. - 2. * nu));
        mu         = 0.5 * E / (1. + nu);
        bulk       = E / (3. * (1. - 2. * nu));
        oedometric = nu / (1. - nu);
      }

      double
      p_wave_modulus() const
      {
        return lambda + 2. * mu;
      }
    };

    /** A law whose parameters are an Elasticity, and whose stiffness is. */
    struct ElasticLaw : MaterialLaw
    {
      template <typename Number>
      [[gnu::always_inline]] static inline Number
      p_wave_modulus(const StressState<Number> & /*stress*/,
                     const Number /*void_ratio*/,
                     const Elasticity &p)
      {
        return p.p_wave_modulus();
      }
    };
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
