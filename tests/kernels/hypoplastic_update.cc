// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One update of the law HypoplasticSand: independence of the step, invariance
// to in-plane rotation, a finite answer to any state, and the bound of the wave
// stiffness.
#include <algorithm>
#include <random>

#include "hypoplastic_test.h"

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
      for (int i = 0; i < n_steps; ++i)
        {
          const StrainIncrement<Scalar> de{2e-3 / n_steps,
                                           -6e-3 / n_steps,
                                           1e-3 / n_steps,
                                           3e-3 / n_steps};
          LawState<Scalar>              state;
          state.plastic_deviatoric = state.plastic_volumetric = Scalar(0.);
          state.void_ratio                                    = Scalar(e);
          HypoplasticSand::update(sigma, de, state, parameters_of(karlsruhe));
          e = (1. + e) * std::exp(-3e-3 / n_steps) - 1.;
        }
      results[k++] = sigma;
    }
  for (int i = 0; i < 2; ++i)
    report(i == 0 ? "one step" : "ten steps",
           std::max(std::max(std::fabs(results[i].rr[0] - results[2].rr[0]),
                             std::fabs(results[i].zz[0] - results[2].zz[0])),
                    std::max(std::fabs(results[i].tt[0] - results[2].tt[0]),
                             std::fabs(results[i].rz[0] - results[2].rz[0]))) /
             1e5,
           1e-3);
}



/** Stress and strain turned by an angle give a stress turned by it. */
void
test_rotation()
{
  const auto turned = [](const StressState<Scalar> &a, const double angle) {
    const double c = std::cos(2. * angle), s = std::sin(2. * angle);
    const double center = .5 * (a.rr[0] + a.zz[0]),
                 half   = .5 * (a.rr[0] - a.zz[0]);
    return StressState<Scalar>{center + c * half + s * a.rz[0],
                               center - c * half - s * a.rz[0],
                               a.tt[0],
                               c * a.rz[0] - s * half};
  };
  const StressState<Scalar> old{-5e4, -1e5, -6e4, 1e4};
  const StressState<Scalar> strain{2e-3, -6e-3, 1e-3, 3e-3};
  double                    error = 0.;
  StressState<Scalar>       straight{0., 0., 0., 0.};
  for (const double angle : {0., 0.3, 1., 2.})
    {
      StressState<Scalar>       sigma = turned(old, angle);
      const StressState<Scalar> D     = turned(strain, angle);
      LawState<Scalar>          state;
      state.plastic_deviatoric = state.plastic_volumetric = Scalar(0.);
      state.void_ratio                                    = Scalar(0.6);
      HypoplasticSand::update(sigma,
                              StrainIncrement<Scalar>{D.rr, D.zz, D.tt, D.rz},
                              state,
                              parameters_of(karlsruhe));
      const StressState<Scalar> back = turned(sigma, -angle);
      if (angle == 0.)
        straight = back;
      raise(error,
            (std::fabs(back.rr[0] - straight.rr[0]) +
             std::fabs(back.zz[0] - straight.zz[0]) +
             std::fabs(back.tt[0] - straight.tt[0]) +
             std::fabs(back.rz[0] - straight.rz[0])) /
              1e5);
    }
  std::printf("Rotation\n");
  report("difference after turning back", error, 1e-12);
}



/** One lane of stress and void ratio @p old under its strain @p increment. */
StressState<Scalar>
update_lane(const double (&old)[5][8],
            const double (&increment)[4][8],
            const int                          lane,
            const HypoplasticSand::Parameters &p)
{
  StressState<Scalar> stress{old[0][lane],
                             old[1][lane],
                             old[2][lane],
                             old[3][lane]};
  LawState<Scalar>    state;
  state.plastic_deviatoric = state.plastic_volumetric = Scalar(0.);
  state.void_ratio                                    = Scalar(old[4][lane]);
  HypoplasticSand::update(stress,
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
  const auto                             p = parameters_of(karlsruhe);
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
      HypoplasticSand::update(sigma, de, state, p);
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
          const double M =
            HypoplasticSand::p_wave_modulus(one, Scalar(old[4][l]), p)[0];
          not_finite += !(std::isfinite(M) && M > 0.);
          modulus = std::max(modulus, M);
        }
    }
  std::printf("Any state\n");
  report("not finite", not_finite, 0.);
  report("lanes against scalar", lanes, 1e-10);
  report("mean tension", tension / karlsruhe[8], 1e-12);
}



/** The bound of wave stiffness against the acoustic tensor of many waves. */
void
test_wave_modulus()
{
  std::mt19937                           generator(8);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  const auto                             p       = parameters_of(karlsruhe);
  double                                 largest = 0.;
  for (unsigned int n = 0; n < 100000; ++n)
    {
      const double pressure = std::pow(10., 4.5 + 1.5 * uniform(generator));
      const StressState<Scalar> sigma{
        -pressure * (1. + .5 * uniform(generator)),
        -pressure * (1. + .5 * uniform(generator)),
        -pressure * (1. + .5 * uniform(generator)),
        .3 * pressure * uniform(generator)};
      const double e     = 0.7 + 0.15 * uniform(generator);
      const double angle = 3.2 * uniform(generator);
      const double nr = std::cos(angle), nz = std::sin(angle);
      // a motion m of a plane wave in direction n strains by sym(m n)
      const double turn = 3.2 * uniform(generator);
      const double mr = std::cos(turn), mz = std::sin(turn), small = 1e-9;
      StressState<Scalar> stress = sigma;
      LawState<Scalar>    state;
      state.plastic_deviatoric = state.plastic_volumetric = Scalar(0.);
      state.void_ratio                                    = Scalar(e);
      HypoplasticSand::update(stress,
                              StrainIncrement<Scalar>{small * mr * nr,
                                                      small * mz * nz,
                                                      0.,
                                                      .5 * small *
                                                        (mr * nz + mz * nr)},
                              state,
                              p);
      const double rr = (stress.rr[0] - sigma.rr[0]) / small,
                   zz = (stress.zz[0] - sigma.zz[0]) / small,
                   rz = (stress.rz[0] - sigma.rz[0]) / small;
      const double stiffness =
        mr * (rr * nr + rz * nz) + mz * (rz * nr + zz * nz);
      raise(largest,
            stiffness /
              HypoplasticSand::p_wave_modulus(sigma, Scalar(e), p)[0]);
    }
  std::printf("Wave modulus\n");
  report("excess over the bound", largest - 1., 1e-6);
  report("rest below the bound", 1. - largest, 5e-3);
}



int
main()
{
  test_step_size();
  test_rotation();
  test_any_state();
  test_wave_modulus();
}
