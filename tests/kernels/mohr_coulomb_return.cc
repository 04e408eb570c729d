// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The laws LinearElastic and MohrCoulomb, against
//
// - an independent reference, which knows neither regions nor edges: Koiter's
//   rule by enumeration of every set of at most three active planes;
// - the defining properties: admissible stress, plastic strain in the cone of
//   the active planes' flow directions, principal axes kept, closest point
//   (associated flow), no change of a returned stress, invariance to in-plane
//   rotation, lanes equal to the scalar result;
// - closed-form strength and dilation in triaxial compression and extension.
//
// Non-associated flow has no theorem of uniqueness, so the kernel is compared
// with the nearest of the reference's solutions, and the largest distance
// between two solutions is a verdict of its own: it is round-off for all the
// parameters below, which have psi <= phi.
#include <caisson_mpm/kernels/linear_elastic.h>
#include <caisson_mpm/kernels/mohr_coulomb.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <set>
#include <vector>

#include "koiter_reference.h"
#include "law_test.h"

/** The components of StressState and StrainIncrement, as plain numbers. */
struct Tensor
{
  double rr, zz, tt, rz;
};

constexpr double stress_scale  = 1e5;
constexpr double angle_per_deg = 3.14159265358979323846 / 180.;

MohrCoulomb::Parameters
parameters_of(const Soil &soil)
{
  return MohrCoulomb::Parameters::make(
    E, soil.nu, soil.phi, soil.psi, soil.cohesion, soil.tension);
}



/** Largest errors found, and what has been visited. */
struct Verdict
{
  double       reference = 0., spread = 0., yield = 0., cone = 0., axes = 0.;
  double       strain = 0., idempotence = 0., rotation = 0., lanes = 0.;
  double       closest_point = 0.;
  unsigned int n_states = 0, no_solution = 0;
  unsigned int n_elastic = 0, n_cone_plane = 0, n_cone_edge = 0, n_apex = 0;
  unsigned int n_cutoff_plane = 0, n_cutoff_edge = 0, n_cutoff_corner = 0;
  unsigned int n_line = 0, n_line_end = 0;
};



Tensor
rotated(const Tensor &a, const double angle)
{
  const double c = std::cos(2. * angle), s = std::sin(2. * angle);
  const double center = 0.5 * (a.rr + a.zz), half = 0.5 * (a.rr - a.zz);
  return {center + c * half + s * a.rz,
          center - c * half - s * a.rz,
          a.tt,
          c * a.rz - s * half};
}



double
magnitude(const Tensor &a)
{
  return std::max(std::max(std::fabs(a.rr), std::fabs(a.zz)),
                  std::max(std::fabs(a.tt), std::fabs(a.rz)));
}



double
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
std::array<Result, 8>
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
Tensor
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
Tensor
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



/** Count a state by the number of planes of both kinds that are active. */
void
count_region(const unsigned int n_mohr_coulomb,
             const unsigned int n_tension,
             Verdict           &verdict)
{
  if (n_mohr_coulomb + n_tension == 0)
    ++verdict.n_elastic;
  else if (n_tension == 0)
    ++(n_mohr_coulomb == 1 ? verdict.n_cone_plane : verdict.n_cone_edge);
  else if (n_mohr_coulomb == 0)
    ++(n_tension == 1 ? verdict.n_cutoff_plane :
       n_tension == 2 ? verdict.n_cutoff_edge :
                        verdict.n_cutoff_corner);
  else if (n_mohr_coulomb > 2)
    ++verdict.n_apex;
  else
    ++(n_mohr_coulomb == 1 ? verdict.n_line : verdict.n_line_end);
}



