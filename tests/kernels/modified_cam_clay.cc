// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The law ModifiedCamClay in element tests: isotropic compression and swelling,
// undrained and drained triaxial compression, undrained extension and one-
// dimensional compression against closed forms (Wood 1990, Soil behaviour and
// critical state soil mechanics), and shear in the plane against an independent
// integration.
#include <caisson_mpm/kernels/modified_cam_clay.h>

#include <initializer_list>

#include "law_test.h"

using Law = ModifiedCamClay;

constexpr double lambda = .16, kappa = .032, nu = .25, phi_c = 24., e_0 = 1.1,
                 p_0 = 1e5, Lambda = (lambda - kappa) / lambda;
const double sine = std::sin(phi_c / degrees), M = 6. * sine / (3. - sine),
             M_extension = 6. * sine / (3. + sine);

/** One point of clay, consolidated under p_0. */
class Clay : public SoilPoint<Law>
{
public:
  Clay(const double yield_stress_ratio = 1.)
    : SoilPoint<Law>({lambda, kappa, nu, phi_c, yield_stress_ratio, 1e2},
                     p_0,
                     e_0)
  {}
};

void
test_isotropic()
{
  std::printf("isotropic compression and swelling\n");
  Clay             clay;
  constexpr int    n = 2000;
  constexpr double d = -5e-5;
  for (int i = 0; i < n; ++i)
    clay.strain({d, d, d, 0.});
  const double p_1 = clay.p(), e_1 = clay.state.void_ratio[0];
  report("slope of compression",
         std::fabs((e_0 - e_1) / std::log(p_1 / p_0) / lambda - 1.),
         1e-3);
  for (int i = 0; i < 200; ++i)
    clay.strain({-d, -d, -d, 0.});
  report("slope of swelling",
         std::fabs((clay.state.void_ratio[0] - e_1) / std::log(p_1 / clay.p()) /
                     kappa -
                   1.),
         1e-3);
}

/** Undrained: p (1 + (q / (p M))^2)^Lambda stays from the yield surface on. */
void
test_undrained()
{
  for (const double ratio : {1., 1.5, 6.})
    for (const double sign : {1., -1.})
      {
        std::printf("undrained %s, yield stress ratio %.1f\n",
                    sign > 0. ? "compression" : "extension",
                    ratio);
        Clay             clay(ratio);
        const double     slope = sign > 0. ? M : M_extension;
        double           worst = 0.;
        constexpr double d     = 1e-5;
        for (int i = 0; i < 60000; ++i)
          {
            clay.strain({sign * d / 2., -sign * d, sign * d / 2., 0.});
            // elastic at constant p, and then on the yield surface
            const double eta = clay.q() / clay.p() / slope,
                         p   = std::fabs(eta) < std::sqrt(ratio - 1.) &&
                                 clay.state.plastic_deviatoric[0] < 1e-12 ?
                                 p_0 :
                                 p_0 * std::pow(ratio / (1. + eta * eta), Lambda);
            raise(worst, std::fabs(clay.p() / p - 1.));
          }
        report("path", worst, 1e-3);
        const double critical = p_0 * std::pow(.5 * ratio, Lambda);
        report("strength",
               std::fabs(std::fabs(clay.q()) / (slope * critical) - 1.),
               1e-3);
      }
}

/** The critical state has q = M p and a known void ratio. */
void
test_drained()
{
  for (const double ratio : {1., 8.})
    {
      std::printf("drained compression, yield stress ratio %.1f\n", ratio);
      Clay   clay(ratio);
      double largest = 0.;
      for (int i = 0; i < 60000; ++i)
        {
          clay.compress(-2e-5);
          raise(largest, clay.q());
        }
      const double p = 3. * p_0 / (3. - M),
                   e = e_0 + lambda * std::log(p_0 / p) +
                       (lambda - kappa) * std::log(.5 * ratio);
      report("strength", std::fabs(clay.q() / (M * p) - 1.), 2e-3);
      report("void ratio", std::fabs(clay.state.void_ratio[0] - e), 2e-3);
      // q = 3 (p - p_0) meets the first yield surface
      const double a = M * M / 9. + 1., b = -2. - M * M / 9. * ratio,
                   x = (-b + std::sqrt(b * b - 4. * a)) / (2. * a);
      if (ratio > 2.)
        report("peak", std::fabs(largest / (3. * p_0 * (x - 1.)) - 1.), 5e-3);
    }
}

