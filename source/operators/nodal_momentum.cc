// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/kernels/cell_map.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/nodal_data.h>
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
    grid.reinit(filled_, 1);
    grid.reinit(change, 2);
    mass_.assign(grid.n_nodes(), 0.);
    raised_mass_.assign(grid.n_nodes(), 0.);
    scaled_mass_.assign(grid.n_nodes(), 0.);
    selective_mass_.initialize(grid);
    n_owned_nodes_ = grid.n_owned_nodes();
    hanging_nodes  = &grid.hanging_nodes();

    grid.reinit(n_soil_cells, 1);
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      if (!grid.is_rigid(cell) && grid.is_owned(cell))
        for (const unsigned int node : grid.cell_nodes(cell).node)
          n_soil_cells.local_element(node) += 1.;
    hanging_nodes->distribute(n_soil_cells, 1);
    n_soil_cells.compress(dealii::VectorOperation::add);
    n_soil_cells.update_ghost_values();
  }

  void
  NodalMomentum::update_filled(const Kernels::StepContext &step)
  {
    // 1. the sum of the filled shares of the cells at each node, on all ranks
    filled_              = 0.;
    double *const filled = filled_.begin();
    for (unsigned int i = 0; i < step.points.n_active_cells; ++i)
      {
        const unsigned int cell     = step.points.active_cells[i];
        const double       fraction = step.points.filled_volume[cell] /
                                Kernels::CellMap<>(step.grid.geometry[cell])
                                  .volume(step.grid.axisymmetric);
        for (const unsigned int node : step.grid.nodes[cell].node)
          filled[node] += fraction;
      }
    hanging_nodes->distribute(filled_, 1);
    filled_.compress(dealii::VectorOperation::add);
    // 2. their mean: over all soil cells at the node, full or empty
    for (unsigned int i = 0; i < n_owned_nodes_; ++i)
      filled[i] /= std::max(n_soil_cells.local_element(i), 1.);
    filled_.update_ghost_values();
    hanging_nodes->interpolate(filled_, 1);
  }

  void
  NodalMomentum::collect(const ForceContext &context,
                         const double       *deformation_inertia,
                         NodalForces        &forces)
  {
    update_filled(context.step);
    sums_             = 0.;
    auto *const nodes = reinterpret_cast<NodalSums *>(sums_.begin());
    context.kernels.points_to_grid(context.step, nodes);
    for (const auto &force : forces)
      force->collect(context, nodes);
    selective_mass_.collect(context.step, deformation_inertia, nodes);
    hanging_nodes->distribute(sums_, sizeof(NodalSums) / sizeof(double));
    sums_.compress(dealii::VectorOperation::add);
    sums_.update_ghost_values();
  }

  void
  NodalMomentum::correct(const ForceContext &context, NodalForces &forces)
  {
    change = 0.;
    for (const auto &force : forces)
      force->correct(context, nodal_vectors(change));
    hanging_nodes->distribute(change, 2);
    change.compress(dealii::VectorOperation::add);
    change.update_ghost_values();
    auto *const nodes = reinterpret_cast<NodalSums *>(sums_.begin());
    for (std::size_t i = 0; i < raised_mass_.size(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
        nodes[i].force[d] += nodal_vectors(change)[i].value[d];
  }

  void
  NodalMomentum::accelerate(const double   dt,
                            const double   damping,
                            const Vector2 &body_velocity,
                            Contact       &contact,
                            const bool     is_corrected)
  {
    const NodalSums   *node = sums();
    NodalVector *const v    = nodal_vectors(old_velocity_),
                       *u   = nodal_vectors(new_velocity_);
    added_inertia_          = 0.;
    double sum              = 0.;
    for (unsigned int i = 0; i < raised_mass_.size(); ++i, ++node)
      {
        if (node->mass <= 0.)
          {
            mass_[i] = raised_mass_[i] = scaled_mass_[i] = 0.;
            v[i] = u[i] = NodalVector();
            continue;
          }
        // 1. M_I = max(m_I, dt^2 K_I / 4), with which the node would be stable;
        //    MinimumNodalMass acts on those nodes where it exceeds m_I, which
        //    count with the inertia of deformation
        const double scaled = lumped_mass(*node);
        mass_[i]            = node->mass;
        scaled_mass_[i]     = std::max(scaled, .25 * dt * dt * node->stiffness);
        raised_mass_[i] = node->mass * std::max(1., scaled_mass_[i] / scaled);
        if (i < n_owned_nodes_)
          added_inertia_ += raised_mass_[i] - node->mass;
        // 2. v_I = p_I / m_I, and v_I+ = v_I + dt f_I / m_I with the force less
        //    its damped share; not at the body, which would bear the damping
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
    // 3. with the inertia of the deformation of cells
    if (is_corrected)
      selective_mass_.correct(sums(), v, u);
    else
      selective_mass_.accelerate(sums(), v, u);
    // 4. one sum finds all values that are not finite
    is_finite_ = std::isfinite(sum);
    accelerate_corners(dt, body_velocity, contact);
  }

  void
  NodalMomentum::accelerate_corners(const double   dt,
                                    const Vector2 &body_velocity,
                                    Contact       &contact)
  {
    contact.corners().accelerate(body_velocity,
                                 dt,
                                 sums(),
                                 nodal_vectors(old_velocity_),
                                 nodal_vectors(new_velocity_));
    // the new velocities follow when they are constrained
    hanging_nodes->interpolate(old_velocity_, 2);
  }

  Contact::Response
  NodalMomentum::respond(const double   dt,
                         const Vector2 &body_velocity,
                         Contact       &contact) const
  {
    return contact.respond(
      body_velocity, dt, sums(), mass_, nodal_vectors(new_velocity_));
  }

  void
  NodalMomentum::predict(NodalData &v) const
  {
    v = new_velocity_;
    v.update_ghost_values();
    const NodalVector *const old = nodal_vectors(old_velocity_);
    for (std::size_t i = 0; i < raised_mass_.size(); ++i)
      if (raised_mass_[i] > mass_[i])
        for (unsigned int d = 0; d < 2; ++d)
          {
            double &own = nodal_vectors(v)[i].value[d];
            own         = old[i].value[d] +
                  mass_[i] / raised_mass_[i] * (own - old[i].value[d]);
          }
  }

  NodalReactions
  NodalMomentum::constrain(const double      dt,
                           const Vector2    &body_velocity,
                           NodalConstraints &constraints,
                           NodalData        &v) const
  {
    constraints.contact.corners().apply(dt, sums(), nodal_vectors(v));
    return constraints.apply(body_velocity, dt, mass_, v);
  }
} // namespace CaissonMPM
