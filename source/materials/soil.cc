// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/materials/soil.h>
#include <caisson_mpm/materials/umat_law.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>

namespace CaissonMPM
{
  using namespace dealii;

  Soil::MassScaling::MassScaling()
    : Section("/Time")
  {
    add_parameter(
      "Mass scaling",
      factor,
      "",
      "The inertia of the soil, but not its weight, is multiplied by this "
      "factor; the time step grows with its square root.",
      Patterns::Double(1., 1e6));
  }

  Soil::Soil()
    : Section("/Soil")
  {
    add_parameter(
      "Number of layers",
      n_layers_,
      "",
      "The soil consists of this number of layers; layer k is described in "
      "section Layer k.",
      Patterns::Integer(1, max_layers));
    add_parameter(
      "Submerged",
      submerged,
      "",
      "Submerged soil is saturated and below water: its weight is the buoyant "
      "one, and its mass contains the water.");
    add_parameter("Fluid density",
                  fluid_density,
                  "kg/m3",
                  "The fluid density is that of the pore water.",
                  Patterns::Double(0.));
    add_parameter("Gravity",
                  gravity_text,
                  "m/s2",
                  "The acceleration of gravity has these r and z components.",
                  Patterns::List(Patterns::Double(), 2, 2));
    declare_initial_stress();
    add_parameter(
      "Initial velocity",
      velocity_text,
      "m/s",
      "The velocity at the start is given by two expressions in r, z and pi, "
      "for its r and z components, with a semicolon between them.");
    parse_parameters_call_back.connect([this]() {
      const auto numbers = [](const std::string &text) {
        return Utilities::string_to_double(Utilities::split_string_list(text));
      };
      std::copy_n(numbers(gravity_text).begin(), 2, gravity.begin());
      std::copy_n(numbers(uniform_text).begin(), 4, uniform_stress.begin());
    });
    declare_layers(1);
  }

  void
  Soil::declare_initial_stress()
  {
    add_choice(
      *this,
      "Initial stress",
      stress_state,
      {{"K0", InitialStress::k0},
       {"none", InitialStress::none},
       {"uniform", InitialStress::uniform},
       {"expression", InitialStress::expression}},
      "",
      "The stress in the soil at the start: K0 is the geostatic effective "
      "stress under the soil's own weight and the surcharge, none is no "
      "stress, uniform takes the entry Uniform stress, and expression the "
      "entry Stress expression.");
    add_parameter(
      "Uniform stress",
      uniform_text,
      "Pa",
      "With Initial stress = uniform, the effective stress is this one "
      "everywhere at the start: rr, zz, tt (hoop) and rz, positive in tension.",
      Patterns::List(Patterns::Double(), 4, 4));
    add_parameter(
      "Stress expression",
      expression_text,
      "Pa",
      "With Initial stress = expression, the effective stress at the start is "
      "given by four expressions in r, z and pi, for rr, zz, tt (hoop) and rz, "
      "with semicolons between them. Tension is positive.");
    add_parameter(
      "Surcharge",
      surcharge,
      "Pa",
      "A load that acts on the soil surface before the body is installed. The "
      "uppermost row of cells carries it as a weight without inertia.",
      Patterns::Double(0.));
  }

  void
  Soil::declare_layers(const unsigned int n)
  {
    while (layers.size() < n)
      layers.push_back(std::make_unique<SoilLayer>(layers.size()));
  }

  bool
  Soil::declare_subsection(const std::string &path)
  {
    const std::string beginning = "Soil/Layer ";
    if (path.compare(0, beginning.size(), beginning) != 0)
      return false;
    const std::string number = path.substr(beginning.size());
    if (number.empty() || number.size() > 4 || number[0] == '0' ||
        number.find_first_not_of("0123456789") != std::string::npos ||
        std::stoul(number) > max_layers)
      return false;
    declare_layers(std::stoul(number));
    return true;
  }

