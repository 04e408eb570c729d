// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/kernels/laws.h>
#include <caisson_mpm/materials/soil.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    using Kernels::LawDescription;
    using Kernels::LawEntry;

    /** Call action(law) for all laws. */
    template <typename Action>
    void
    for_each_law(const Action &action)
    {
      for (const LawDescription &law : Kernels::law_table.law)
        if (law.name != nullptr)
          action(law);
    }

    std::string
    names_of_laws()
    {
      std::string names;
      for_each_law([&](const LawDescription &law) {
        names += (names.empty() ? "" : "|") + std::string(law.name);
      });
      return names;
    }

    const LawDescription &
    law_named(const std::string &name)
    {
      const LawDescription *result = nullptr;
      for_each_law([&](const LawDescription &law) {
        if (name == law.name)
          result = &law;
      });
      AssertThrow(result != nullptr, ExcInternalError());
      return *result;
    }
  } // namespace

  SoilLayer::SoilLayer(const unsigned int index)
    : ParameterAcceptor("/Soil/Layer " + to_text(index))
  {
    add_parameter("Top depth",
                  top_depth,
                  "The depth of the layer's upper boundary below the soil "
                  "surface must be 0 for layer 1. Units: m.",
                  prm,
                  Patterns::Double(0.));
    add_parameter("Law",
                  law,
                  "The constitutive law gives the stress in the layer. Units: "
                  "none.",
                  prm,
                  Patterns::Selection(names_of_laws()));
    for_each_law([this](const LawDescription &law) {
      for (int i = 0; i < law.n_entries; ++i)
        {
          const LawEntry &e = law.entries[i];
          if (values.count(e.name) > 0)
            continue;
          double &value = values[e.name] = e.value;
          add_parameter(e.name,
                        value,
                        e.text,
                        prm,
                        Patterns::Double(e.smallest, e.largest));
        }
    });
    add_parameter("Porosity",
                  porosity,
                  "The porosity is the share of the pores in the volume of the "
                  "soil at the start. Units: none.",
                  prm,
                  Patterns::Double(0., 0.95));
    add_parameter("Solid density",
                  solid_density,
                  "The solid density is that of the grains, without pores. "
                  "Units: kg/m3.",
                  prm,
                  Patterns::Double(1e-12));
    add_word_or_number(*this,
                       "K0",
                       k0,
                       "auto",
                       -1.,
                       "K0 is the ratio of the horizontal to the vertical "
                       "effective stress at the start; auto takes the value of "
                       "the layer's law, 1 - sin(phi) or, without a friction "
                       "angle, nu / (1 - nu). Units: none.",
                       Patterns::Double(0., 10.));
    declare_permeability();
    declare_internal_length();
  }

  void
  SoilLayer::declare_permeability()
  {
    add_parameter("Permeability",
                  permeability,
                  "The permeability to water in the vertical, where water "
                  "flows (Water/Level). Units: m/s.",
                  prm,
                  Patterns::Double(1e-20));
    add_parameter("Permeability ratio",
                  anisotropy,
                  "The horizontal permeability over the vertical one. Units: "
                  "none.",
                  prm,
                  Patterns::Double(1e-6, 1e6));
    add_parameter("Permeability by void ratio",
                  loosening_conducts,
                  "The permeability follows the void ratio e as e3/(1 + e) "
                  "(Kozeny-Carman); Permeability is that of the porosity at "
                  "the start. Units: none.");
  }

  void
  SoilLayer::declare_internal_length()
  {
    add_parameter(
      "Internal length",
      internal_length,
      "The strength of soil that shears grows by the share l g / v, "
      "where l is this length, g the rate of shear and v the "
      "internal velocity, so that a shear band is some of these "
      "lengths wide; 0 leaves its width to the mesh. Units: m.",
      prm,
      Patterns::Double(0.));
    add_parameter("Internal velocity",
                  internal_velocity,
                  "The internal length is that of shear bands whose sides pass "
                  "each other at this velocity, which should be that of the "
                  "body. Units: m/s.",
                  prm,
                  Patterns::Double(1e-12));
  }

  void
  SoilLayer::check_parameters() const
  {
    Kernels::LawMessage message;
    if (!law_named(law).check(law_values().data(),
                              {earth_pressure_at_rest(), void_ratio()},
                              message))
      throw BadInput(section() + "/" + message.text);
    if (internal_length > 0. && !law_named(law).has_yield_surface)
      throw BadInput(
        section() + "/Internal length = " + to_text(internal_length) +
        " m: the law " + law + " has none. Set the length to 0, or " +
        section() + "/Law to Mohr-Coulomb or Mohr-Coulomb with softening.");
  }

  void
  SoilLayer::name_unused_entries(ParameterOrigins &origins) const
  {
    const LawDescription    &description = law_named(law);
    std::vector<std::string> unused;
    for (const auto &entry : values)
      {
        bool is_used = false;
        for (int i = 0; i < description.n_entries; ++i)
          is_used = is_used || entry.first == description.entries[i].name;
        if (!is_used)
          unused.push_back(section() + "/" + entry.first);
      }
    origins.add_unused(unused, section() + "/Law is " + law);
    if (internal_length == 0.)
      origins.add_unused({section() + "/Internal velocity"},
                         section() + "/Internal length is 0");
  }

  std::string
  SoilLayer::section() const
  {
    return get_section_name().substr(1);
  }

  std::vector<double>
  SoilLayer::law_values() const
  {
    const LawDescription &description = law_named(law);
    std::vector<double>   result;
    for (int i = 0; i < description.n_entries; ++i)
      result.push_back(values.at(description.entries[i].name));
    return result;
  }

  double
  SoilLayer::dry_density() const
  {
    return (1. - porosity) * solid_density;
  }

  double
  SoilLayer::earth_pressure_at_rest() const
  {
    if (k0)
      return *k0;
    Kernels::Material material;
    set_law(material);
    return law_named(law).earth_pressure_at_rest(material);
  }

  std::optional<double>
  SoilLayer::friction_angle() const
  {
    const int entry = law_named(law).friction_entry;
    if (entry < 0)
      return {};
    return law_values()[entry];
  }

  std::string
  SoilLayer::known_limit() const
  {
    // what is said of softening, the length takes care of
    if (internal_length > 0. && law_named(law).has_yield_surface &&
        law_value("Softening shape factor"))
      return "";
    const char *const limit = law_named(law).warning(law_values().data());
    return limit == nullptr ? "" : section() + ": " + limit;
  }

  std::optional<double>
  SoilLayer::law_value(const std::string &entry) const
  {
    const LawDescription &description = law_named(law);
    for (int i = 0; i < description.n_entries; ++i)
      if (entry == description.entries[i].name)
        return values.at(entry);
    return {};
  }

  bool
  SoilLayer::stiffness_varies() const
  {
    return law_named(law).stiffness_varies;
  }

  double
  SoilLayer::permeability_at(const double e) const
  {
    if (!loosening_conducts)
      return permeability;
    const auto carman = [](const double e) { return e * e * e / (1. + e); };
    // points that are pressed together may have lost all pores
    return permeability * carman(std::max(e, .1 * void_ratio())) /
           carman(void_ratio());
  }

  void
  SoilLayer::set_law(Kernels::Material &material) const
  {
    law_named(law).set(material, law_values().data());
    material.initial_void_ratio = void_ratio();
    material.overstress_time    = internal_length / internal_velocity;
  }

  StateVariables
  SoilLayer::start_of_state() const
  {
    Kernels::Material material;
    set_law(material);
    StateVariables result;
    law_named(law).start(material, result.data());
    return result;
  }

  double
  p_wave_modulus(const Kernels::Material &material,
                 const Stress            &stress,
                 const double             void_ratio)
  {
    return material.water_modulus +
           Kernels::law_table.law[material.law].p_wave_modulus(material,
                                                               stress.data(),
                                                               void_ratio);
  }

  Soil::MassScaling::MassScaling()
    : ParameterAcceptor("/Time")
  {
    add_parameter("Mass scaling",
                  factor,
                  "The inertia of the soil, but not its weight, is multiplied "
                  "by this factor; the time step grows with its square root. "
                  "Units: none.",
                  prm,
                  Patterns::Double(1., 1e6));
  }

  Soil::Soil()
    : ParameterAcceptor("/Soil")
  {
    add_parameter("Number of layers",
                  n_layers_,
                  "The soil consists of this number of layers; layer k is "
                  "described in section Layer k. Units: none.",
                  prm,
                  Patterns::Integer(1, max_layers));
    add_parameter("Submerged",
                  submerged,
                  "Submerged soil is saturated and below water: its weight is "
                  "the buoyant one, and its mass contains the water. Units: "
                  "none.");
    add_parameter("Fluid density",
                  fluid_density,
                  "The fluid density is that of the pore water. Units: kg/m3.",
                  prm,
                  Patterns::Double(0.));
    add_parameter("Gravity",
                  gravity_text,
                  "The acceleration of gravity has these r and z components. "
                  "Units: m/s2.",
                  prm,
                  Patterns::List(Patterns::Double(), 2, 2));
    add_choice(*this,
               "Initial stress",
               stress_state,
               {{"K0", InitialStress::k0},
                {"none", InitialStress::none},
                {"uniform", InitialStress::uniform}},
               "The stress in the soil at the start: K0 is the geostatic "
               "effective stress under the soil's own weight, none is no "
               "stress, and uniform takes the entry Uniform stress. Units: "
               "none.");
    add_parameter("Uniform stress",
                  uniform_text,
                  "With Initial stress = uniform, the effective stress is this "
                  "one everywhere at the start: rr, zz, tt (hoop) and rz, "
                  "positive in tension. Units: Pa.",
                  prm,
                  Patterns::List(Patterns::Double(), 4, 4));
    add_parameter("Initial velocity",
                  velocity_text,
                  "The velocity at the start is given by two expressions in r, "
                  "z and pi, for its r and z components, with a semicolon "
                  "between them. Units: m/s.");
    parse_parameters_call_back.connect([this]() {
      const auto components = Utilities::split_string_list(gravity_text);
      gravity               = {{Utilities::string_to_double(components[0]),
                                Utilities::string_to_double(components[1])}};
      const auto stresses   = Utilities::split_string_list(uniform_text);
      for (unsigned int c = 0; c < 4; ++c)
        uniform_stress[c] = Utilities::string_to_double(stresses[c]);
    });
    for (unsigned int i = 0; i < max_layers; ++i)
      layers.push_back(std::make_unique<SoilLayer>(i + 1));
  }

  void
  Soil::check_parameters() const
  {
    for (unsigned int i = 0; i < n_layers_; ++i)
      {
        layers[i]->check_parameters();
        if (i == 0 ? layers[0]->top_depth != 0. :
                     layers[i]->top_depth <= layers[i - 1]->top_depth)
          throw BadInput(
            "Soil/Layer " + to_text(i + 1) +
            "/Top depth = " + to_text(layers[i]->top_depth) +
            " m: layers must be listed from the surface (Top "
            "depth = 0) downward, each deeper than the one above.");
        if (submerged && layers[i]->solid_density <= fluid_density)
          throw BadInput("Soil/Layer " + to_text(i + 1) + "/Solid density = " +
                         to_text(layers[i]->solid_density) +
                         " kg/m3 does not exceed Soil/Fluid density = " +
                         to_text(fluid_density) +
                         " kg/m3: the soil would float. Correct one of them, "
                         "or set Soil/Submerged = false.");
      }
    if (stress_state == InitialStress::k0 && gravity[radial] != 0.)
      throw BadInput(
        "Soil/Gravity has a horizontal component, and Soil/Initial "
        "stress = K0 needs it vertical. Set Initial stress = none.");
    if (stress_state == InitialStress::k0 && gravity[vertical] > 0.)
      throw BadInput("Soil/Gravity = " + gravity_text +
                     " points upward (z grows upward), and with Soil/Initial "
                     "stress = K0 the soil would be in tension. Write 0, "
                     "-9.81.");
    initial_velocity();
  }

  void
  Soil::name_unused_entries(ParameterOrigins &origins) const
  {
    const std::string stress =
      std::string("Soil/Initial stress is ") +
      (stress_state == InitialStress::none ? "none" : "uniform");
    for (unsigned int i = 0; i < max_layers; ++i)
      {
        const std::string section = "Soil/Layer " + to_text(i + 1);
        if (i >= n_layers_)
          origins.add_unused({section},
                             "Soil/Number of layers is " + to_text(n_layers_));
        else
          layers[i]->name_unused_entries(origins);
        if (i < n_layers_ && stress_state != InitialStress::k0)
          origins.add_unused({section + "/K0"}, stress);
      }
    if (stress_state != InitialStress::uniform)
      origins.add_unused({"Soil/Uniform stress"},
                         "Soil/Initial stress is not uniform");
    if (!submerged)
      origins.add_unused({"Soil/Fluid density"}, "Soil/Submerged is false");
  }

  unsigned int
  Soil::layer_at(const double z) const
  {
    unsigned int i = n_layers_ - 1;
    while (i > 0 && -z < layers[i]->top_depth)
      --i;
    return i;
  }

  std::vector<double>
  Soil::interfaces() const
  {
    std::vector<double> result;
    for (unsigned int i = 1; i < n_layers_; ++i)
      result.push_back(-layers[i]->top_depth);
    return result;
  }

  double
  Soil::mass_density(const unsigned int i) const
  {
    return layers[i]->dry_density() +
           (submerged ? layers[i]->porosity * fluid_density : 0.);
  }

  double
  Soil::unit_weight(const unsigned int i) const
  {
    const SoilLayer &l = *layers[i];
    return -gravity[vertical] * (1. - l.porosity) *
           (l.solid_density - (submerged ? fluid_density : 0.));
  }

  double
  Soil::unit_weight_of_water() const
  {
    return -fluid_density * gravity[vertical];
  }

  Stress
  Soil::initial_stress(const double z) const
  {
    if (stress_state == InitialStress::uniform)
      return uniform_stress;
    if (stress_state == InitialStress::none || z >= 0.)
      return {{0., 0., 0., 0.}};
    double sigma_zz = 0.;
    for (unsigned int i = 0; i < n_layers_ && -z > layers[i]->top_depth; ++i)
      {
        const double bottom =
          i + 1 < n_layers_ ? std::min(-z, layers[i + 1]->top_depth) : -z;
        sigma_zz -= unit_weight(i) * (bottom - layers[i]->top_depth);
      }
    const double sigma_rr =
      layers[layer_at(z)]->earth_pressure_at_rest() * sigma_zz;
    return {{sigma_rr, sigma_zz, sigma_rr, 0.}};
  }

  VectorExpression
  Soil::initial_velocity() const
  {
    return parse_vector(velocity_text, "Soil/Initial velocity");
  }

  std::vector<std::string>
  Soil::known_limits() const
  {
    std::vector<std::string> limits;
    for (unsigned int i = 0; i < n_layers(); ++i)
      if (const std::string limit = layers[i]->known_limit(); !limit.empty())
        limits.push_back(limit);
    if (mass_scaling() > 100.)
      limits.push_back(
        "Time/Mass scaling above 100 has been seen to change the tip force "
        "by more than 5 %");
    return limits;
  }

  std::vector<Kernels::Material>
  Soil::kernel_materials() const
  {
    std::vector<Kernels::Material> result(n_layers_);
    for (unsigned int i = 0; i < n_layers_; ++i)
      {
        layers[i]->set_law(result[i]);
        result[i].p_wave_modulus =
          p_wave_modulus(result[i], Stress(), layers[i]->void_ratio());
        result[i].initial_density = inertial_density(i);
        // weight and mass ratio: buoyancy and mass scaling leave the force
        const double buoyancy =
          (1. - layers[i]->porosity) *
          (layers[i]->solid_density - (submerged ? fluid_density : 0.)) /
          mass_density(i);
        for (unsigned int d = 0; d < 2; ++d)
          result[i].body_force[d] = gravity[d] * buoyancy / mass_scaling();
      }
    return result;
  }
} // namespace CaissonMPM
