// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/operators/nodal_constraints.h>

namespace CaissonMPM
{
  using Kernels::NodalVector;

  NodalReactions
  NodalConstraints::apply(const Vector2             &body_velocity,
                          const double               dt,
                          const std::vector<double> &inertia,
                          NodalVector               *v)
  {
    NodalReactions result;
    if (!contact.empty())
      result.contact = contact.apply(body_velocity, dt, inertia, v);
    result.prescribed = boundary_conditions.apply(inertia, v);
    return result;
  }

  void
  NodalConstraints::hold(NodalVector *v) const
  {
    if (!contact.empty())
      contact.constrain(contact.body_velocity(), v);
    boundary_conditions.constrain(v);
  }

  void
  NodalConstraints::hold_difference(NodalVector *v) const
  {
    if (!contact.empty())
      contact.constrain(Vector2(), v);
    boundary_conditions.constrain_difference(v);
  }
} // namespace CaissonMPM
