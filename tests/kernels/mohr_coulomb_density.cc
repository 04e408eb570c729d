// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The law MohrCoulombDensity in element tests: drained triaxial compression
// against an independent integration; shearing at constant volume, and drained
// simple shear, which end in the critical state if the sand is denser;
// stiffness by stress and density; a gap that closes without stress.
#include <caisson_mpm/kernels/mohr_coulomb_density.h>

#include <initializer_list>

#include "law_test.h"

using Law = MohrCoulombDensity;

constexpr double phi_c = 33., e_min = 0.6, e_max = 1., Q = 9.8, per_index = 3.2,
                 p_s = 8e4, E = 5e7, nu = 0.2, exponent = 0.4, e_r = 0.7;
constexpr double sand[] =
  {E, nu, phi_c, e_min, e_max, Q, per_index, p_s, 1e5, exponent, 1e3, e_r};

/** Bolton's dilatancy index at the mean stress p (Pa), from 0 to 4. */
double
index_of(const double e, const double p)
{
  const double density = (e_max - e) / (e_max - e_min);
  return std::fmin(
    std::fmax(density * (Q - std::log(std::fmax(p, p_s) / 1e3)) - 1., 0.), 4.);
}

/** The void ratio of the critical state. */
double
critical_void_ratio(const double p)
{
  return e_max - (e_max - e_min) / (Q - std::log(std::fmax(p, p_s) / 1e3));
}

double
hardin(const double e)
{
  return (2.17 - e) * (2.17 - e) / (1. + e);
}

struct Triaxial
{
  double q_peak, q, void_ratio;
};

/**
 * Triaxial compression to the axial strain @p strain: elastic to the yield
 * stress, which then is the deviator at each void ratio, and follows it.
 */
Triaxial
integrate(const double pressure, const double e_0, const double strain)
{
  constexpr int n = 400000;
  const double  d = strain / n;
  double        q = 0., e = e_0, largest = 0.;
  const auto    yield = [&](const double p) {
    const double s = std::sin((phi_c + per_index * index_of(e, p)) / degrees);
    return 2. * s / (1. - s) * pressure;
  };
  for (int i = 0; i < n; ++i)
    {
      const double p = pressure + q / 3.;
      const double modulus =
        E * std::pow(p / 1e5, exponent) * hardin(e) / hardin(e_r);
      const double elastic_q = q + modulus * d,
                   new_q     = std::fmin(elastic_q, yield(p));
      const double elastic = (new_q - q) / modulus, index = index_of(e, p),
                   growth = .3 * index;
      // compression of the elastic part, growth of the plastic one
      const double volume = -(1. - 2. * nu) * elastic + growth * (d - elastic);
      e += (1. + e) * volume;
      q       = new_q;
      largest = std::fmax(largest, q);
    }
  return {largest, q, e};
}

void
test_triaxial()
{
  for (const double e : {0.65, 0.8, 0.95})
    for (const double pressure : {5e4, 4e5, 3e6})
      {
        std::printf("triaxial compression, e = %.2f, %.0f kPa\n",
                    e,
                    pressure / 1e3);
        constexpr double strain = .2;
        constexpr int    n      = 8000;
        Sample<Law>      sample(read_parameters<Law>(sand), pressure, e);
        double           q_peak = 0.;
        for (int i = 0; i < n; ++i)
          {
            sample.strain_at_lateral_stress(-pressure, -strain / n);
            raise(q_peak, -sample.axial - pressure);
          }
        const Triaxial exact = integrate(pressure, e, strain);
        report("peak", std::fabs(q_peak / exact.q_peak - 1.), 3e-3);
        report("end",
               std::fabs((-sample.axial - pressure) / exact.q - 1.),
               3e-3);
        report("void ratio",
               std::fabs(sample.void_ratio - exact.void_ratio),
               2e-3);
      }
}

void
test_constant_volume()
{
  constexpr double e        = 0.92; // a relative density of 0.2
  const double     critical = 1e3 * std::exp(Q - (e_max - e_min) / (e_max - e)),
               s            = std::sin(phi_c / degrees);
  for (const double start : {.3, 3.})
    {
      std::printf("constant volume, from %.1f of the critical stress\n", start);
      Sample<Law> sample(read_parameters<Law>(sand), start * critical, e);
      for (int i = 0; i < 40000; ++i)
        sample.strain(2.5e-5, -5e-5);
      const double p = -(sample.axial + 2. * sample.lateral) / 3.,
                   q = sample.lateral - sample.axial;
      // looser sand keeps its stress
      report("mean stress",
             std::fabs(p / critical / std::fmax(1., start) - 1.),
             1e-2);
      report("ratio", std::fabs(q / p / (6. * s / (3. - s)) - 1.), 2e-3);
    }
}

