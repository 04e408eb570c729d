// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Element tests whose numbers or closed forms others have published.
//
// ModifiedCamClay: the lightly and the heavily overconsolidated sample of
// Itasca's verification problem "Drained and undrained triaxial compression
// test on a Cam-clay sample" (FLAC3D 9.0) against the critical states of Wood
// (1990), Soil behaviour and critical state soil mechanics; and the stress over
// shear strain of the undrained test, which has a closed form for a constant
// Poisson ratio (as in D. Peric, B. R. Shah, M. A. Onyango (2006), Analytical
// solutions for a three-invariant original Cam clay model. EJGE).
//
// NorSand: a drained triaxial test of loose sand computed by NorTxl, the
// spreadsheet with Jefferies & Been (2015), Soil liquefaction, as the table
// Drained_verification/Benchmark.csv of github.com/luisez1988/NorSand-VT has
// it. Gamma, lambda, N, chi, M and the Poisson ratio are those beside the
// table. G = 71.5 MPa (p / 500 kPa)^0.4 and H = 50 follow from its rows, where
// the parameters beside it name 40.
//
// NgiAdp: in plane strain the strength of any direction is on an ellipse (E. H.
// Davis, J. T. Christian (1971), Bearing capacity of anisotropic cohesive soil.
// J. Soil Mech. Found. Div. ASCE 97, 753-769), as that of NGI-ADP at failure.
#include <caisson_mpm/kernels/modified_cam_clay.h>
#include <caisson_mpm/kernels/ngi_adp.h>
#include <caisson_mpm/kernels/nor_sand.h>

#include "law_test.h"

namespace CamClay
{
  constexpr double M = 1.02, lambda = .2, kappa = .05, v_lambda = 3.32,
                   p_1 = 1e3, p_0 = 5e3, nu = .3,
                   Lambda = (lambda - kappa) / lambda;
  const double phi_c      = std::asin(3. * M / (6. + M)) * degrees,
               Gamma      = v_lambda - (lambda - kappa) * std::log(2.);

  double
  specific_volume(const double ratio)
  {
    return v_lambda - lambda * std::log(ratio * p_0 / p_1) +
           kappa * std::log(ratio);
  }

  SoilPoint<ModifiedCamClay>
  sample(const double ratio)
  {
    return {{lambda, kappa, nu, phi_c, ratio, 1.},
            p_0,
            specific_volume(ratio) - 1.};
  }

  /** The shear strain of the undrained test at a stress ratio on the yield
   * surface, but for a constant. */
  double
  shear_strain(const double eta, const double v)
  {
    const double G_over_K = 1.5 * (1. - 2. * nu) / (1. + nu),
                 angle    = std::atan(eta / M),
                 elastic =
                   (eta - 2. * Lambda * (eta - M * angle)) / (3. * G_over_K),
                 plastic =
                   Lambda / M *
                   (std::log((M + eta) / std::fabs(M - eta)) - 2. * angle);
    return kappa / v * (elastic + plastic);
  }

  void
  test_undrained(const double ratio)
  {
    SoilPoint<ModifiedCamClay> clay = sample(ratio);
    const double v = specific_volume(ratio), yield = M * std::sqrt(ratio - 1.),
                 at_yield =
                   kappa * yield * (1. + nu) / (4.5 * (1. - 2. * nu)) / v;
    double worst = 0.;
    for (int i = 1; i <= 100000; ++i)
      {
        constexpr double d = 1e-5;
        clay.strain({d / 2., -d, d / 2., 0.});
        const double eta = clay.q() / clay.p();
        if (clay.state.plastic_deviatoric[0] > 0. && std::fabs(eta - M) > .01)
          raise(worst,
                std::fabs(
                  (at_yield + shear_strain(eta, v) - shear_strain(yield, v)) /
                    (i * d) -
                  1.));
      }
    const double p = p_1 * std::exp((Gamma - v) / lambda);
    std::printf("undrained, p %.3f kPa, q %.3f kPa\n", p / 1e3, M * p / 1e3);
    report("shear strain", worst, 5e-3);
    report("p", std::fabs(clay.p() / p - 1.), 1e-3);
    report("q", std::fabs(clay.q() / (M * p) - 1.), 1e-3);
  }

