// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The law NgiAdp in element tests: undrained triaxial compression and
// extension, direct simple shear and plane strain against closed forms, and
// shear in the plane against an independent integration. In plane strain the
// strength of any direction is on an ellipse (E. H. Davis, J. T. Christian
// (1971), Bearing capacity of anisotropic cohesive soil. J. Soil Mech. Found.
// Div. ASCE 97, 753-769).
#include <caisson_mpm/kernels/ngi_adp.h>

#include <algorithm>
#include <initializer_list>

#include "law_test.h"

using Law = NgiAdp;

constexpr double A = 20e3, D = .7 * A, P = .45 * A, of_A = .012, of_D = .03,
                 of_P = .05, G = 400. * A;

/** One point of clay with the shear stress tau_0 of K0. */
class Clay
{
public:
  StressState<Scalar> sigma;
  LawState<Scalar>    state;
  Law::Parameters     parameters;

  Clay(const double tau_0, const double tension = 1e9)
    : Clay(tau_0, {A, D / A, P / A, of_A, of_D, of_P, G / A, .49, tension})
  {}

  Clay(const double tau_0, const std::initializer_list<double> values)
    : sigma{-1e5 + tau_0, -1e5 - tau_0, -1e5 + tau_0, 0.}
    , parameters(read_parameters<Law>(values.begin()))
  {
    state.plastic_deviatoric = state.plastic_volumetric = Scalar(0.);
    double variable[n_state_variables]                  = {};
    Law::start(parameters, variable);
    for (int i = 0; i < n_state_variables; ++i)
      state.variable[i] = Scalar(variable[i]);
  }

  void
  strain(const StrainIncrement<Scalar> &de)
  {
    Law::update(sigma, de, state, parameters);
  }

  void
  strain(const double rr, const double zz, const double tt, const double rz)
  {
    strain(StrainIncrement<Scalar>{rr, zz, tt, rz});
  }

  /** Of the triaxial test, positive in compression along z. */
  double
  tau() const
  {
    return .5 * (sigma.rr - sigma.zz)[0];
  }

  /** The radius of the largest of Mohr's circles. */
  double
  largest_shear() const
  {
    const PrincipalStresses<Scalar> s =
      PrincipalFrame<Scalar>(sigma).principal_stresses();
    return .5 * (s.major - s.minor)[0];
  }
};

/** The plastic shear strain over that at failure with a mobilization. */
double
share_of(const double kappa)
{
  const double x = kappa / (1. + std::sqrt(std::max(0., 1. - kappa * kappa)));
  return x * x;
}

/** tau = tau_0 + kappa (s - tau_0) is reached at the strain
 * x^2 (g - (s - tau_0) / G) + (tau - tau_0) / G. */
void
test_triaxial()
{
  for (const double tau_0 : {0., 6e3, 15e3, -5e3})
    for (const double sign : {1., -1.})
      {
        std::printf("triaxial %s, tau_0 = %.0f kPa\n",
                    sign > 0. ? "compression" : "extension",
                    tau_0 / 1e3);
        Clay          clay(tau_0);
        const double  strength = sign > 0. ? A : -P;
        const double  failure  = sign > 0. ? of_A : of_P;
        constexpr int n        = 2000;
        const double  d        = failure / n;
        const double  plastic  = failure - std::fabs(strength - tau_0) / G;
        double        worst    = 0.;
        for (int i = 1; i <= 2 * n; ++i)
          {
            const double axial = 2. / 3. * sign * d;
            clay.strain(.5 * axial, -axial, .5 * axial, 0.);
            if (i == n)
              report("strength at failure",
                     std::fabs(clay.tau() / strength - 1.),
                     1e-6);
            const double tau    = clay.tau(),
                         kappa  = (tau - tau_0) / (strength - tau_0),
                         strain = share_of(kappa) * plastic +
                                  std::fabs(tau - tau_0) / G;
            if (i < n)
              raise(worst, std::fabs(strain - i * d) / failure);
          }
        report("strain", worst, 1e-4);
        report("strength", std::fabs(clay.tau() / strength - 1.), 1e-9);
        report("equal lateral stresses",
               std::fabs((clay.sigma.rr - clay.sigma.tt)[0]) / A,
               1e-9);
      }
}

