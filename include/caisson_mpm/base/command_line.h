// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The command line of the program.
#ifndef caisson_mpm_base_command_line_h
#define caisson_mpm_base_command_line_h

#include <string>
#include <vector>

namespace CaissonMPM
{
  /** What the user asked for on the command line. */
  struct CommandLine
  {
    /** Empty only with --help, --version, --print-parameters or --explain. */
    std::string parameter_file;
    /** The texts "Section/Sub/Entry=value" of each --set, in order. */
    std::vector<std::string> overrides;
    /** Empty where --output-directory was not given. */
    std::string output_directory;
    /** The word of --explain, or empty where it was not given. */
    std::string explain;
    /** All words behind the name of the program. */
    std::string text;
    bool        print_parameters = false;
    bool        validate         = false;
    bool        strict           = false;
    bool        restart          = false;
    bool        overwrite        = false;
    bool        version          = false;
    bool        help             = false;
  };

  /**
   * Read the command line. Throws BadInput for an unknown option (naming the
   * nearest one), an option without its value or given twice, and for no or
   * more than one parameter file. Whatever else is on the line, --help and
   * --version are obeyed as long as all options are known.
   */
  CommandLine
  parse_command_line(int argc, const char *const *argv);

  /** The text that --help prints. */
  std::string
  usage();
} // namespace CaissonMPM

#endif
