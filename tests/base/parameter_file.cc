// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The parameter file, included files and --set, with every message that they
// can give.
#include <caisson_mpm/base/stop_request.h>
#include <caisson_mpm/base/text.h>

#include <filesystem>
#include <fstream>
#include <iostream>

#include "sample_entries.h"

void
test_good_file(const SoilEntries &soil, const Grid &grid)
{
  title("a good file");
  const ParameterOrigins origins =
    read_sample("\xEF\xBB\xBF# Shows what may stand in a file.\r\n"
                "subsection Soil   # the sand\r\n"
                "  set  Friction   angle= 38 # as measured\r\n"
                "  set Youngs modulus = 2e7\r\n"
                "end\r\n"
                "SUBSECTION Grid\n"
                "subsection Fine zone\n"
                "  SET Rows = 0.25, \\  # two rows\n"
                "             0.5\n"
                "  # set Rows = 1, \\\n"
                "  set Points per cell = 4\n"
                "end\n"
                "END",
                {" Grid / Fine zone/Columns = 12", "Soil/Friction angle=33"});
  std::cout << soil.friction_angle << ' ' << soil.youngs_modulus << ' '
            << soil.model << ' ' << grid.n_points << ' ' << grid.n_columns
            << ' ' << grid.rows[0] << ' ' << grid.rows[1] << ' ' << grid.moves
            << '\n';
  for (const std::string path : {"Soil/Friction angle",
                                 "Soil/Youngs modulus",
                                 "Soil/Model",
                                 "Grid/Fine zone/Columns",
                                 "Grid/Fine zone/Rows",
                                 "Grid/Fine zone/Points per cell"})
    std::cout << path << ": " << origins.origin(path) << ' '
              << origins.is_set(path) << '\n';
  for (const std::string &text : origins.warnings())
    std::cout << text << '\n';
}



void
test_bad_files()
{
  title("files that cannot be read");
  const auto read_file = [](const std::string &name) {
    print_error(name, [&]() { read_parameters(name); });
  };
  read_file("missing/jack.prm");
  read_file("jcak.prm"); // jack.prm is there from the test before
  std::filesystem::create_directory("directory.prm");
  read_file("directory.prm");
}



void
test_bad_statements()
{
  title("statements that cannot be read");
  const auto read = [](const std::string &text) {
    print_error(text.substr(0, text.find('\0')), [&]() { read_sample(text); });
  };
  read("");
  read("# only a comment\n\n");
  read(std::string("binary\0file", 11));
  read("subsection Soil\nend\n");
  read("set Friction angle 38");
  read("subsection Soil\n  set = 38\nend");
  read("Friction angle = 38");
  read("<?xml version=\"1.0\" encoding=\"utf-8\"?><ParameterHandler><Soil>");
  read("subsection");
  read("subsection Soil\nend Soil");
  read("subsection Soil\nend\nend\n");
  read("\nsubsection Grid\nsubsection Fine zone\n  set Moves = true\nend\n");
  read("subsection Soil\n  set Friction angle = 30\nsubsection Grid\n");

  title("unknown names");
  read("subsection Sol\n");
  read("subsection Fine zone\n");
  read("subsection Weather\n");
  read("set Youngs modulus = 1e7");
  read("set Soil/Youngs modulus = 1e7");
  read("set Soil/Youngs modulsu = 1e7");
  read("subsection Grid/Fine zone");
  read("set Grid = 1");
  read("subsection Soil\n  set friction angel = 38\n");
  read("subsection Soil\n  set Young's modulus (E) = 1e7\n");
  read("subsection Soil\n  set Modulus = 1e7\n");
  read("subsection Soil\n  set Columns = 8\n");
  read("subsection Soil\n  set Dilatancy = 8\n");

  title("values that are not allowed");
  read("subsection Soil\n  set Friction angle = 95\n");
  read("subsection Soil\n  set Friction angle = 38,5\n");
  read("subsection Soil\n  set Friction angle =\n");
  read("subsection Soil\n  set Youngs modulus = -1\n");
  read("subsection Soil\n  set Youngs modulus = nan\n");
  read("subsection Soil\n  set Model = Mohr Coulomb\n");
  read("subsection Grid\nsubsection Fine zone\n  set Points per cell = -1");
  read("subsection Grid\nsubsection Fine zone\n  set Points per cell = 2.5");
  read("subsection Grid\nsubsection Fine zone\n  set Columns = 0");
  read("subsection Grid\nsubsection Fine zone\n  set Rows = 1, \\\n  -1\n");
  read("subsection Grid\nsubsection Fine zone\n  set Moves = yes\n");
  read("subsection Run control\n  set Wall time limit = 1 h\n");

  title("entries that are set twice");
  read("subsection Soil\n  set Model = Tresca\n  set Model = Tresca\n");
  read("subsection Soil\n  set Youngs modulus = 1\nend\n"
       "subsection Soil\n  set Youngs modulus = 2\n");
}



