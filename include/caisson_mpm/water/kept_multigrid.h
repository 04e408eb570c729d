// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Conjugate gradients with an algebraic multigrid that is kept while the matrix
// changes.
#ifndef caisson_mpm_water_kept_multigrid_h
#define caisson_mpm_water_kept_multigrid_h

#include <caisson_mpm/operators/nodal_data.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <algorithm>

namespace CaissonMPM
{
  /**
   * Owns the matrix that the multigrid is made from. The multigrid of an
   * earlier matrix serves until the iterations beyond the fewest that it took
   * have cost as much as making a new one. All functions are collective.
   */
  class KeptMultigrid
  {
  public:
    /** Set up an empty matrix. Weaker couplings than @p threshold times the
     * diagonal are not aggregated. */
    void
    initialize(const dealii::IndexSet               &own,
               const dealii::DynamicSparsityPattern &pattern,
               const MPI_Comm                        communicator,
               const double                          threshold);

    dealii::TrilinosWrappers::SparseMatrix &
    matrix()
    {
      return matrix_;
    }

    /**
     * Solve for @p correction, from zero, until the residual is below @p
     * tolerance. @p equations has vmult(), and @p assemble fills matrix(), which
     * is called where a new multigrid is needed. Throws RunFailure where that
     * does not suffice.
     */
    template <typename Equations, typename Assemble>
    void
    solve(const Equations &equations,
          const Assemble  &assemble,
          const double     tolerance,
          const NodalData &right_side,
          NodalData       &correction)
    {
      const auto iterate = [&](const unsigned int max_iterations) {
        correction = 0.;
        dealii::SolverControl       control(max_iterations, tolerance);
        dealii::SolverCG<NodalData> solver(control);
        try
          {
            solver.solve(equations, correction, right_side, multigrid);
          }
        catch (const dealii::SolverControl::NoConvergence &)
          {}
        n_iterations_ = control.last_step();
        return control.last_check() == dealii::SolverControl::success;
      };
      if (n_more < cost_of_setup && iterate(n_least + cost_of_setup))
        {
          n_least = std::min(n_least, n_iterations_);
          n_more += n_iterations_ - n_least;
          return;
        }
      assemble();
      make_multigrid();
      if (!iterate(most_iterations))
        report_no_solution();
      n_least = n_iterations_;
      n_more  = 0;
    }

    /** The iterations of the last solution. */
    unsigned int
    n_iterations() const
    {
      return n_iterations_;
    }

  private:
    static constexpr unsigned int most_iterations = 1000;
    // Making a multigrid takes as long as this many iterations.
    static constexpr unsigned int cost_of_setup = 40;

    void
    make_multigrid();
    [[noreturn]] static void
    report_no_solution();

    dealii::TrilinosWrappers::SparseMatrix    matrix_;
    dealii::TrilinosWrappers::PreconditionAMG multigrid;
    double                                    threshold     = 0.;
    unsigned int                              n_iterations_ = 0;
    unsigned int n_least = 0; // fewest iterations with this multigrid
    unsigned int n_more  = cost_of_setup; // beyond these, all together
  };
} // namespace CaissonMPM

#endif
