// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/water/kept_multigrid.h>

#include <deal.II/lac/trilinos_sparsity_pattern.h>

namespace CaissonMPM
{
  using namespace dealii;

  void
  KeptMultigrid::initialize(const IndexSet               &own,
                            const DynamicSparsityPattern &pattern,
                            const MPI_Comm                communicator,
                            const double                  new_threshold)
  {
    threshold = new_threshold;
    multigrid.clear(); // it refers to the matrix
    n_more = cost_of_setup;
    // The way from the pattern itself to the matrix is a template of deal.II's
    // library whose name clang mangles in another way than GCC.
    TrilinosWrappers::SparsityPattern places;
    places.reinit(own, own, pattern, communicator);
    matrix_.reinit(places);
  }

  void
  KeptMultigrid::make_multigrid()
  {
    // Incomplete factors smooth best where cells are long and flat: with
    // Chebyshev polynomials, six times as many iterations are needed.
    TrilinosWrappers::PreconditionAMG::AdditionalData settings;
    settings.smoother_type         = "ILU";
    settings.smoother_sweeps       = 1;
    settings.aggregation_threshold = threshold;
    multigrid.initialize(matrix_, settings);
  }

  void
  KeptMultigrid::report_no_solution()
  {
    throw RunFailure(
      "the pressure of the pore water was not found in " +
      to_text(most_iterations) +
      " iterations. Reduce the contrast of the permeabilities, or the ratio of "
      "width to height of the cells.");
  }
} // namespace CaissonMPM
