// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/console.h>
#include <caisson_mpm/base/declared_entries.h>
#include <caisson_mpm/base/fingerprint.h>
#include <caisson_mpm/base/parameter_file.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/materials/like_layer.h>
#include <caisson_mpm/simulation/physics_text.h>
#include <caisson_mpm/simulation/run_scene.h>
#include <caisson_mpm/simulation/simulation.h>

#include <deal.II/base/parameter_acceptor.h>

namespace CaissonMPM
{
  namespace
  {
    /** Print all entries, or those with a word; notes on the input become
     * comments. */
    void
    print_parameters(const ParameterOrigins &origins,
                     const std::string      &word,
                     std::ostream           &out)
    {
      const std::string entries =
        word.empty() ? describe_parameters() : describe_parameters(word);
      for (const std::string &text : origins.warnings())
        out << "# warning: " << printable(text) << '\n';
      out << entries;
      if (word.empty())
        out << "# fingerprint: " << fingerprint_of(changed_physics()) << '\n';
    }

    /** Print the warnings, each with the places of the entries that it names.
     */
    void
    print_warnings(const ParameterOrigins &origins, std::ostream &out)
    {
      for (const std::string &text : origins.warnings())
        out << "warning: "
            << printable(text + origins.places_of_entries_in(text)) << '\n';
      out << std::flush;
    }

    /** Do something, and add to a BadInput where the entries that it names were
     * set. */
    template <typename Action>
    auto
    with_places(const ParameterOrigins &origins, const Action &action)
    {
      try
        {
          return action();
        }
      catch (const BadInput &error)
        {
          throw BadInput(error.what() +
                         origins.places_of_entries_in(error.what()));
        }
    }

    /** Set the scene up, and collect the warnings of it. Those that were found
     * before an error are printed: they may explain it. */
    void
    set_up(const CommandLine &command_line,
           Simulation        &simulation,
           ParameterOrigins  &origins,
           std::ostream      &out)
    {
      try
        {
          dealii::ParameterAcceptor::parse_all_parameters();
          simulation.name_unused_entries(origins);
          simulation.set_up(command_line, origins);
          simulation.review(origins);
        }
      catch (const BadInput &)
        {
          print_warnings(origins, out);
          throw;
        }
    }

    void
    refuse_mistakes(const std::string      &scene_file,
                    const ParameterOrigins &origins)
    {
      const auto &mistakes = origins.mistakes();
      if (mistakes.empty())
        return;
      std::string text;
      for (const std::string &mistake : mistakes)
        text += "\nwarning: " + mistake + origins.places_of_entries_in(mistake);
      throw BadInput(scene_file + " has " + to_text(mistakes.size()) +
                     (mistakes.size() == 1 ? " warning" : " warnings") +
                     ", which --strict takes for errors:" + text);
    }
  } // namespace

  ExitStatus
  run_scene(const CommandLine &command_line, std::ostream &out)
  {
    Simulation simulation(MPI_COMM_WORLD);
    auto       origins = read_parameters(command_line.parameter_file,
                                   command_line.overrides,
                                   [&simulation](const std::string &path) {
                                     return simulation.declare_subsection(path);
                                   });
    if (!command_line.output_directory.empty())
      origins.record("Output/Directory", "--output-directory");
    with_places(origins, [&]() { fill_like_layers(origins); });
    if (command_line.print_parameters || !command_line.explain.empty())
      {
        print_parameters(origins, command_line.explain, out);
        finish_list(out);
        return ExitStatus::success;
      }
    with_places(origins,
                [&]() { set_up(command_line, simulation, origins, out); });
    if (command_line.strict)
      refuse_mistakes(command_line.parameter_file, origins);
    if (!command_line.validate)
      return with_places(origins, [&]() { return simulation.run(origins); });
    // the first steps, too, may show that an entry is wrong
    const RunCost cost =
      with_places(origins, [&]() { return simulation.estimate_cost(); });
    if (!cost.failure.empty())
      origins.add_warning(cost.failure);
    print_warnings(origins, out);
    out << printable(command_line.parameter_file)
        << (cost.failure.empty() ?
              " is valid\n" :
              " has no wrong entry, but its first steps fail\n")
        << describe(cost);
    finish_list(out);
    return ExitStatus::success;
  }
} // namespace CaissonMPM
