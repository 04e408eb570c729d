// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The law NorSand in element tests: drained triaxial compression against its
// peak and its critical state, undrained compression and extension against the
// critical state, and shear in the plane against an independent integration.
#include <caisson_mpm/kernels/nor_sand.h>

#include <algorithm>
#include <initializer_list>

#include "law_test.h"

using Law = NorSand;

// Erksak sand, from memory of Jefferies (1993): unconfirmed
constexpr double Gamma = .816, lambda = .0135, N = .3, chi = 3.5, phi_c = 31.4,
                 H = 200., E_ref = 1e8, nu = .2, p_0 = 1e5;
const double sine = std::sin(phi_c / degrees), M = 6. * sine / (3. - sine),
             M_extension = 6. * sine / (3. + sine),
             chi_i       = chi / (1. - chi * lambda / M);

/** The void ratio of the critical state at a mean stress (Pa). */
double
critical_void_ratio(const double p)
{
  return Gamma - lambda * std::log(p / 1e3);
}

/** One point of sand, consolidated under p_0. */
class Sand : public SoilPoint<Law>
{
public:
  /** @p psi: the state parameter. */
  Sand(const double psi, const double hardening = H, const double ratio = 1.)
    : SoilPoint<Law>({E_ref,
                      nu,
                      phi_c,
                      Gamma,
                      lambda,
                      N,
                      chi,
                      hardening,
                      ratio,
                      1e5,
                      .5,
                      1e3},
                     p_0,
                     critical_void_ratio(p_0) + psi)
  {}

  double
  psi() const
  {
    return state.void_ratio[0] - critical_void_ratio(p());
  }
};

/** The peak has D = chi psi and eta = M_i - D, with the state parameter there,
 * and comes the later the softer the sand: so much is left for H = 200. */
void
test_drained()
{
  for (const double psi : {-.15, -.08, .05})
    {
      std::printf("drained compression, state parameter %.2f\n", psi);
      Sand             sand(psi);
      constexpr double d = 2e-5;
      double largest = 0., peak = 0., least_dilatancy = 9., state = 0.;
      for (int i = 0; i < 60000; ++i)
        {
          const Sand before = sand;
          sand.compress(-d, -p_0, .7);
          const double eta     = sand.q() / sand.p(),
                       plastic = (sand.state.plastic_deviatoric -
                                  before.state.plastic_deviatoric)[0];
          const double D       = -(sand.state.plastic_volumetric -
                             before.state.plastic_volumetric)[0] /
                           plastic;
          if (plastic > 0. && D < least_dilatancy)
            {
              least_dilatancy = D;
              state           = sand.psi();
              peak            = M - N * std::fabs(D) - D;
            }
          raise(largest, eta);
        }
      if (psi < 0.)
        {
          report("largest dilatancy over chi psi",
                 std::fabs(least_dilatancy / (chi * state) - 1.),
                 2e-2);
          report("peak", std::fabs(largest / peak - 1.), 5e-3);
        }
      const double p = 3. * p_0 / (3. - M);
      report("critical strength", std::fabs(sand.q() / (M * p) - 1.), 1e-2);
      report("critical void ratio",
             std::fabs(sand.state.void_ratio[0] - critical_void_ratio(p)),
             2e-3);
    }
}

/** At constant volume shearing ends where e_c(p) is the void ratio. */
void
test_undrained()
{
  for (const double psi : {.03, -.03})
    for (const double sign : {1., -1.})
      {
        std::printf("undrained %s, state parameter %.2f\n",
                    sign > 0. ? "compression" : "extension",
                    psi);
        Sand             sand(psi);
        constexpr double d = 2e-5;
        for (int i = 0; i < 100000; ++i)
          sand.strain({sign * d / 2., -sign * d, sign * d / 2., 0.});
        const double p = p_0 * std::exp(-psi / lambda);
        report("mean stress", std::fabs(sand.p() / p - 1.), 5e-2);
        report("stress ratio",
               std::fabs(std::fabs(sand.q() / sand.p()) /
                           (sign > 0. ? M : M_extension) -
                         1.),
               1e-2);
      }
}

