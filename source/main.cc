// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/command_line.h>
#include <caisson_mpm/base/compat.h>
#include <caisson_mpm/base/console.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/mpi_settings.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/base/version.h>
#include <caisson_mpm/simulation/run_scene.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/revision.h>

#include <fcntl.h>
#include <malloc.h>

#include <chrono>
#include <iostream>
#include <new>
#include <string>
#include <thread>

namespace
{
  using namespace CaissonMPM;

  /**
   * Prints an error once. What all ranks find, as an entry that is wrong, the
   * first one prints, and all end in order. Where the others go on and would
   * wait for ever, the rank that failed prints the error and ends them all.
   */
  class FailureReport
  {
  public:
    /** Collective; an object lives as long as MPI is used. */
    explicit FailureReport(const MPI_Comm communicator)
    {
      MPI_Comm_dup(communicator, &this->communicator);
    }

    ~FailureReport()
    {
      MPI_Comm_free(&communicator);
    }

    FailureReport(const FailureReport &) = delete;
    FailureReport &
    operator=(const FailureReport &) = delete;

    /** Print the text, and return the status as a number, or end the program
     * with it. Waits some seconds for the other ranks. */
    int
    end(const ExitStatus status, const std::string &text)
    {
      const bool in_order = all_have_failed();
      if (!in_order ||
          dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
        std::cerr << printable(text) << std::endl;
      if (!in_order)
        MPI_Abort(MPI_COMM_WORLD, static_cast<int>(status));
      return static_cast<int>(status);
    }

  private:
    /** Whether all ranks have come here within some seconds. */
    bool
    all_have_failed()
    {
      using namespace std::chrono_literals;
      if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
        return true;
      // of several ranks that fail one shall be the first to report it
      const auto patience =
        3s + 100ms * dealii::Utilities::MPI::this_mpi_process(communicator);
      const auto  start = std::chrono::steady_clock::now();
      MPI_Request request;
      MPI_Ibarrier(communicator, &request);
      int all_are_here = 0;
      while (true)
        {
          MPI_Test(&request, &all_are_here, MPI_STATUS_IGNORE);
          if (all_are_here ||
              std::chrono::steady_clock::now() - start > patience)
            return all_are_here;
          std::this_thread::sleep_for(1ms);
        }
    }

    MPI_Comm communicator = MPI_COMM_NULL; // for this purpose alone
  };

  /** Where standard input, output or error is closed, open a file there that is
   * always full: a file of results would get its number, and the text. */
  void
  fill_closed_streams()
  {
    for (const int number : {0, 1, 2})
      if (fcntl(number, F_GETFD) < 0)
        open("/dev/full", O_RDWR); // it gets the lowest number that is free
  }

  ExitStatus
  run(const int argc, const char *const *argv)
  {
    std::ostream out(dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) ==
                         0 ?
                       std::cout.rdbuf() :
                       nullptr);
    const CommandLine command_line = parse_command_line(argc, argv);
    if (command_line.help)
      out << usage();
    else if (command_line.version)
      out << "caisson_mpm " << program_version()
          << " (deal.II " DEAL_II_PACKAGE_VERSION ")\n";
    else
      return run_scene(command_line, out);
    finish_list(out);
    return ExitStatus::success;
  }
} // namespace

int
main(int argc, char *argv[])
{
  fill_closed_streams();
  set_up_mpi();
  // Large arrays get pages of their own, whatever was freed before: the blocks
  // of points then begin at cache lines (MaterialPoints::Place).
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  int                     n_names = 1; // the options are not for libraries
  const Compat::Libraries libraries(n_names, argv);
  FailureReport           failure(MPI_COMM_WORLD);
  try
    {
      return static_cast<int>(run(argc, argv));
    }
  catch (const BadInput &error)
    {
      return failure.end(ExitStatus::bad_input,
                         std::string("bad input: ") + error.what());
    }
  catch (const std::bad_alloc &)
    {
      return failure.end(ExitStatus::failure,
                         "failure: there is not enough memory for this scene. "
                         "Use larger cells or fewer material points "
                         "(--validate says how many there are), or more "
                         "memory.");
    }
  catch (const std::exception &error)
    {
      return failure.end(ExitStatus::failure,
                         std::string("failure: ") + error.what());
    }
}
