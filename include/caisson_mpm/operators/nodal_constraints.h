// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What constrains the nodes: the contact with the rigid body, then the boundary
// conditions, which take precedence; hanging nodes follow their masters.
#ifndef caisson_mpm_operators_nodal_constraints_h
#define caisson_mpm_operators_nodal_constraints_h

#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/boundary_conditions.h>
#include <caisson_mpm/operators/contact.h>

namespace CaissonMPM
{
  /** What the constraints did in one step, at the nodes of this rank. */
  struct NodalReactions
  {
    ContactResult    contact;
    PrescribedResult prescribed;
  };

  /**
   * All constraints as one. Holds references; the caller owns what they refer
   * to. Collective in a mesh with hanging nodes.
   */
  struct NodalConstraints
  {
    Contact            &contact;
    BoundaryConditions &boundary_conditions;
    const HangingNodes &hanging_nodes;

    /** Correct the new velocities @p v [n_nodes] of nodes with the given
     * @p mass [n_nodes]. */
    NodalReactions
    apply(const Vector2             &body_velocity,
          const double               dt,
          const std::vector<double> &mass,
          NodalData                 &v);

    /** Constrain another velocity field as the last apply() did the new one. */
    void
    constrain(NodalData &v) const;

    /** Set @p constrained to the velocities @p old before the step, constrained
     * likewise. */
    void
    constrain_old(const NodalData &old, NodalData &constrained) const;

    /** Constrain a field, or the difference of two that are constrained, of
     * which the soil gains the momentum @p share times m_I v_I, and add what
     * the constraints bear to @p result, that of the last apply(). */
    void
    constrain(const Kernels::NodalSums *sums,
              const double              share,
              const bool                as_difference,
              NodalData                &v,
              NodalReactions           &result) const;
  };
} // namespace CaissonMPM

#endif
