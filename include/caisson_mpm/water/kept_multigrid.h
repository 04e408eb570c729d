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
   * earlier matrix serves as long as it costs only some more iterations than a
   * new one. All functions are collective.
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
        correction.zero_out_ghost_values();
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
      if (n_at_setup > 0 && iterate(n_at_setup + n_at_setup / 2 + 2))
        return;
      assemble();
      make_multigrid();
      if (!iterate(most_iterations))
        report_no_solution();
      n_at_setup = std::max(n_iterations_, 1u);
    }

    /** The iterations of the last solution. */
    unsigned int
    n_iterations() const
    {
      return n_iterations_;
    }

  private:
    static constexpr unsigned int most_iterations = 1000;

    void
    make_multigrid();
    [[noreturn]] static void
    report_no_solution();

    dealii::TrilinosWrappers::SparseMatrix    matrix_;
    dealii::TrilinosWrappers::PreconditionAMG multigrid;
    double                                    threshold     = 0.;
    unsigned int                              n_iterations_ = 0;
    unsigned int n_at_setup = 0; // of the multigrid, 0: there is none
  };
} // namespace CaissonMPM

#endif
