// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The law MohrCoulombStiffening in element tests: isotropic and oedometric
// compression against their closed forms; a constant modulus below the smallest
// stress; strength and plastic strain in triaxial compression, which do not
// depend on the stiffness; with the exponent 0 it is Mohr-Coulomb.
#include <caisson_mpm/kernels/mohr_coulomb_stiffening.h>

#include <algorithm>

#include "law_test.h"

using Law = MohrCoulombStiffening;

constexpr int n_values = 10;
// of the entries, in their order; the cohesion of the elastic tests is large
constexpr double
  sand[n_values]    = {4e7, 0.3, 36., 0., 0., 0., 2., 1e5, 0.55, 1e3},
  elastic[n_values] = {3e7, 0.2, 30., 0., 1e9, 0., 2., 8e4, 0.4, 1e3};

/** The mean stress p after a compression, where dp / de = modulus (p / p_r)^m.
 */
double
mean_stress(const double start, const double modulus, const double strain)
{
  const double left = 1. - elastic[8];
  return std::pow(std::pow(start, left) +
                    left * modulus * std::pow(elastic[7], -elastic[8]) * strain,
                  1. / left);
}

void
test_compression()
{
  std::printf("compression of elastic soil\n");
  const double E = elastic[0], nu = elastic[1], start = 5e3, strain = 0.03,
               bulk     = E / (3. * (1. - 2. * nu)),
               confined = E * (1. - nu) / ((1. + nu) * (1. - 2. * nu)),
               ratio = nu / (1. - nu), mean_over_axial = (1. + 2. * ratio) / 3.;
  for (const int n_steps : {1000, 4000})
    {
      Sample<Law> isotropic(read_parameters<Law>(elastic), start, 1.),
        oedometer(read_parameters<Law>(elastic), start, 1.);
      for (int i = 0; i < n_steps; ++i)
        {
          isotropic.strain(-strain / 3. / n_steps, -strain / 3. / n_steps);
          oedometer.strain(0., -strain / n_steps);
        }
      const double p = mean_stress(start, bulk, strain),
                   q = mean_stress(start, mean_over_axial * confined, strain),
                   axial     = start + (q - start) / mean_over_axial;
      const double tolerance = 8. / n_steps;
      report("isotropic", std::fabs(-isotropic.axial / p - 1.), tolerance);
      report("oedometer", std::fabs(-oedometer.axial / axial - 1.), tolerance);
      report("its lateral stress",
             std::fabs(-oedometer.lateral / (start + ratio * (axial - start)) -
                       1.),
             tolerance);
    }
}

void
test_smallest_stress()
{
  std::printf("below the smallest stress\n");
  const double start = 10., strain = 1e-6;
  Sample<Law>  sample(read_parameters<Law>(elastic), start, 1.);
  sample.strain(-strain / 3., -strain / 3.);
  const double bulk = elastic[0] / (3. * (1. - 2. * elastic[1])) *
                      std::pow(elastic[9] / elastic[7], elastic[8]);
  report("modulus",
         std::fabs((-sample.axial - start) / (bulk * strain) - 1.),
         1e-9);
}

void
test_triaxial()
{
  std::printf("triaxial compression\n");
  const double s = std::sin(sand[2] / degrees), N = (1. + s) / (1. - s),
               pressure = 2e4, step = 1e-4;
  for (const double E : {1e7, 4e7, 1.6e8})
    {
      double values[n_values];
      std::copy(sand, sand + n_values, values);
      values[0] = E;
      Sample<Law> sample(read_parameters<Law>(values), pressure, 1.);
      for (int i = 0; i < 1000; ++i)
        sample.strain_at_lateral_stress(-pressure, -step);
      report("strength", std::fabs(sample.axial / -pressure / N - 1.), 1e-9);
      // stress and elastic strain stay, and the volume: all strain is plastic
      const double plastic = sample.plastic;
      sample.strain_at_lateral_stress(-pressure, -step);
      report("plastic strain",
             std::fabs((sample.plastic - plastic) / step - 1.),
             1e-6);
    }

  double values[n_values];
  std::copy(sand, sand + n_values, values);
  values[8] = 0.;
  Sample<Law>         stiffening(read_parameters<Law>(values), pressure, 1.);
  Sample<MohrCoulomb> perfect(read_parameters<MohrCoulomb>(values),
                              pressure,
                              1.);
  double              difference = 0.;
  for (int i = 0; i < 200; ++i)
    {
      stiffening.strain_at_lateral_stress(-pressure, -step);
      perfect.strain_at_lateral_stress(-pressure, -step);
      raise(difference, std::fabs(stiffening.axial / perfect.axial - 1.));
      raise(difference, std::fabs(stiffening.plastic - perfect.plastic));
    }
  report("exponent 0 against Mohr-Coulomb", difference, 1e-10);
}

int
main()
{
  test_compression();
  test_smallest_stress();
  test_triaxial();
}
