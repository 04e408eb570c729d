// SPDX-License-Identifier: LGPL-2.1-or-later
//
// An independent reference for returns to the Mohr-Coulomb cone with a tension
// cut-off: Koiter's rule in principal stresses by enumeration of every set of
// at most three of the nine yield planes. It knows no order of the stresses,
// no regions and no edges, and is slow.
//
// Uniqueness. For associated flow Koiter's rule has one solution, the closest
// point in the energy norm. Non-associated flow carries no such theorem, so
// every solution is returned and the user can see whether they differ.
#ifndef caisson_mpm_tests_koiter_reference_h
#define caisson_mpm_tests_koiter_reference_h

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

using Vector = std::array<double, 3>;

/** Young's modulus of all soils, and a tensile strength without effect. */
constexpr double E          = 2e7;
constexpr double no_tension = 1e30;

/** Angles in rad, strengths in Pa. */
struct Soil
{
  double nu, phi, psi, cohesion, tension;
};



inline double
norm(const Vector &a)
{
  return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}



inline Vector
difference(const Vector &a, const Vector &b)
{
  return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
}



inline double
dot(const Vector &a, const Vector &b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}



/**
 * Solve the n x n system for n <= 3 by elimination with pivoting; false if it
 * is singular.
 */
inline bool
solve(double (&matrix)[3][3], Vector &right_side, const unsigned int n)
{
  double largest = 0.;
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      largest = std::max(largest, std::fabs(matrix[i][j]));
  for (unsigned int k = 0; k < n; ++k)
    {
      unsigned int pivot = k;
      for (unsigned int i = k + 1; i < n; ++i)
        if (std::fabs(matrix[i][k]) > std::fabs(matrix[pivot][k]))
          pivot = i;
      if (std::fabs(matrix[pivot][k]) <= 1e-9 * largest)
        return false;
      std::swap(matrix[k], matrix[pivot]);
      std::swap(right_side[k], right_side[pivot]);
      for (unsigned int i = k + 1; i < n; ++i)
        {
          const double factor = matrix[i][k] / matrix[k][k];
          for (unsigned int j = k; j < n; ++j)
            matrix[i][j] -= factor * matrix[k][j];
          right_side[i] -= factor * right_side[k];
        }
    }
  for (int i = n - 1; i >= 0; --i)
    {
      for (unsigned int j = i + 1; j < n; ++j)
        right_side[i] -= matrix[i][j] * right_side[j];
      right_side[i] /= matrix[i][i];
    }
  return true;
}



/** A yield plane normal . sigma <= bound with its flow direction. */
struct Plane
{
  Vector normal, flow;
  double bound;
  bool   is_tension;
};



/** All nine planes, for principal stresses in any order. */
inline std::vector<Plane>
yield_planes(const Soil &soil)
{
  const double s = std::sin(soil.phi), d = std::sin(soil.psi);
  const double strength = 2. * soil.cohesion * std::cos(soil.phi);
  double       cutoff   = soil.tension;
  if (s > 0.)
    cutoff = std::min(cutoff, soil.cohesion / std::tan(soil.phi));

  std::vector<Plane> planes;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      if (i != j)
        {
          Plane plane{{{0., 0., 0.}}, {{0., 0., 0.}}, strength, false};
          plane.normal[i] = 1. + s;
          plane.normal[j] = -(1. - s);
          plane.flow[i]   = 1. + d;
          plane.flow[j]   = -(1. - d);
          planes.push_back(plane);
        }
  if (cutoff < no_tension)
    for (unsigned int i = 0; i < 3; ++i)
      {
        Plane plane{{{0., 0., 0.}}, {{0., 0., 0.}}, cutoff, true};
        plane.normal[i] = plane.flow[i] = 1.;
        planes.push_back(plane);
      }
  return planes;
}



/** D . strain and its inverse in principal components. */
inline Vector
stiffness(const Soil &soil, const Vector &strain)
{
  const double lambda = E * soil.nu / ((1. + soil.nu) * (1. - 2. * soil.nu));
  const double two_mu = E / (1. + soil.nu);
  const double trace  = strain[0] + strain[1] + strain[2];
  return {{lambda * trace + two_mu * strain[0],
           lambda * trace + two_mu * strain[1],
           lambda * trace + two_mu * strain[2]}};
}



