// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the tests of the material laws share: an element test with one point,
// and how errors are collected and reported.
#ifndef caisson_mpm_tests_law_test_h
#define caisson_mpm_tests_law_test_h

#include <caisson_mpm/kernels/material_law.h>

#include <cmath>
#include <cstdio>
#include <initializer_list>

using namespace CaissonMPM::Kernels;
using Scalar = Lanes<1>;

constexpr double degrees = 180. / 3.14159265358979323846;

inline void
report(const char *name, const double error, const double tolerance)
{
  if (error <= tolerance)
    std::printf("%s <= %.0e: yes\n", name, tolerance);
  else
    std::printf("%s <= %.0e: NO, %.2e\n", name, tolerance, error);
}

inline void
raise(double &largest, const double value)
{
  // a NaN must fail, and must stay
  if (!std::isnan(largest) && !(value <= largest))
    largest = value;
}

/** The parameters of a law for the values of its entries. */
template <typename Law>
typename Law::Parameters
parameters_of(const std::initializer_list<double> values)
{
  return read_parameters<Law>(values.begin());
}

/** Strain soil along a straight @p path (rr, zz, tt, rz) to @p size times it, in
 * @p n steps, and an independent reference, with @p finer as many. Return the
 * largest difference of their stresses over scale(). */
template <typename Soil, typename Reference, typename Scale>
double
largest_difference(Soil      &soil,
                   Reference &exact,
                   const double (&path)[4],
                   const double size,
                   const int    n,
                   const int    finer,
                   const Scale &scale)
{
  double worst = 0.;
  for (int i = 0; i < n; ++i)
    {
      double de[4];
      for (int k = 0; k < 4; ++k)
        de[k] = path[k] * size / n / finer;
      for (int k = 0; k < finer; ++k)
        exact.strain(de);
      soil.strain(StrainIncrement<Scalar>{path[0] * size / n,
                                          path[1] * size / n,
                                          path[2] * size / n,
                                          path[3] * size / n});
      const double own[4] = {soil.sigma.rr[0],
                             soil.sigma.zz[0],
                             soil.sigma.tt[0],
                             soil.sigma.rz[0]};
      for (int k = 0; k < 4; ++k)
        raise(worst, std::fabs(own[k] - exact.s[k]) / scale());
    }
  return worst;
}

/** Where the error is zero within the tolerance, by secants from a and b. */
template <typename Error>
double
root(const Error &error, double a, double b, const double tolerance)
{
  double f_a = error(a), f_b = error(b);
  for (int i = 0; i < 60 && std::fabs(f_b) > tolerance && f_a != f_b; ++i)
    {
      const double c = b - f_b * (b - a) / (f_b - f_a);
      a              = b;
      f_a            = f_b;
      b              = c;
      f_b            = error(b);
    }
  return b;
}

/** One point under strain, and the means to hold its lateral stress. */
template <typename Law>
class Sample
{
public:
  typename Law::Parameters parameters;
  double                   lateral, axial; // stress, tension positive
  double                   void_ratio                  = 1.;
  double                   plastic                     = 0.;
  double                   variable[n_state_variables] = {}; // of its state

  Sample(const typename Law::Parameters &parameters,
         const double                    pressure,
         const double                    void_ratio)
    : parameters(parameters)
    , lateral(-pressure)
    , axial(-pressure)
    , void_ratio(void_ratio)
  {
    Law::start(parameters, variable);
  }

  void
  strain(const double d_lateral, const double d_axial)
  {
    StressState<Scalar> sigma{lateral, axial, lateral, 0.};
    LawState<Scalar>    state;
    state.plastic_deviatoric = Scalar(plastic);
    state.plastic_volumetric = Scalar(0.);
    state.void_ratio         = Scalar(void_ratio);
    for (int i = 0; i < n_state_variables; ++i)
      state.variable[i] = Scalar(variable[i]);
    Law::update(sigma,
                StrainIncrement<Scalar>{d_lateral, d_axial, d_lateral, 0.},
                state,
                parameters);
    lateral = sigma.rr[0];
    axial   = sigma.zz[0];
    plastic = state.plastic_deviatoric[0];
    for (int i = 0; i < n_state_variables; ++i)
      variable[i] = state.variable[i][0];
    // the volume of a point grows with exp(tr D) as steps become small
    void_ratio = (1. + void_ratio) * std::exp(2. * d_lateral + d_axial) - 1.;
  }

  /** The lateral strain that leads to this lateral stress, by secants. */
  double
  strain_at_lateral_stress(const double wanted, const double d_axial)
  {
    const auto error = [&](const double x) {
      Sample copy = *this;
      copy.strain(x, d_axial);
      return copy.lateral - wanted;
    };
    const double d =
      root(error, -0.2 * d_axial, -0.6 * d_axial, 1e-10 * std::fabs(wanted));
    strain(d, d_axial);
    return d;
  }
};

#endif
