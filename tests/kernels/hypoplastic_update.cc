// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One update of hypoplastic sand: independence of the step, and a finite answer
// to any state.
#include <algorithm>
#include <random>

#include "intergranular_test.h"

/** Of sand whose intergranular strain changes slowly: where steps are long
 * beside its range, it amplifies round-off. */
Law::Parameters
slow_parameters()
{
  Law::Parameters p = parameters();
  p.range           = 1e-2;
  return p;
}

/** A strain in one step, in ten and in a thousand. */
void
test_step_size()
{
  std::printf("Independence of the step\n");
  StressState<Scalar> results[3];
  int                 k = 0;
  for (const int n_steps : {1, 10, 1000})
    {
      StressState<Scalar> sigma{-5e4, -1e5, -6e4, 1e4};
      double              e = 0.6;
      LawState<Scalar>    state;
      for (Scalar &variable : state.variable)
        variable = Scalar(0.);
      for (int i = 0; i < n_steps; ++i)
        {
          const StrainIncrement<Scalar> de{2e-3 / n_steps,
                                           -6e-3 / n_steps,
                                           1e-3 / n_steps,
                                           3e-3 / n_steps};
          state.plastic_deviatoric = state.plastic_volumetric = Scalar(0.);
          state.void_ratio                                    = Scalar(e);
          Law::update(sigma, de, state, parameters());
          e = (1. + e) * std::exp(-3e-3 / n_steps) - 1.;
        }
      results[k++] = sigma;
    }
  report("one step", difference(results[0], results[2]), 1e-3);
  report("ten steps", difference(results[1], results[2]), 1e-3);
}



/** One lane of stress and void ratio @p old under its strain @p increment. */
StressState<Scalar>
update_lane(const double (&old)[5][8],
            const double (&increment)[4][8],
            const int              lane,
            const Law::Parameters &p)
{
  StressState<Scalar> stress{old[0][lane],
                             old[1][lane],
                             old[2][lane],
                             old[3][lane]};
  LawState<Scalar>    state;
  state.plastic_deviatoric = state.plastic_volumetric = Scalar(0.);
  state.void_ratio                                    = Scalar(old[4][lane]);
  for (Scalar &variable : state.variable)
    variable = Scalar(0.);
  Law::update(stress,
              StrainIncrement<Scalar>{increment[0][lane],
                                      increment[1][lane],
                                      increment[2][lane],
                                      increment[3][lane]},
              state,
              p);
  return stress;
}



/** Any stress, void ratio and strain; eight lanes against one. */
void
test_any_state()
{
  std::mt19937                           generator(7);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  const auto                             p = slow_parameters();
  double       lanes = 0., tension = -1e300, modulus = 0.;
  unsigned int not_finite = 0;
  for (unsigned int n = 0; n < 3000; ++n)
    {
      double old[5][8], increment[4][8];
      for (int l = 0; l < 8; ++l)
        {
          const double size = std::pow(10., 3. + 3. * uniform(generator));
          const double jump = std::pow(10., -4. + 3. * uniform(generator));
          for (int c = 0; c < 4; ++c)
            {
              old[c][l]       = size * uniform(generator);
              increment[c][l] = jump * uniform(generator);
            }
          old[4][l] = 0.5 + 1.5 * uniform(generator); // padding has -1
        }
      using Eight = Lanes<8>;
      StressState<Eight>           sigma{Eight::load(old[0]),
                               Eight::load(old[1]),
                               Eight::load(old[2]),
                               Eight::load(old[3])};
      const StrainIncrement<Eight> de{Eight::load(increment[0]),
                                      Eight::load(increment[1]),
                                      Eight::load(increment[2]),
                                      Eight::load(increment[3])};
      LawState<Eight>              state;
      state.plastic_deviatoric = state.plastic_volumetric = Eight(0.);
      state.void_ratio                                    = Eight::load(old[4]);
      for (Eight &variable : state.variable)
        variable = Eight(0.);
      Law::update(sigma, de, state, p);
      for (int l = 0; l < 8; ++l)
        {
          const StressState<Scalar> one = update_lane(old, increment, l, p);
          const double size = std::fabs(one.rr[0]) + std::fabs(one.zz[0]) + 1.;
          raise(lanes,
                (std::fabs(one.rr[0] - sigma.rr[l]) +
                 std::fabs(one.zz[0] - sigma.zz[l]) +
                 std::fabs(one.tt[0] - sigma.tt[l]) +
                 std::fabs(one.rz[0] - sigma.rz[l])) /
                  size);
          tension = std::max(tension, one.rr[0] + one.zz[0] + one.tt[0]);
          const double sum = one.rr[0] + one.zz[0] + one.tt[0] + one.rz[0];
          not_finite += !std::isfinite(sum);
          const double M = Law::p_wave_modulus(one, Scalar(old[4][l]), p)[0];
          not_finite += !(std::isfinite(M) && M > 0.);
          modulus = std::max(modulus, M);
        }
    }
  std::printf("Any state\n");
  report("not finite", not_finite, 0.);
  report("lanes against scalar", lanes, 1e-10);
  report("mean tension", tension / p.shift, 1e-12);
}



int
main()
{
  test_step_size();
  test_any_state();
}
