// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the tests of MohrCoulomb share: a stress as plain numbers, random
// stresses, and the kernel on one and on eight points.
#ifndef caisson_mpm_tests_mohr_coulomb_test_h
#define caisson_mpm_tests_mohr_coulomb_test_h

#include <caisson_mpm/kernels/linear_elastic.h>
#include <caisson_mpm/kernels/mohr_coulomb.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "koiter_reference.h"
#include "law_test.h"

/** The components of StressState and StrainIncrement, as plain numbers. */
struct Tensor
{
  double rr, zz, tt, rz;
};



constexpr double stress_scale  = 1e5;
constexpr double angle_per_deg = 3.14159265358979323846 / 180.;



inline MohrCoulomb::Parameters
parameters_of(const Soil &soil)
{
  return parameters_of<MohrCoulomb>({E,
                                     soil.nu,
                                     soil.phi * degrees,
                                     soil.psi * degrees,
                                     soil.cohesion,
                                     soil.tension,
                                     no_limit});
}



inline Tensor
rotated(const Tensor &a, const double angle)
{
  const double c = std::cos(2. * angle), s = std::sin(2. * angle);
  const double center = 0.5 * (a.rr + a.zz), half = 0.5 * (a.rr - a.zz);
  return {center + c * half + s * a.rz,
          center - c * half - s * a.rz,
          a.tt,
          c * a.rz - s * half};
}



inline double
magnitude(const Tensor &a)
{
  return std::max(std::max(std::fabs(a.rr), std::fabs(a.zz)),
                  std::max(std::fabs(a.tt), std::fabs(a.rz)));
}



inline double
distance(const Tensor &a, const Tensor &b)
{
  return magnitude({a.rr - b.rr, a.zz - b.zz, a.tt - b.tt, a.rz - b.rz});
}



struct Result
{
  Tensor stress;
  double deviatoric, volumetric;
};



/** The kernel on one point; the plastic strains start from zero. */
template <typename Law>
Result
update(const Tensor                   &old_stress,
       const Tensor                   &increment,
       const typename Law::Parameters &parameters)
{
  StressState<Scalar>           sigma{old_stress.rr,
                            old_stress.zz,
                            old_stress.tt,
                            old_stress.rz};
  const StrainIncrement<Scalar> de{increment.rr,
                                   increment.zz,
                                   increment.tt,
                                   increment.rz};
  LawState<Scalar>              state;
  state.plastic_deviatoric = state.plastic_volumetric = Scalar(0.);
  state.void_ratio                                    = Scalar(0.);
  Law::update(sigma, de, state, parameters);
  return {{sigma.rr[0], sigma.zz[0], sigma.tt[0], sigma.rz[0]},
          state.plastic_deviatoric[0],
          state.plastic_volumetric[0]};
}



/**
 * The kernel on eight points at once; the plastic strains start from @p offset,
 * which must be added to and not overwritten.
 */
inline std::array<Result, 8>
update_lanes(const std::array<Tensor, 8>   &old_stress,
             const std::array<Tensor, 8>   &increment,
             const MohrCoulomb::Parameters &parameters,
             const double                   offset)
{
  using Number      = Lanes<8>;
  const auto gather = [](const std::array<Tensor, 8> &from,
                         double Tensor::*const component) {
    double values[8];
    for (unsigned int l = 0; l < 8; ++l)
      values[l] = from[l].*component;
    return Number::load(values);
  };
  StressState<Number>           sigma{gather(old_stress, &Tensor::rr),
                            gather(old_stress, &Tensor::zz),
                            gather(old_stress, &Tensor::tt),
                            gather(old_stress, &Tensor::rz)};
  const StrainIncrement<Number> de{gather(increment, &Tensor::rr),
                                   gather(increment, &Tensor::zz),
                                   gather(increment, &Tensor::tt),
                                   gather(increment, &Tensor::rz)};
  LawState<Number>              state;
  state.plastic_deviatoric = state.plastic_volumetric = Number(offset);
  MohrCoulomb::update(sigma, de, state, parameters);
  std::array<Result, 8> result;
  for (unsigned int l = 0; l < 8; ++l)
    result[l] = {{sigma.rr[l], sigma.zz[l], sigma.tt[l], sigma.rz[l]},
                 state.plastic_deviatoric[l] - offset,
                 state.plastic_volumetric[l] - offset};
  return result;
}



/** The linear elastic stress after a strain increment. */
inline Tensor
elastic_stress(const Soil &soil, const Tensor &old, const Tensor &increment)
{
  const Vector normal =
    stiffness(soil, {{increment.rr, increment.zz, increment.tt}});
  return {old.rr + normal[0],
          old.zz + normal[1],
          old.tt + normal[2],
          old.rz + E / (1. + soil.nu) * increment.rz};
}



/**
 * A stress of random size and mean. Some states are degenerate: isotropic in
 * the plane, isotropic, or with two equal principal stresses.
 */
inline Tensor
random_stress(std::mt19937 &generator, const unsigned int number)
{
  const auto uniform = [&generator]() {
    return generator() / 4294967296. * 2. - 1.;
  };
  const double size   = stress_scale * std::pow(100., -0.5 * (1. + uniform()));
  const double center = size * (uniform() - 0.3);
  Tensor       stress{center + size * uniform(),
                center + size * uniform(),
                center + size * uniform(),
                size * uniform()};
  switch (number % 16)
    {
      case 0:
        stress.zz = stress.rr;
        stress.rz = 0.;
        break;
      case 1:
        stress.zz = stress.tt = stress.rr;
        stress.rz             = 0.;
        break;
      case 2:
        stress.tt = stress.rr;
        stress.rz = 0.;
        break;
      default:
        break;
    }
  return stress;
}

#endif