/** Admissibility, reference, cone, axes and strain measures of one result. */
void
check_return(const Soil               &soil,
             const std::vector<Plane> &planes,
             const Tensor             &trial,
             const double              scale,
             const Result             &result,
             Verdict                  &verdict)
{
  // both stresses on the principal axes of the trial stress
  const double angle = 0.5 * std::atan2(2. * trial.rz, trial.rr - trial.zz);
  const Tensor trial_axes  = rotated(trial, angle);
  const Tensor stress_axes = rotated(result.stress, angle);
  raise(verdict.axes, std::fabs(stress_axes.rz) / scale);
  const Vector trial_values  = {{trial_axes.rr, trial_axes.zz, trial_axes.tt}};
  const Vector stress_values = {
    {stress_axes.rr, stress_axes.zz, stress_axes.tt}};

  unsigned int n_mohr_coulomb = 0, n_tension = 0;
  for (const Plane &plane : planes)
    {
      const double f = dot(plane.normal, stress_values) - plane.bound;
      raise(verdict.yield, f / scale);
      if (std::fabs(f) <= 1e-9 * scale)
        ++(plane.is_tension ? n_tension : n_mohr_coulomb);
    }
  ++verdict.n_states;
  count_region(n_mohr_coulomb, n_tension, verdict);

  const std::vector<Vector> solutions =
    koiter_solutions(soil, planes, trial_values, scale);
  double nearest = solutions.empty() ? 1. : 1e300;
  for (const Vector &a : solutions)
    {
      nearest = std::min(nearest, norm(difference(a, stress_values)) / scale);
      raise(verdict.spread, norm(difference(a, solutions[0])) / scale);
    }
  raise(verdict.reference, nearest);
  if (solutions.empty())
    ++verdict.no_solution;

  const Vector strain =
    compliance(soil, difference(trial_values, stress_values));
  raise(verdict.cone,
        distance_from_cone(planes, stress_values, strain, scale) * E / scale);
  const double trace = strain[0] + strain[1] + strain[2];
  const Vector deviator =
    difference(strain, {{trace / 3., trace / 3., trace / 3.}});
  raise(verdict.strain, std::fabs(result.volumetric - trace) * E / scale);
  raise(verdict.strain,
        std::fabs(result.deviatoric - std::sqrt(2. / 3.) * norm(deviator)) * E /
          scale);
}



/** Eight states of one soil and what the scalar kernel makes of them. */
struct Block
{
  std::array<Tensor, 8> old_stress, increment, trial;
  std::array<Result, 8> result;
  std::array<double, 8> scale;
};



/** A returned stress stays; rotating the problem rotates the result. */
void
check_invariance(const MohrCoulomb::Parameters &parameters,
                 const Block                   &block,
                 Verdict                       &verdict)
{
  for (unsigned int l = 0; l < 8; ++l)
    {
      const Tensor &stress = block.result[l].stress;
      const Result  again =
        update<MohrCoulomb>(stress, {0., 0., 0., 0.}, parameters);
      raise(verdict.idempotence,
            distance(again.stress, stress) / block.scale[l]);

      const double angle = 0.1 + 0.37 * l;
      const Result turned =
        update<MohrCoulomb>(rotated(block.old_stress[l], angle),
                            rotated(block.increment[l], angle),
                            parameters);
      raise(verdict.rotation,
            distance(turned.stress, rotated(stress, angle)) / block.scale[l]);
    }
}



void
check_lanes(const MohrCoulomb::Parameters &parameters,
            const Block                   &block,
            Verdict                       &verdict)
{
  const auto lanes =
    update_lanes(block.old_stress, block.increment, parameters, 1. / 64.);
  for (unsigned int l = 0; l < 8; ++l)
    {
      const Result &scalar = block.result[l];
      raise(verdict.lanes,
            distance(lanes[l].stress, scalar.stress) / block.scale[l]);
      raise(verdict.lanes, std::fabs(lanes[l].deviatoric - scalar.deviatoric));
      raise(verdict.lanes, std::fabs(lanes[l].volumetric - scalar.volumetric));
    }
}



/** (trial - s) : C : (x - s) <= 0 for the other results x of the block. */
void
check_closest_point(const Soil &soil, const Block &block, Verdict &verdict)
{
  for (unsigned int l = 0; l < 8; ++l)
    {
      const Tensor &s = block.result[l].stress;
      const Tensor &t = block.trial[l];
      const Vector  strain =
        compliance(soil, {{t.rr - s.rr, t.zz - s.zz, t.tt - s.tt}});
      const double shear = (1. + soil.nu) / E * (t.rz - s.rz);
      for (unsigned int k = 0; k < 8; ++k)
        {
          const Tensor &x     = block.result[k].stress;
          const double  scale = std::max(block.scale[l], block.scale[k]);
          const double  work =
            dot(strain, {{x.rr - s.rr, x.zz - s.zz, x.tt - s.tt}}) +
            2. * shear * (x.rz - s.rz);
          raise(verdict.closest_point, work * E / (scale * scale));
        }
    }
}



