// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/failure_report.h>
#include <caisson_mpm/base/text.h>

#include <chrono>
#include <iostream>
#include <thread>

namespace CaissonMPM
{
  using namespace dealii;

  FailureReport::FailureReport(const MPI_Comm communicator)
  {
    MPI_Comm_dup(communicator, &this->communicator);
  }

  FailureReport::~FailureReport()
  {
    MPI_Comm_free(&communicator);
  }

  int
  FailureReport::end(const ExitStatus status, const std::string &text)
  {
    const bool in_order = all_have_failed();
    if (!in_order || Utilities::MPI::this_mpi_process(communicator) == 0)
      std::cerr << printable(text) << std::endl;
    if (!in_order)
      MPI_Abort(MPI_COMM_WORLD, static_cast<int>(status));
    return static_cast<int>(status);
  }

  bool
  FailureReport::all_have_failed()
  {
    using namespace std::chrono_literals;
    if (Utilities::MPI::n_mpi_processes(communicator) == 1)
      return true;
    // of several ranks that fail one shall be the first to report it
    const auto patience =
      3s + 100ms * Utilities::MPI::this_mpi_process(communicator);
    const auto  start = std::chrono::steady_clock::now();
    MPI_Request request;
    MPI_Ibarrier(communicator, &request);
    int all_are_here = 0;
    while (true)
      {
        MPI_Test(&request, &all_are_here, MPI_STATUS_IGNORE);
        if (all_are_here || std::chrono::steady_clock::now() - start > patience)
          return all_are_here;
        std::this_thread::sleep_for(1ms);
      }
  }
} // namespace CaissonMPM
