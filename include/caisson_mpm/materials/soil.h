// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The soil profile: horizontal layers, their materials and the stress in them
// at the start.
#ifndef caisson_mpm_materials_soil_h
#define caisson_mpm_materials_soil_h

#include <caisson_mpm/base/conventions.h>
#include <caisson_mpm/base/expression.h>
#include <caisson_mpm/base/parameter_origins.h>
#include <caisson_mpm/kernels/layout.h>

#include <deal.II/base/parameter_acceptor.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /** What a material law keeps of a point besides its plastic strains. */
  using StateVariables = std::array<double, Kernels::n_state_variables>;

  /**
   * One layer of soil: what the user says of it, and what follows. The section
   * of layer k is "Soil/Layer k". It declares the entries of all material laws
   * (kernels/laws.h) and hands those of the layer's own law on.
   */
  class SoilLayer : public dealii::ParameterAcceptor
  {
  public:
    explicit SoilLayer(const unsigned int index);

    /** Throws BadInput where the entries contradict each other. */
    void
    check_parameters() const;

    /** Name the entries of laws other than the layer's own. */
    void
    name_unused_entries(ParameterOrigins &origins) const;

    /** Mass of solids per volume of soil. Units: kg/m3. */
    double
    dry_density() const;

    /** The ratio of horizontal to vertical effective stress at the start. */
    double
    earth_pressure_at_rest() const;

    /** The void ratio at the start. */
    double
    void_ratio() const
    {
      return porosity / (1. - porosity);
    }

    /** The friction angle of the law (peak, critical) if it has one. Units:
     * degrees. */
    std::optional<double>
    friction_angle() const;

    /** Return the value of an entry if the layer's law has it. */
    std::optional<double>
    law_value(const std::string &entry) const;

    /** What the law is known not to describe; empty if nothing. */
    std::string
    known_limit() const;

    /** Whether the stiffness depends on stress or void ratio. */
    bool
    stiffness_varies() const;

    /** Return the vertical permeability at a void ratio. Units: m/s. */
    double
    permeability_at(const double void_ratio) const;

    /** Write the law and its parameters for the kernels. */
    void
    set_law(Kernels::Material &material) const;

    /** The law's variables of a point at the start. */
    StateVariables
    start_of_state() const;

    double                top_depth          = 0.;
    std::string           law                = "Mohr-Coulomb";
    double                porosity           = 0.4;
    double                internal_length    = 0.;
    double                internal_velocity  = 0.1;
    double                solid_density      = 2500.;
    double                permeability       = 1e-4; // vertical
    double                anisotropy         = 1.;   // horizontal over vertical
    bool                  loosening_conducts = false;
    std::optional<double> k0; // no value: the law's own

    /** The entries of all laws by name, in the units of the entries. */
    std::map<std::string, double> values;

  private:
    void
    declare_internal_length();
    void
    declare_permeability();

    /** "Soil/Layer k". */
    std::string
    section() const;

    /** The values that the layer's law asks for, in its order. */
    std::vector<double>
    law_values() const;
  };

  /** lambda + 2 mu of a material in this state, and the bulk modulus of its
   * water if it is undrained. Units: Pa. */
  double
  p_wave_modulus(const Kernels::Material &material,
                 const Stress            &stress,
                 const double             void_ratio);

  /**
   * The soil profile below z = 0. Owns the layers; layer i is the material i of
   * the kernels. Nothing here is collective.
   */
  class Soil : public dealii::ParameterAcceptor
  {
  public:
    static constexpr unsigned int max_layers = 5;

    Soil();

    /** Throws BadInput where the entries contradict each other. */
    void
    check_parameters() const;

    /** Tell which entries of the section have no effect. */
    void
    name_unused_entries(ParameterOrigins &origins) const;

    unsigned int
    n_layers() const
    {
      return n_layers_;
    }

    const SoilLayer &
    layer(const unsigned int i) const
    {
      return *layers[i];
    }

    /** The layer at depth -z. */
    unsigned int
    layer_at(const double z) const;

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
    inertial_density(const unsigned int layer) const
    {
      return mass_scaling() * mass_density(layer);
    }

    /** The effective unit weight (submerged or dry). Units: N/m3. */
    double
    unit_weight(const unsigned int layer) const;

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

    /** The kernels' materials, one per layer. Their body force is that on a
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
    mass_density(const unsigned int layer) const;

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
  };
} // namespace CaissonMPM

#endif