/** From the middle between both strengths the stress never leaves the axis. */
void
test_direct_shear()
{
  for (const double tau_0 : {.5 * (A - P), 0., 15e3})
    {
      std::printf("direct simple shear, tau_0 = %.1f kPa\n", tau_0 / 1e3);
      Clay             clay(tau_0);
      constexpr int    n = 2000;
      constexpr double d = of_D / n, plastic = of_D - D / G;
      const bool       central = tau_0 == .5 * (A - P);
      double           worst = 0., largest = 0.;
      for (int i = 1; i <= 4 * n; ++i)
        {
          clay.strain(0., 0., 0., .5 * d);
          const double tau = clay.sigma.rz[0];
          raise(largest, tau);
          if (i == n)
            report("strength at failure",
                   std::fabs(tau / D - 1.),
                   central ? 1e-6 : .02);
          if (i < n)
            raise(worst,
                  std::fabs(share_of(tau / D) * plastic + tau / G - i * d) /
                    of_D);
        }
      if (central)
        report("strain", worst, 1e-4);
      report("strength", std::fabs(clay.sigma.rz[0] / D - 1.), 1e-4);
      report("nowhere stronger", largest / D - 1., 1e-6);
    }
}

void
test_plane_strain()
{
  for (const double sign : {1., -1.})
    {
      std::printf("plane strain, %s\n", sign > 0. ? "active" : "passive");
      Clay clay(6e3);
      for (int i = 0; i < 4000; ++i)
        clay.strain(sign * 5e-5, -sign * 5e-5, 0., 0.);
      report("strength",
             std::fabs(clay.tau() / (sign > 0. ? A : -P) - 1.),
             1e-6);
    }
  std::printf("isotropic strength in any direction\n");
  double worst = 0.;
  for (int k = 0; k < 50; ++k)
    {
      Clay         clay(0., {A, 1., 1., .02, .02, .02, 400., .45, 1e9});
      const double rr = std::sin(1. + k), zz = std::cos(3. * k),
                   rz = std::sin(7. * k), d = 1e-4;
      for (int i = 0; i < 2000; ++i)
        clay.strain(d * rr, d * zz, -d * (rr + zz), d * rz);
      raise(worst, std::fabs(clay.largest_shear() / A - 1.));
    }
  report("Tresca", worst, 1e-6);
}

/** Unloading is elastic until it mobilizes as much strength on the other side.
 */
void
test_unloading()
{
  std::printf("unloading\n");
  Clay clay(6e3);
  for (int i = 0; i < 1000; ++i)
    clay.strain(2e-6, -4e-6, 2e-6, 0.);
  const double loaded = clay.tau(), x = clay.state.variable[0][0],
               kappa = 2. * x / (1. + x * x);
  clay.strain(-2e-5, 4e-5, -2e-5, 0.);
  report("stiffness", std::fabs((loaded - clay.tau()) / (6e-5 * G) - 1.), 1e-9);
  while (clay.state.variable[0][0] == x)
    clay.strain(-2e-7, 4e-7, -2e-7, 0.);
  report("elastic range",
         std::fabs((loaded - clay.tau()) / (kappa * (A + P)) - 1.),
         1e-3);
}

/** The nearest principal stresses whose differences are at most @p most, by
 * Dykstra's alternating projections on the six half spaces. */
void
project(double (&e)[3], const double most)
{
  double moved[3][3] = {};
  for (int cycle = 0; cycle < 40; ++cycle)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (i != j)
          {
            e[i] += moved[i][j];
            e[j] -= moved[i][j];
            moved[i][j] = .5 * std::max(0., e[i] - e[j] - most);
            e[i] -= moved[i][j];
            e[j] += moved[i][j];
          }
}

/** The state of an independent integration in tensors, with tiny steps: the
 * plastic strain is that of the nearest admissible stress, and hardening
 * follows by bisection, with the center of the surface at the start of the
 * step. */
struct Reference
{
  double s[4], tau_0, share = 0.; // rr, zz, tt, rz; x^2

  Reference(const double tau_0)
    : s{-1e5 + tau_0, -1e5 - tau_0, -1e5 + tau_0, 0.}
    , tau_0(tau_0)
  {}

  double
  kappa() const
  {
    return share < 1. ? 2. * std::sqrt(share) / (1. + share) : 1.;
  }

  static double
  tresca(const double (&e)[3])
  {
    return .5 * (*std::max_element(e, e + 3) - *std::min_element(e, e + 3));
  }

  /** At @p a, the deviator along z from the center over the strength used. */
  double
  failure_strain(const double a) const
  {
    const double of_shear = .5 * (A + P) / D * (of_D - D / G),
                 x        = std::max(-1., std::min(1., a));
    return of_shear +
           x * x *
             ((x > 0. ? of_A - (A - tau_0) / G : of_P - (P + tau_0) / G) -
              of_shear);
  }

