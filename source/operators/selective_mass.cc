// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/kernels/cell_map.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/selective_mass.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  using Kernels::NodalSums;
  using Kernels::NodalVector;

  double
  lumped_mass(const NodalSums &node)
  {
    return node.mass + node.deformation_mass;
  }

  std::vector<double>
  factors_of_translation(const BackgroundGrid      &grid,
                         const std::vector<double> &factors)
  {
    // 1. the nodes of the body, with the masters of hanging ones, and those at
    //    the sides
    NodalData mark;
    grid.reinit(mark, 1);
    const unsigned int n_nodes = grid.n_nodes();
    for (unsigned int c = 0; c < grid.n_cells(); ++c)
      if (grid.is_rigid(c) && grid.is_owned(c))
        for (const unsigned int n : grid.cell_nodes(c).node)
          mark.local_element(n) = 1.;
    grid.hanging_nodes().distribute(mark, 1);
    mark.compress(dealii::VectorOperation::add);
    mark.update_ghost_values();
    grid.hanging_nodes().interpolate(mark, 1);
    using Side = GridLines::Side;
    std::vector<bool> is_lumped(n_nodes);
    for (unsigned int n = 0; n < n_nodes; ++n)
      is_lumped[n] = mark.local_element(n) > 0. || grid.is_at(n, Side::axis) ||
                     grid.is_at(n, Side::outer) ||
                     grid.is_at(n, Side::bottom) || grid.is_at(n, Side::top);
    // 2. the cells at one of them
    std::vector<double> result(factors.size(), 1.);
    for (unsigned int c = 0; c < grid.n_cells(); ++c)
      {
        const auto &node = grid.cell_nodes(c).node;
        if (std::any_of(node, node + 4, [&](const unsigned int n) {
              return is_lumped[n];
            }))
          result[c] = factors[c];
      }
    return result;
  }

  void
  SelectiveMass::initialize(const BackgroundGrid &grid)
  {
    for (NodalData *v :
         {&increment, &withheld, &residual, &direction, &product})
      grid.reinit(*v, 2);
    hanging_nodes = &grid.hanging_nodes();
    n_nodes       = grid.n_nodes();
    cells.clear();
    coupled.clear();
  }

  void
  SelectiveMass::collect(const Kernels::StepContext &step,
                         const double               *factors,
                         NodalSums                  *nodes)
  {
    cells.clear();
    is_active = factors != nullptr;
    if (!is_active)
      return;
    for (unsigned int i = 0; i < step.points.n_active_cells; ++i)
      {
        const unsigned int cell  = step.points.active_cells[i];
        const double       added = factors[cell] - inertia_in(step, cell);
        if (added <= 0.)
          continue;
        const double *const       m    = step.moments[cell].mass;
        const unsigned int *const node = step.grid.nodes[cell].node;
        Cell                      c = {{{node[0], node[1], node[2], node[3]}},
                                       {},
                                       1. / (added * m[0])};
        Kernels::moments_to_corners(m, c.mass.data());
        for (unsigned int k = 0; k < 4; ++k)
          {
            c.mass[k] *= added;
            nodes[node[k]].deformation_mass += c.mass[k];
          }
        cells.push_back(c);
      }
  }

  void
  SelectiveMass::apply(NodalData &from, NodalData &to) const
  {
    hanging_nodes->interpolate(from, 2);
    to                         = 0.;
    const NodalVector *const x = nodal_vectors(from);
    NodalVector *const       y = nodal_vectors(to);
    for (const Cell &c : cells)
      {
        double mean[2] = {0., 0.};
        for (unsigned int k = 0; k < 4; ++k)
          for (unsigned int d = 0; d < 2; ++d)
            mean[d] += c.mass[k] * x[c.node[k]].value[d];
        for (unsigned int d = 0; d < 2; ++d)
          mean[d] *= c.inverse_sum;
        for (unsigned int k = 0; k < 4; ++k)
          for (unsigned int d = 0; d < 2; ++d)
            y[c.node[k]].value[d] +=
              c.mass[k] * (x[c.node[k]].value[d] - mean[d]);
      }
    hanging_nodes->distribute(to, 2);
    to.compress(dealii::VectorOperation::add);
    to.update_ghost_values();
  }

  namespace
  {
    // the polynomial has five terms on [1/20, 1]
    constexpr unsigned int n_terms = 5;
    constexpr double       least = 1. / 20., theta = .5 * (1. + least),
                     delta = .5 * (1. - least);
  } // namespace

  void
  SelectiveMass::accelerate(const NodalSums   *nodes,
                            const NodalVector *v,
                            NodalVector       *u)
  {
    coupled.clear();
    if (!is_active)
      return;
    // 1. the impulse dt f, and the first term of the polynomial
    NodalVector *const        a = nodal_vectors(increment),
                       *const r = nodal_vectors(residual),
                       *const p = nodal_vectors(direction),
                       *const w = nodal_vectors(withheld);
    direction                   = 0.;
    for (unsigned int i = 0; i < n_nodes; ++i)
      if (nodes[i].deformation_mass > 0.)
        {
          coupled.push_back(i);
          for (unsigned int d = 0; d < 2; ++d)
            {
              r[i].value[d] = w[i].value[d] =
                nodes[i].mass * (u[i].value[d] - v[i].value[d]);
              a[i].value[d] = p[i].value[d] =
                r[i].value[d] / lumped_mass(nodes[i]) / theta;
            }
        }
    // 2. the others
    double rho = delta / theta;
    for (unsigned int term = 1; term < n_terms; ++term)
      rho = add_term(nodes, rho);
    // 3. no motion may be lighter than with M + L
    const double keep =
      1. / (1. + 1. / std::cosh(n_terms * std::acosh(theta / delta)));
    for (const unsigned int i : coupled)
      for (unsigned int d = 0; d < 2; ++d)
        {
          a[i].value[d] *= keep;
          w[i].value[d] -= nodes[i].mass * a[i].value[d];
          u[i].value[d] = v[i].value[d] + a[i].value[d];
        }
  }

  double
  SelectiveMass::add_term(const NodalSums *nodes, const double rho)
  {
    apply(direction, product);
    const double       next = 1. / (2. * theta / delta - rho);
    NodalVector *const r    = nodal_vectors(residual), *const p =
                                                      nodal_vectors(direction);
    for (const unsigned int i : coupled)
      for (unsigned int d = 0; d < 2; ++d)
        {
          r[i].value[d] -=
            nodes[i].mass * p[i].value[d] + nodal_vectors(product)[i].value[d];
          p[i].value[d] = next * rho * p[i].value[d] + 2. * next / delta *
                                                         r[i].value[d] /
                                                         lumped_mass(nodes[i]);
          nodal_vectors(increment)[i].value[d] += p[i].value[d];
        }
    return next;
  }

  void
  SelectiveMass::correct(const NodalSums   *nodes,
                         const NodalVector *v,
                         NodalVector       *u)
  {
    for (const unsigned int i : coupled)
      for (unsigned int d = 0; d < 2; ++d)
        {
          const double mass   = nodes[i].mass,
                       a      = nodal_vectors(increment)[i].value[d];
          double      &w      = nodal_vectors(withheld)[i].value[d];
          const double change = mass * (u[i].value[d] - v[i].value[d] - a) - w;
          const double answer = change / lumped_mass(nodes[i]);
          u[i].value[d]       = v[i].value[d] + a + answer;
          w += change - mass * answer;
        }
  }

  double
  SelectiveMass::work(const NodalVector *v, const unsigned int n_owned) const
  {
    double work = 0.;
    for (const unsigned int i : coupled)
      if (i < n_owned)
        for (unsigned int d = 0; d < 2; ++d)
          work += nodal_vectors(withheld)[i].value[d] * v[i].value[d];
    return work;
  }
} // namespace CaissonMPM