void
test_one_dimensional()
{
  std::printf("one-dimensional compression\n");
  Clay clay;
  for (int i = 0; i < 40000; ++i)
    clay.strain({0., -1e-5, 0., 0.});
  const double shear = 1.5 * (1. - 2. * nu) / (1. + nu);
  // elastic and plastic strain of the deviator are 2/3 of those of the volume
  double low = 0., high = M;
  for (int i = 0; i < 60; ++i)
    {
      const double eta       = .5 * (low + high);
      const double of_volume = (1. - Lambda) * eta / (3. * shear) +
                               Lambda * 2. * eta / (M * M - eta * eta);
      (of_volume < 2. / 3. ? low : high) = eta;
    }
  report("stress ratio", std::fabs(clay.q() / clay.p() / low - 1.), 2e-3);
}

/** The state of an independent integration: forward Euler with tiny steps. The
 * plastic multiplier of each follows from the yield surface by bisection. */
struct Reference
{
  double s[4] = {-p_0, -p_0, -p_0, 0.}, yield_stress, e = e_0; // rr, zz, tt, rz

  double
  mean() const
  {
    return -(s[0] + s[1] + s[2]) / 3.;
  }

  double
  M_squared() const
  {
    const double p = mean(), a = s[0] + p, b = s[1] + p, c = s[2] + p,
                 J2 = .5 * (a * a + b * b + c * c) + s[3] * s[3],
                 J3 = c * (a * b - s[3] * s[3]),
                 sine_3 =
                   J2 > 0. ? 1.5 * std::sqrt(3.) * J3 / std::pow(J2, 1.5) : -1.,
                 r = std::pow((3. - sine) / (3. + sine), 4);
    return M * M * std::sqrt(2. * r / (1. + r + (1. - r) * sine_3));
  }

  double
  q_squared() const
  {
    const double p = mean(), a = s[0] + p, b = s[1] + p, c = s[2] + p;
    return 1.5 * (a * a + b * b + c * c + 2. * s[3] * s[3]);
  }

  double
  f() const
  {
    return q_squared() / M_squared() + mean() * (mean() - yield_stress);
  }

  void
  strain(const double (&de)[4])
  {
    const double K      = (1. + e) / kappa * mean(),
                 G      = 1.5 * (1. - 2. * nu) / (1. + nu) * K,
                 volume = de[0] + de[1] + de[2], p = mean(),
                 inverse_M2 = 1. / M_squared(), f_p = 2. * p - yield_stress;
    double flow[4]; // df/dsigma, with M kept
    for (int i = 0; i < 4; ++i)
      flow[i] =
        3. * (s[i] + (i < 3 ? p : 0.)) * inverse_M2 - (i < 3 ? f_p / 3. : 0.);
    const Reference before = *this;
    const auto      apply  = [&](const double multiplier) {
      *this                = before;
      const double plastic = -multiplier * f_p; // of the volume
      for (int i = 0; i < 4; ++i)
        s[i] += 2. * G * (de[i] - multiplier * flow[i]) +
                (i < 3 ? (K - 2. / 3. * G) * (volume - plastic) : 0.);
      yield_stress *= std::exp(-(1. + e) / (lambda - kappa) * plastic);
      e = (1. + e) * std::exp(volume) - 1.;
      return f();
    };
    if (apply(0.) <= 0.)
      return;
    double low = 0., high = 1e-3 / p;
    for (int i = 0; i < 60; ++i)
      (apply(.5 * (low + high)) > 0. ? low : high) = .5 * (low + high);
  }
};

