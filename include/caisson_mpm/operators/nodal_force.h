// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What acts on the soil through the nodes, besides its own stress, its weight
// and the contact: one class and file for each such force, and their list.
#ifndef caisson_mpm_operators_nodal_force_h
#define caisson_mpm_operators_nodal_force_h

#include <caisson_mpm/base/conventions.h>
#include <caisson_mpm/domain/background_grid.h>
#include <caisson_mpm/domain/material_points.h>
#include <caisson_mpm/kernels/layout.h>

#include <memory>
#include <vector>

namespace CaissonMPM
{
  /** What a nodal force may look at when it is found. */
  struct ForceContext
  {
    const Kernels::KernelTable &kernels;
    // after points_to_grid: it says which cells are full
    const Kernels::StepContext &step;
    const MaterialPoints       &points;
    const BackgroundGrid       &grid;
    double                      time; // at the start of the step
  };

  /**
   * A force on the nodes. A derived class declares its own entries, if it is a
   * Section, and says what it adds; this class keeps the forces of
   * the step and finds their work. The forces are those that the points of this
   * rank bring, to all nodes that it knows; the sum over ranks is made once for
   * all of them. Not collective.
   */
  class NodalForce
  {
  public:
    virtual ~NodalForce() = default;

    /** Throws BadInput for entries that cannot be used. */
    virtual void
    check_parameters() const
    {}

    /** Prepare for the run, when all parameters are known. @p mass_scaling is
     * the factor that the inertia of the points contains. */
    virtual void
    initialize(const double mass_scaling)
    {
      (void)mass_scaling;
    }

    /** Return whether the force is present at all. One that is not costs
     * nothing. */
    virtual bool
    is_active() const = 0;

    /** Return what a cell adds to its corner, if that is a convex corner of the
     * body, which takes it from each cell on its own. Units: N per radian. */
    virtual Vector2
    at_corner(const unsigned int cell, const unsigned int corner) const
    {
      (void)cell;
      (void)corner;
      return Vector2();
    }

    /** Find the force of this step, keep it, and add it to @p nodes
     * [n_nodes]. */
    void
    collect(const ForceContext &context, Kernels::NodalSums *nodes);

    /** Return whether the force follows from the velocities at the end of the
     * step: those with the force of the last step predict them, solve()
     * computes the force from these, and correct() adds it. */
    virtual bool
    is_implicit() const
    {
      return false;
    }

    /** Compute an implicit force from the predicted @p velocity [n_nodes], which
     * cells at @p corners of the body see as these say. The force accelerates
     * the @p mass of the nodes [n_nodes], kg per radian. Collective. */
    virtual void
    solve(const Kernels::NodalVector             *velocity,
          const std::vector<Kernels::CornerView> &corners,
          const std::vector<double>              &mass)
    {
      (void)velocity;
      (void)corners;
      (void)mass;
    }

    /** Find an implicit force again, keep it, and add what it has changed by to
     * @p change [n_nodes]. */
    void
    correct(const ForceContext &context, Kernels::NodalVector *change);

    /**
     * Return the work in a step of length @p dt, in which the nodes move with
     * the mean of the velocities @p start and @p end [n_nodes]. Units: J per
     * radian.
     */
    double
    work(const double                dt,
         const Kernels::NodalVector *start,
         const Kernels::NodalVector *end) const;

  protected:
    /** Add the force to @p force [n_nodes]. Units: N per radian (per meter in
     * plane strain). */
    virtual void
    add(const ForceContext &context, Kernels::NodalVector *force) = 0;

  private:
    std::vector<Kernels::NodalVector> force; // empty unless the force acts
  };

  /** All forces of a run. What adds one that needs an object of its own must
   * let this object live as long. */
  using NodalForces = std::vector<std::unique_ptr<NodalForce>>;

  /** Return the forces that need nothing but their entries: a new one is one
   * line there. */
  NodalForces
  make_nodal_forces();
} // namespace CaissonMPM

#endif
