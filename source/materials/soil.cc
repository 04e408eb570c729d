// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/materials/soil.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  using namespace dealii;

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
      layers.push_back(std::make_unique<SoilLayer>(i));
  }

  void
  Soil::check_parameters()
  {
    materials.clear();
    for (unsigned int i = 0; i < n_layers_; ++i)
      {
        materials.push_back(layers[i]->material());
        const SoilMaterial &m = materials.back();
        m.check();
        if (i == 0 ? m.top_depth != 0. :
                     m.top_depth <= materials[i - 1].top_depth)
          throw BadInput(
            m.section() + "/Top depth = " + to_text(m.top_depth) +
            " m: layers must be listed from the surface (Top "
            "depth = 0) downward, each deeper than the one above.");
        if (submerged && m.solid_density <= fluid_density)
          throw BadInput(m.section() +
                         "/Solid density = " + to_text(m.solid_density) +
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
  Soil::material_at(const double z) const
  {
    unsigned int i = n_materials() - 1;
    while (i > 0 && -z < materials[i].top_depth)
      --i;
    return i;
  }

  std::vector<double>
  Soil::interfaces() const
  {
    std::vector<double> result;
    for (unsigned int i = 1; i < n_layers_; ++i)
      result.push_back(-layers[i]->top_depth());
    return result;
  }

  double
  Soil::mass_density(const unsigned int i) const
  {
    return materials[i].dry_density() +
           (submerged ? materials[i].porosity * fluid_density : 0.);
  }

  double
  Soil::unit_weight(const unsigned int i) const
  {
    const SoilMaterial &m = materials[i];
    return -gravity[vertical] * (1. - m.porosity) *
           (m.solid_density - (submerged ? fluid_density : 0.));
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
    for (unsigned int i = 0; i < n_materials() && -z > materials[i].top_depth;
         ++i)
      {
        const double bottom =
          i + 1 < n_materials() ? std::min(-z, materials[i + 1].top_depth) : -z;
        sigma_zz -= unit_weight(i) * (bottom - materials[i].top_depth);
      }
    const double sigma_rr =
      materials[material_at(z)].earth_pressure_at_rest * sigma_zz;
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
    for (const SoilMaterial &m : materials)
      if (const std::string limit = m.known_limit(); !limit.empty())
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
    std::vector<Kernels::Material> result(n_materials());
    for (unsigned int i = 0; i < n_materials(); ++i)
      {
        const SoilMaterial &m = materials[i];
        m.set_law(result[i]);
        result[i].p_wave_modulus =
          p_wave_modulus(result[i], Stress(), m.void_ratio());
        result[i].initial_density = inertial_density(i);
        // weight and mass ratio: buoyancy and mass scaling leave the force
        const double buoyancy =
          (1. - m.porosity) *
          (m.solid_density - (submerged ? fluid_density : 0.)) /
          mass_density(i);
        for (unsigned int d = 0; d < 2; ++d)
          result[i].body_force[d] = gravity[d] * buoyancy / mass_scaling();
      }
    return result;
  }
} // namespace CaissonMPM
