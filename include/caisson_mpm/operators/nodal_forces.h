// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The list of all nodal forces of a run.
#ifndef caisson_mpm_operators_nodal_forces_h
#define caisson_mpm_operators_nodal_forces_h

#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/nodal_force.h>

#include <memory>
#include <vector>

namespace CaissonMPM
{
  /**
   * Owns the nodal forces and treats them as one. A new force is registered by
   * one line in the constructor, or by add() if it needs an object that the
   * caller owns, which must then outlive this one. Not collective.
   */
  class NodalForces
  {
  public:
    NodalForces();

    /** Add a force, before parameters are parsed. */
    void
    add(std::unique_ptr<NodalForce> force);

    /** Throws BadInput. */
    void
    check_parameters() const;

    /** See NodalForce::initialize(). */
    void
    initialize(const double mass_scaling);

    /** Find all forces of the step and add them to @p nodes [n_nodes]. */
    void
    collect(const ForceContext &context, Kernels::NodalSums *nodes);

    /** Return whether there is an implicit force; see
     * NodalForce::is_implicit().
     */
    bool
    have_implicit() const;

    /** Compute the implicit forces, see NodalForce::solve(). Collective. */
    void
    solve(const Kernels::NodalVector             *velocity,
          const std::vector<Kernels::CornerView> &corners,
          const std::vector<double>              &mass);

    /** Find the implicit forces again, and add their change to @p change
     * [n_nodes]. */
    void
    correct(const ForceContext &context, Kernels::NodalVector *change);

    /** Return the sum of NodalForce::at_corner(). */
    Vector2
    at_corner(const unsigned int cell, const unsigned int corner) const;

    /** Return the work of all forces, see NodalForce::work(). */
    double
    work(const double                dt,
         const Kernels::NodalVector *start,
         const Kernels::NodalVector *end) const;

  private:
    std::vector<std::unique_ptr<NodalForce>> forces;
  };
} // namespace CaissonMPM

#endif
