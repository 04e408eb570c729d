// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/operators/local_damping.h>
#include <caisson_mpm/operators/nodal_momentum.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  using Kernels::NodalSums;
  using Kernels::NodalVector;

  void
  NodalMomentum::initialize(const BackgroundGrid &grid)
  {
    grid.reinit(sums_, sizeof(NodalSums) / sizeof(double));
    grid.reinit(old_velocity_, 2);
    grid.reinit(new_velocity_, 2);
    mass_.assign(grid.n_nodes(), 0.);
    inertia_.assign(grid.n_nodes(), 0.);
    n_owned_nodes_ = grid.n_owned_nodes();
    hanging_nodes  = &grid.hanging_nodes();
  }

  void
  NodalMomentum::collect(const ForceContext &context, NodalForces &forces)
  {
    sums_ = 0.;
    sums_.zero_out_ghost_values();
    auto *const nodes = reinterpret_cast<NodalSums *>(sums_.begin());
    context.kernels.points_to_grid(context.step, nodes);
    forces.collect(context, nodes);
    hanging_nodes->distribute(sums_, sizeof(NodalSums) / sizeof(double));
    sums_.compress(dealii::VectorOperation::add);
    sums_.update_ghost_values();
  }

  void
  NodalMomentum::accelerate(const double   dt,
                            const double   damping,
                            const Contact &contact)
  {
    const NodalSums   *node = sums();
    NodalVector *const v    = nodal_vectors(old_velocity_),
                       *u   = nodal_vectors(new_velocity_);
    added_inertia_          = 0.;
    double sum              = 0.;
    for (unsigned int i = 0; i < inertia_.size(); ++i, ++node)
      {
        if (node->mass <= 0.)
          {
            mass_[i] = inertia_[i] = 0.;
            v[i] = u[i] = NodalVector();
            continue;
          }
        mass_[i]    = node->mass;
        inertia_[i] = std::max(node->mass, .25 * dt * dt * node->stiffness);
        if (i < n_owned_nodes_)
          added_inertia_ += inertia_[i] - node->mass;
        const double share =
          damping > 0. && !contact.is_contact_node(i) ? damping : 0.;
        for (unsigned int d = 0; d < 2; ++d)
          {
            v[i].value[d] = node->momentum[d] / node->mass;
            const double force =
              node->force[d] -
              damping_force(share, node->force[d], v[i].value[d]);
            u[i].value[d] = v[i].value[d] + dt * force / node->mass;
            sum += u[i].value[d];
          }
      }
    is_finite_ = std::isfinite(sum);
    // the new velocities follow when they are constrained
    hanging_nodes->interpolate(old_velocity_, 2);
  }

  NodalReactions
  NodalMomentum::constrain(const double      dt,
                           const Vector2    &body_velocity,
                           NodalConstraints &constraints)
  {
    return constraints.apply(body_velocity, dt, mass_, new_velocity_);
  }
} // namespace CaissonMPM
