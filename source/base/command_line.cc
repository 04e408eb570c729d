// SPDX-License-Identifier: LGPL-2.1-or-later

#include <caisson_mpm/base/command_line.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/nearest_names.h>

#include <boost/program_options.hpp>

#include <algorithm>
#include <sstream>

namespace CaissonMPM
{
  namespace
  {
    namespace po = boost::program_options;

    /** The options of --help, which set the members of @p line. */
    po::options_description
    visible_options(CommandLine &line)
    {
      po::options_description options("Options");
      auto                    add = options.add_options();
      add("set",
          po::value(&line.overrides)->value_name("\"Section/Entry=value\""),
          "set one entry, overriding the file; may be repeated");
      add("output-directory",
          po::value(&line.output_directory)->value_name("DIR"),
          "write all results into DIR");
      add("print-parameters",
          po::bool_switch(&line.print_parameters),
          "print all entries with their meaning and the values in effect, and "
          "stop; the output is itself a parameter file");
      add("explain",
          po::value(&line.explain)->value_name("WORD"),
          "print the entries with this word in their name or section, for "
          "example friction or \"Rigid body\", and stop");
      add("validate",
          po::bool_switch(&line.validate),
          "check the input without running it, and stop");
      add("strict",
          po::bool_switch(&line.strict),
          "treat warnings of likely mistakes in the input as errors, with "
          "--validate and in a run");
      add("restart",
          po::bool_switch(&line.restart),
          "continue from the checkpoint in the output directory");
      add("overwrite",
          po::bool_switch(&line.overwrite),
          "remove the results of an earlier run in the output directory, "
          "which are otherwise kept in earlier_1, earlier_2, ...; with "
          "--restart: continue although rows of history.csv are lost");
      add("version",
          po::bool_switch(&line.version),
          "print the version and stop");
      add("help,h", po::bool_switch(&line.help), "print this text and stop");
      return options;
    }

    /** The options that begin with a name, or else those that are close to it.
     */
    std::vector<std::string>
    options_near(const std::string &name)
    {
      std::vector<std::string>      names, result;
      CommandLine                   unused;
      const po::options_description options = visible_options(unused);
      for (const auto &known : options.options())
        {
          names.push_back(known->long_name());
          if (name.size() > 1 &&
              names.back().compare(0, name.size(), name) == 0)
            result.push_back(names.back());
        }
      return result.empty() ? nearest_names(name, names) : result;
    }

    std::string
    unknown_option_message(const std::string &option)
    {
      // dashes, which all options have, make none of them nearer
      const std::size_t begin =
        std::min(option.find_first_not_of('-'), option.size());
      std::vector<std::string> names =
        options_near(option.substr(begin, option.find('=') - begin));
      for (std::string &name : names)
        name = "--" + name;
      return "Unknown option \"" + option + "\"." + did_you_mean(names) +
             "\n  \"caisson_mpm --help\" lists the options.";
    }

    std::string
    single_parameter_file(const std::vector<std::string> &files,
                          const bool                      may_be_missing)
    {
      if (files.empty() && !may_be_missing)
        throw BadInput("No parameter file was given.\n"
                       "  Write, for example, \"caisson_mpm prm/jack.prm\"; "
                       "\"caisson_mpm --help\" says more.");
      if (files.size() > 1)
        throw BadInput(
          "More than one parameter file was given: \"" + files[0] +
          "\" and \"" + files[1] +
          "\".\n  Give one file; single entries are changed with --set "
          "\"Section/Entry=value\" (mind the quotes).");
      return files.empty() ? "" : files.front();
    }

    CommandLine
    parse_options(const int argc, const char *const *argv)
    {
      CommandLine              result;
      std::vector<std::string> files;
      po::options_description  all = visible_options(result);
      all.add_options()("file", po::value(&files));
      po::positional_options_description positional;
      positional.add("file", -1);

      // No abbreviations: scripts must not depend on which options exist.
      const int style = po::command_line_style::default_style &
                        ~po::command_line_style::allow_guessing;
      po::variables_map given;
      po::store(po::command_line_parser(argc, argv)
                  .options(all)
                  .positional(positional)
                  .style(style)
                  .run(),
                given);
      po::notify(given);
      if (given.count("explain") > 0 &&
          result.explain.find_first_not_of(' ') == std::string::npos)
        throw BadInput(
          "--explain needs a word, for example --explain friction; "
          "--print-parameters prints all entries.");
      if (!result.help && !result.version)
        result.parameter_file = single_parameter_file(
          files, result.print_parameters || !result.explain.empty());
      return result;
    }
  } // namespace

  CommandLine
  parse_command_line(const int argc, const char *const *argv)
  {
    try
      {
        CommandLine result = parse_options(argc, argv);
        for (int i = 1; i < argc; ++i)
          result.text += (i > 1 ? " " : "") + std::string(argv[i]);
        return result;
      }
    catch (const po::unknown_option &error)
      {
        throw BadInput(unknown_option_message(error.get_option_name()));
      }
    catch (const po::error &error)
      {
        throw BadInput(
          "The command line cannot be read: " + std::string(error.what()) +
          ".\n  \"caisson_mpm --help\" lists the options.");
      }
  }

  std::string
  usage()
  {
    CommandLine        unused;
    std::ostringstream text;
    text
      << "caisson_mpm: suction caissons pushed into sand, by an "
         "axisymmetric material point method.\n\n"
         "Usage: caisson_mpm FILE.prm [options]\n\n"
      << visible_options(unused)
      << "\nExamples are in prm/, from prm/tutorial.prm on; the documentation "
         "is in doc/,\nfrom doc/quick_start.md on. Where the program is "
         "installed, \"caisson scenes\"\nlists the examples.\n"
         "\nExit status: 0 success, 1 bad input, 2 failure while running, "
         "3 stopped on request\nwith a checkpoint.\n";
    return text.str();
  }
} // namespace CaissonMPM
