// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The base floor: the command line, the parameter file with every message
// that it can give, stop requests, timing, and the console.

#include <caisson_mpm/base/command_line.h>
#include <caisson_mpm/base/console.h>
#include <caisson_mpm/base/declared_entries.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/nearest_names.h>
#include <caisson_mpm/base/parameter_file.h>
#include <caisson_mpm/base/stop_request.h>
#include <caisson_mpm/base/timing.h>

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/utilities.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <thread>

using namespace CaissonMPM;
using dealii::ParameterAcceptor;
using dealii::ParameterHandler;
namespace Patterns = dealii::Patterns;

void
title(const std::string &text)
{
  std::cout << "\n=== " << text << '\n';
}



void
print_error(const std::string &what, const std::function<void()> &action)
{
  std::cout << "--- " << dealii::Utilities::trim(what) << '\n';
  try
    {
      action();
      std::cout << "accepted\n";
    }
  catch (const BadInput &error)
    {
      std::cout << error.what() << '\n';
    }
}



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
  print(parse({"--version"}));
  print(parse({"--help"}));
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
  read("include soil.prm");
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
    std::make_shared<Patterns::DirectoryName>()};
  for (const auto &pattern : patterns)
    std::cout << allowed_values(pattern->description()) << '\n';

  title("all entries, readable as a parameter file");
  const std::string text = describe_parameters(ParameterAcceptor::prm);
  std::cout << text;
  read_text(text);
  std::cout << "read again: "
            << (describe_parameters(ParameterAcceptor::prm) == text) << '\n';
}



void
test_nearest_names()
{
  title("edit distance");
  std::cout << edit_distance("", "abc") << edit_distance("kitten", "sitting")
            << edit_distance("Angle", "angel") << edit_distance("a", "a")
            << '\n';
}



// Stop request, timing -----------------------------------------------------

void
test_stop_request()
{
  title("stop request");
  const auto ask = [](StopRequest &request) {
    std::cout << '"' << request.reason() << "\" \"" << request.reason()
              << "\"\n";
  };
  std::filesystem::create_directory("results");
  {
    StopRequest request;
    request.arm("results");
    ask(request);
    std::raise(SIGTERM);
    ask(request);
  }
  {
    StopRequest request;
    request.arm("results/");
    ask(request);
    std::raise(SIGINT);
    ask(request);
    // The second SIGINT would meet the default action.
    struct sigaction now;
    sigaction(SIGINT, nullptr, &now);
    std::cout << (now.sa_handler == SIG_DFL) << '\n';
  }
  struct sigaction restored;
  sigaction(SIGTERM, nullptr, &restored);
  std::cout << (restored.sa_handler == SIG_DFL) << '\n';
  {
    StopRequest request;
    request.arm("results");
    std::ofstream("results/stop") << "";
    ask(request);
    std::cout << std::filesystem::exists("results/stop") << '\n';
  }
  {
    // Entries of objects that are gone must not be set.
    ParameterAcceptor::clear();
    StopRequest request;
    read_text("subsection Run control\n  set Wall time limit = 0.01\nend");
    request.arm("results");
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ask(request);
  }
}



void
test_timing()
{
  title("timing");
  SectionTimer       timer;
  const unsigned int stress   = timer.section("stress");
  const unsigned int transfer = timer.section("points to grid");
  for (unsigned int i = 0; i < 3; ++i)
    {
      SectionTimer::Scope scope(timer, transfer);
      std::this_thread::sleep_for(std::chrono::milliseconds(4));
    }
  std::cout << stress << transfer << timer.section("stress") << '\n';
  for (const auto &[name, seconds] : timer.seconds())
    std::cout << name << ' ' << (seconds >= 0.012) << (seconds < 10.) << '\n';
  std::cout << (peak_memory_bytes() > 1e6) << (peak_memory_bytes() < 1e12)
            << '\n';
}



// Console ------------------------------------------------------------------

void
test_console()
{
  RecordLine body;
  body.has_body               = true;
  body.penetration            = 1.23456789;
  body.tip                    = 1234567.89;
  body.inner                  = 12345.6789;
  body.outer                  = -1e-12;
  body.total                  = body.tip + body.inner + body.outer;
  body.fraction_done          = 0.2345678;
  body.eta_seconds            = 83.4;
  body.point_steps_per_second = 12.34e6;
  RecordLine column;
  column.time           = 0.0123456789;
  column.kinetic_energy = 1.23456789e-5;
  column.max_speed      = 0.0123456789;
  column.eta_seconds    = std::numeric_limits<double>::quiet_NaN();

  for (const auto verbosity : {Console::Verbosity::full,
                               Console::Verbosity::plain,
                               Console::Verbosity::silent})
    {
      title("console");
      Console console(verbosity);
      console.header({{"version", "1.2.3"}, {"output directory", "results"}});
      console.summary({{"cells", "12"}, {"material points", "108"}});
      console.record(body);
      console.record(column);
      console.message("checkpoint written");
      console.warning("two points left their cell by more than a cell");
      console.failure("1 of 2 checks failed");
      console.table("Wall time",
                    {{"points to grid", 12.3456, 61.2}, {"contact", 0.1, 0.5}});
    }
}



int
main()
{
  test_command_line();
  {
    Soil        soil;
    Grid        grid;
    StopRequest stop_request;
    test_good_file(soil, grid);
    test_bad_files();
    test_bad_statements();
    test_bad_overrides();
    test_descriptions();
  }
  test_nearest_names();
  test_stop_request();
  test_timing();
  test_console();
}
