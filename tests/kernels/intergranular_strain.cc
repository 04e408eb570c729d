// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The intergranular strain of hypoplastic sand, against what Niemunis & Herle
// (1997) imply: straight on the law is the one without it, after a reversal and
// at rest its linear part is m_R times as stiff, after a turn by 90 degrees m_T
// times; its length grows by a closed form for beta_r = 1; and it turns with
// the soil.
#include <caisson_mpm/kernels/update_stress.h>

#include <random>

#include "intergranular_test.h"

const Stress forward{.3 / 1.1, -1. / 1.1, .1 / 1.1, .2 / 1.1};



void
test_stiffness()
{
  const auto   p = parameters();
  const Stress D = times(1. / norm(forward), forward);
  Point        point;
  std::printf("Stiffness\n");
  report("at rest, m_R L",
         difference(stiffness(point, D, p),
                    times(m_R, linear_stiffness(point, D, p))),
         1e-3);
  for (unsigned int i = 0; i < 200; ++i)
    strain(point, times(range, D), p);
  report("straight on, no memory",
         difference(stiffness(point, D, p), stiffness_without(point, D, p)),
         1e-3);
  report("reversed, m_R L",
         difference(stiffness(point, times(-1., D), p),
                    times(-m_R, linear_stiffness(point, D, p))),
         1e-3);
  // normal to D, and on the side of the reversal
  Stress       normal{1., 1., 1., -.5};
  const double along = product(normal, D);
  normal             = minus(normal, times(along, D));
  normal             = times(1. / norm(normal), normal);
  report("turned, m_T L",
         difference(stiffness(point, minus(normal, times(1e-9, D)), p),
                    times(m_T, linear_stiffness(point, normal, p))),
         1e-3);
}



/** With beta_r = 1, |h| = R (1 - exp(-e / R)) on a straight path. */
void
test_growth()
{
  const auto   p     = parameters(1.);
  const Stress D     = times(1. / norm(forward), forward);
  double       error = 0., step = 0.;
  for (const int n : {1, 10, 1000})
    for (const double e : {.1, .5, 1., 3.})
      {
        Point point;
        for (int i = 0; i < n; ++i)
          strain(point, times(e * range / n, D), p);
        const double found = norm(point.memory) / range - (1. - std::exp(-e));
        raise(n == 1000 ? error : step, std::fabs(found));
      }
  std::printf("Growth\n");
  report("error of |h| / R, small steps", error, 2e-3);
  report("error of |h| / R, any steps", step, 3e-2);
}



/** Turning stress, strain and memory turns the answer. */
void
test_rotation()
{
  const auto turned = [](const Stress &s, const double angle) {
    const double c = std::cos(angle), d = std::sin(angle);
    return Stress{c * c * s.rr + d * d * s.zz - 2. * c * d * s.rz,
                  d * d * s.rr + c * c * s.zz + 2. * c * d * s.rz,
                  s.tt,
                  c * d * (s.rr - s.zz) + (c * c - d * d) * s.rz};
  };
  const auto   p = parameters();
  const Stress memory{.2e-4, -.5e-4, .1e-4, .3e-4}, D{3e-5, -8e-5, 1e-5, 2e-5};
  double       error = 0., turn = 0.;
  Point        straight;
  for (const double angle : {0., .3, 1., 2.})
    {
      Point point;
      point.stress = turned(point.stress, angle);
      point.memory = turned(memory, angle);
      strain(point, turned(D, angle), p);
      if (angle == 0.)
        straight = point;
      raise(error,
            difference(turned(point.stress, -angle), straight.stress) +
              difference(turned(point.memory, -angle), straight.memory));

      LawState<Scalar> state;
      const Scalar variable[] = {memory.rr, memory.zz, memory.tt, memory.rz};
      for (int i = 0; i < 4; ++i)
        state.variable[i] = variable[i];
      // a step of the soil by -2 angle / 100: the spin is (L_rz - L_zr) / 2
      for (int i = 0; i < 100; ++i)
        turn_state<Law>(HalfTurn<Scalar>(Scalar(-angle / 100.)), state);
      const Scalar *v = state.variable;
      raise(turn,
            difference(Stress{v[0], v[1], v[2], v[3]},
                       turned(memory, .5 * angle)));
    }
  std::printf("Rotation\n");
  report("difference after turning back", error, 1e-12);
  report("memory that turns with the soil", turn, 1e-6);
}



/** Any state and step: finite, |h| <= R, and the bound of wave stiffness. */
void
test_any_state()
{
  std::mt19937                           generator(9);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  const auto                             p          = parameters();
  unsigned int                           not_finite = 0;
  double                                 length = 0., excess = 0.;
  const auto                             any = [&](const double size) {
    return Stress{size * uniform(generator),
                  size * uniform(generator),
                  size * uniform(generator),
                  size * uniform(generator)};
  };
  for (unsigned int n = 0; n < 20000; ++n)
    {
      Point point;
      point.stress     = any(std::pow(10., 3. + 3. * uniform(generator)));
      point.memory     = any(range);
      point.void_ratio = .7 + .15 * uniform(generator);
      strain(point, any(std::pow(10., -5. + 3. * uniform(generator))), p);
      raise(length, norm(point.memory) / range);
      not_finite += !std::isfinite(norm(point.stress));

      const double pressure = std::pow(10., 4.5 + 1.5 * uniform(generator));
      point.stress          = any(.3 * pressure);
      point.stress.rr -= pressure;
      point.stress.zz -= pressure;
      point.stress.tt -= pressure;
      point.void_ratio   = .7 + .15 * uniform(generator);
      const double angle = 3.2 * uniform(generator),
                   turn  = 3.2 * uniform(generator);
      const double nr = std::cos(angle), nz = std::sin(angle);
      const double mr = std::cos(turn), mz = std::sin(turn);
      const Stress answer =
        stiffness(point, {mr * nr, mz * nz, 0., .5 * (mr * nz + mz * nr)}, p);
      const double wave = (mr * (answer.rr * nr + answer.rz * nz) +
                           mz * (answer.rz * nr + answer.zz * nz))[0];
      raise(excess,
            wave / Law::p_wave_modulus(point.stress,
                                       Scalar(point.void_ratio),
                                       p)[0]);
    }
  std::printf("Any state\n");
  report("not finite", not_finite, 0.);
  report("|h| / R", length, 1. + 1e-12);
  report("excess over the bound", excess - 1., 1e-3);
}



int
main()
{
  test_stiffness();
  test_growth();
  test_rotation();
  test_any_state();
}
