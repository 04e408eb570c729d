// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/declared_entries.h>
#include <caisson_mpm/base/parameter_file.h>
#include <caisson_mpm/simulation/run_scene.h>
#include <caisson_mpm/simulation/simulation.h>

#include <deal.II/base/parameter_acceptor.h>

namespace CaissonMPM
{
  namespace
  {
    /** Print all entries; notes on the input become comments. */
    void
    print_parameters(const ParameterOrigins &origins, std::ostream &out)
    {
      for (const std::string &text : origins.warnings())
        out << "# warning: " << text << '\n';
      out << describe_parameters(dealii::ParameterAcceptor::prm);
    }
  } // namespace



  ExitStatus
  run_scene(const CommandLine &command_line, std::ostream &out)
  {
    Simulation simulation(MPI_COMM_WORLD);
    auto       origins = read_parameters(dealii::ParameterAcceptor::prm,
                                   command_line.parameter_file,
                                   command_line.overrides);
    if (command_line.print_parameters)
      {
        print_parameters(origins, out);
        return ExitStatus::success;
      }
    try
      {
        dealii::ParameterAcceptor::parse_all_parameters();
        simulation.name_unused_entries(origins);
        for (const std::string &text : origins.warnings())
          out << "warning: " << text << std::endl;
        if (!command_line.validate)
          return simulation.run(command_line.parameter_file,
                                command_line.output_directory,
                                command_line.restart,
                                origins.warnings());
        simulation.validate(command_line.output_directory);
        out << command_line.parameter_file << " is valid\n"
            << describe(simulation.estimate_cost()) << std::flush;
        return ExitStatus::success;
      }
    catch (const BadInput &error)
      {
        throw BadInput(error.what() +
                       origins.places_of_entries_in(error.what()));
      }
  }
} // namespace CaissonMPM