void
test_simple_shear()
{
  for (const double e : {0.65, 0.95})
    {
      std::printf("drained simple shear, e = %.2f\n", e);
      constexpr double    vertical = 1e5, step = 1e-4;
      StressState<Scalar> sigma{-5e4, -vertical, -5e4, 0.};
      LawState<Scalar>    state;
      state.plastic_deviatoric = state.plastic_volumetric = Scalar(0.);
      state.void_ratio                                    = Scalar(e);
      const Law::Parameters p      = read_parameters<Law>(sand);
      double                height = 0.;
      for (int i = 0; i < 30000; ++i)
        {
          const auto sheared = [&](const double growth) {
            StressState<Scalar> s = sigma;
            LawState<Scalar>    l = state;
            Law::update(s, {0., growth, 0., .5 * step}, l, p);
            return s;
          };
          // the vertical strain that keeps the vertical stress, by a secant
          double a = height, b = height + .1 * step,
                 f_a = sheared(a).zz[0] + vertical,
                 f_b = sheared(b).zz[0] + vertical;
          for (int k = 0; k < 20 && std::fabs(f_b) > 1e-6 && f_a != f_b; ++k)
            {
              const double c = b - f_b * (b - a) / (f_b - f_a);
              a              = b;
              f_a            = f_b;
              b              = c;
              f_b            = sheared(b).zz[0] + vertical;
            }
          Law::update(sigma, {0., b, 0., .5 * step}, state, p);
          state.void_ratio =
            (Scalar(1.) + state.void_ratio) * Scalar(std::exp(b)) - Scalar(1.);
          height = b;
        }
      const double mean = -(sigma.rr[0] + sigma.zz[0] + sigma.tt[0]) / 3.;
      // looser sand is only compressed elastically
      const double K     = E / (3. * (1. - 2. * nu)) * hardin(e) / hardin(e_r),
                   power = 1. - exponent,
                   compression = (std::pow(mean / 1e5, power) -
                                  std::pow(2e5 / 3. / 1e5, power)) *
                                 1e5 / (K * power),
                   loose  = (1. + e) * (1. - compression) - 1.,
                   at_end = std::fmax(loose, critical_void_ratio(mean));
      report("void ratio", std::fabs(state.void_ratio[0] - at_end), 2e-3);
      const double center = .5 * (sigma.rr[0] + sigma.zz[0]),
                   radius =
                     std::hypot(.5 * (sigma.rr[0] - sigma.zz[0]), sigma.rz[0]);
      report("strength",
             std::fabs(radius / -center / std::sin(phi_c / degrees) - 1.),
             5e-3);
    }
}

void
test_stiffness()
{
  std::printf("stiffness\n");
  for (const double e : {0.65, 0.7, 0.9})
    for (const double pressure : {2e4, 1e5, 1e6})
      {
        constexpr double strain = 1e-7;
        Sample<Law>      sample(read_parameters<Law>(sand), pressure, e);
        sample.strain(-strain, -strain);
        const double bulk = E / (3. * (1. - 2. * nu)) *
                            std::pow(pressure / 1e5, exponent) * hardin(e) /
                            hardin(e_r);
        report("bulk modulus",
               std::fabs((-sample.axial - pressure) / (3. * bulk * strain) -
                         1.),
               1e-6);
      }
}

void
test_gap()
{
  std::printf("a gap that closes\n");
  Sample<Law> sample(read_parameters<Law>(sand), 0., e_max + 0.02);
  double      closed = 0.;
  while (sample.void_ratio > e_max + 1e-3)
    {
      sample.strain(-1e-4, -1e-4);
      raise(closed, -sample.axial);
    }
  report("its stress (Pa)", closed, 0.);
  for (int i = 0; i < 100; ++i)
    sample.strain(-1e-4, -1e-4);
  report("soil that bears none", sample.axial < -1e4 ? 0. : 1., 0.);
}

int
main()
{
  test_triaxial();
  test_constant_volume();
  test_simple_shear();
  test_stiffness();
  test_gap();
}
