// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The works of one step at the nodes, for the energy balance.
//
// A force f on a node that has the velocity h at the start of the step, once
// the constraints of the new velocity hold for it, and v+ at its end does the
// work dt f (h + v+) / 2. The forces of the soil's stress and of loads take the
// velocity that strains the points in the place of v+, so that their work is
// what the points are given.
#ifndef caisson_mpm_operators_nodal_work_h
#define caisson_mpm_operators_nodal_work_h

#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/minimum_nodal_mass.h>

namespace CaissonMPM
{
  /**
   * Works of one step at the nodes, on the whole circumference (per meter in
   * plane strain). Units: J.
   */
  struct NodalWork
  {
    double forces     = 0.; // of all forces on the nodes, before damping
    double load       = 0.; // of the nodal forces, contained in forces
    double body       = 0.; // of the rigid body on the soil
    double water      = 0.; // and on the water that resists it
    double prescribed = 0.; // of the nodes with a prescribed velocity
    double friction   = 0.; // heat at the body's surface
    double damping    = 0.; // taken by local damping
    double mass_floor = 0.; // taken by the mass floor
    double deformation_inertia = 0.; // and by that inertia
  };

  /**
   * Finds the works. Owns one nodal vector as memory. Not collective: the works
   * are of the nodes and the points of this rank.
   */
  class WorkOfStep
  {
  public:
    /** Set up for the nodes that this rank knows. */
    void
    initialize(const BackgroundGrid &grid);

    /** Return the works of a step with the velocities @p strain [n_nodes] that
     * strain the points, but for those of @p reactions, which are given. */
    NodalWork
    find(const double                dt,
         const double                damping,
         const NodalMomentum        &momentum,
         const MinimumNodalMass     &minimum_nodal_mass,
         const Kernels::NodalVector *strain,
         const NodalForces          &forces,
         const NodalConstraints     &constraints,
         const NodalReactions       &reactions);

  private:
    /** The work of the forces at corners of the body that cells see with a
     * velocity of their own, beyond that with the velocity of the node. */
    double
    missing_work(const double                dt,
                 const NodalConstraints     &constraints,
                 const Kernels::NodalVector *strain) const;

    double circumference = 0.;
    NodalData
      constrained_old; // the old velocity with the constraints of the new one
  };
} // namespace CaissonMPM

#endif