/** Write files, of which the first is read; names come before texts. */
ParameterOrigins
read_files(const std::vector<std::pair<std::string, std::string>> &files)
{
  for (const auto &[name, text] : files)
    std::ofstream("scenes/" + name, std::ios::binary) << text;
  return read_parameters("scenes/" + files[0].first);
}



void
test_include(const SoilEntries &soil, const Grid &grid)
{
  title("include");
  std::filesystem::create_directories("scenes/base");
  const std::pair<std::string, std::string> base = {
    "base/sand.prm",
    "subsection Soil\n  set Friction angle = 30\n"
    "  set Youngs modulus = 1e6\nend\n"};
  const std::pair<std::string, std::string> wide = {
    "base/wide.prm",
    "# a comment may stand before\ninclude sand.prm\nsubsection Grid\n"
    "subsection Fine zone\n  set Columns = 20\nend\nend\n"};
  const ParameterOrigins origins =
    read_files({{"jack.prm",
                 "include base/wide.prm # the domain\n"
                 "subsection Soil\n  set Friction angle = 35\nend\n"},
                wide,
                base});
  std::cout << soil.friction_angle << ' ' << soil.youngs_modulus << ' '
            << grid.n_columns << '\n';
  for (const std::string path :
       {"Soil/Friction angle", "Soil/Youngs modulus", "Grid/Fine zone/Columns"})
    std::cout << path << ": " << origins.origin(path) << '\n';
  for (const std::string &text : origins.warnings())
    std::cout << text << '\n';

  const auto read = [&](const std::string &text, const std::string &included) {
    print_error(text, [&]() {
      read_files({{"jack.prm", text}, {"base/sand.prm", included}, wide});
    });
  };
  read("include", "");
  read("include base/snad.prm", "");
  read("include base", "");
  read("subsection Soil\nend\ninclude base/sand.prm", "");
  read("include jack.prm", "");
  read("include base/wide.prm", "include ../jack.prm");
  read("include base/wide.prm\ninclude base/sand.prm", base.second);
  read("include base/sand.prm", "# nothing\n");
  read("include base/sand.prm", "subsection Soil\n  set Friction = 3\nend\n");
  read("include base/wide.prm", "subsection Soil\n");
  read("include base/wide.prm",
       "subsection Soil\n  set Model = elastic\n  set Model = Tresca\nend\n");
  read("include base/wide.prm", base.second);
}



void
test_bad_overrides()
{
  title("overrides");
  const auto read = [](const std::vector<std::string> &overrides) {
    std::string all;
    for (const std::string &text : overrides)
      all += "--set \"" + text + "\" ";
    print_error(printable(all), [&]() { read_parameters("", overrides); });
  };
  read({"Soil/Friction angle=38"});
  read({"Soil/Friction"});
  read({"Soil/Friction angel=38"});
  read({"Friction angle=38"});
  read({"Soil/Friction angle=steep"});
  read({"Grid/Fine zone=2"});
  read({"Soil/Model=Tresca", "Soil/Model=elastic"});
  read({"Run control/Stop file=a\x1b[31m"});
  read({"Run control/Stop file=a\xc2\x9b"
        "31m"});
  read({"Run control/Stop file=in\nthree\t\r\nwords"});
  ParameterAcceptor::prm.enter_subsection("Run control");
  std::cout << '"' << ParameterAcceptor::prm.get("Stop file") << "\"\n";
  ParameterAcceptor::prm.leave_subsection();
}



int
main(int, char **)
{
  SoilEntries soil;
  Grid        grid;
  Method      method;
  StopRequest stop_request;
  test_good_file(soil, grid);
  test_bad_files();
  test_bad_statements();
  test_include(soil, grid);
  test_bad_overrides();
  return 0;
}