/** The elastic stiffness at p_0, and a larger surface at the start. */
void
test_elastic()
{
  std::printf("elastic range\n");
  Sand         sand(-.1, H, 1.5);
  const double d = 1e-7, G = E_ref / (2. * (1. + nu));
  sand.strain({d, -2. * d, d, 0.});
  report("shear modulus", std::fabs(sand.q() / (6. * G * d) - 1.), 1e-9);
  sand.strain({-d, 2. * d, -d, 0.});
  report("comes back", std::fabs(sand.q()) / p_0, 1e-9);
  while (sand.state.plastic_deviatoric[0] == 0.)
    sand.strain({d, -2. * d, d, 0.});
  // p_i = 1.5 p_0 / exp(1), and eta = M_i (1 + ln(p_i / p_0)) at p_0
  const double image   = 1.5 * p_0 / std::exp(1.),
               psi_i   = -.1 + lambda * std::log(image / p_0),
               M_image = M + N * chi_i * psi_i;
  report("yields",
         std::fabs(sand.q() / (M_image * std::log(1.5) * p_0) - 1.),
         5e-3);
}

/** The state of an independent integration: forward Euler with tiny steps. The
 * plastic multiplier of each follows from the yield surface by bisection. */
struct Reference
{
  double s[4] = {-p_0, -p_0, -p_0, 0.}, image = 0., e; // rr, zz, tt, rz

  Reference(const double psi)
    : e(critical_void_ratio(p_0) + psi)
  {
    image = p_0 / std::exp(1.);
  }

  double
  mean() const
  {
    return -(s[0] + s[1] + s[2]) / 3.;
  }

  double
  q() const
  {
    const double p = mean(), a = s[0] + p, b = s[1] + p, c = s[2] + p;
    return std::sqrt(1.5 * (a * a + b * b + c * c + 2. * s[3] * s[3]));
  }

  double
  image_state() const
  {
    return e - critical_void_ratio(image);
  }

  /** M by the Lode angle. */
  double
  slope() const
  {
    const double p = mean(), a = s[0] + p, b = s[1] + p, c = s[2] + p,
                 J2 = q() * q() / 3., J3 = c * (a * b - s[3] * s[3]),
                 sine_3 =
                   J2 > 0. ? 1.5 * std::sqrt(3.) * J3 / std::pow(J2, 1.5) : -1.,
                 r = std::pow((3. - sine) / (3. + sine), 4);
    return M * std::pow(2. * r / (1. + r + (1. - r) * sine_3), .25);
  }

  double
  image_slope() const
  {
    return slope() * (1. - N * chi_i * std::fabs(image_state()) / M);
  }

  /** ln(p_i / p) at most, as no stress exceeds the peak. */
  double
  limit() const
  {
    return std::max(0.,
                    -chi_i * image_state() /
                      (M - N * chi_i * std::fabs(image_state())));
  }

  double
  f() const
  {
    return q() / mean() / image_slope() - 1. -
           std::min(std::log(image / mean()), limit());
  }