  void
  test_drained(const double ratio)
  {
    SoilPoint<ModifiedCamClay> clay = sample(ratio);
    for (int i = 0; i < 60000; ++i)
      clay.compress(-2e-5);
    const double p = 3. * p_0 / (3. - M),
                 v = Gamma - lambda * std::log(p / p_1);
    std::printf("drained, p %.3f kPa, q %.3f kPa, v %.4f\n",
                p / 1e3,
                M * p / 1e3,
                v);
    report("p", std::fabs(clay.p() / p - 1.), 2e-3);
    report("q", std::fabs(clay.q() / (M * p) - 1.), 2e-3);
    report("v", std::fabs(clay.specific_volume() - v), 2e-3);
  }
} // namespace CamClay

void
test_nor_sand()
{
  std::printf("NorSand, drained\n");
  constexpr double M = 1.45, lambda = .048 / 2.3, Gamma = .875, p_0 = 500e3,
                   nu = .15, E = 2. * (1. + nu) * 71.5e6;
  const double       phi_c = std::asin(3. * M / (6. + M)) * degrees;
  SoilPoint<NorSand> sand(
    {E, nu, phi_c, Gamma, lambda, .43, 3.4, 50., 1., p_0, .4, 1e3},
    p_0,
    .853303831);
  // axial strain of the first length, q (kPa) and void ratio
  constexpr double rows[5][3] = {{.00999910064, 280.0399626, .839218566},
                                 {.02050402823, 458.0317723, .827580933},
                                 {.05964341793, 793.8299766, .798239297},
                                 {.06808218795, 837.8611536, .793541473},
                                 {.2170712864, 1239.873215, .747313955}};
  double           reached    = 0.;
  for (const auto &row : rows)
    {
      const double  wanted = -std::log(1. - row[0]);
      constexpr int n      = 2000;
      for (int i = 0; i < n; ++i)
        sand.compress((reached - wanted) / n);
      reached = wanted;
      std::printf("axial strain %.4f\n", row[0]);
      report("q", std::fabs(sand.q() / (1e3 * row[1]) - 1.), 2e-3);
      report("void ratio", std::fabs(sand.state.void_ratio[0] - row[2]), 2e-4);
    }
}

void
test_ngi_adp()
{
  std::printf("NGI-ADP, plane strain in 24 directions\n");
  constexpr double A = 20e3, D = 14e3, P = 8e3;
  double           worst = 0.;
  for (int k = 0; k < 24; ++k)
    {
      SoilPoint<NgiAdp> clay({A, D / A, P / A, .01, .02, .03, 400., .49, 1e9},
                             1e5,
                             1.);
      const double      angle = 2. * k / 24. * std::acos(-1.);
      for (int i = 0; i < 4000; ++i)
        clay.strain({2e-5 * std::cos(angle),
                     -2e-5 * std::cos(angle),
                     0.,
                     2e-5 * std::sin(angle)});
      const double h = .5 * (clay.sigma.rr - clay.sigma.zz)[0] - .5 * (A - P),
                   share = std::hypot(h / (.5 * (A + P)), clay.sigma.rz[0] / D);
      raise(worst, std::fabs(share - 1.));
    }
  report("strength on the ellipse", worst, 1e-6);
}

int
main()
{
  for (const double ratio : {1.6, 8.})
    {
      std::printf("modified Cam clay, overconsolidation ratio %.1f\n", ratio);
      CamClay::test_undrained(ratio);
      CamClay::test_drained(ratio);
    }
  test_nor_sand();
  test_ngi_adp();
}
