// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The base floor: the command line, and the parameter file with every message
// that it can give.

#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/command_line.h>
#include <caisson_mpm/base/declared_entries.h>
#include <caisson_mpm/base/nearest_names.h>
#include <caisson_mpm/base/parameter_file.h>
#include <caisson_mpm/base/stop_request.h>
#include <caisson_mpm/base/text.h>

#include <deal.II/base/parameter_acceptor.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>

#include "../shared/messages.h"

using namespace CaissonMPM;
using dealii::ParameterAcceptor;
using dealii::ParameterHandler;
namespace Patterns = dealii::Patterns;



// Command line -------------------------------------------------------------

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



// Parameter file -----------------------------------------------------------

/** Entries as the classes of the program declare them. */
struct Soil : public ParameterAcceptor
{
  Soil()
    : ParameterAcceptor("Soil")
  {
    add_parameter("Friction angle",
                  friction_angle,
                  "Angle of internal friction of the sand. Units: degree",
                  prm,
                  Patterns::Double(0., 90.));
    add_parameter("Youngs modulus",
                  youngs_modulus,
                  "Stiffness of the skeleton. Units: Pa",
                  prm,
                  Patterns::Double(0.));
    add_parameter("Model",
                  model,
                  "The constitutive model. Units: none",
                  prm,
                  Patterns::Selection("elastic|Mohr-Coulomb|Tresca"));
    prm.enter_subsection("Soil");
    prm.declare_alias("Youngs modulus", "Stiffness", true);
    prm.leave_subsection();
  }

  double      friction_angle = 31.;
  double      youngs_modulus = 1e7;
  std::string model          = "Mohr-Coulomb";
};



struct Grid : public ParameterAcceptor
{
  Grid()
    : ParameterAcceptor("Grid/Fine zone")
  {
    add_parameter("Points per cell",
                  n_points,
                  "Material points per cell and direction. Units: none");
    add_parameter("Columns",
                  n_columns,
                  "Cells from the axis to the rim. Units: none",
                  prm,
                  Patterns::Integer(1, 1000));
    add_parameter("Rows",
                  rows,
                  "Height of each row. Units: m",
                  prm,
                  Patterns::List(Patterns::Double(0.), 1, 4));
    add_parameter("Moves",
                  moves,
                  "Whether the zone moves with the body. Units: none");
  }

  unsigned int        n_points  = 3;
  int                 n_columns = 8;
  std::vector<double> rows      = {0.1, 0.2};
  bool                moves     = true;
};



/** A choice, and words in the place of numbers. */
struct Method : public ParameterAcceptor
{
  enum class Transfer
  {
    flip,
    pic
  };

  Method()
    : ParameterAcceptor("/Method")
  {
    add_choice(*this,
               "Velocity transfer",
               transfer,
               {{"FLIP", Transfer::flip}, {"PIC", Transfer::pic}},
               "How points take the velocity of the grid. Units: none.");
    add_word_or_number(*this,
                       "Record interval",
                       interval,
                       "every step",
                       0.,
                       "Time between records. Units: s.",
                       Patterns::Double(0.));
    add_word_or_number(*this,
                       "K0",
                       k0,
                       "auto",
                       {},
                       "Ratio of stresses. Units: none.",
                       Patterns::Double(0., 10.));
  }

  Transfer              transfer = Transfer::pic;
  std::optional<double> interval = 0.1;
  std::optional<double> k0;
};



ParameterOrigins
read_text(const std::string              &text,
          const std::vector<std::string> &overrides = {})
{
  std::ofstream("jack.prm", std::ios::binary) << text;
  return read_parameters(ParameterAcceptor::prm, "jack.prm", overrides);
}