inline Vector
compliance(const Soil &soil, const Vector &stress)
{
  const double trace = stress[0] + stress[1] + stress[2];
  Vector       strain;
  for (unsigned int i = 0; i < 3; ++i)
    strain[i] = ((1. + soil.nu) * stress[i] - soil.nu * trace) / E;
  return strain;
}



/** The indices of one to three items. */
struct IndexSet
{
  std::array<unsigned int, 3> index;
  unsigned int                n;
};



/** Call action(set) for all sets of one to three of n items. */
template <typename Action>
void
for_each_set(const unsigned int n, const Action &action)
{
  for (unsigned int i = 0; i < n; ++i)
    {
      action(IndexSet{{{i, 0, 0}}, 1});
      for (unsigned int j = i + 1; j < n; ++j)
        {
          action(IndexSet{{{i, j, 0}}, 2});
          for (unsigned int k = j + 1; k < n; ++k)
            action(IndexSet{{{i, j, k}}, 3});
        }
    }
}



/**
 * All stresses trial - D sum gamma_i flow_i with gamma >= 0 that lie on the
 * active planes and violate none; trial itself if it is admissible.
 */
inline std::vector<Vector>
koiter_solutions(const Soil               &soil,
                 const std::vector<Plane> &planes,
                 const Vector             &trial,
                 const double              scale)
{
  const auto admissible = [&](const Vector &stress) {
    return std::all_of(planes.begin(), planes.end(), [&](const Plane &plane) {
      return dot(plane.normal, stress) - plane.bound <= 1e-11 * scale;
    });
  };
  if (admissible(trial))
    return {trial};

  std::vector<Vector> solutions;
  for_each_set(planes.size(), [&](const IndexSet &set) {
    double matrix[3][3];
    Vector gamma;
    for (unsigned int i = 0; i < set.n; ++i)
      {
        const Plane &plane = planes[set.index[i]];
        gamma[i]           = dot(plane.normal, trial) - plane.bound;
        for (unsigned int j = 0; j < set.n; ++j)
          matrix[i][j] =
            dot(plane.normal, stiffness(soil, planes[set.index[j]].flow));
      }
    if (!solve(matrix, gamma, set.n))
      return;
    Vector plastic_strain = {{0., 0., 0.}};
    for (unsigned int i = 0; i < set.n; ++i)
      {
        if (gamma[i] < -1e-13 * scale / E)
          return;
        for (unsigned int k = 0; k < 3; ++k)
          plastic_strain[k] += gamma[i] * planes[set.index[i]].flow[k];
      }
    const Vector stress = difference(trial, stiffness(soil, plastic_strain));
    if (admissible(stress))
      solutions.push_back(stress);
  });
  return solutions;
}



/**
 * The distance of a plastic strain from the cone of the flow directions of the
 * planes that are active at a stress (Caratheodory: three of them suffice).
 */
inline double
distance_from_cone(const std::vector<Plane> &planes,
                   const Vector             &stress,
                   const Vector             &plastic_strain,
                   const double              scale)
{
  std::vector<Vector> flow;
  for (const Plane &plane : planes)
    if (std::fabs(dot(plane.normal, stress) - plane.bound) <= 1e-9 * scale)
      flow.push_back(plane.flow);

  double distance = norm(plastic_strain);
  for_each_set(flow.size(), [&](const IndexSet &set) {
    double matrix[3][3];
    Vector gamma;
    for (unsigned int i = 0; i < set.n; ++i)
      {
        gamma[i] = dot(flow[set.index[i]], plastic_strain);
        for (unsigned int j = 0; j < set.n; ++j)
          matrix[i][j] = dot(flow[set.index[i]], flow[set.index[j]]);
      }
    if (!solve(matrix, gamma, set.n))
      return;
    Vector rest = plastic_strain;
    for (unsigned int i = 0; i < set.n; ++i)
      for (unsigned int k = 0; k < 3; ++k)
        rest[k] -= std::max(gamma[i], 0.) * flow[set.index[i]][k];
    distance = std::min(distance, norm(rest));
  });
  return distance;
}

#endif
