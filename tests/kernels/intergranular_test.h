// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the tests of the intergranular strain share: a point, its strain, and
// its stiffness with and without intergranular strain.
#ifndef caisson_mpm_tests_intergranular_test_h
#define caisson_mpm_tests_intergranular_test_h

#include <caisson_mpm/kernels/hypoplastic_intergranular.h>

#include "law_test.h"

using Law    = HypoplasticIntergranular;
using Stress = StressState<Scalar>;



constexpr double range = 1e-4, m_R = 5., m_T = 2.;



struct Point
{
  Stress stress{-5e4, -1e5, -6e4, 1e4}, memory{0., 0., 0., 0.};
  double void_ratio = .6;
};



inline Law::Parameters
parameters(const double evolution = .5)
{
  const double values[] = {30.,
                           5.8e9,
                           .28,
                           .53,
                           .84,
                           1.,
                           .13,
                           1.05,
                           1.,
                           range,
                           m_R,
                           m_T,
                           evolution,
                           6.,
                           0.};
  return read_parameters<Law>(values);
}



inline Stress
times(const double factor, const Stress &a)
{
  return {factor * a.rr, factor * a.zz, factor * a.tt, factor * a.rz};
}



inline Stress
minus(const Stress &a, const Stress &b)
{
  return {a.rr - b.rr, a.zz - b.zz, a.tt - b.tt, a.rz - b.rz};
}



inline double
product(const Stress &a, const Stress &b)
{
  return (a.rr * b.rr + a.zz * b.zz + a.tt * b.tt + 2. * (a.rz * b.rz))[0];
}



inline double
norm(const Stress &a)
{
  return std::sqrt(product(a, a));
}



inline double
difference(const Stress &a, const Stress &b)
{
  return norm(minus(a, b)) / norm(b);
}



inline void
strain(Point &point, const Stress &D, const Law::Parameters &p)
{
  LawState<Scalar> state;
  state.plastic_deviatoric = state.plastic_volumetric = Scalar(0.);
  state.void_ratio         = Scalar(point.void_ratio);
  const Stress &h          = point.memory;
  const Scalar  variable[] = {h.rr, h.zz, h.tt, h.rz};
  for (int i = 0; i < 4; ++i)
    state.variable[i] = variable[i];
  Law::update(point.stress, {D.rr, D.zz, D.tt, D.rz}, state, p);
  point.void_ratio += (1. + point.void_ratio) * (D.rr + D.zz + D.tt)[0];
  point.memory = {state.variable[0],
                  state.variable[1],
                  state.variable[2],
                  state.variable[3]};
}



/** The stress increment for a tiny strain @p D, over its length. */
inline Stress
stiffness(const Point &at, const Stress &D, const Law::Parameters &p)
{
  constexpr double tiny  = 1e-11;
  Point            point = at;
  strain(point, times(tiny, D), p);
  return times(1. / tiny, minus(point.stress, at.stress));
}



/** The same without intergranular strain, if the length of D counts as much as
 * @p nonlinear says: 1, or 0 for the linear part L alone. */
inline Stress
stiffness_without(const Point           &at,
                  const Stress          &D,
                  const Law::Parameters &p,
                  const double           nonlinear = 1.)
{
  return Law::stress_increment(Law::shifted(at.stress, -p.shift),
                               Scalar(at.void_ratio),
                               D,
                               Scalar(nonlinear * norm(D)),
                               p);
}

/** L alone. */
inline Stress
linear_stiffness(const Point &at, const Stress &D, const Law::Parameters &p)
{
  return stiffness_without(at, D, p, 0.);
}

#endif
