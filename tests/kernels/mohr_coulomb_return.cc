// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The return of the law MohrCoulomb from random states, against
//
// - an independent reference, which knows neither regions nor edges: Koiter's
//   rule by enumeration of every set of at most three active planes;
// - the defining properties: admissible stress, plastic strain in the cone of
//   the active planes' flow directions, principal axes kept, closest point
//   (associated flow), no change of a returned stress, invariance to in-plane
//   rotation, lanes equal to the scalar result.
//
// Non-associated flow has no theorem of uniqueness, so the kernel is compared
// with the nearest of the reference's solutions, and the largest distance
// between two solutions is a verdict of its own: it is round-off for all the
// parameters below, which have psi <= phi.
#include <set>
#include <vector>

#include "mohr_coulomb_test.h"

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
  report("states without a reference", verdict.no_solution, 0.);
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



int
main()
{
  test_random_states();
}
