// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The law LinearElastic, and the law MohrCoulomb in triaxial compression and
// extension: strength and dilation against their closed forms.
#include "mohr_coulomb_test.h"

/**
 * Strain-controlled triaxial test at constant lateral stress, from an isotropic
 * stress to failure; the lateral strain of each step is found by bisection.
 */
void
test_triaxial(const char *name, const double direction)
{
  const double pressure = 1e5;
  const Soil   soil{
    0.3, 30. * angle_per_deg, 10. * angle_per_deg, 2e4, no_tension};
  const auto parameters = parameters_of(soil);

  Tensor stress{-pressure, -pressure, -pressure, 0.};
  double volumetric_rate = 0., axial_rate = 0.;
  for (unsigned int step = 0; step < 40; ++step)
    {
      const double axial = direction * 1e-3;
      double       low = -2e-3, high = 2e-3;
      for (unsigned int i = 0; i < 80; ++i)
        {
          const double lateral = 0.5 * (low + high);
          const Result trial =
            update<MohrCoulomb>(stress,
                                {lateral, axial, lateral, 0.},
                                parameters);
          (trial.stress.rr < -pressure ? low : high) = lateral;
        }
      const Result result =
        update<MohrCoulomb>(stress, {low, axial, low, 0.}, parameters);
      const Vector elastic = compliance(soil,
                                        {{result.stress.rr - stress.rr,
                                          result.stress.zz - stress.zz,
                                          result.stress.tt - stress.tt}});
      volumetric_rate      = result.volumetric;
      axial_rate           = std::fabs(axial - elastic[1]);
      stress               = result.stress;
    }

  const double s = std::sin(soil.phi), d = std::sin(soil.psi);
  const double n     = (1. + s) / (1. - s);
  const double exact = direction < 0. ?
                         n * pressure + 2. * soil.cohesion * std::sqrt(n) :
                         pressure / n - 2. * soil.cohesion / std::sqrt(n);
  const double dilation =
    direction < 0. ? 2. * d / (1. - d) : 2. * d / (1. + d);
  std::printf("%s\n", name);
  std::printf("axial / lateral stress at failure: %.6f\n",
              stress.zz / stress.rr);
  std::printf("plastic volumetric / axial strain: %.6f\n",
              volumetric_rate / axial_rate);
  report("lateral stress error",
         std::fabs(stress.rr + pressure) / pressure,
         1e-10);
  report("strength error", std::fabs(stress.zz + exact) / pressure, 1e-10);
  report("dilation error",
         std::fabs(volumetric_rate / axial_rate - dilation),
         1e-10);
}



void
test_elastic()
{
  const Soil   soil{0.3, 30. * angle_per_deg, 0., 0., 0.};
  const auto   elastic = parameters_of<LinearElastic>({E, soil.nu});
  const Tensor old{-1e5, -2e5, -1.5e5, 2e4};
  const Tensor increment{1e-3, -2e-3, 5e-4, 7e-4};

  const Result result = update<LinearElastic>(old, increment, elastic);
  std::printf("Linear elastic\n");
  report("stress error",
         distance(result.stress, elastic_stress(soil, old, increment)) /
           stress_scale,
         1e-14);
  std::printf("plastic strains: %.1f %.1f\n",
              result.deviatoric,
              result.volumetric);

  // an oedometric path stays inside the cone, where both laws are one
  Tensor a{0., 0., 0., 0.}, b{0., 0., 0., 0.};
  for (unsigned int step = 0; step < 10; ++step)
    {
      a = update<LinearElastic>(a, {0., -1e-3, 0., 0.}, elastic).stress;
      b =
        update<MohrCoulomb>(b, {0., -1e-3, 0., 0.}, parameters_of(soil)).stress;
    }
  std::printf("oedometer: lateral / axial stress: %.6f %.6f\n",
              a.rr / a.zz,
              b.tt / b.zz);
  std::printf("oedometer: modulus / E: %.6f %.6f\n",
              -a.zz / (1e-2 * E),
              -b.zz / (1e-2 * E));
  const double at_rest = soil.nu / (1. - soil.nu);
  report("earth pressure at rest error",
         std::max(std::fabs(a.rr / a.zz - at_rest),
                  std::fabs(b.tt / b.zz - at_rest)),
         1e-10);
}



int
main()
{
  test_elastic();
  test_triaxial("Triaxial compression", -1.);
  test_triaxial("Triaxial extension", 1.);
}
