// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One step at the nodes: from the points to the nodes, the equation of motion
// there, and back to the points.
#ifndef caisson_mpm_operators_nodal_motion_h
#define caisson_mpm_operators_nodal_motion_h

#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/nodal_work.h>
#include <caisson_mpm/operators/point_transfer.h>

#include <array>
#include <vector>

namespace CaissonMPM
{
  /** The soil and the grid in a step. What the members refer to is the
   * caller's, and must stay where it is until the step is over. */
  struct SoilOnGrid
  {
    const Kernels::KernelTable           &kernels;
    MaterialPoints                       &points;
    const BackgroundGrid                 &grid;
    const std::vector<Kernels::Material> &materials;
    const double                         *pore_pressure; // see StepContext
    const double                         *inertia;       // see StepContext
    const double *deformation_inertia;                   // see SelectiveMass
  };

  /**
   * The parts of a step in their order. Each function must be called once per
   * step, in the order in which they stand here; this is checked also in
   * Release mode. Owns settings, nodal fields and moments of cells. Collective
   * over MPI: collect() and prepare_transfer() exchange nodal values.
   */
  class NodalMotion
  {
  public:
    /** Set up for the nodes that this rank knows. */
    void
    initialize(const BackgroundGrid &grid);

    /** Sum mass, momentum and force of the points, @p forces at @p time
     * included. */
    void
    collect(const SoilOnGrid &soil, NodalForces &forces, const double time);

    /** v = p / m, and v+ = v + dt f / m. Small masses are raised first. */
    void
    accelerate(const StepSize    &step_size,
               const NodalForces &forces,
               const Vector2     &body_velocity,
               Contact           &contact);

    /** Return how the soil responds to a body that keeps the velocity which
     * accelerate() was given. For a body that responds, this and the next
     * function follow accelerate(). */
    Contact::Response
    respond(Contact &contact) const;

    /** Replace the velocity of the body that accelerate() was given. */
    void
    replace_body_velocity(const Vector2 &body_velocity, Contact &contact);

    /** Compute the implicit forces from v+, constrained by contact and boundary
     * conditions, and v+ again with them; does nothing where there are none.
     * See NodalForce::is_implicit(). */
    void
    correct(const SoilOnGrid &soil,
            NodalForces      &forces,
            const double      time,
            const Vector2    &body_velocity,
            NodalConstraints &constraints,
            Contact          &contact);

    /** Constrain v+ by contact and boundary conditions; see reactions(). */
    void
    constrain(const Vector2 &body_velocity, NodalConstraints &constraints);

    /** Find the fields that update the points. */
    void
    prepare_transfer(const NodalConstraints &constraints);

    /** Return the works of this step, of the nodes of this rank. */
    NodalWork
    work_of_step(const NodalForces      &forces,
                 const NodalConstraints &constraints);

    /** The velocities at the end of the step, after constrain(). [n_nodes] */
    const Kernels::NodalVector *
    new_velocity() const
    {
      return nodal_vectors(momentum.new_velocity());
    }

    /** Update the points, from the start of the step to its end, when the grid
     * has @p moved. @p volume_rates: see Kernels::PointUpdate. */
    void
    update_points(const Kernels::GridView &moved,
                  const double            *volume_rates,
                  Kernels::UpdateResult   &result);

    void
    choose_stress_update(const bool scales_selectively)
    {
      settings_.choose_stress_update(scales_selectively);
    }

    void
    choose_flip_fraction(const bool vibrates)
    {
      settings_.choose_flip_fraction(vibrates);
    }

    const MethodSettings &
    settings() const
    {
      return settings_;
    }

    /** The rates of stretch in r and z at a place in a cell, with the
     * velocities at the end of the last step. Units: 1/s. */
    std::array<double, 2>
    rate_of_stretch(const BackgroundGrid   &grid,
                    const unsigned int      cell,
                    const dealii::Point<2> &place) const;

    /** What the constraints did in the last step. */
    const NodalReactions &
    reactions() const
    {
      return reactions_;
    }

    /** The mass that nodes lacked, see NodalMomentum. */
    double
    added_inertia() const
    {
      return momentum.added_inertia();
    }

    /** Whether all nodal velocities of the last step are finite. */
    bool
    is_finite() const
    {
      return momentum.is_finite();
    }

  private:
    /** What has been done in this step. */
    enum class Stage
    {
      points_updated,
      collected,
      accelerated,
      corrected,
      constrained,
      transfer_prepared,
      work_found
    };

    /** Enter @p next, which must be the stage that follows. */
    void
    enter(const Stage next);

    void
    accelerate(const Vector2 &body_velocity,
               Contact       &contact,
               const bool     is_corrected);
    /** Give the kernels how cells see the corners of the body. */
    void
    show_corners(const Contact &contact);

    MethodSettings                    settings_;
    NodalMomentum                     momentum;
    MinimumNodalMass                  mass_floor;
    PointTransfer                     transfer;
    WorkOfStep                        work;
    std::vector<Kernels::CellMoments> moments;
    const Kernels::KernelTable       *kernels = nullptr; // of this step
    Kernels::StepContext              step    = {};
    StepSize                          size    = {};
    Vector2                           velocity_of_body; // in accelerate()
    NodalReactions                    reactions_;
    NodalData                         predicted;
    Stage                             stage = Stage::points_updated;
  };
} // namespace CaissonMPM

#endif
