// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The soil of one kind: numbers, and what follows from them.
#ifndef caisson_mpm_materials_soil_material_h
#define caisson_mpm_materials_soil_material_h

#include <caisson_mpm/base/conventions.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/materials/umat_settings.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace CaissonMPM
{
  /** What a material law keeps of a point besides its plastic strains. */
  using StateVariables = std::array<double, Kernels::n_state_variables>;

  /**
   * The numbers of a soil, the same in the whole of it, its material law, and
   * what follows from them. A layer of the user is of one such material, or of
   * several where its numbers change with depth.
   */
  struct SoilMaterial
  {
    unsigned int layer     = 0;  // from 0
    double       top_depth = 0.; // below the soil surface, m

    int                 law = 0;    // its number in Kernels::law_table
    std::vector<double> law_values; // in the order of its entries

    // what the law answers, as far as it has them, when set_law_values() has
    // been called: Pa, degrees. The friction angle is the peak or the critical
    // one; the strength, on which adhesion and the design methods for clay are
    // based, is the cohesion or that in direct simple shear
    std::optional<double> youngs_modulus, poisson_ratio, friction_angle,
      shear_strength, densest_void_ratio, loosest_void_ratio;
    double dilatancy_angle = 0., tension_cutoff = 0.;

    double added_weight           = 0.; // that the soil carries, N/m3
    double porosity               = 0.4;
    double solid_density          = 2500.; // kg/m3
    double earth_pressure_at_rest = 0.5;   // horizontal over vertical stress
    double permeability           = 1e-4;  // vertical, m/s
    double anisotropy             = 1.;    // horizontal over vertical
    bool   loosening_conducts     = false;
    std::optional<double> relative_density;    // of the layer, if it is given
    std::optional<double> wall_friction_angle; // degrees; none: the body's
    std::optional<double> wall_adhesion;       // Pa; none: the body's

    Kernels::StressMeasure stress_measure = Kernels::StressMeasure::cauchy;

    // of a user material; of other laws none
    std::shared_ptr<UmatLaw> umat;
    UmatStiffness            umat_stiffness; // at the start
    Kernels::VolumeInShear   volume_in_shear = Kernels::VolumeInShear::by_state;

    /** "Soil/Layer k", with k from 1. */
    std::string
    section() const;

    /** Take the values of the entries of the law, in their order. */
    void
    set_law_values(std::vector<double> values);

    /** Throws BadInput where the numbers contradict each other, or the largest
     * mean stress at the start. Units: Pa. */
    void
    check(const double mean_stress = 0.) const;

    /** Whether the strength at the start holds a stress. A library of the user
     * is not asked. Units: Pa. */
    bool
    bears(const Stress &stress) const;

    /** Mass of solids per volume of soil. Units: kg/m3. */
    double
    dry_density() const
    {
      return (1. - porosity) * solid_density;
    }

    /** The void ratio at the start. */
    double
    void_ratio() const
    {
      return porosity / (1. - porosity);
    }

    /** The relative density at the start: that of the layer or, of hypoplastic
     * sand, that between its densest and its critical void ratio at zero
     * pressure. */
    std::optional<double>
    density_index() const;

    /** The name of the law. */
    std::string
    law_name() const;

    /** Whether the law is elastic up to a yield surface. */
    bool
    is_elastic_until_it_yields() const;

    /**
     * How much faster than the body soil of a constant dilatancy angle moves
     * where it fails beneath it: exp(pi/2 tan psi), the ratio of the speeds at
     * both ends of a fan of logarithmic spirals of 90 degrees; 1 without such
     * an angle.
     */
    double
    speed_of_failure() const;

    /** The entries of the law: names, units and values. */
    std::vector<std::tuple<std::string, std::string, double>>
    law_entries() const;

    /** Return the value of an entry if the law has it. */
    std::optional<double>
    law_value(const std::string &entry) const;

    /** Whether the strength is that of undrained soil by total stress, which
     * depends on no mean stress: water does not flow through it. */
    bool
    has_undrained_strength() const;

    /** Return the tension that the soil bears. Units: Pa. */
    double
    tension() const;

    /** The ratio of horizontal to vertical stress of the law itself. */
    double
    earth_pressure_of_law() const;

    /** What the law is known not to describe; empty if nothing. */
    std::string
    known_limit() const;

    /** Whether the stiffness depends on stress or void ratio. */
    bool
    stiffness_varies() const;

    /** The largest modulus that points may have until the next look, where the
     * largest one now is @p found. Units: Pa. */
    double
    modulus_to_come(const double found) const;

    /** Return the vertical permeability at a void ratio. Units: m/s. */
    double
    permeability_at(const double void_ratio) const;

    /** Write the law and its parameters for the kernels. */
    void
    set_law(Kernels::Material &material) const;

    /** The law's variables of a point at the start. */
    StateVariables
    start_of_state() const;
  };

  /** lambda + 2 mu of a material in this state, and the bulk modulus of its
   * water if it is undrained. Units: Pa. */
  double
  p_wave_modulus(const Kernels::Material &material,
                 const Stress            &stress,
                 const double             void_ratio);

  /** The void ratio of the soil itself, if that of a point may include a gap.
   */
  double
  void_ratio_of_soil(const Kernels::Material &material,
                     const Stress            &stress,
                     const double             void_ratio);
} // namespace CaissonMPM

#endif
