// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Ground whose numbers change with depth: its materials, and the stress at the
// start, against closed forms; and what is refused.
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/kernels/laws.h>
#include <caisson_mpm/materials/soil.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "../shared/scene.h"
#include "../shared/verdict.h"

/** Rows of 0.05 m to a depth of 10 m, in the order of GridLines::row_lines().
 */
std::vector<double>
rows()
{
  std::vector<double> result;
  for (int i = 200; i >= 0; --i)
    result.push_back(-.05 * i);
  return result;
}

struct Ground : EmptyParameters
{
  explicit Ground(const std::string &entries)
  {
    auto &prm = dealii::ParameterAcceptor::prm;
    soil.declare_layers(2);
    prm.parse_input_from_string("subsection Soil\n" + entries + "end\n");
    dealii::ParameterAcceptor::parse_all_parameters(prm);
    soil.check_parameters();
    soil.divide(rows());
  }

  /** The depth of the middle of a material. */
  double
  middle(const unsigned int i) const
  {
    const double bottom =
      i + 1 < soil.n_materials() ? soil.material(i + 1).top_depth : 10.;
    return .5 * (soil.material(i).top_depth + bottom);
  }

  double
  vertical_stress(const double depth) const
  {
    return -soil.initial_stress(dealii::Point<2>(1., -depth))[zz];
  }

  /** The largest relative error of a number of all materials. */
  double
  error(const std::function<double(const SoilMaterial &)> &found,
        const std::function<double(double depth)>         &exact) const
  {
    double largest = 0.;
    for (unsigned int i = 0; i < soil.n_materials(); ++i)
      largest =
        std::max(largest,
                 std::abs(found(soil.material(i)) / exact(middle(i)) - 1.));
    return largest;
  }

  Soil soil;
};

void
check_constant()
{
  const Ground g("set Number of layers = 2\nset Submerged = false\n"
                 "subsection Layer 1\nset Friction angle = 33\nend\n"
                 "subsection Layer 2\nset Top depth = 2\nend\n");
  std::printf("two layers of constant numbers: %u materials\n",
              g.soil.n_materials());
}

/** An expression without a variable is a number. */
void
check_constant_expression()
{
  const Ground g("subsection Layer 1\nset Youngs modulus = 300*5e3\nend\n");
  std::printf("a constant expression: %u material, %g Pa\n",
              g.soil.n_materials(),
              *g.soil.material(0).youngs_modulus);
}

void
check_strength()
{
  const Ground g("subsection Layer 1\n"
                 "set Friction angle = 0\n"
                 "set Cohesion = 4e3 + 1.5e3*d\n"
                 "set Youngs modulus = 300*(4e3 + 1.5e3*d)\n"
                 "set K0 = 1\nend\n");
  std::printf("strength that grows with depth: %u materials\n",
              g.soil.n_materials());
  const auto strength = [](const double d) { return 4e3 + 1.5e3 * d; };
  verdict("cohesion",
          g.error([](const auto &m) { return *m.shear_strength; }, strength),
          1e-12);
  verdict("Young's modulus",
          g.error([](const auto &m) { return *m.youngs_modulus; },
                  [&](const double d) { return 300. * strength(d); }),
          1e-12);
  double largest = 0.;
  for (unsigned int i = 0; i + 1 < g.soil.n_materials(); ++i)
    if (g.middle(i + 1) - g.middle(i) > .051) // more than a row
      largest = std::max(largest,
                         *g.soil.material(i + 1).shear_strength /
                             *g.soil.material(i).shear_strength -
                           1.);
  verdict("step from material to material", largest, .042);
}

void
check_stiffness_by_stress()
{
  const Ground g("set Submerged = false\nset Surcharge = 50e3\n"
                 "subsection Layer 1\n"
                 "set Porosity = 0.4\nset Solid density = 2650\n"
                 "set Friction angle = 30\nset Overconsolidation ratio = 4\n"
                 "set Youngs modulus = 40e6*(p/100e3)^0.5\nend\n");
  const double gamma = .6 * 2650. * 9.81, k0 = .5 * std::sqrt(4.);
  const auto   stress = [&](const double d) { return 50e3 + gamma * d; };
  std::printf("stiffness by stress, below a surcharge: %u materials\n",
              g.soil.n_materials());
  verdict("K0 of overconsolidated sand",
          g.error([](const auto &m) { return m.earth_pressure_at_rest; },
                  [&](const double) { return k0; }),
          1e-12);
  double modulus = 0., vertical = 0.;
  for (unsigned int i = 1; i < g.soil.n_materials(); ++i) // 0: the surcharge
    {
      const double d = g.middle(i), p = stress(d) * (1. + 2. * k0) / 3.;
      modulus = std::max(modulus,
                         std::abs(*g.soil.material(i).youngs_modulus /
                                    (40e6 * std::sqrt(p / 100e3)) -
                                  1.));
      vertical =
        std::max(vertical, std::abs(g.vertical_stress(d) / stress(d) - 1.));
    }
  verdict("Young's modulus", modulus, 1e-12);
  verdict("vertical stress", vertical, 1e-12);
  verdict("vertical stress at the surface", g.vertical_stress(0.), 0.);
}

