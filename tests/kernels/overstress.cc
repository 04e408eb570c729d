// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The overstress of kernels/overstress.h in element tests: in steady shearing
// the strength grows by the share t g, whatever the pressure and the step; the
// plastic strain is then all of the strain; soil without strength has none; and
// a softening law takes the plastic strain that remains.
#include <caisson_mpm/kernels/mohr_coulomb.h>
#include <caisson_mpm/kernels/mohr_coulomb_softening.h>
#include <caisson_mpm/kernels/overstress.h>

#include <initializer_list>

#include "law_test.h"

constexpr double no_cutoff = MohrCoulombStrength<double>::no_cutoff;
constexpr double E = 2e7, time_of_overstress = 0.5, rate = 0.4;

struct Point
{
  StressState<Scalar> stress;
  LawState<Scalar>    state;
};

/** The point after @p n steps of @p dt at the rate of shear, of an undilatant
 * soil at @p pressure. */
template <typename Law>
Point
sheared(const typename Law::Parameters &parameters,
        const double                    pressure,
        const int                       n,
        const double                    dt)
{
  Point p;
  p.stress = {Scalar(-pressure), Scalar(-pressure), Scalar(-pressure), 0.};
  p.state.plastic_deviatoric = p.state.plastic_volumetric = p.state.void_ratio =
    Scalar(0.);
  for (int i = 0; i < n; ++i)
    update_with_overstress<Law>(
      p.stress,
      {Scalar(0.), Scalar(0.), Scalar(0.), Scalar(.5 * rate * dt)},
      p.state,
      parameters,
      time_of_overstress / dt);
  return p;
}

void
test_strength()
{
  std::printf("steady shear\n");
  const auto sand =
    parameters_of<MohrCoulomb>({E, 0.3, 30., 0., 0., no_cutoff, no_limit});
  const auto clay =
    parameters_of<MohrCoulomb>({E, 0.3, 0., 0., 1e4, no_cutoff, no_limit});
  double error = 0., plastic = 0.;
  for (const double pressure : {1e3, 1e5})
    for (const double dt : {1e-4, 1e-3})
      {
        const int   n        = static_cast<int>(1. / dt);
        const Point once     = sheared<MohrCoulomb>(sand, pressure, n, dt),
                    more     = sheared<MohrCoulomb>(sand, pressure, n + 1, dt),
                    cohesive = sheared<MohrCoulomb>(clay, pressure, n, dt);
        const double factor  = 1. + time_of_overstress * rate;
        raise(error,
              std::fabs(once.stress.rz[0] / (factor * .5 * pressure) - 1.));
        raise(error, std::fabs(cohesive.stress.rz[0] / (factor * 1e4) - 1.));
        raise(plastic,
              std::fabs((more.state.plastic_deviatoric[0] -
                         once.state.plastic_deviatoric[0]) *
                          std::sqrt(3.) / (rate * dt) -
                        1.));
      }
  report("error of the strength", error, 1e-6);
  report("error of the plastic strain", plastic, 1e-6);
}

void
test_tension()
{
  std::printf("pulled apart\n");
  const auto sand =
    parameters_of<MohrCoulomb>({E, 0.3, 30., 0., 0., no_cutoff, no_limit});
  StressState<Scalar> stress{-1e3, -1e3, -1e3, 0.};
  LawState<Scalar>    state;
  state.plastic_deviatoric = state.plastic_volumetric = state.void_ratio =
    Scalar(0.);
  for (int i = 0; i < 10; ++i)
    update_with_overstress<MohrCoulomb>(
      stress, {1e-4, 1e-4, 1e-4, 0.}, state, sand, 1e3);
  report("largest stress (Pa)", std::fabs(stress.rr[0]), 1e-9);
}

void
test_softening()
{
  std::printf("softening\n");
  constexpr double values[] = {E, 0.3, 0., 0., 2e4, 1e30, 0., 0., 5e3, 20.};
  const auto       law      = read_parameters<MohrCoulombSoftening>(values);
  const Point      p = sheared<MohrCoulombSoftening>(law, 1e5, 4000, 1e-4);
  const double c = 5e3 + 15e3 * std::exp(-20. * p.state.plastic_deviatoric[0]);
  // the stress falls with the strength: G g_plastic = G g - d tau / dt
  const double without = 1. + time_of_overstress * rate;
  report("strength is that of the plastic strain",
         std::fabs(p.stress.rz[0] / (without * c) - 1.),
         0.02);
}

int
main()
{
  test_strength();
  test_tension();
  test_softening();
  return 0;
}
