// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/operators/nodal_constraints.h>
#include <caisson_mpm/operators/nodal_data.h>

namespace CaissonMPM
{
  NodalReactions
  NodalConstraints::apply(const Vector2             &body_velocity,
                          const double               dt,
                          const std::vector<double> &inertia,
                          NodalData                 &v)
  {
    NodalReactions result;
    if (!contact.empty())
      result.contact =
        contact.apply(body_velocity, dt, inertia, nodal_vectors(v));
    result.prescribed = boundary_conditions.apply(inertia, nodal_vectors(v));
    hanging_nodes.interpolate(v, 2);
    return result;
  }

  void
  NodalConstraints::hold(NodalData &v) const
  {
    if (!contact.empty())
      contact.constrain(contact.body_velocity(), nodal_vectors(v));
    boundary_conditions.constrain(nodal_vectors(v));
    hanging_nodes.interpolate(v, 2);
  }

  void
  NodalConstraints::hold_difference(NodalData &v) const
  {
    if (!contact.empty())
      contact.constrain(Vector2(), nodal_vectors(v));
    boundary_conditions.constrain_difference(nodal_vectors(v));
    hanging_nodes.interpolate(v, 2);
  }
} // namespace CaissonMPM