void
test_in_the_plane()
{
  // compression in the plane, simple shear, and extension of the hoop
  constexpr double paths[3][4] = {{.3, -1., 0., 0.},
                                  {0., -.1, 0., 1.},
                                  {-.4, -.5, .8, .3}};
  for (const auto &path : paths)
    for (const double ratio : {1., 4.})
      {
        std::printf("strain in the plane %.1f %.1f %.1f %.1f, ratio %.0f\n",
                    path[0],
                    path[1],
                    path[2],
                    path[3],
                    ratio);
        Clay      clay(ratio);
        Reference exact;
        exact.yield_stress = ratio * p_0;
        report(
          "stress over mean stress",
          largest_difference(
            clay, exact, path, .08, 2000, 50, [&]() { return exact.mean(); }),
          5e-3);
      }
}

/** Large steps, torn soil and lanes. */
void
test_robust()
{
  std::printf("large steps\n");
  for (const double size : {1e-3, 1e-2, .1})
    {
      double worst = 0.;
      for (int k = 0; k < 200; ++k)
        {
          Clay clay(1. + k % 5);
          for (int i = 0; i < 20; ++i)
            {
              const auto part = [&](const int m) {
                return size * std::sin(1. + 7. * k + 3. * i + 2.3 * m);
              };
              clay.strain({part(0), part(1), part(2), part(3)});
              const double p = clay.p(), yield = clay.state.variable[0][0];
              raise(worst, std::isfinite(p) && p >= 0. && yield > 0. ? 0. : 1.);
              clay.state.void_ratio = Scalar(e_0);
            }
        }
      report("finite, and not in tension", worst, 0.);
    }
  std::printf("lanes\n");
  using Eight = Lanes<8>;
  Clay   single[8];
  double zz[8], rz[8];
  for (int i = 0; i < 8; ++i)
    {
      zz[i]           = -1e5 - 1e4 * i;
      rz[i]           = 5e3 * i;
      single[i].sigma = {-1e5, zz[i], -9e4, rz[i]};
      Law::update(single[i].sigma,
                  {1e-4, -2e-4, 1e-5, 1e-4},
                  single[i].state,
                  single[i].parameters);
    }
  StressState<Eight> sigma{-1e5, Eight::load(zz), -9e4, Eight::load(rz)};
  LawState<Eight>    state;
  state.plastic_deviatoric = state.plastic_volumetric = Eight(0.);
  state.void_ratio                                    = Eight(e_0);
  for (Eight &variable : state.variable)
    variable = Eight(0.);
  Law::update(sigma,
              StrainIncrement<Eight>{1e-4, -2e-4, 1e-5, 1e-4},
              state,
              single[0].parameters);
  double worst = 0.;
  for (int i = 0; i < 8; ++i)
    {
      raise(worst, std::fabs(sigma.zz[i] / single[i].sigma.zz[0] - 1.));
      raise(worst,
            std::fabs(state.variable[0][i] / single[i].state.variable[0][0] -
                      1.));
    }
  report("as single points", worst, 1e-12);
}

/** The critical state of 24 degrees holds K0 from tan^2(45 - 12 degrees),
 * 0.422, to its inverse, 2.371. */
void
test_check()
{
  const double values[] = {lambda, kappa, nu, phi_c, 1., 1e2};
  for (const double k0 : {.42, .424, 1., 2.36, 2.38})
    std::printf("K0 = %.3f: %s\n",
                k0,
                Law::bears<Lanes<1>>({-k0, -1., -k0, 0.},
                                     e_0,
                                     read_parameters<Law>(values)) ?
                  "borne" :
                  "too much");
}

int
main()
{
  test_check();
  test_isotropic();
  test_undrained();
  test_drained();
  test_one_dimensional();
  test_in_the_plane();
  test_robust();
}