  void
  strain(const double (&de)[4])
  {
    const double lambda = 2. * G * .49 / .02, volume = de[0] + de[1] + de[2],
                 n = .5 * (A + P) / D,
                 c = (1. - kappa()) * tau_0 + kappa() * .5 * (A - P);
    for (int i = 0; i < 4; ++i)
      s[i] += 2. * G * de[i] + (i < 3 ? lambda * volume : 0.);
    // the stress from the center, with scaled shear
    const double rr = s[0] - 2. / 3. * c, zz = s[1] + 4. / 3. * c,
                 tt = s[2] - 2. / 3. * c, rz = n * s[3],
                 middle   = .5 * (rr + zz),
                 radius   = std::hypot(.5 * (rr - zz), rz);
    const double trial[3] = {middle + radius, middle - radius, tt};
    const double before   = share,
                 failure =
                   failure_strain(((rr + zz + tt) / 3. - zz) / tresca(trial));
    double     e[3];
    const auto excess = [&](const double plastic) {
      share = before + plastic / failure;
      std::copy(trial, trial + 3, e);
      project(e, kappa() * (A + P));
      double p[3];
      for (int i = 0; i < 3; ++i)
        p[i] = trial[i] - e[i];
      return tresca(p) / G - plastic;
    };
    if (excess(0.) <= 0.)
      return;
    double low = 0., high = tresca(trial) / G;
    for (int i = 0; i < 40; ++i)
      (excess(.5 * (low + high)) > 0. ? low : high) = .5 * (low + high);
    const double scale = .5 * (e[0] - e[1]) / radius;
    s[0] = .5 * (e[0] + e[1]) + scale * .5 * (rr - zz) + 2. / 3. * c;
    s[1] = .5 * (e[0] + e[1]) - scale * .5 * (rr - zz) - 4. / 3. * c;
    s[2] = e[2] + 2. / 3. * c;
    s[3] = scale * rz / n;
  }
};

void
test_in_the_plane()
{
  constexpr double paths[4][4] = {{1., -1., 0., 0.},
                                  {.1, -.2, .05, .5},
                                  {-.4, -.5, .8, .3},
                                  {-.7, .6, .1, -.3}};
  for (const auto &path : paths)
    for (const double tau_0 : {0., 9e3})
      {
        std::printf("strain in the plane %.2f %.2f %.2f %.2f, tau_0 = %.0f "
                    "kPa\n",
                    path[0],
                    path[1],
                    path[2],
                    path[3],
                    tau_0 / 1e3);
        Clay      clay(tau_0);
        Reference exact(tau_0);
        report("stress over strength",
               largest_difference(
                 clay, exact, path, .03, 600, 4, []() { return A; }),
               1e-2);
      }
}

void
test_all_directions()
{
  std::printf("plane strain in 24 directions\n");
  double worst = 0.;
  for (int k = 0; k < 24; ++k)
    {
      Clay         clay(0., {A, D / A, P / A, .01, .02, .03, 400., .49, 1e9});
      const double angle = 2. * k / 24. * std::acos(-1.);
      for (int i = 0; i < 4000; ++i)
        clay.strain(2e-5 * std::cos(angle),
                    -2e-5 * std::cos(angle),
                    0.,
                    2e-5 * std::sin(angle));
      const double h     = clay.tau() - .5 * (A - P),
                   share = std::hypot(h / (.5 * (A + P)), clay.sigma.rz[0] / D);
      raise(worst, std::fabs(share - 1.));
    }
  report("strength on the ellipse", worst, 1e-6);
}

/** A stress on the axis of K0, and one that is off it, which begins within a
 * larger surface. */
void
test_at_rest()
{
  std::printf("at rest\n");
  double worst = 0.;
  for (const double shear : {0., 3e3, -8e3})
    for (const double hoop : {0., 4e3, -4e3})
      {
        Clay clay(6e3);
        clay.sigma.rz                    = Scalar(shear);
        clay.sigma.tt                    = clay.sigma.tt + Scalar(hoop);
        const StressState<Scalar> before = clay.sigma;
        for (int i = 0; i < 3; ++i)
          clay.strain(0., 0., 0., 0.);
        raise(worst, std::fabs((clay.sigma.rr - before.rr)[0]) / A);
        raise(worst, std::fabs((clay.sigma.tt - before.tt)[0]) / A);
        raise(worst, std::fabs((clay.sigma.rz - before.rz)[0]) / A);
      }
  report("stress stays", worst, 1e-9);
}