void
check_block(const Soil                    &soil,
            const MohrCoulomb::Parameters &parameters,
            const std::vector<Plane>      &planes,
            std::mt19937                  &generator,
            Verdict                       &verdict)
{
  Block block;
  for (unsigned int l = 0; l < 8; ++l)
    {
      // old stress and elastic increment with the same degeneracy
      const unsigned int kind = generator();
      const Tensor       step = random_stress(generator, kind);
      block.old_stress[l]     = random_stress(generator, kind);
      block.increment[l]      = {step.rr / (3. * E),
                                 step.zz / (3. * E),
                                 step.tt / (3. * E),
                                 step.rz / (3. * E)};
      block.trial[l] =
        elastic_stress(soil, block.old_stress[l], block.increment[l]);
      block.scale[l]  = std::max(magnitude(block.trial[l]), soil.cohesion);
      block.result[l] = update<MohrCoulomb>(block.old_stress[l],
                                            block.increment[l],
                                            parameters);
      check_return(
        soil, planes, block.trial[l], block.scale[l], block.result[l], verdict);
    }
  check_invariance(parameters, block, verdict);
  check_lanes(parameters, block, verdict);
  if (soil.psi == soil.phi)
    check_closest_point(soil, block, verdict);
}



void
report_visits(const char *region, const unsigned int n_states)
{
  std::printf("%s, visited: %s\n", region, n_states > 500 ? "yes" : "NO");
}



void
test_random_states()
{
  std::vector<Soil> soils;
  for (const double nu : {0.3, 0.49})
    for (const double phi : {0., 20., 30., 45.})
      for (const double psi : std::set<double>{0., std::min(10., phi), phi})
        for (const double cohesion : {0., 1e3, 1e5})
          for (const double tension : {0., 500., no_tension})
            soils.push_back({nu,
                             phi * angle_per_deg,
                             psi * angle_per_deg,
                             cohesion,
                             tension});

  Verdict      verdict;
  std::mt19937 generator(2024);
  const auto   n_blocks = 100000 / (8 * soils.size()) + 1;
  for (const Soil &soil : soils)
    {
      const auto parameters = parameters_of(soil);
      const auto planes     = yield_planes(soil);
      for (unsigned int block = 0; block < n_blocks; ++block)
        check_block(soil, parameters, planes, generator, verdict);
    }

  std::printf("Random states\n");
  std::printf("at least 1e5 states: %s\n",
              verdict.n_states >= 100000 ? "yes" : "NO");
  report_visits("elastic", verdict.n_elastic);
  report_visits("cone: plane", verdict.n_cone_plane);
  report_visits("cone: edge", verdict.n_cone_edge);
  report_visits("cone: apex", verdict.n_apex);
  report_visits("cut-off: plane", verdict.n_cutoff_plane);
  report_visits("cut-off: edge", verdict.n_cutoff_edge);
  report_visits("cut-off: corner", verdict.n_cutoff_corner);
  report_visits("cut-off and cone: line", verdict.n_line);
  report_visits("cut-off and cone: end points", verdict.n_line_end);
  std::printf("states without a reference: %u\n", verdict.no_solution);
  report("difference from the reference", verdict.reference, 1e-10);
  report("distance between solutions", verdict.spread, 1e-9);
  report("yield function", verdict.yield, 1e-10);
  report("plastic strain outside the cone", verdict.cone, 1e-10);
  report("turn of the principal axes", verdict.axes, 1e-10);
  report("plastic strain measures", verdict.strain, 1e-10);
  report("second return", verdict.idempotence, 1e-10);
  report("in-plane rotation", verdict.rotation, 1e-10);
  report("lanes against scalar", verdict.lanes, 1e-12);
  report("closest-point inequality", verdict.closest_point, 1e-10);
}



/**
 * Strain-controlled triaxial test at constant lateral stress, from an isotropic
 * stress to failure; the lateral strain of each step is found by bisection.
 */
