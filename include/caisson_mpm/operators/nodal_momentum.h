// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The equation of motion at the nodes: what the points bring, and the new
// velocities
//   v_I = p_I / m_I,   v_I+ = v_I + dt f_I / m_I,
// constrained by contact and boundary conditions. Where m_I is below the mass
// M_I = dt^2 K_I / 4 that the time step needs, with the bound K_I of the row
// sum of the stiffness, MinimumNodalMass distributes the impulses afterwards
// (doc/theory.md, section 5).
#ifndef caisson_mpm_operators_nodal_momentum_h
#define caisson_mpm_operators_nodal_momentum_h

#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/nodal_constraints.h>
#include <caisson_mpm/operators/nodal_data.h>
#include <caisson_mpm/operators/nodal_force.h>
#include <caisson_mpm/operators/selective_mass.h>

#include <vector>

namespace CaissonMPM
{
  /**
   * Owns the nodal sums of a step and the velocities before and after it.
   * collect() is collective over MPI: what the points of all ranks bring to a
   * node is summed. From then on every rank works on all nodes that it knows.
   * Hanging nodes have neither mass nor force, and follow their masters.
   */
  class NodalMomentum
  {
  public:
    /** Set up for the nodes that this rank knows. */
    void
    initialize(const BackgroundGrid &grid);

    /** Sum mass, momentum and force of the points, @p forces included; with
     * the factors of SelectiveMass. */
    void
    collect(const ForceContext &context,
            const double       *deformation_inertia,
            NodalForces        &forces);

    /** Find those @p forces again that are corrected within the step. */
    void
    correct(const ForceContext &context, NodalForces &forces);

    /** How full the soil cells at a node are on average [n_nodes], in a step
     * that collect() has begun. */
    const double *
    filled() const
    {
      return filled_.begin();
    }

    /** Set the velocities before the step and, but for the constraints, after
     * it. Of the out-of-balance force away from the body, the share @p damping
     * acts against the velocity. @p is_corrected says whether correct() has
     * changed the forces since this was called. */
    void
    accelerate(const double   dt,
               const double   damping,
               const Vector2 &body_velocity,
               Contact       &contact,
               const bool     is_corrected);

    /** Replace both velocities at the corners of the body by those of a body
     * that has the given velocity. */
    void
    accelerate_corners(const double   dt,
                       const Vector2 &body_velocity,
                       Contact       &contact);

    /** Return what the soil would do to a body that has the velocity with which
     * its corners were accelerated. */
    Contact::Response
    respond(const double   dt,
            const Vector2 &body_velocity,
            Contact       &contact) const;

    /** Set @p v to the new velocities, as if each node had the mass that the
     * time step needs. */
    void
    predict(NodalData &v) const;

    /** Constrain the velocities @p v at the end of the step by contact and
     * boundary conditions. */
    NodalReactions
    constrain(const double      dt,
              const Vector2    &body_velocity,
              NodalConstraints &constraints,
              NodalData        &v) const;

    /** What the points brought [n_nodes]. */
    const Kernels::NodalSums *
    sums() const
    {
      return reinterpret_cast<const Kernels::NodalSums *>(sums_.begin());
    }

    /** The larger one of m_I and M_I [n_nodes], 0 without soil. Units: kg per
     * radian. */
    const std::vector<double> &
    raised_mass() const
    {
      return raised_mass_;
    }

    /** raised_mass() with the inertia of deformation, lumped, with which nodes
     * answer to the forces that correct() changes [n_nodes]. */
    const std::vector<double> &
    scaled_mass() const
    {
      return scaled_mass_;
    }

    /** The inertia of the deformation of cells. */
    const SelectiveMass &
    selective_mass() const
    {
      return selective_mass_;
    }

    /** The velocities that the points brought. */
    const NodalData &
    old_velocity() const
    {
      return old_velocity_;
    }

    /** The velocities at the end of the step. */
    const NodalData &
    new_velocity() const
    {
      return new_velocity_;
    }

    /** The same, for whoever changes them. */
    NodalData &
    new_velocity()
    {
      return new_velocity_;
    }

    unsigned int
    n_owned_nodes() const
    {
      return n_owned_nodes_;
    }

    /** The mass that the nodes lacked in the last step at the nodes of
     * this rank. Units: kg per radian. */
    double
    added_inertia() const
    {
      return added_inertia_;
    }

    /** Whether all nodal velocities of the last step are finite. */
    bool
    is_finite() const
    {
      return is_finite_;
    }

  private:
    void
    update_filled(const Kernels::StepContext &step);

    const HangingNodes *hanging_nodes  = nullptr;
    unsigned int        n_owned_nodes_ = 0;
    double              added_inertia_ = 0.;
    bool                is_finite_     = true;
    std::vector<double> mass_, raised_mass_, scaled_mass_;
    SelectiveMass       selective_mass_;
    NodalData           sums_, old_velocity_, new_velocity_, filled_, change;
    // of soil cells at a node, those at hanging nodes by their masters
    NodalData n_soil_cells;
  };
} // namespace CaissonMPM

#endif