void
test_tension()
{
  std::printf("tension\n");
  Clay clay(6e3, 0.);
  for (int i = 0; i < 400; ++i)
    clay.strain(1e-4, 3e-4, 1e-4, 2e-5);
  report("none", clay.sigma.zz[0] / A, 1e-9);
  report("torn soil bears nothing",
         std::fabs(clay.sigma.rr[0]) / A + clay.largest_shear() / A,
         1e-3);
  report("growth of the volume is plastic",
         std::fabs(clay.state.plastic_volumetric[0] / .2 - 1.),
         2e-2);
  for (int i = 0; i < 100; ++i)
    clay.strain(1e-4, -4e-4, 1e-4, 0.);
  report("bears again", std::fabs(clay.largest_shear() / A - 1.), 1e-3);
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
          Clay clay(1e3 * (k % 20) - 5e3, 1e3 * (k % 3));
          for (int i = 0; i < 20; ++i)
            {
              const auto part = [&](const int m) {
                return size * std::sin(1. + 7. * k + 3. * i + 2.3 * m);
              };
              clay.strain(part(0), part(1), part(2), part(3));
              const double x = clay.state.variable[0][0];
              raise(worst, clay.largest_shear() / (A * 1.08) - 1.);
              raise(worst, x >= 0. && x <= 1. ? 0. : 1.);
            }
        }
      report("within the strength", worst, 0.);
    }
  std::printf("lanes\n");
  using Eight = Lanes<8>;
  double             zz[8], rz[8], worst = 0.;
  StressState<Eight> sigma;
  LawState<Eight>    state;
  Clay               single(0.);
  for (int i = 0; i < 8; ++i)
    {
      zz[i] = -1e5 - 2e3 * i;
      rz[i] = 1e3 * i;
    }
  sigma                    = {-1e5, Eight::load(zz), -9.9e4, Eight::load(rz)};
  state.plastic_deviatoric = state.plastic_volumetric = Eight(0.);
  state.variable[0]                                   = Eight(-1.);
  state.variable[1]                                   = Eight(0.);
  for (int k = 0; k < 5; ++k)
    Law::update(sigma,
                StrainIncrement<Eight>{1e-4, -2e-4, 1e-5, 1e-4},
                state,
                single.parameters);
  for (int i = 0; i < 8; ++i)
    {
      Clay one(0.);
      one.sigma = {-1e5, zz[i], -9.9e4, rz[i]};
      for (int k = 0; k < 5; ++k)
        one.strain(1e-4, -2e-4, 1e-5, 1e-4);
      raise(worst, std::fabs(sigma.zz[i] / one.sigma.zz[0] - 1.));
      raise(worst,
            std::fabs(state.variable[0][i] / one.state.variable[0][0] - 1.));
    }
  report("as single points", worst, 1e-9);
}

void
test_check()
{
  const auto ask = [](const char                         *what,
                      const std::initializer_list<double> values,
                      const double                        k0) {
    LawMessage message;
    std::printf("%s: %s\n",
                what,
                Law::check(read_parameters<Law>(values.begin()),
                           {k0, 1., 6e4},
                           message) ?
                  "taken" :
                  message.text);
  };
  // (1 - K0) / (1 + 2 K0) times 90 kPa, and A is 20 kPa, P 9 kPa
  const double values[] = {A, .7, .45, of_A, of_D, of_P, 400., .49, 0.};
  ask("K0 = 0.6", {A, .7, .45, of_A, of_D, of_P, 400., .49, 0.}, .6);
  for (const double k0 : {.54, .53, 1.37, 1.38})
    {
      const double vertical = 3. * 6e4 / (1. + 2. * k0);
      std::printf(
        "K0 = %.2f: %s\n",
        k0,
        Law::bears<Lanes<1>>({-k0 * vertical, -vertical, -k0 * vertical, 0.},
                             1.,
                             read_parameters<Law>(values)) ?
          "borne" :
          "too much");
    }
  ask("strain", {A, .7, .45, of_A, .001, of_P, 400., .49, 0.}, 1.);
}

int
main()
{
  test_check();
  test_triaxial();
  test_direct_shear();
  test_plane_strain();
  test_unloading();
  test_in_the_plane();
  test_all_directions();
  test_at_rest();
  test_tension();
  test_robust();
}
