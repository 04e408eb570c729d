// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/nodal_constraints.h>
#include <caisson_mpm/operators/nodal_data.h>

namespace CaissonMPM
{
  NodalReactions
  NodalConstraints::apply(const Vector2             &body_velocity,
                          const double               dt,
                          const std::vector<double> &mass,
                          NodalData                 &v)
  {
    NodalReactions result;
    if (!contact.empty())
      result.contact = contact.apply(body_velocity, dt, mass, nodal_vectors(v));
    result.prescribed = boundary_conditions.apply(mass, nodal_vectors(v));
    hanging_nodes.interpolate(v, 2);
    return result;
  }

  void
  NodalConstraints::constrain(NodalData &v) const
  {
    if (!contact.empty())
      contact.constrain(contact.body_velocity(), nodal_vectors(v));
    boundary_conditions.constrain(nodal_vectors(v));
    hanging_nodes.interpolate(v, 2);
  }

  void
  NodalConstraints::constrain_old(const NodalData &old,
                                  NodalData       &constrained) const
  {
    constrained = old;
    constrained.update_ghost_values();
    constrain(constrained);
  }

  void
  NodalConstraints::constrain(const Kernels::NodalSums *sums,
                              const double              share,
                              const bool                as_difference,
                              NodalData                &v,
                              NodalReactions           &result) const
  {
    Kernels::NodalVector *const u = nodal_vectors(v);
    if (!contact.empty())
      contact.constrain(as_difference ? Vector2() : contact.body_velocity(),
                        sums,
                        share,
                        u,
                        result.contact);
    boundary_conditions.add_impulses(
      sums, share, as_difference, u, result.prescribed);
    if (as_difference)
      boundary_conditions.constrain_difference(u);
    else
      boundary_conditions.constrain(u);
    hanging_nodes.interpolate(v, 2);
  }
} // namespace CaissonMPM
