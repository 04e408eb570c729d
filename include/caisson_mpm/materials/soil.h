// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The soil profile: horizontal layers, their materials and the stress in them
// at the start.
#ifndef caisson_mpm_materials_soil_h
#define caisson_mpm_materials_soil_h

#include <caisson_mpm/base/expression.h>
#include <caisson_mpm/materials/soil_layer.h>

#include <memory>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * The soil profile below z = 0. Owns the layers, and the materials of which
   * they are: material i is that of the number i in the points and kernels.
   * Nothing here is collective.
   */
  class Soil : public dealii::ParameterAcceptor
  {
  public:
    static constexpr unsigned int max_layers = 5;

    Soil();

    /** Make the materials. Throws BadInput where the entries contradict each
     * other. */
    void
    check_parameters();

    /** Tell which entries of the section have no effect. */
    void
    name_unused_entries(ParameterOrigins &origins) const;

    unsigned int
    n_layers() const
    {
      return n_layers_;
    }

    unsigned int
    n_materials() const
    {
      return materials.size();
    }

    const SoilMaterial &
    material(const unsigned int i) const
    {
      return materials[i];
    }

    /** The number of the material at depth -z. */
    unsigned int
    material_at(const double z) const;

    /** The z of the boundaries between layers, from above. Units: m. */
    std::vector<double>
    interfaces() const;

    /** The factor on all inertia of the soil; see base/conventions.h. */
    double
    mass_scaling() const
    {
      return scaling.factor;
    }

    /** The inertia per volume, mass scaling included. Units: kg/m3. */
    double
    inertial_density(const unsigned int material) const
    {
      return mass_scaling() * mass_density(material);
    }

    /** The effective unit weight (submerged or dry). Units: N/m3. */
    double
    unit_weight(const unsigned int material) const;

    /** Whether the soil is below water. */
    bool
    is_submerged() const
    {
      return submerged;
    }

    /** The unit weight of the pore water. Units: N/m3. */
    double
    unit_weight_of_water() const;

    /** Effective stress at height z before anything happens. Units: Pa. */
    Stress
    initial_stress(const double z) const;

    /** The velocity before anything happens, of the initial place. Units: m/s.
     * Throws BadInput where its text cannot be parsed. */
    VectorExpression
    initial_velocity() const;

    /** The kernels' materials. Their body force is that on a
     * unit of inertia: mass scaling leaves the weight as it is. */
    std::vector<Kernels::Material>
    kernel_materials() const;

    /** Warnings of what the layers' laws are known not to describe, and of mass
     * scaling that is known to change the answer. */
    std::vector<std::string>
    known_limits() const;

    std::array<double, 2> gravity = {{0., -9.81}};

  private:
    /** The entry is in section Time, because it lengthens the time step. */
    struct MassScaling : dealii::ParameterAcceptor
    {
      MassScaling();

      double factor = 1.;
    };

    /** The mass of grains and water per volume. Units: kg/m3. */
    double
    mass_density(const unsigned int material) const;

    /** The effective stress in the soil at the start. */
    enum class InitialStress
    {
      k0,
      none,
      uniform
    };

    MassScaling                             scaling;
    unsigned int                            n_layers_      = 1;
    bool                                    submerged      = true;
    double                                  fluid_density  = 1000.;
    InitialStress                           stress_state   = InitialStress::k0;
    std::string                             uniform_text   = "0, 0, 0, 0";
    std::string                             velocity_text  = "0 ; 0";
    std::string                             gravity_text   = "0, -9.81";
    Stress                                  uniform_stress = {{0., 0., 0., 0.}};
    std::vector<std::unique_ptr<SoilLayer>> layers;
    std::vector<SoilMaterial>               materials; // from above
  };
} // namespace CaissonMPM

#endif