  void
  Soil::check_parameters() const
  {
    if (n_layers_ > layers.size())
      throw BadInput("Soil/Number of layers = " + to_text(n_layers_) +
                     ", but there is no Soil/Layer " +
                     to_text(layers.size() + 1) +
                     ". Describe each layer, with its Top depth, or reduce the "
                     "number.");
    for (unsigned int i = 0; i < n_layers_; ++i)
      {
        const SoilLayer &layer = *layers[i];
        layer.check_parameters();
        if (i == 0 ? layer.top_depth() != 0. :
                     layer.top_depth() <= layers[i - 1]->top_depth())
          throw BadInput(
            layer.section() + "/Top depth = " + to_text(layer.top_depth()) +
            " m: layers must be listed from the surface (Top "
            "depth = 0) downward, each deeper than the one above.");
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
    if (surcharge > 0. && stress_state != InitialStress::k0)
      throw BadInput("Soil/Surcharge = " + to_text(surcharge) +
                     " Pa is part of the stress at the start with Soil/Initial "
                     "stress = K0 only. Set K0, or the surcharge to 0.");
  }

  namespace
  {
    /** The depths of the lines between two depths, and the lower one. */
    std::vector<double>
    depths_between(const std::vector<double> &row_lines,
                   const double               top,
                   const double               bottom)
    {
      std::vector<double> result;
      for (auto z = row_lines.rbegin(); z != row_lines.rend(); ++z)
        if (-*z > top && -*z < bottom)
          result.push_back(-*z);
      result.push_back(bottom);
      return result;
    }
  } // namespace

  bool
  Soil::has_friction() const
  {
    return std::any_of(materials.begin(),
                       materials.end(),
                       [](const SoilMaterial &m) {
                         return m.friction_angle.value_or(0.) > 0. ||
                                m.shear_strength.value_or(0.) <= 0.;
                       });
  }

  bool
  Soil::has_layer_with_friction() const
  {
    return std::any_of(layers.begin(),
                       layers.begin() + n_layers_,
                       [](const auto &layer) { return layer->has_friction(); });
  }

  double
  Soil::stress_borne_above(const double z, const double height) const
  {
    // that of its weight: a surcharge, which lies on the soil, does not
    // make it heavier
    if (has_friction())
      return (-initial_stress(Point<2>(0., z))[zz] -
              (stress_state == InitialStress::k0 && z < 0. ? surcharge : 0.)) /
             materials[material_at(z)].speed_of_failure();
    // without friction it bears what its strength does, and not its weight
    double least = std::numeric_limits<double>::infinity();
    for (unsigned int i = material_at(z + height); i <= material_at(z); ++i)
      least = std::min(least, .5 * *materials[i].shear_strength);
    return least;
  }

  void
  Soil::divide(const std::vector<double> &row_lines)
  {
    materials.clear();
    if (stress_state == InitialStress::expression)
      parse_stress();
    double stress = 0.;
    for (unsigned int i = 0; i < n_layers_; ++i)
      {
        const double top    = layers[i]->top_depth(),
                     bottom = i + 1 < n_layers_ ? layers[i + 1]->top_depth() :
                                                  -row_lines.front();
        divide(*layers[i], depths_between(row_lines, top, bottom), stress);
      }
  }

  void
  Soil::divide(const SoilLayer           &layer,
               const std::vector<double> &lines,
               double                    &stress)
  {
    // what a number may change within a material, relatively
    constexpr double    largest_change = .04;
    double              top            = layer.top_depth();
    std::vector<double> depths;
    for (unsigned int i = 0; i < lines.size(); ++i)
      {
        const auto may_reach = [&](const double bottom) {
          if (surcharge > 0. && top == 0.)
            return false; // one row bears it
          return !layer.varies() ||
                 layer.change(
                   top,
                   vertical_stress(top, stress),
                   bottom,
                   vertical_stress(bottom,
                                   stress_below(layer, top, bottom, stress))) <=
                   largest_change;
        };
        while (i + 1 < lines.size() && may_reach(lines[i + 1]))
          ++i;
        add_material(layer, top, lines[i], stress);
        for (const double depth : {.5 * (top + lines[i]), lines[i]})
          depths.push_back(depth);
        top = lines[i];
      }
    check_at_rest(layer, depths);
  }

  double
  Soil::stress_below(const SoilLayer &layer,
                     const double     top,
                     const double     bottom,
                     const double     stress) const
  {
    return stress + (top == 0. ? surcharge : 0.) +
           unit_weight(layer.weight_at(.5 * (top + bottom))) * (bottom - top);
  }

  void
  Soil::add_material(const SoilLayer &layer,
                     const double     top,
                     const double     bottom,
                     double          &stress)
  {
    const double middle = .5 * (top + bottom);
    const double below  = stress_below(layer, top, bottom, stress);
    const auto   ratio  = given_stress_ratio(bottom);
    SoilMaterial m =
      layer.material_at(middle,
                        vertical_stress(middle, .5 * (stress + below)),
                        given_stress_ratio(middle));
    if (submerged && m.solid_density <= fluid_density)
      throw BadInput(m.section() +
                     "/Solid density = " + to_text(m.solid_density) +
                     " kg/m3 does not exceed Soil/Fluid density = " +
                     to_text(fluid_density) +
                     " kg/m3: the soil would float. Correct one of them, "
                     "or set Soil/Submerged = false.");
    SoilMaterial at_bottom = m;
    if (ratio)
      at_bottom.earth_pressure_at_rest = *ratio;
    at_bottom.check(vertical_stress(bottom, below) *
                    (1. + 2. * at_bottom.earth_pressure_at_rest) / 3.);
    if (m.umat)
      m.umat_stiffness =
        m.umat->test(stress_at_rest(m, bottom, vertical_stress(bottom, below)),
                     bottom);
    m.top_depth = top;
    if (top == 0.)
      m.added_weight = surcharge / (bottom - top);
    stress = below;
    materials.push_back(m);
  }

  void
  Soil::name_unused_permeability(ParameterOrigins  &origins,
                                 const std::string &why) const
  {
    for (unsigned int i = 1; i <= n_layers_; ++i)
      {
        const std::string layer = "Soil/Layer " + to_text(i) + "/Permeability";
        origins.add_unused({layer, layer + " ratio", layer + " by void ratio"},
                           why);
      }
  }

  void
  Soil::name_unused_entries(ParameterOrigins &origins) const
  {
    const std::string stress = "Soil/Initial stress is not K0";
    for (unsigned int i = 0; i < layers.size(); ++i)
      {
        const std::string section = "Soil/Layer " + to_text(i + 1);
        if (i >= n_layers_)
          origins.add_unused({section},
                             "Soil/Number of layers is " + to_text(n_layers_));
        else
          layers[i]->name_unused_entries(origins);
        if (i < n_layers_ && stress_state != InitialStress::k0)
          origins.add_unused({section + "/K0",
                              section + "/Overconsolidation ratio"},
                             stress);
      }
    if (stress_state != InitialStress::uniform)
      origins.add_unused({"Soil/Uniform stress"},
                         "Soil/Initial stress is not uniform");
    if (stress_state != InitialStress::expression)
      origins.add_unused({"Soil/Stress expression"},
                         "Soil/Initial stress is not expression");
    if (!submerged)
      origins.add_unused({"Soil/Fluid density"}, "Soil/Submerged is false");
  }

  bool
  Soil::has_walls() const
  {
    return std::any_of(materials.begin(),
                       materials.end(),
                       [](const SoilMaterial &m) {
                         return m.wall_friction_angle || m.wall_adhesion;
                       });
  }

  bool
  Soil::is_elastic_until_it_yields() const
  {
    return std::all_of(materials.begin(),
                       materials.end(),
                       [](const SoilMaterial &m) {
                         return m.is_elastic_until_it_yields();
                       });
  }

  std::vector<unsigned int>
  Soil::uppermost_materials() const
  {
    std::vector<unsigned int> result;
    for (unsigned int i = 0; i < n_materials(); ++i)
      if (i == 0 || materials[i].layer != materials[i - 1].layer)
        result.push_back(i);
    return result;
  }

  unsigned int
  Soil::material_at(const double z) const
  {
    const auto below =
      std::upper_bound(materials.begin(),
                       materials.end(),
                       -z,
                       [](const double depth, const SoilMaterial &m) {
                         return depth < m.top_depth;
                       });
    return below == materials.begin() ? 0 : below - materials.begin() - 1;
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
  Soil::unit_weight(const SoilMaterial &m) const
  {
    return -gravity[vertical] * (1. - m.porosity) *
           (m.solid_density - (submerged ? fluid_density : 0.));
  }

  double
  Soil::unit_weight_of_water() const
  {
    return -fluid_density * gravity[vertical];
  }

  void
  Soil::parse_stress()
  {
    const auto parts = Utilities::split_string_list(expression_text, ';');
    const std::string entry = "Soil/Stress expression = " + expression_text;
    if (parts.size() != 4)
      throw BadInput(entry +
                     " must be four expressions, for rr, zz, tt and rz, with "
                     "semicolons between them, for instance 4e3*z ; 8e3*z ; "
                     "4e3*z ; 0.");
    for (unsigned int c = 0; c < 4; ++c)
      stress_expression[c] =
        Expression(parts[c], entry + ": \"" + parts[c] + "\"");
  }

  VectorExpression
  Soil::initial_velocity() const
  {
    return parse_vector(velocity_text, "Soil/Initial velocity");
  }

  double
  Soil::usual_mass_scaling(const double depth) const
  {
    // soil that grows stiffer with its stress is far stiffer under the tip than
    // elsewhere, and is strained the slower for it
    const bool stiffens =
      std::all_of(materials.begin(), materials.end(), [depth](const auto &m) {
        return m.top_depth >= depth ||
               (m.stiffness_varies() && m.youngs_modulus);
      });
    return stiffens ? 400. : 100.;
  }

  std::vector<std::string>
  Soil::known_limits(const double depth) const
  {
    std::vector<std::string> limits;
    for (const SoilMaterial &m : materials)
      if (const std::string limit = m.known_limit();
          !limit.empty() && (limits.empty() || limits.back() != limit))
        limits.push_back(limit);
    if (const double usual = usual_mass_scaling(depth); mass_scaling() > usual)
      limits.push_back("Time/Mass scaling above " + to_text(usual) +
                       " was found to change the tip force by more than 5 %");
    return limits;
  }

  namespace
  {
    /** Return the damping of vibrations of the volume. Soil with friction has
     * the strength of its smallest pressure, which any vibration lowers: a
     * twentieth is enough, and more disturbs laws that depend on their path.
     * Besides, the noise of the pressure grows with the bulk modulus over the
     * shear modulus: it is harmless at a Poisson ratio of 0.3, and not at 0.45.
     */
    double
    volume_damping(const SoilMaterial &m)
    {
      constexpr double harmless = .3, harmful = .4, with_friction = .1;
      const double     least =
        m.friction_angle.value_or(0.) > 0. ? with_friction : 0.;
      const double nu =
        m.poisson_ratio.value_or(m.umat ? m.umat_stiffness.poisson : harmless);
      return std::clamp((nu - harmless) / (harmful - harmless), least, 1.);
    }
  } // namespace

  std::vector<Kernels::Material>
  Soil::kernel_materials(const double water_modulus) const
  {
    std::vector<Kernels::Material> result(n_materials());
    for (unsigned int i = 0; i < n_materials(); ++i)
      {
        const SoilMaterial &m = materials[i];
        m.set_law(result[i]);
        result[i].p_wave_modulus =
          p_wave_modulus(result[i], Stress(), m.void_ratio()) + water_modulus;
        result[i].water_modulus   = water_modulus;
        result[i].initial_density = inertial_density(i);
        result[i].volume_damping  = volume_damping(m);
        // weight and mass ratio: buoyancy and mass scaling leave the force
        const double buoyancy =
          (1. - m.porosity) *
          (m.solid_density - (submerged ? fluid_density : 0.)) /
          mass_density(i);
        for (unsigned int d = 0; d < 2; ++d)
          result[i].body_force[d] = gravity[d] * buoyancy / mass_scaling();
        result[i].body_force[vertical] -= m.added_weight / inertial_density(i);
      }
    return result;
  }
} // namespace CaissonMPM
