// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/command_line.h>
#include <caisson_mpm/base/declared_entries.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/parameter_file.h>
#include <caisson_mpm/simulation/simulation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/revision.h>

#include <iostream>

namespace
{
  using namespace CaissonMPM;

  ExitStatus
  run(const int argc, const char *const *argv)
  {
    const CommandLine command_line = parse_command_line(argc, argv);
    if (command_line.help || command_line.version)
      {
        std::cout << (command_line.help ? usage() :
                                          "caisson_mpm " CAISSON_MPM_VERSION
                                          " (deal.II " DEAL_II_PACKAGE_VERSION
                                          ")\n");
        return ExitStatus::success;
      }
    Simulation simulation(MPI_COMM_WORLD);
    auto      &prm = dealii::ParameterAcceptor::prm;
    const auto origins =
      read_parameters(prm, command_line.parameter_file, command_line.overrides);
    for (const std::string &text : origins.warnings())
      std::cout << "warning: " << text << std::endl;
    if (command_line.print_parameters)
      {
        std::cout << describe_parameters(prm);
        return ExitStatus::success;
      }
    dealii::ParameterAcceptor::parse_all_parameters();
    if (command_line.validate)
      {
        simulation.validate();
        std::cout << command_line.parameter_file << " is valid" << std::endl;
        return ExitStatus::success;
      }
    return simulation.run(command_line.parameter_file,
                          command_line.output_directory,
                          command_line.restart);
  }
} // namespace

int
main(int argc, char *argv[])
{
  try
    {
      dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
      return static_cast<int>(run(argc, argv));
    }
  catch (const BadInput &error)
    {
      std::cerr << "bad input: " << error.what() << std::endl;
      return static_cast<int>(ExitStatus::bad_input);
    }
  catch (const std::exception &error)
    {
      std::cerr << "failure: " << error.what() << std::endl;
      return static_cast<int>(ExitStatus::failure);
    }
}