  void
  strain(const double (&de)[4])
  {
    const double p = mean(), stiffness = E_ref * std::sqrt(p / 1e5),
                 G         = stiffness / (2. * (1. + nu)),
                 K         = stiffness / (3. * (1. - 2. * nu)),
                 volume    = de[0] + de[1] + de[2];
    const Reference before = *this;
    for (int i = 0; i < 4; ++i)
      s[i] += 2. * G * de[i] + (i < 3 ? (K - 2. / 3. * G) * volume : 0.);
    e = (1. + e) * std::exp(volume) - 1.;
    if (f() <= 0.)
      return;
    // the flow at the trial stress, per plastic shear
    const double p_now = mean(), q_now = q(),
                 D =
                   -image_slope() * std::min(std::log(image / p_now), limit()),
                 M_c   = M - N * chi_i * std::fabs(before.image_state()),
                 limit = std::exp(-chi_i * before.image_state() / M_c),
                 ratio = before.image / p, harder = H * slope() / M;
    double flow[4];
    for (int i = 0; i < 4; ++i)
      flow[i] =
        1.5 * (s[i] + (i < 3 ? p_now : 0.)) / q_now - (i < 3 ? D / 3. : 0.);
    const Reference trial = *this;
    const auto      apply = [&](const double shear) {
      *this = trial;
      for (int i = 0; i < 4; ++i)
        s[i] -= 2. * G * shear * flow[i] -
                (i < 3 ? (K - 2. / 3. * G) * shear * D : 0.);
      image *= std::exp(harder * (limit - ratio) / (ratio * ratio) * shear);
      return f();
    };
    double low = 0., high = .3 * q_now / G;
    for (int i = 0; i < 60; ++i)
      (apply(.5 * (low + high)) > 0. ? low : high) = .5 * (low + high);
  }
};

void
test_in_the_plane()
{
  // compression in the plane, simple shear, and extension of the hoop
  constexpr double paths[3][4] = {{.7, -1., 0., 0.},
                                  {0., -.1, 0., 1.},
                                  {-.4, -.5, .8, .3}};
  for (const auto &path : paths)
    for (const double psi : {-.1, .04})
      {
        std::printf("strain in the plane %.1f %.1f %.1f %.1f, psi %.2f\n",
                    path[0],
                    path[1],
                    path[2],
                    path[3],
                    psi);
        Sand      sand(psi);
        Reference exact(psi);
        report(
          "stress over mean stress",
          largest_difference(
            sand, exact, path, .03, 3000, 20, [&]() { return exact.mean(); }),
          1e-2);
      }
}

/** Sand at rest, within its surface or on it, stays so. */
void
test_at_rest()
{
  std::printf("at rest\n");
  double worst = 0.;
  for (const double k0 : {.4, .8, 1.7})
    for (const double psi : {-.15, .05})
      {
        Sand sand(psi);
        sand.sigma = {-k0 * p_0, -p_0, -k0 * p_0, 0.};
        for (int i = 0; i < 5; ++i)
          sand.strain({0., 0., 0., 0.});
        raise(worst, std::fabs((sand.sigma.rr[0] + k0 * p_0) / p_0));
        raise(worst, std::fabs((sand.sigma.zz[0] + p_0) / p_0));
      }
  report("stress stays", worst, 1e-7);
}

/** Pulled apart there is no stress; unloaded, dense sand bears its peak. */
void
test_low_stress()
{
  std::printf("low stress\n");
  Sand sand(-.1);
  for (int i = 0; i < 200; ++i)
    sand.strain({1e-5, 1e-5, 1e-5, 1e-6});
  report("torn soil bears nothing", sand.p() + sand.q(), 1e-9);
  for (int i = 0; i < 2000; ++i)
    sand.strain({-1e-6, -1e-5, -1e-6, 0.});
  report("bears again", sand.p() > 1e3 ? 0. : 1., 0.);
  Sand         loaded(-.1, H, 1.);
  const double d = 1e-6;
  while (loaded.p() < 10. * p_0)
    loaded.strain({-d, -d, -d, 0.});
  while (loaded.p() > 100.)
    loaded.strain({d, d, d, 0.});
  double largest = 0.;
  for (int i = 0; i < 2000; ++i)
    {
      loaded.strain({d, -2. * d, d, 0.});
      raise(largest, loaded.q() / loaded.p());
    }
  report("no principal stress in tension", largest / 3., 1.);
  report("more than the critical strength", M / largest, 1.);
}

