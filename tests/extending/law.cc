// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The law that doc/extending.md adds, against its closed form in isotropic
// compression: with the bulk modulus K at 100 kPa,
//   (p / 100 kPa)^(1 - m) - (p_0 / 100 kPa)^(1 - m) = (1 - m) K e / 100 kPa.

#include <caisson_mpm/kernels/laws.h>

#include <cmath>
#include <cstdio>

#include "janbu.h"

using namespace CaissonMPM::Kernels;
using Two = Lanes<2>;

/** Compress all lanes by a volumetric strain, in steps. */
void
compress(StressState<Two>        &sigma,
         LawState<Two>           &state,
         const Janbu::Parameters &parameters,
         const double             strain,
         const int                n_steps)
{
  const Two de(-strain / 3. / n_steps);
  for (int i = 0; i < n_steps; ++i)
    Janbu::update(sigma,
                  StrainIncrement<Two>{de, de, de, Two(0.)},
                  state,
                  parameters);
}

int
main()
{
  const double         E = 20e6, nu = 0.25, m = 0.5, unloading = 4.;
  const double         values[]   = {E, nu, m, unloading};
  const auto           parameters = read_parameters<Janbu>(values);
  const LawDescription law        = describe<Janbu>();
  std::printf("%s, %d entries\n", law.name, law.n_entries);

  LawMessage   message;
  const double incompressible[] = {E, 0.48, m, unloading};
  std::printf("check: %d %d\n",
              Janbu::check(parameters, LawContext(), message),
              Janbu::check(read_parameters<Janbu>(incompressible),
                           LawContext(),
                           message));
  std::printf("%s\n", message.text);

  const double     p_0 = 5e4, strain = 0.01;
  StressState<Two> sigma{Two(-p_0), Two(-p_0), Two(-p_0), Two(0.)};
  LawState<Two>    state;
  state.variable[0] = Two(0.);
  compress(sigma, state, parameters, strain, 20000);

  const double K     = E / (3. * (1. - 2. * nu));
  const double root  = std::sqrt(1e-5 * p_0) + .5 * K * strain * 1e-5;
  const double exact = 1e5 * root * root;
  const double p     = -sigma.rr[1];
  std::printf("pressure error <= 1e-4: %s\n",
              std::abs(p / exact - 1.) <= 1e-4 ? "yes" : "no");

  compress(sigma, state, parameters, -1e-2 * strain, 1);
  const double before = -sigma.rr[1];
  compress(sigma, state, parameters, -1e-6 * strain, 1);
  const double stiffness = (before + sigma.rr[1]) / (1e-6 * strain);
  std::printf("unloading stiffness error <= 1e-4: %s\n",
              std::abs(stiffness / (unloading * K * std::sqrt(1e-5 * before)) -
                       1.) <= 1e-4 ?
                "yes" :
                "no");
}
