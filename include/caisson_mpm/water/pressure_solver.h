// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Linear equations for a field on the nodes of the grid, with FE_Q(1):
//   sum_J K_IJ p_J = f_I   at nodes with water whose value is not known.
#ifndef caisson_mpm_water_pressure_solver_h
#define caisson_mpm_water_pressure_solver_h

#include <caisson_mpm/water/kept_multigrid.h>
#include <caisson_mpm/water/mudline.h>

#include <deal.II/lac/affine_constraints.h>

#include <array>
#include <vector>

namespace CaissonMPM
{
  /**
   * Knows at which nodes the water has a pressure that is to be found, and
   * solves for it with conjugate gradients and algebraic multigrid. K is the
   * sum of the symmetric matrices of cells, which the caller sets. It is
   * applied cell by cell; only to set the multigrid up is it assembled. All
   * functions are collective.
   */
  class PressureSolver
  {
  public:
    /** What is known of the field at a node. */
    enum State : int
    {
      no_water,
      unknown,
      open, // at the free surface outside, or at a drained side
      plug, // at the mudline inside the body
      n_states
    };

    /** The matrix of a cell, by rows; its corners are those of CellNodes. */
    using CellMatrix = std::array<double, 16>;

    /** Which sides of the domain keep the pressure of the open water. */
    struct OpenSides
    {
      bool outer = false, bottom = false, surface = true;
    };

    /** Set up what knows the nodes of this rank. */
    void
    initialize(const BackgroundGrid &grid);

    /** Find the states of the nodes. */
    void
    find_states(const BackgroundGrid &grid,
                const Mudline        &mudline,
                const OpenSides      &sides);

    State
    state(const unsigned int node) const
    {
      return static_cast<State>(static_cast<int>(states.local_element(node)));
    }

    /** The cells of this rank with water, and room for the matrix of each, to
     * be filled before solve(). Their entries should be of order one. */
    const std::vector<unsigned int> &
    cells() const
    {
      return cells_;
    }
    std::vector<CellMatrix> &
    matrices()
    {
      return matrices_;
    }

    /**
     * Solve for @p field [n_nodes], which is the first guess, and has the known
     * values at open and plug; the rest but hanging nodes is set to zero where
     * there is no water. @p source [n_nodes] is f, with hanging nodes already
     * at their masters. The residual becomes smaller than @p accuracy times
     * that of the known values alone; throws RunFailure where it does not.
     */
    void
    solve(const NodalData &source, const double accuracy, NodalData &field);

    /** The iterations of the last solution. */
    unsigned int
    n_iterations() const
    {
      return multigrid.n_iterations();
    }

    /** to = K from, at all nodes. @p from is current at ghost nodes and hanging
     * ones. */
    void
    apply(const NodalData &from, NodalData &to) const;

    /** K at the unknown nodes and the identity at all others, for SolverCG. */
    void
    vmult(NodalData &to, const NodalData &from) const;

    /** A sum over the nodes of each State. */
    using SumsByState = std::array<double, n_states>;

    /** Return these sums of @p of_nodes [n_nodes], of the whole mesh. */
    SumsByState
    sums_by_state(const NodalData &of_nodes) const;

  private:
    void
    assemble();
    /** Take away what is not at unknown nodes of this rank. */
    void
    keep_unknown(NodalData &field) const;

    const BackgroundGrid                        *grid = nullptr;
    dealii::AffineConstraints<double>            hanging, constraints;
    KeptMultigrid                                multigrid;
    std::vector<dealii::types::global_dof_index> dof_of_node; // [n_nodes]
    std::vector<unsigned int>                    cells_;
    std::vector<CellMatrix>                      matrices_; // [n_cells_]
    NodalData                                    states; // of State [n_nodes]
    NodalData         right_side, correction, product;   // memory of solve()
    mutable NodalData with_ghosts;                       // memory of vmult()
  };
} // namespace CaissonMPM

#endif
