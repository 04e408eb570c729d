// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/minimum_nodal_mass.h>
#include <caisson_mpm/operators/nodal_data.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace CaissonMPM
{
  using Kernels::NodalSums;
  using Kernels::NodalVector;

  void
  MinimumNodalMass::initialize(const BackgroundGrid &grid)
  {
    for (NodalData *v : {&theta, &received, &field, &product})
      grid.reinit(*v, 2);
    n_owned_nodes = grid.n_owned_nodes();
    impulses.clear();
  }

  void
  MinimumNodalMass::distribute(const Kernels::KernelTable &kernels,
                               const Kernels::StepContext &step,
                               const NodalConstraints     &constraints,
                               NodalMomentum              &momentum,
                               NodalReactions             &reactions)
  {
    impulses.clear();
    // 1. theta = 1 - m / M, and the cells where it is not 0
    const HangingNodes &hanging_nodes = constraints.hanging_nodes;
    if (!update_weak_cells(step, hanging_nodes, momentum))
      return;
    // 2. C theta, for mu = (1 - theta) m + C theta; theta, and what follows
    //    from it, is 0 in all other cells
    Kernels::StepContext weak  = step;
    weak.points.active_cells   = weak_cells.data();
    weak.points.n_active_cells = weak_cells.size();
    apply_consistent_mass(kernels, weak, hanging_nodes, theta, received);
    // 3. P = m (v+ - v), and C theta m^-1 P, which the neighbors receive
    compute_impulses(momentum);
    hanging_nodes.interpolate(field, 2);
    apply_consistent_mass(kernels, weak, hanging_nodes, field, product);
    // 4. x = mu^-1 T^T P = mu^-1 ((1 - theta) P + C theta m^-1 P), and C x
    compute_increments(momentum);
    hanging_nodes.interpolate(field, 2);
    apply_consistent_mass(kernels, weak, hanging_nodes, field, product);
    // 5. v+ = v + T x = v + (1 - theta) x + theta m^-1 C x, constrained again
    set_velocities(momentum);
    constraints.constrain(
      momentum.sums(), 1., false, momentum.new_velocity(), reactions);
  }

  bool
  MinimumNodalMass::update_weak_cells(const Kernels::StepContext &step,
                                      const HangingNodes         &hanging_nodes,
                                      const NodalMomentum        &momentum)
  {
    const NodalSums           *node    = momentum.sums();
    const std::vector<double> &inertia = momentum.raised_mass();
    NodalVector *const         share   = nodal_vectors(theta);
    bool                       any     = false;
    for (unsigned int i = 0; i < inertia.size(); ++i)
      {
        const bool is_weak = inertia[i] > node[i].mass && node[i].mass > 0.;
        share[i] = {{is_weak ? 1. - node[i].mass / inertia[i] : 0., 0.}};
        any      = any || is_weak;
      }
    hanging_nodes.interpolate(theta, 2);
    // theta of a hanging node is that of its masters, and its cells count, too
    weak_cells.clear();
    for (unsigned int i = 0; any && i < step.points.n_active_cells; ++i)
      {
        const unsigned int        cell    = step.points.active_cells[i];
        const unsigned int *const corners = step.grid.nodes[cell].node;
        if (std::any_of(corners, corners + 4, [&](const unsigned int k) {
              return share[k].value[0] > 0.;
            }))
          weak_cells.push_back(cell);
      }
    return dealii::Utilities::MPI::max(weak_cells.empty() ? 0 : 1,
                                       theta.get_mpi_communicator()) == 1;
  }

  void
  MinimumNodalMass::compute_impulses(const NodalMomentum &momentum)
  {
    const NodalVector *const taken  = nodal_vectors(received),
                             *share = nodal_vectors(theta),
                             *v     = nodal_vectors(momentum.old_velocity()),
                             *u     = nodal_vectors(momentum.new_velocity());
    NodalVector *const withheld     = nodal_vectors(field);
    for (unsigned int i = 0; i < momentum.raised_mass().size(); ++i)
      {
        withheld[i] = NodalVector();
        if (!(taken[i].value[0] > 0.))
          continue;
        Vector2 impulse;
        for (unsigned int d = 0; d < 2; ++d)
          {
            impulse[d] =
              momentum.sums()[i].mass * (u[i].value[d] - v[i].value[d]);
            withheld[i].value[d] =
              share[i].value[0] / momentum.sums()[i].mass * impulse[d];
          }
        impulses.push_back({i, impulse});
      }
  }

  void
  MinimumNodalMass::compute_increments(const NodalMomentum &momentum)
  {
    const NodalVector *const given = nodal_vectors(product);
    for (const auto &[i, impulse] : impulses)
      {
        const double keep = 1. - nodal_vectors(theta)[i].value[0];
        const double mu =
          keep * momentum.sums()[i].mass + nodal_vectors(received)[i].value[0];
        for (unsigned int d = 0; d < 2; ++d)
          nodal_vectors(field)[i].value[d] =
            (keep * impulse[d] + given[i].value[d]) / mu;
      }
  }

  void
  MinimumNodalMass::set_velocities(NodalMomentum &momentum)
  {
    const NodalVector *const v = nodal_vectors(momentum.old_velocity());
    for (auto &[i, impulse] : impulses)
      {
        const double share = nodal_vectors(theta)[i].value[0],
                     mass  = momentum.sums()[i].mass;
        for (unsigned int d = 0; d < 2; ++d)
          {
            const double increment =
              (1. - share) * nodal_vectors(field)[i].value[d] +
              share / mass * nodal_vectors(product)[i].value[d];
            nodal_vectors(momentum.new_velocity())[i].value[d] =
              v[i].value[d] + increment;
            impulse[d] -= mass * increment;
          }
      }
  }

  double
  MinimumNodalMass::work(const NodalVector *v) const
  {
    double work = 0.;
    for (const auto &[i, impulse] : impulses)
      for (unsigned int d = 0; d < 2; ++d)
        if (i < n_owned_nodes)
          work += impulse[d] * v[i].value[d];
    return work;
  }
} // namespace CaissonMPM
