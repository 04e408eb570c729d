// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/nodal_data.h>
#include <caisson_mpm/operators/nodal_work.h>

namespace CaissonMPM
{
  void
  WorkOfStep::initialize(const BackgroundGrid &grid)
  {
    grid.reinit(constrained_old, 2);
    circumference = grid.circumference();
  }

  double
  WorkOfStep::missing_work(const double                dt,
                           const NodalConstraints     &constraints,
                           const Kernels::NodalVector *strain) const
  {
    const ContactCorners &corners = constraints.contact.corners();
    return .5 * dt *
           (corners.missing_power(nodal_vectors(constrained_old)) +
            corners.missing_power(strain));
  }

  NodalWork
  WorkOfStep::find(const double                dt,
                   const double                damping,
                   const NodalMomentum        &momentum,
                   const MinimumNodalMass     &minimum_nodal_mass,
                   const Kernels::NodalVector *strain,
                   const NodalForces          &forces,
                   const NodalConstraints     &constraints,
                   const NodalReactions       &reactions)
  {
    const std::size_t n = 2 * momentum.raised_mass().size();
    constraints.constrain_old(momentum.old_velocity(), constrained_old);

    NodalWork                 result;
    const Kernels::NodalSums *node = momentum.sums();
    const double *const       v0   = momentum.old_velocity().begin(),
                        *v         = momentum.new_velocity().begin(),
                        *s         = strain->value;
    double *const h                = constrained_old.begin();
    for (unsigned int i = 0; i < momentum.n_owned_nodes(); ++i, ++node)
      for (unsigned int d = 0; d < 2; ++d)
        {
          const unsigned int k = 2 * i + d;
          const double       f = dt * node->force[d];
          result.forces += f * .5 * (h[k] + s[k]);
          if (damping > 0. && !constraints.contact.is_contact_node(i))
            result.damping +=
              damping_force(damping, f, v0[k]) * .5 * (h[k] + v[k]);
        }
    result.forces += missing_work(dt, constraints, strain);
    // of what this rank's points bring, to all of their nodes
    for (const auto &force : forces)
      result.load += force->work(dt, nodal_vectors(constrained_old), strain);
    result.body       = reactions.contact.work;
    result.prescribed = reactions.prescribed.work;
    for (std::size_t k = 0; k < n; ++k)
      h[k] = .5 * (h[k] + v[k]);
    result.mass_floor = minimum_nodal_mass.work(nodal_vectors(constrained_old));
    result.deformation_inertia =
      momentum.selective_mass().work(nodal_vectors(constrained_old),
                                     momentum.n_owned_nodes());
    for (double *sum : {&result.forces,
                        &result.load,
                        &result.mass_floor,
                        &result.deformation_inertia,
                        &result.damping})
      *sum *= circumference;
    if (!constraints.contact.empty())
      result.friction =
        constraints.contact.friction_heat(nodal_vectors(constrained_old));
    return result;
  }
} // namespace CaissonMPM
