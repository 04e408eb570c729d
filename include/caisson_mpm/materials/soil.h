// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The soil profile: horizontal layers, their materials and the stress in them
// at the start.
#ifndef caisson_mpm_materials_soil_h
#define caisson_mpm_materials_soil_h

#include <caisson_mpm/base/expression.h>
#include <caisson_mpm/base/section.h>
#include <caisson_mpm/kernels/layout.h>
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
  class Soil : public Section
  {
  public:
    /** No soil has more; each needs a row of cells. */
    static constexpr unsigned int max_layers = 1000;

    /** Declares the first layer. */
    Soil();

    /** Declare the layers down to number @p n, counted from 1. */
    void
    declare_layers(const unsigned int n);

    /** Declare the layer "Soil/Layer k" and those above it; return whether the
     * path is that of a layer. */
    bool
    declare_subsection(const std::string &path);

    /** Load the libraries of user materials, whose paths are relative to the
     * files that set them. Throws BadInput. */
    void
    load_libraries(const ParameterOrigins &origins);

    /** A line for each layer with a user material, which differs where the
     * content of its library does. */
    std::string
    checksums_of_libraries() const;

    /** The routines of user materials, with their libraries. */
    std::vector<std::string>
    user_routines() const;

    /** The number of numbers that each point keeps for user materials. */
    unsigned int
    n_user_state() const;

    /** Whether each material has a law of the user. */
    std::vector<bool>
    user_materials() const;

    /** What to add to a message on a run that cannot go on, where laws of the
     * user may be the cause; empty where they are not, or have failed. */
    std::string
    cause_in_user_materials() const;

    /** Tell the user materials of a step. Units: s. */
    void
    begin_step(const double       time,
               const double       step_size,
               const unsigned int step) const;

    /** Throws RunFailure where a user material has failed. */
    void
    check_user_materials() const;

    /** Throws BadInput where the entries contradict each other. */
    void
    check_parameters() const;

    /**
     * Make the materials. A layer whose numbers change with depth becomes
     * several: each consists of whole rows of cells, and has the numbers in its
     * middle. Throws BadInput where the numbers contradict each other.
     *
     * @param row_lines The z of the lines between the rows, from below. Units:
     *                  m.
     */
    void
    divide(const std::vector<double> &row_lines);

    /** Report which entries of the section have no effect. */
    void
    name_unused_entries(ParameterOrigins &origins) const override;

    /** Name the permeabilities of all layers, which have no effect. */
    void
    name_unused_permeability(ParameterOrigins  &origins,
                             const std::string &why) const;

    /** Whether the strength of any material depends on its pressure, or is not
     * known. */
    bool
    has_friction() const;

    /** Whether a layer has a friction angle, before the layers are divided. */
    bool
    has_layer_with_friction() const;

    /** What the soil between z and a height above it can bear: the initial
     * vertical effective stress of the weight at z, over its speed of failure,
     * or, where no soil has friction, half the least strength. Units: m, Pa. */
    double
    stress_borne_above(const double z, const double height) const;

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

    /** Whether a material has a friction angle or adhesion of its own at the
     * walls of the body. */
    bool
    has_walls() const;

    /** Whether all laws are elastic up to a yield surface. */
    bool
    is_elastic_until_it_yields() const;

    /** Return the uppermost material of each layer. */
    std::vector<unsigned int>
    uppermost_materials() const;

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

    /** The effective unit weight (submerged or dry), without a surcharge.
     * Units: N/m3. */
    double
    unit_weight(const SoilMaterial &material) const;

    /** Whether the soil is below water. */
    bool
    is_submerged() const
    {
      return submerged;
    }

    /** The unit weight of the pore water. Units: N/m3. */
    double
    unit_weight_of_water() const;

    /** Effective stress at a place before anything happens. Units: Pa. */
    Stress
    initial_stress(const dealii::Point<2> &place) const;

    /** The velocity before anything happens, of the initial place. Units: m/s.
     * Throws BadInput where its text cannot be parsed. */
    VectorExpression
    initial_velocity() const;

    /** The kernels' materials. Their body force is that on a
     * unit of inertia: mass scaling leaves the weight as it is. Water with this
     * bulk modulus over the porosity resists their change of volume. Units: Pa.
     */
    std::vector<Kernels::Material>
    kernel_materials(const double water_modulus = 0.) const;

    /** Warnings of what the layers' laws are known not to describe, and of mass
     * scaling that is known to change the answer of a body that reaches down to
     * a depth. */
    std::vector<std::string>
    known_limits(double depth) const;

    std::array<double, 2> gravity = {{0., -9.81}};

  private:
    /** The largest mass scaling that has been seen to change forces by little,
     * where a body reaches down to a depth: see doc/limitations.md. */
    double
    usual_mass_scaling(double depth) const;

    /** The entry is in section Time, because it lengthens the time step. */
    struct MassScaling : Section
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
      uniform,
      expression
    };

    void
    declare_initial_stress();

    /** Make the materials of a layer. @p lines are the depths at which they may
     * end, of which the last is the bottom of the layer; @p stress is the
     * vertical one at its top, and then at its bottom. Units: m, Pa. */
    void
    divide(const SoilLayer           &layer,
           const std::vector<double> &lines,
           double                    &stress);

    /** Make the material between two depths. */
    void
    add_material(const SoilLayer &layer,
                 const double     top,
                 const double     bottom,
                 double          &stress);

    /** The vertical stress of the weight below a part of a layer, with @p
     * stress above it. Positive in compression, Pa. */
    double
    stress_below(const SoilLayer &layer,
                 const double     top,
                 const double     bottom,
                 const double     stress) const;

    /** The stress at the start at a depth, where this is the vertical one of
     * the weight. Units: m, Pa. */
    Stress
    stress_at_rest(const SoilMaterial &material,
                   const double        depth,
                   const double        vertical_stress) const;

    /** Throw BadInput where the strength of the layer at one of these depths
     * (m) does not hold the stress at the start; the text has the K0 that it
     * holds where there is least room. */
    void
    check_at_rest(const SoilLayer           &layer,
                  const std::vector<double> &depths) const;

    /** Parse Stress expression. */
    void
    parse_stress();

    Stress
    stress_by_expression(const dealii::Point<2> &place) const;

    /** Horizontal over vertical stress at a depth, if the stress is given and
     * the vertical one is compressive. */
    std::optional<double>
    given_stress_ratio(const double depth) const;

    /** The vertical stress at a depth if it is given, and else that of the
     * weight. Positive in compression, Pa. */
    double
    vertical_stress(const double depth, const double of_weight) const;

    MassScaling                             scaling;
    unsigned int                            n_layers_       = 1;
    bool                                    submerged       = true;
    double                                  fluid_density   = 1000.;
    InitialStress                           stress_state    = InitialStress::k0;
    std::string                             uniform_text    = "0, 0, 0, 0";
    std::string                             velocity_text   = "0 ; 0";
    std::string                             gravity_text    = "0, -9.81";
    std::string                             expression_text = "0 ; 0 ; 0 ; 0";
    Stress                                  uniform_stress = {{0., 0., 0., 0.}};
    std::array<Expression, 4>               stress_expression;
    double                                  surcharge = 0.; // Pa
    std::vector<std::unique_ptr<SoilLayer>> layers;
    std::vector<SoilMaterial>               materials; // from above
  };
} // namespace CaissonMPM

#endif