/** Large steps, and lanes. */
void
test_robust()
{
  std::printf("large steps\n");
  for (const double size : {1e-3, 1e-2, .1})
    {
      double worst = 0.;
      for (int k = 0; k < 200; ++k)
        {
          Sand sand(-.2 + .02 * (k % 15), H, 1. + k % 3);
          for (int i = 0; i < 20; ++i)
            {
              const auto part = [&](const int m) {
                return size * std::sin(1. + 7. * k + 3. * i + 2.3 * m);
              };
              sand.strain({part(0), part(1), part(2), part(3)});
              const PrincipalStresses<Scalar> s =
                PrincipalFrame<Scalar>(sand.sigma).principal_stresses();
              const double image = sand.state.variable[0][0];
              raise(worst, image > 0. && std::isfinite(image) ? 0. : 1.);
              raise(worst, s.major[0] / p_0);
            }
        }
      report("finite, and not in tension", worst, 0.);
    }
  std::printf("lanes\n");
  using Eight = Lanes<8>;
  double zz[8], rz[8], worst = 0.;
  for (int i = 0; i < 8; ++i)
    {
      zz[i] = -1e5 - 1e4 * i;
      rz[i] = 5e3 * i;
    }
  Sand               first(-.1);
  StressState<Eight> sigma{-1e5, Eight::load(zz), -9e4, Eight::load(rz)};
  LawState<Eight>    state;
  state.plastic_deviatoric = state.plastic_volumetric = Eight(0.);
  state.void_ratio  = Eight(first.state.void_ratio[0]);
  state.variable[0] = Eight(0.);
  Law::update(sigma,
              StrainIncrement<Eight>{1e-4, -2e-4, 1e-5, 1e-4},
              state,
              first.parameters);
  for (int i = 0; i < 8; ++i)
    {
      Sand one(-.1);
      one.sigma = {-1e5, zz[i], -9e4, rz[i]};
      one.strain({1e-4, -2e-4, 1e-5, 1e-4});
      raise(worst, std::fabs(sigma.zz[i] / one.sigma.zz[0] - 1.));
      raise(worst,
            std::fabs(state.variable[0][i] / one.state.variable[0][0] - 1.));
    }
  report("as single points", worst, 1e-12);
}

void
test_check()
{
  const auto ask = [](const char  *what,
                      const double dilatancy,
                      const double k0,
                      const double e) {
    const double values[] = {
      E_ref, nu, phi_c, Gamma, lambda, N, dilatancy, H, 1., 1e5, .5, 1e3};
    LawMessage message;
    std::printf("%s: %s\n",
                what,
                Law::check(read_parameters<Law>(values),
                           {k0, e, p_0},
                           message) ?
                  "taken" :
                  message.text);
  };
  ask("dense", chi, .5, .65);
  ask("too dense", chi, .5, .4);
  ask("too loose", chi, .5, 1.1);
  ask("no void ratio", chi, .5, 0.);
  const double values[] = {
    E_ref, nu, phi_c, Gamma, lambda, N, chi, H, 1., 1e5, .5, 1e3};
  for (const double k0 : {.2, .25})
    for (const double e : {.65, .78})
      {
        const double vertical = 3. * p_0 / (1. + 2. * k0);
        std::printf(
          "K0 = %.2f at e = %.2f: %s\n",
          k0,
          e,
          Law::bears<Lanes<1>>({-k0 * vertical, -vertical, -k0 * vertical, 0.},
                               e,
                               read_parameters<Law>(values)) ?
            "borne" :
            "too much");
      }
  // y = -chi psi / M in triaxial compression
  const double limit = .45 * M / chi,
               e_c   = Gamma - lambda * std::log(p_0 / 1e3);
  ask("just below the limit", chi, 1., e_c + .999 * limit);
  ask("just above the limit", chi, 1., e_c + 1.001 * limit);
  ask("no dilatancy", 0., 1., 1.1);
  const double steep[] = {
    E_ref, nu, phi_c, Gamma, .1, N, 10., H, 1., 1e5, .5, 1e3};
  LawMessage message;
  Law::check(read_parameters<Law>(steep), {.5, .7, p_0}, message);
  std::printf("%s\n", message.text);
}

int
main()
{
  test_check();
  test_drained();
  test_undrained();
  test_elastic();
  test_in_the_plane();
  test_at_rest();
  test_low_stress();
  test_robust();
}
