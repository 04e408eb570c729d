// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the user says of a horizontal layer of soil.
#ifndef caisson_mpm_materials_soil_layer_h
#define caisson_mpm_materials_soil_layer_h

#include <caisson_mpm/base/parameter_origins.h>
#include <caisson_mpm/base/section.h>
#include <caisson_mpm/materials/profile.h>
#include <caisson_mpm/materials/soil_material.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * The entries of one layer. The section of layer k is "Soil/Layer k". It
   * declares the entries of all material laws (kernels/laws.h) and hands those
   * of the layer's own law on.
   */
  class SoilLayer : public Section
  {
  public:
    /** @p index counts from 0. */
    explicit SoilLayer(const unsigned int index);

    /** Load the library of a user material, whose path is relative to the file
     * that sets it. Throws BadInput. */
    void
    load_library(const ParameterOrigins &origins);

    /** The law of a user material, or null. */
    UmatLaw *
    umat() const
    {
      return soil.umat.get();
    }

    /** Name the entries of laws other than the layer's own. */
    void
    name_unused_entries(ParameterOrigins &origins) const override;

    /** "Soil/Layer k", with k from 1. */
    std::string
    section() const;

    /** Units: m. */
    double
    top_depth() const
    {
      return soil.top_depth;
    }

    /** Whether one of its numbers changes with depth. */
    bool
    varies() const;

    /** Return the largest relative change of a number from one depth to
     * another, with the vertical effective stresses there. Units: m, Pa. */
    double
    change(const double top,
           const double stress_at_top,
           const double bottom,
           const double stress_at_bottom) const;

    /** Throws BadInput where the entries contradict each other at any depth. */
    void
    check_parameters() const;

    /**
     * Return the soil of the layer at a place. Throws BadInput where the
     * numbers contradict each other, or their entries.
     *
     * @param depth           Below the soil surface, m.
     * @param vertical_stress The effective one at the start there, positive in
     *                        compression, Pa.
     * @param given_ratio     Horizontal over vertical stress at the start, where
     *                        the stress is given; without it K0.
     */
    SoilMaterial
    material_at(const double                depth,
                const double                vertical_stress,
                const std::optional<double> given_ratio = {}) const;

    /** Porosity and density of solids alone, which make the stress. */
    SoilMaterial
    weight_at(const double depth) const;

    /** Whether the law has a friction angle that is not 0 everywhere. */
    bool
    has_friction() const;

  private:
    void
    declare_density();
    void
    declare_earth_pressure();
    void
    declare_permeability();
    void
    declare_user_material();
    void
    declare_walls();

    /** The profiles in use. */
    std::vector<const Profile *>
    profiles() const;

    /** The profile that says how dense the soil is. */
    const Profile &
    density_of_state() const;

    double
    porosity_at(const PlaceInGround &place) const;

    void
    set_walls(SoilMaterial &result, const PlaceInGround &place) const;

    /** Set what depends on the mean stress; K0 not yet. */
    void
    set_values(SoilMaterial &result, const PlaceInGround &place) const;

    double
    earth_pressure_at(const SoilMaterial  &material,
                      const PlaceInGround &place) const;

    SoilMaterial soil; // the numbers that cannot change
    UmatSettings umat_settings;
    std::string  properties_text; // empty: not given
    std::string  law = "Mohr-Coulomb";
    Profile      porosity, solid_density, permeability, overconsolidation;
    std::unique_ptr<Profile> k0;                  // none: the law's own
    std::unique_ptr<Profile> relative_density;    // none: the porosity counts
    std::unique_ptr<Profile> void_ratio;          // none: the same
    std::unique_ptr<Profile> dry_density;         // none: the solid one counts
    std::unique_ptr<Profile> wall_friction_angle; // none: that of the body
    std::unique_ptr<Profile> adhesion_factor;     // none: the body's adhesion
    Profile                  sensitivity;

    /** The entries of all laws by name, in the units of the entries. */
    std::map<std::string, Profile> values;

    /** The paths of the entries of a user material. */
    std::vector<std::string> user_entries;
  };
} // namespace CaissonMPM

#endif