void
test_triaxial(const char *name, const double direction)
{
  const double pressure = 1e5;
  const Soil   soil{
    0.3, 30. * angle_per_deg, 10. * angle_per_deg, 2e4, no_tension};
  const auto parameters = parameters_of(soil);

  Tensor stress{-pressure, -pressure, -pressure, 0.};
  double volumetric_rate = 0., axial_rate = 0.;
  for (unsigned int step = 0; step < 40; ++step)
    {
      const double axial = direction * 1e-3;
      double       low = -2e-3, high = 2e-3;
      for (unsigned int i = 0; i < 80; ++i)
        {
          const double lateral = 0.5 * (low + high);
          const Result trial =
            update<MohrCoulomb>(stress,
                                {lateral, axial, lateral, 0.},
                                parameters);
          (trial.stress.rr < -pressure ? low : high) = lateral;
        }
      const Result result =
        update<MohrCoulomb>(stress, {low, axial, low, 0.}, parameters);
      const Vector elastic = compliance(soil,
                                        {{result.stress.rr - stress.rr,
                                          result.stress.zz - stress.zz,
                                          result.stress.tt - stress.tt}});
      volumetric_rate      = result.volumetric;
      axial_rate           = std::fabs(axial - elastic[1]);
      stress               = result.stress;
    }

  const double s = std::sin(soil.phi), d = std::sin(soil.psi);
  const double n     = (1. + s) / (1. - s);
  const double exact = direction < 0. ?
                         n * pressure + 2. * soil.cohesion * std::sqrt(n) :
                         pressure / n - 2. * soil.cohesion / std::sqrt(n);
  const double dilation =
    direction < 0. ? 2. * d / (1. - d) : 2. * d / (1. + d);
  std::printf("%s\n", name);
  std::printf("axial / lateral stress at failure: %.6f\n",
              stress.zz / stress.rr);
  std::printf("plastic volumetric / axial strain: %.6f\n",
              volumetric_rate / axial_rate);
  report("lateral stress error",
         std::fabs(stress.rr + pressure) / pressure,
         1e-10);
  report("strength error", std::fabs(stress.zz + exact) / pressure, 1e-10);
  report("dilation error",
         std::fabs(volumetric_rate / axial_rate - dilation),
         1e-10);
}



void
test_elastic()
{
  const Soil   soil{0.3, 30. * angle_per_deg, 0., 0., 0.};
  const auto   elastic = LinearElastic::Parameters::make(E, soil.nu);
  const Tensor old{-1e5, -2e5, -1.5e5, 2e4};
  const Tensor increment{1e-3, -2e-3, 5e-4, 7e-4};

  const Result result = update<LinearElastic>(old, increment, elastic);
  std::printf("Linear elastic\n");
  report("stress error",
         distance(result.stress, elastic_stress(soil, old, increment)) /
           stress_scale,
         1e-14);
  std::printf("plastic strains: %.1f %.1f\n",
              result.deviatoric,
              result.volumetric);

  // an oedometric path stays inside the cone, where both laws are one
  Tensor a{0., 0., 0., 0.}, b{0., 0., 0., 0.};
  for (unsigned int step = 0; step < 10; ++step)
    {
      a = update<LinearElastic>(a, {0., -1e-3, 0., 0.}, elastic).stress;
      b =
        update<MohrCoulomb>(b, {0., -1e-3, 0., 0.}, parameters_of(soil)).stress;
    }
  std::printf("oedometer: lateral / axial stress: %.6f %.6f\n",
              a.rr / a.zz,
              b.tt / b.zz);
  std::printf("oedometer: modulus / E: %.6f %.6f\n",
              -a.zz / (1e-2 * E),
              -b.zz / (1e-2 * E));
  const double at_rest = soil.nu / (1. - soil.nu);
  report("earth pressure at rest error",
         std::max(std::fabs(a.rr / a.zz - at_rest),
                  std::fabs(b.tt / b.zz - at_rest)),
         1e-10);
}



int
main()
{
  test_elastic();
  test_random_states();
  test_triaxial("Triaxial compression", -1.);
  test_triaxial("Triaxial extension", 1.);
}
