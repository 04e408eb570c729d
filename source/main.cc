// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/command_line.h>
#include <caisson_mpm/base/compat.h>
#include <caisson_mpm/base/console.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/failure_report.h>
#include <caisson_mpm/base/mpi_settings.h>
#include <caisson_mpm/base/version.h>
#include <caisson_mpm/simulation/run_scene.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/revision.h>

#include <fcntl.h>
#include <malloc.h>

#include <iostream>
#include <new>
#include <string>

namespace
{
  using namespace CaissonMPM;

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
