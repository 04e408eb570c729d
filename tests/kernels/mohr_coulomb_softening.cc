// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The law MohrCoulombSoftening in element tests: with eta = 0 it is
// Mohr-Coulomb; the strength in triaxial compression against its closed form;
// the plastic strain against the one integrated from it.
#include <caisson_mpm/kernels/mohr_coulomb_softening.h>

#include <algorithm>

#include "law_test.h"

constexpr double brittle[] = {5e7, 0.3, 36., 8., 5e3, 1e30, 30., 0., 1e3, 15.};

/** Axial over lateral stress against the strength at the plastic strain. */
void
test_softening()
{
  using Law = MohrCoulombSoftening;
  std::printf("Mohr-Coulomb with softening, triaxial compression\n");
  const double pressure = 1e5;
  for (const int n_steps : {1000, 4000})
    {
      Sample<Law> sample(read_parameters<Law>(brittle), pressure, 1.);
      double      peak = 0., error = 0., flow = 0.;
      for (int i = 0; i < n_steps; ++i)
        {
          const double d_axial = -0.2 / n_steps, plastic = sample.plastic;
          const double stress = sample.axial;
          const double d_lateral =
            sample.strain_at_lateral_stress(-pressure, d_axial);
          peak = std::max(peak, sample.axial / sample.lateral);
          if (plastic == 0.)
            continue;
          // the strength of the step's start, in closed form
          const double left = std::exp(-brittle[9] * plastic);
          const double phi  = (30. + 6. * left) / degrees,
                       psi = 8. * left / degrees, c = 1e3 + 4e3 * left;
          const double N = (1. + std::sin(phi)) / (1. - std::sin(phi));
          raise(error,
                std::fabs(-sample.axial - N * pressure -
                          2. * c * std::sqrt(N)) /
                  pressure);
          const double plastic_axial = -d_axial + (sample.axial - stress) / 5e7;
          const double plastic_lateral =
            d_lateral + 0.3 * (sample.axial - stress) / 5e7;
          const double ratio = (1. + std::sin(psi)) / (1. - std::sin(psi));
          raise(flow, std::fabs(2. * plastic_lateral / plastic_axial - ratio));
        }
      std::printf("%d steps: peak %.4f, end %.4f, plastic strain %.4f\n",
                  n_steps,
                  peak,
                  sample.axial / sample.lateral,
                  sample.plastic);
      report("strength error", error, 1e-8);
      report("flow rule error", flow, 1e-5);
    }

  double values[10];
  std::copy(brittle, brittle + 10, values);
  values[9] = 0.;
  Sample<Law>         soft(read_parameters<Law>(values), pressure, 1.);
  Sample<MohrCoulomb> hard(read_parameters<MohrCoulomb>(values), pressure, 1.);
  double              difference = 0.;
  for (int i = 0; i < 200; ++i)
    {
      soft.strain_at_lateral_stress(-pressure, -1e-3);
      hard.strain_at_lateral_stress(-pressure, -1e-3);
      raise(difference, std::fabs(soft.axial / hard.axial - 1.));
    }
  report("eta = 0 against Mohr-Coulomb", difference, 1e-10);
}

int
main()
{
  test_softening();
}
