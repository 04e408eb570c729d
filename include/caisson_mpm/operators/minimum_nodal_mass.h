// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The minimum nodal mass (entry Method/Mass floor): what it takes from the
// impulses of nodes with little mass goes to their neighbors.
//
// A node with the mass m and the raised mass M answers to an impulse P with
// P / M. Its points thus receive m / M of P. The share theta = 1 - m / M that
// is left is given to the nodes that share the points with it. With the
// consistent mass matrix of the points C, whose row sums are m, and
//   T = 1 - theta + theta m^-1 C,
// impulses are distributed by T^T and velocities averaged by T:
//   dv = T mu^-1 T^T P,   mu = T^T m = (1 - theta) m + C theta.
// This is symmetric, so that it creates no energy, and m^T dv = 1^T P, so that
// it keeps the momentum: m^T T = mu^T, and the rows of T have the sum 1. A node
// whose neighbors have enough mass answers with P / M, and what its neighbors
// do besides.
#ifndef caisson_mpm_operators_minimum_nodal_mass_h
#define caisson_mpm_operators_minimum_nodal_mass_h

#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/nodal_momentum.h>

#include <vector>

namespace CaissonMPM
{
  /**
   * Owns the nodal fields that this needs, and what it found in the last step.
   * It costs next to nothing where no node has too little mass.
   */
  class MinimumNodalMass
  {
  public:
    /** Set up for the nodes that this rank knows. */
    void
    initialize(const BackgroundGrid &grid);

    /**
     * Replace the new velocities of @p momentum, which answer to the impulses
     * of the step with the raised masses, and constrain them again, with
     * what the constraints bear added to @p reactions. Collective over
     * MPI.
     */
    void
    distribute(const Kernels::KernelTable &kernels,
               const Kernels::StepContext &step,
               const NodalConstraints     &constraints,
               NodalMomentum              &momentum,
               NodalReactions             &reactions);

    /** Return the work of the impulses in the last step that is left when the
     * nodes, with the mean velocities @p v [n_nodes], have got their kinetic
     * energy, of the nodes of this rank. Units: J per radian. */
    double
    work(const Kernels::NodalVector *v) const;

  private:
    /** A node that gives or takes, and an impulse. Units: N s per radian. */
    struct Impulse
    {
      unsigned int node;
      Vector2      impulse;
    };

    /** Set theta, and the active cells where it is not 0. Returns whether there
     * are any on any rank. Collective. */
    bool
    update_weak_cells(const Kernels::StepContext &step,
                      const HangingNodes         &hanging_nodes,
                      const NodalMomentum        &momentum);

    /** Set the impulses of all nodes of weak cells, and the field to m^-1 theta
     * P. */
    void
    compute_impulses(const NodalMomentum &momentum);

    /** Set the field to mu^-1 T^T P. */
    void
    compute_increments(const NodalMomentum &momentum);

    /** Set the new velocities to v + T mu^-1 T^T P, and the impulses to what
     * is left of P - m dv. */
    void
    set_velocities(NodalMomentum &momentum);

    unsigned int              n_owned_nodes = 0;
    std::vector<unsigned int> weak_cells;
    std::vector<Impulse>      impulses;
    // theta and C theta, each in the first component; a field, and C times it
    NodalData theta, received, field, product;
  };
} // namespace CaissonMPM

#endif