void
test_good_file(const Soil &soil, const Grid &grid)
{
  title("a good file");
  const ParameterOrigins origins =
    read_text("\xEF\xBB\xBF# Shows what may stand in a file.\r\n"
              "subsection Soil   # the sand\r\n"
              "  set  Friction   angle= 38 # as measured\r\n"
              "  set Stiffness = 2e7\r\n"
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
    print_error(name, [&]() { read_parameters(ParameterAcceptor::prm, name); });
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
    print_error(text.substr(0, text.find('\0')), [&]() { read_text(text); });
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
  read("subsection Soil\n  set Stiffness = -1\n");
  read("subsection Soil\n  set Model = Mohr Coulomb\n");
  read("subsection Grid\nsubsection Fine zone\n  set Points per cell = -1");
  read("subsection Grid\nsubsection Fine zone\n  set Points per cell = 2.5");
  read("subsection Grid\nsubsection Fine zone\n  set Columns = 0");
  read("subsection Grid\nsubsection Fine zone\n  set Rows = 1, \\\n  -1\n");
  read("subsection Grid\nsubsection Fine zone\n  set Moves = yes\n");
  read("subsection Run control\n  set Wall time limit = 1 h\n");

  title("entries that are set twice");
  read("subsection Soil\n  set Model = Tresca\n  set Model = Tresca\n");
  read("subsection Soil\n  set Stiffness = 1\nend\n"
       "subsection Soil\n  set Youngs modulus = 2\n");
}



/** Write files, of which the first is read; names come before texts. */
ParameterOrigins
read_files(const std::vector<std::pair<std::string, std::string>> &files)
{
  for (const auto &[name, text] : files)
    std::ofstream("scenes/" + name, std::ios::binary) << text;
  return read_parameters(ParameterAcceptor::prm, "scenes/" + files[0].first);
}



void
test_include(const Soil &soil, const Grid &grid)
{
  title("include");
  std::filesystem::create_directories("scenes/base");
  const std::pair<std::string, std::string> base = {
    "base/sand.prm",
    "subsection Soil\n  set Friction angle = 30\n"
    "  set Stiffness = 1e6\nend\n"};
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
test_choices(const Method &method)
{
  title("choices, and words for numbers");
  const auto print = [&]() {
    std::cout << (method.transfer == Method::Transfer::pic ? "PIC" : "FLIP")
              << ' ' << (method.interval ? to_text(*method.interval) : "-")
              << ' ' << (method.k0 ? to_text(*method.k0) : "-") << '\n';
  };
  const auto read = [&](const std::string &text) {
    print_error(text, [&]() {
      const ParameterOrigins origins =
        read_text("subsection Method\n" + text + "\nend\n");
      for (const std::string &warning : origins.warnings())
        std::cout << warning << '\n';
      print();
    });
  };
  print();
  read("set Velocity transfer = FLIP");
  read("set Velocity transfer = flip");
  read("set Record interval = every step");
  read("set Record interval = 0.5");
  read("set Record interval = 0.0");
  read("set Record interval = never");
  read("set Record interval = -1");
  read("set K0 = 0");
  read("set K0 = auto");
}



void
test_places()
{
  title("places and entries that are not used");
  std::ofstream("sand.prm") << "subsection Soil\n  set Model = Tresca\nend\n";
  ParameterOrigins origins =
    read_text("include sand.prm\nsubsection Soil\n  set Youngs modulus = 1\n"
              "end\nsubsection Grid\nsubsection Fine zone\n"
              "  set Rows = 1\n  set Columns = 2\nend\nend\n",
              {"Soil/Friction angle=3"});
  std::cout << origins.places_of_entries_in(
                 "Soil/Friction angle = 3 does not fit Soil/Youngs modulus = 1 "
                 "and Soil/Model, Soil/Youngs moduli; Method/K0 = 2.")
            << '\n';
  std::cout << '"' << origins.places_of_entries_in("no entry at all") << "\"\n";
  origins.add_unused({"Grid"}, "there is no mesh");
  origins.add_unused({"Grid/Fine zone"},
                     "Grid/Fine zone/Columns is less than 3");
  origins.add_unused({"Soil/Model", "Method"}, "this is never said");
  origins.add_unused({"Soil"}, "Soil/Youngs modulus is 1");
  for (const std::string &text : origins.warnings())
    std::cout << text << '\n';
}



void
test_bad_overrides()
{
  title("overrides");
  const auto read = [](const std::vector<std::string> &overrides) {
    std::string all;
    for (const std::string &text : overrides)
      all += "--set \"" + text + "\" ";
    print_error(all, [&]() {
      read_parameters(ParameterAcceptor::prm, "", overrides);
    });
  };
  read({"Soil/Friction angle=38"});
  read({"Soil/Friction"});
  read({"Soil/Friction angel=38"});
  read({"Friction angle=38"});
  read({"Soil/Friction angle=steep"});
  read({"Grid/Fine zone=2"});
  read({"Soil/Model=Tresca", "Soil/Model=elastic"});
}



void
test_descriptions()
{
  title("patterns in words");
  const std::vector<std::shared_ptr<Patterns::PatternBase>> patterns = {
    std::make_shared<Patterns::Integer>(),
    std::make_shared<Patterns::Integer>(0),
    std::make_shared<Patterns::Integer>(std::numeric_limits<int>::min(), 5),
    std::make_shared<Patterns::Double>(),
    std::make_shared<Patterns::Double>(-1., 1e-3),
    std::make_shared<Patterns::Double>(-std::numeric_limits<double>::max(), 5.),
    std::make_shared<Patterns::Bool>(),
    std::make_shared<Patterns::Selection>("a|b | c"),
    std::make_shared<Patterns::MultipleSelection>("a|b|c"),
    std::make_shared<Patterns::List>(Patterns::Double(0.), 1, 1),
    std::make_shared<Patterns::List>(Patterns::Anything()),
    std::make_shared<Patterns::List>(Patterns::Integer(), 2),
    std::make_shared<Patterns::List>(
      Patterns::List(Patterns::Double(), 2, 2), 0, 4, ";"),
    std::make_shared<Patterns::Map>(Patterns::Anything(), Patterns::Double(0.)),
    std::make_shared<Patterns::Anything>(),
    std::make_shared<Patterns::FileName>(),
    std::make_shared<Patterns::DirectoryName>(),
    std::make_shared<WordOrNumber>("auto", -1., Patterns::Double(0., 10.)),
    std::make_shared<WordOrNumber>("never", std::nullopt, Patterns::Double())};
  for (const auto &pattern : patterns)
    std::cout << allowed_values(pattern->description()) << '\n';

  title("all entries, readable as a parameter file");
  const std::string text = describe_parameters(ParameterAcceptor::prm);
  std::cout << text;
  read_text(text);
  std::cout << "read again: "
            << (describe_parameters(ParameterAcceptor::prm) == text) << '\n';

  title("entries with a word");
  for (const char *word : {"friction", "INTERNAL friction", "Frcition angle"})
    print_error(word, [&]() {
      std::cout << describe_parameters(ParameterAcceptor::prm, word);
    });
}



void
test_nearest_names()
{
  title("edit distance");
  std::cout << edit_distance("", "abc") << edit_distance("kitten", "sitting")
            << edit_distance("Angle", "angel") << edit_distance("a", "a")
            << '\n';
}



int
main()
{
  test_command_line();
  {
    Soil        soil;
    Grid        grid;
    Method      method;
    StopRequest stop_request;
    test_good_file(soil, grid);
    test_bad_files();
    test_bad_statements();
    test_include(soil, grid);
    test_choices(method);
    test_places();
    test_bad_overrides();
    test_descriptions();
  }
  test_nearest_names();
}
