// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Everything that differs between deal.II 9.4 (Debian 12) and 9.6 (Debian 13).
#ifndef caisson_mpm_base_compat_h
#define caisson_mpm_base_compat_h

#include <deal.II/base/config.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/trilinos_vector.h>
#include <deal.II/lac/vector_memory.h>

#include <p4est_bits.h>

#include <exception>

namespace CaissonMPM::Compat
{
  /** The libraries that the program uses, from the beginning of main() to its
   * end: MPI, p4est and, where deal.II has it, Kokkos, in one thread.
   * deal.II's MPI_InitFinalize would also start PETSc, which executes what a
   * file .petscrc in the current folder or at home says. */
#if DEAL_II_VERSION_GTE(9, 6, 0)
  class Libraries
  {
  public:
    Libraries(int &n_words, char **&words)
      : started(n_words,
                words,
                dealii::InitializeLibrary::MPI |
                  dealii::InitializeLibrary::Kokkos |
                  dealii::InitializeLibrary::P4EST,
                1)
    {}

  private:
    const dealii::InitFinalize started;
  };
#else
  class Libraries
  {
  public:
    Libraries(int &n_words, char **&words)
    {
      int provided;
      MPI_Init_thread(&n_words, &words, MPI_THREAD_SERIALIZED, &provided);
      p4est_init(nullptr, SC_LP_SILENT);
      dealii::MultithreadInfo::set_thread_limit(1);
      signals().at_mpi_init();
    }

    /** MPI ends last, and not where other ranks may wait for an exception of
     * this one. */
    ~Libraries()
    {
      using namespace dealii;
      signals().at_mpi_finalize();
      GrowingVectorMemory<
        LinearAlgebra::distributed::Vector<double>>::release_unused_memory();
      GrowingVectorMemory<
        LinearAlgebra::distributed::Vector<float>>::release_unused_memory();
      GrowingVectorMemory<
        TrilinosWrappers::MPI::Vector>::release_unused_memory();
      sc_finalize();
      if (std::uncaught_exceptions() == 0)
        MPI_Finalize();
    }

    Libraries(const Libraries &) = delete;
    Libraries &
    operator=(const Libraries &) = delete;

  private:
    static dealii::Utilities::MPI::MPI_InitFinalize::Signals &
    signals()
    {
      return dealii::Utilities::MPI::MPI_InitFinalize::signals;
    }
  };
#endif

  inline dealii::IndexSet
  locally_relevant_dofs(const dealii::DoFHandler<2> &dof_handler)
  {
#if DEAL_II_VERSION_GTE(9, 5, 0)
    return dealii::DoFTools::extract_locally_relevant_dofs(dof_handler);
#else
    dealii::IndexSet result;
    dealii::DoFTools::extract_locally_relevant_dofs(dof_handler, result);
    return result;
#endif
  }

  /** Constraints, still empty, of the dofs that this rank knows. */
  inline dealii::AffineConstraints<double>
  empty_constraints(const dealii::DoFHandler<2> &dof_handler)
  {
    const auto known = locally_relevant_dofs(dof_handler);
#if DEAL_II_VERSION_GTE(9, 6, 0)
    return dealii::AffineConstraints<double>(dof_handler.locally_owned_dofs(),
                                             known);
#else
    return dealii::AffineConstraints<double>(known);
#endif
  }
} // namespace CaissonMPM::Compat

#endif
