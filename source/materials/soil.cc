// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
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
    : ParameterAcceptor("/Soil/Layer " + std::to_string(index))
  {
    add_parameter("Top depth",
                  top_depth,
                  "Depth of the layer's upper boundary below the soil surface; "
                  "0 for layer 1. Units: m.",
                  prm,
                  Patterns::Double(0.));
    add_parameter("Law",
                  law,
                  "The constitutive law. Units: none.",
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
                  "Initial porosity n. Units: none.",
                  prm,
                  Patterns::Double(0., 0.95));
    add_parameter("Solid density",
                  solid_density,
                  "Density of the grains. Units: kg/m3.",
                  prm,
                  Patterns::Double(1e-12));
    add_parameter("K0",
                  k0,
                  "Horizontal over vertical effective stress at the start; -1 "
                  "for 1 - sin(phi) or, without a friction angle, nu / (1 - "
                  "nu). Units: none.",
                  prm,
                  Patterns::Double(-1., 10.));
  }

  void
  SoilLayer::check_parameters() const
  {
    const std::string where = get_section_name().substr(1) + "/";
    if (k0 < 0. && k0 != -1.)
      throw BadInput(where + "K0 = " + std::to_string(k0) +
                     " is negative. Set a value of 0 or more, or -1 for the "
                     "law's own value.");
    Kernels::LawMessage message;
    if (!law_named(law).check(law_values().data(),
                              {earth_pressure_at_rest(), void_ratio()},
                              message))
      throw BadInput(where + message.text);
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
    if (k0 >= 0.)
      return k0;
    Kernels::Material material;
    set_law(material);
    return law_named(law).earth_pressure_at_rest(material);
  }

  double
  SoilLayer::friction_angle() const
  {
    const LawDescription &description = law_named(law);
    return description.friction_entry >= 0 ?
             law_values()[description.friction_entry] :
             values.at("Friction angle");
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

  void
  SoilLayer::set_law(Kernels::Material &material) const
  {
    law_named(law).set(material, law_values().data());
    material.initial_void_ratio = void_ratio();
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
    return Kernels::law_table.law[material.law].p_wave_modulus(material,
                                                               stress.data(),
                                                               void_ratio);
  }

  Soil::Soil()
    : ParameterAcceptor("/Soil")
  {
    add_parameter("Number of layers",
                  n_layers_,
                  "Number of soil layers; layer k is described in section "
                  "Layer k. Units: none.",
                  prm,
                  Patterns::Integer(1, max_layers));
    add_parameter("Submerged",
                  submerged,
                  "Whether the soil is saturated and below water: its weight "
                  "is then the buoyant one, and its mass contains the water. "
                  "Units: none.");
    add_parameter("Fluid density",
                  fluid_density,
                  "Density of the pore water. Units: kg/m3.",
                  prm,
                  Patterns::Double(0.));
    add_parameter("Gravity",
                  gravity_text,
                  "Acceleration of gravity, its r and z components. Units: "
                  "m/s2.",
                  prm,
                  Patterns::List(Patterns::Double(), 2, 2));
    add_parameter("Initial stress",
                  initial_state,
                  "K0: geostatic effective stress under the soil's own weight; "
                  "none: no stress at the start; uniform: see Uniform stress. "
                  "Units: none.",
                  prm,
                  Patterns::Selection("K0|none|uniform"));
    add_parameter("Uniform stress",
                  uniform_text,
                  "Effective stress everywhere at the start where Initial "
                  "stress = uniform: rr, zz, tt (hoop), rz, tension positive. "
                  "Units: Pa.",
                  prm,
                  Patterns::List(Patterns::Double(), 4, 4));
    add_parameter("Initial velocity",
                  velocity_text,
                  "Velocity at the start: two expressions in r, z and pi, for "
                  "its r and z components, with a semicolon between them. "
                  "Units: m/s.");
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
            "Soil/Layer " + std::to_string(i + 1) +
            "/Top depth = " + std::to_string(layers[i]->top_depth) +
            " m: layers must be listed from the surface (Top "
            "depth = 0) downward, each deeper than the one above.");
        if (submerged && layers[i]->solid_density <= fluid_density)
          throw BadInput(
            "Soil/Layer " + std::to_string(i + 1) +
            "/Solid density = " + std::to_string(layers[i]->solid_density) +
            " kg/m3 does not exceed Soil/Fluid density = " +
            std::to_string(fluid_density) +
            " kg/m3: the soil would float. Correct one of them, "
            "or set Soil/Submerged = false.");
      }
    if (initial_state == "K0" && gravity[radial] != 0.)
      throw BadInput(
        "Soil/Gravity has a horizontal component, and Soil/Initial "
        "stress = K0 needs it vertical. Set Initial stress = none.");
    initial_velocity();
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
  Soil::inertial_density(const unsigned int i) const
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

  Stress
  Soil::initial_stress(const double z) const
  {
    if (initial_state == "uniform")
      return uniform_stress;
    if (initial_state == "none" || z >= 0.)
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
      {
        const SoilLayer  &layer = *layers[i];
        const std::string place = "Soil/Layer " + std::to_string(i + 1);
        if (layer.law == "Mohr-Coulomb" &&
            layer.values.at("Dilatancy angle") > 0.)
          limits.push_back(place + ": Mohr-Coulomb sand with a dilatancy angle "
                                   "grows in volume without limit; where it is "
                                   "large take Method/Pressure in full cells = "
                                   "mean, or a law with a critical state: see "
                                   "doc/limitations.md");
        if (layer.law == "Mohr-Coulomb with softening")
          limits.push_back(place +
                           ": softening is not regularised: shear bands "
                           "are about a cell wide, so compare meshes: see "
                           "doc/limitations.md");
      }
    return limits;
  }

  std::vector<Kernels::Material>
  Soil::kernel_materials(const double mass_scaling) const
  {
    std::vector<Kernels::Material> result(n_layers_);
    for (unsigned int i = 0; i < n_layers_; ++i)
      {
        layers[i]->set_law(result[i]);
        result[i].p_wave_modulus =
          p_wave_modulus(result[i], Stress(), layers[i]->void_ratio());
        // weight and mass ratio: buoyancy and mass scaling leave the force
        const double buoyancy =
          (1. - layers[i]->porosity) *
          (layers[i]->solid_density - (submerged ? fluid_density : 0.)) /
          inertial_density(i);
        for (unsigned int d = 0; d < 2; ++d)
          result[i].body_force[d] = gravity[d] * buoyancy / mass_scaling;
      }
    return result;
  }
} // namespace CaissonMPM
