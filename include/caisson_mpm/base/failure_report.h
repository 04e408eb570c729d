// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How the program ends after an error on one rank or on all.
#ifndef caisson_mpm_base_failure_report_h
#define caisson_mpm_base_failure_report_h

#include <caisson_mpm/base/exceptions.h>

#include <deal.II/base/mpi.h>

#include <string>

namespace CaissonMPM
{
  /**
   * Prints an error once. What all ranks find, as an entry that is wrong, the
   * first one prints, and all end in order. Where the others go on and would
   * wait for ever, the rank that failed prints the error and ends them all.
   */
  class FailureReport
  {
  public:
    /** Collective; an object lives as long as MPI is used. */
    explicit FailureReport(const MPI_Comm communicator);
    ~FailureReport();

    FailureReport(const FailureReport &) = delete;
    FailureReport &
    operator=(const FailureReport &) = delete;

    /** Print the text, and return the status as a number, or end the program
     * with it. Waits some seconds for the other ranks. */
    int
    end(const ExitStatus status, const std::string &text);

  private:
    /** Whether all ranks have come here within some seconds. */
    bool
    all_have_failed();

    MPI_Comm communicator = MPI_COMM_NULL; // for this purpose alone
  };
} // namespace CaissonMPM

#endif