void
check_relative_density()
{
  const Ground g("subsection Layer 1\n"
                 "set Law = hypoplastic sand with intergranular strain\n"
                 "set Relative density = 0.9 - 0.05*d\n"
                 "set Minimum void ratio = 0.6\nset Maximum void ratio = 0.9\n"
                 "set Solid density = 2650\nend\n");
  const auto   void_ratio = [](const double d) {
    return .9 - .3 * (.9 - .05 * d);
  };
  std::printf("relative density that falls with depth: %u materials\n",
              g.soil.n_materials());
  verdict("void ratio",
          g.error([](const auto &m) { return m.void_ratio(); }, void_ratio),
          1e-12);
  // with a = 1 + e at the surface and e = e(0) + b d the weight is
  // gamma_s / b log(1 + b d / a)
  const double a = 1.63, b = .015, weight = 1650. * 9.81;
  double       largest = 0.;
  for (int i = 1; i < 10; ++i)
    largest = std::max(largest,
                       std::abs(g.vertical_stress(i) * b /
                                  (weight * std::log(1. + b * i / a)) -
                                1.));
  verdict("vertical stress", largest, 1e-3);
}

void
check_given_stress()
{
  const Ground g("set Initial stress = expression\n"
                 "set Stress expression = 6e3*z ; 9e3*z - 1e3*r ; 5e3*z ; "
                 "100*r\n"
                 "subsection Layer 1\nset Cohesion = 1e3 + 0.2*s\nend\n");
  const Stress s = g.soil.initial_stress(dealii::Point<2>(2., -3.));
  std::printf("given stress: %g %g %g %g Pa\n", s[rr], s[zz], s[tt], s[rz]);
  verdict("cohesion by stress",
          g.error([](const auto &m) { return *m.shear_strength; },
                  [](const double d) { return 1e3 + .2 * 9e3 * d; }),
          1e-12);
}

/** The tension that soil bears: its cut-off, or the apex of the cone. */
void
check_tension()
{
  for (const std::string entries :
       {"Cohesion = 5e3\nset Tension cut-off = 2e3",
        "Cohesion = 1e3\nset Tension cut-off = 2e3",
        "Friction angle = 0\nset Cohesion = 5e3\nset Tension cut-off = 2e4",
        "Law = hypoplastic sand with intergranular strain"})
    std::printf("tension %g Pa\n",
                Ground("subsection Layer 1\nset " + entries + "\nend\n")
                  .soil.material(0)
                  .tension());
}

/** What each law answers with the defaults of its entries. */
void
check_numbers_of_laws()
{
  for (const Kernels::LawDescription &law : Kernels::law_table.law)
    {
      std::vector<double> values;
      for (int i = 0; i < law.n_entries; ++i)
        values.push_back(law.entry(i).value);
      const Kernels::LawNumbers n = law.numbers(values.data());
      std::printf("%s:", law.name);
      for (const double number : {n.youngs_modulus,
                                  n.poisson_ratio,
                                  n.friction_angle,
                                  n.dilatancy_angle,
                                  n.shear_strength,
                                  n.tension_cutoff,
                                  n.densest,
                                  n.loosest})
        std::printf(" %g", number);
      std::printf("\n");
    }
}

void
check_refusals()
{
  for (
    const std::string layer :
    {"set Porosity = 0.55 - 0.1*d",
     "set Porosity = 0.4 - 1e-6*s",
     "set Relative density = 0.5",
     "set Relative density = 1.2\nset Minimum void ratio = 0.1\n"
     "set Maximum void ratio = 0.9\nset Solid density = 1e-3",
     "set Friction angle = 30 - 4*d\nset Dilatancy angle = 10",
     "set Cohesion = 1e3*log(d - 5)",
     "set Cohesion = 1e3*(d",
     "set Cohesion = 1e3*(2 + r)",
     "set Relative density = 0.5\nset Maximum void ratio = 0.9",
     "set Overconsolidation ratio = 1 + 100e3/s",
     "set K0 = 0.4 + 1e-6*p",
     // at 10 m, below 88.29 kPa: 1 -+ 2 c / 88.29 kPa
     "set Friction angle = 0\nset Cohesion = 5e3\nset K0 = 0.5",
     // 1/3 - 2 c / sqrt(3) / 88.29 kPa, and 3 + 2 c sqrt(3) / 88.29 kPa
     "set Cohesion = 100\nset K0 = 0.1",
     "set Cohesion = 100\nset K0 = 3.1",
     "set Law = Mohr-Coulomb by density and stress\n"
     "set Relative density = 0.6\nset Minimum void ratio = 0.5\n"
     "set Maximum void ratio = 0.9\nset K0 = 0.1",
     "set Law = NGI-ADP\nset Active strength = 2e4\nset K0 = 0.3",
     "set Law = hypoplastic sand with intergranular strain\nset Void ratio = 0.6\nset K0 = 0.1",
     // below 2 c / (1 - K0) it stands, where strength grows with depth
     "set Friction angle = 0\nset Cohesion = 100 + 0.25*s\nset K0 = 0.45",
     "set Friction angle = 0\nset Cohesion = 100 + 0.25*s\nset K0 = 0.51"})
    try
      {
        const Ground g("subsection Layer 1\n" + layer + "\nend\n");
        std::printf("accepted: %s\n", layer.c_str());
      }
    catch (const BadInput &error)
      {
        std::printf("refused: %s\n", error.what());
      }
}

/** Stresses that no K0 describes. */
void
check_given_stresses()
{
  for (const std::string stress : {"-1e5, -1e5, -1e5, 0",
                                   "-1e5, 1e5, -1e5, 0",
                                   "-1e5, -1e5, -1e5, 8e4",
                                   "-1e5, -1e5, -4e5, 0"})
    try
      {
        const Ground g("set Initial stress = uniform\nset Uniform stress = " +
                       stress + "\n");
        std::printf("held: %s\n", stress.c_str());
      }
    catch (const BadInput &error)
      {
        std::printf("refused: %s\n", error.what());
      }
}

int
main(int, char **)
{
  check_constant();
  check_constant_expression();
  check_strength();
  check_stiffness_by_stress();
  check_relative_density();
  check_given_stress();
  check_tension();
  check_numbers_of_laws();
  check_refusals();
  check_given_stresses();
  return 0;
}
