// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The command line: what is understood, what is refused, and the usage.
#include <caisson_mpm/base/command_line.h>

#include <iostream>
#include <string>
#include <vector>

#include "../shared/messages.h"

using namespace CaissonMPM;



CommandLine
parse(std::vector<const char *> arguments)
{
  arguments.insert(arguments.begin(), "caisson_mpm");
  return parse_command_line(arguments.size(), arguments.data());
}



void
print(const CommandLine &command_line)
{
  std::cout << "file \"" << command_line.parameter_file << "\" directory \""
            << command_line.output_directory << "\" flags "
            << command_line.print_parameters << command_line.validate
            << command_line.restart << command_line.version
            << command_line.help;
  if (!command_line.explain.empty())
    std::cout << " explain " << command_line.explain;
  for (const std::string &text : command_line.overrides)
    std::cout << " [" << text << ']';
  std::cout << '\n';
}



void
test_command_line()
{
  title("command line");
  print(parse({"prm/jack.prm"}));
  print(parse({"--set",
               "Soil/Friction angle = -3",
               "a.prm",
               "--set=Run control/Stop file=a=b",
               "--output-directory",
               "my results",
               "--restart",
               "--validate"}));
  print(parse({"--print-parameters"}));
  print(parse({"a.prm", "--print-parameters"}));
  print(parse({"--explain", "friction"}));
  print(parse({"--version"}));
  print(parse({"--help"}));
  print(parse({"-h"}));
  for (const std::vector<const char *> &arguments :
       std::vector<std::vector<const char *>>{
         {},
         {"a.prm", "b.prm"},
         {"a.prm", "--ouput-directory", "x"},
         {"a.prm", "--out=x"},
         {"a.prm", "--verbose"},
         {"a.prm", "-x"},
         {"a.prm", "--set"},
         {"a.prm", "--restart=yes"},
         {"a.prm", "--output-directory=x", "--output-directory=y"}})
    {
      std::string line;
      for (const char *const argument : arguments)
        line += std::string(argument) + ' ';
      print_error(line, [&]() { print(parse(arguments)); });
    }
  std::cout << usage();
}



int
main(int, char **)
{
  test_command_line();
  return 0;
}
