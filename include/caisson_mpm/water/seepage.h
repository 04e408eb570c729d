// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Steady flow of the pore water:  div(k grad phi) = 0.
//
// phi is the share of the suction that has reached a place: 1 on the mudline of
// the plug, 0 on that outside, no flow through the body and the sides of the
// domain. With the suction s, the excess pore pressure is p = -s phi, and the
// water flows with k s / gamma_w grad phi.
#ifndef caisson_mpm_water_seepage_h
#define caisson_mpm_water_seepage_h

#include <caisson_mpm/water/cell_integrals.h>
#include <caisson_mpm/water/kept_multigrid.h>
#include <caisson_mpm/water/soil_columns.h>

#include <deal.II/lac/affine_constraints.h>

#include <array>
#include <vector>

namespace CaissonMPM
{
  /**
   * Finds phi on the nodes of the grid, with FE_Q(1), conjugate gradients and
   * algebraic multigrid. The matrix K is applied cell by cell, and assembled
   * only to set the multigrid up. A cell that the mudline cuts is replaced by
   * its lower part: its vertical conductance is divided by the filled share and
   * its radial one multiplied with it. The solution then changes continuously
   * when the mudline moves through the mesh. All functions are collective.
   */
  class Seepage
  {
  public:
    /** Set up what knows the nodes of this rank. */
    void
    initialize(const BackgroundGrid &grid);

    /**
     * Find the field, beginning with the last one. @p permeability [n_cells] in
     * m/s is read of the cells of this rank. Throws RunFailure where the solver
     * does not converge.
     */
    void
    solve(const SoilColumns              &soil_columns,
          const std::vector<Conductance> &permeability,
          const OpenSides                &sides);

    /** The field, of all nodes that this rank knows. [n_nodes] */
    NodalData &
    field()
    {
      return phi;
    }

    /** int k grad phi grad N over the soil: what flows out of the soil at the
     * nodes of the plug, and minus what flows in at open ones. [n_nodes], m2/s
     * per radian */
    const NodalData &
    residual() const
    {
      return residual_;
    }

    /** Return its sum over the nodes of the plug, and over open ones. m2/s */
    std::array<double, 2>
    sums_of_plug_and_open() const;

    unsigned int
    n_iterations() const
    {
      return multigrid.n_iterations();
    }

    /** K at the unknown nodes and the identity at all others, for SolverCG. */
    void
    vmult(NodalData &to, const NodalData &from) const;

  private:
    /** What is known of the field at a node. */
    enum State : int
    {
      no_water,
      unknown,
      open, // at the free surface outside, or at a drained side
      plug  // at the mudline inside the body
    };

    State
    state(const unsigned int node) const
    {
      return static_cast<State>(static_cast<int>(states.local_element(node)));
    }

    /** Find the states of the nodes, and the cells with water. */
    void
    find_states(const SoilColumns &soil_columns, const OpenSides &sides);

    void
    assemble();

    /** to = K from, at all nodes. @p from is current at ghost nodes and hanging
     * ones. */
    void
    apply(const NodalData &from, NodalData &to) const;

    /** Call action(node) for the nodes of this rank whose value is known, or
     * follows from others. */
    template <typename Action>
    void
    for_each_given(const Action &action) const;

    /** Find minus K p at the unknown nodes. Returns its norm. */
    double
    find_right_side(NodalData &p);

    const BackgroundGrid             *grid = nullptr;
    dealii::AffineConstraints<double> hanging;
    KeptMultigrid                     multigrid;
    std::vector<unsigned int>         cells;    // of this rank, with water
    std::vector<CellMatrix>           matrices; // of these
    NodalData                         states;   // of State [n_nodes]
    NodalData         phi, residual_, right_side, correction; // [n_nodes]
    mutable NodalData with_ghosts; // memory of vmult()
  };
} // namespace CaissonMPM

#endif
