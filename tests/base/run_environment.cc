// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The base floor: expressions, numbers as text, the output directory, stop
// requests, timing, and the console.

#include <caisson_mpm/base/console.h>
#include <caisson_mpm/base/expression.h>
#include <caisson_mpm/base/mpi_settings.h>
#include <caisson_mpm/base/output_directory.h>
#include <caisson_mpm/base/parameter_file.h>
#include <caisson_mpm/base/stop_request.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/base/text_file.h>
#include <caisson_mpm/base/timing.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_acceptor.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <thread>

#include "../shared/messages.h"

using namespace CaissonMPM;
using dealii::ParameterAcceptor;

void
test_expressions()
{
  title("expressions");
  for (const std::string text :
       {"r + z*t", "r+*z", "r + ", "", "sin(r", "2*x", "if(r > 1, 2)"})
    print_error(text, [&]() {
      const Expression expression(text, "Soil/Initial velocity");
      std::cout << expression(dealii::Point<2>(1., 2.), 3.) << '\n';
    });
}



void
test_numbers()
{
  title("numbers");
  for (const double x :
       {0., 0.1, 1. / 3., 1.2e-7, -2500., 5e6, 1234567., 0.30000000000000004})
    std::cout << to_text(x) << ' ';
  std::cout << to_text(7u) << ' ' << to_text(1. / 3., 3) << '\n';
}



/** What comes from files and from the command line. */
void
test_foreign_text()
{
  title("text from outside");
  for (const std::string text : {"\x1b[31mred\n\x7f\tlast",
                                 "Gr\xc3\xb6\xc3\x9f"
                                 "e \xc2\x9b"
                                 "31m"})
    std::cout << printable(text) << '\n';
  for (const std::string text : {"Gr\xf6\xdf"
                                 "e",
                                 "Gr\xc3\xb6\xc3\x9f"
                                 "e",
                                 "\xc3"})
    std::cout << as_utf8(text) << '\n';
}



/** What an earlier run left in mesh/results is kept. */
void
test_put_aside()
{
  print_error("put aside", [&]() {
    const OutputDirectory directory("mesh/results", MPI_COMM_WORLD);
    for (const std::string text : {"time_s\n", "time_s\n0\n1\n2\n"})
      {
        std::ofstream("mesh/results/history.csv") << text;
        std::ofstream("mesh/results/report.html") << "drawn";
        std::cout << '"' << directory.make_room(false, MPI_COMM_WORLD).place
                  << "\" ";
      }
    std::cout << '\n'
              << read_text("mesh/results/earlier_2/history.csv")
              << read_text("mesh/results/earlier_2/report.html") << '\n'
              << std::filesystem::exists("mesh/results/report.html") << '\n';
  });
  std::filesystem::remove_all("mesh/results/earlier_1");
  std::filesystem::remove_all("mesh/results/earlier_2");
}



void
test_output_directory()
{
  title("output directory");
  const auto use = [](const std::string &path) {
    const OutputDirectory directory(path, MPI_COMM_WORLD);
    directory.record({"grid.pvd", "body.pvd", "history.csv"});
    const auto room = directory.make_room(true, MPI_COMM_WORLD);
    std::cout << "cleared of " << room.n_removed << " files, the others in \""
              << room.place << "\"\n";
    std::filesystem::remove(path + "/.caisson");
    if (!room.place.empty())
      std::cout << std::filesystem::remove_all(room.place) - 1 << " of them\n";
  };
  print_error("new", [&]() { use("mesh/results"); });
  for (const std::string name : {"points_0001.vtu",
                                 "points_0001.2.vtu",
                                 "points_0001.pvtu",
                                 "grid.pvd",
                                 "body.pvd",
                                 "body_0001.vtu",
                                 "history.csv",
                                 "checkpoint-a.h5",
                                 "checkpoint.info",
                                 "run.json",
                                 "forces.png",
                                 "run.json.of_rank_1",
                                 "my_points_0001.vtu",
                                 "history.csv.bak"})
    std::ofstream("mesh/results/" + name) << name;
  print_error("again", [&]() { use("mesh/results"); });
  test_put_aside();
  print_error("in use", [&]() {
    const OutputDirectory directory("mesh/results", MPI_COMM_WORLD);
    for (const bool has_file : {true, false})
      try
        {
          if (!has_file) // the user has removed it
            std::filesystem::remove("mesh/results/.lock");
          use("mesh/results");
        }
      catch (const BadInput &error)
        {
          // without the names of process and host
          const std::string text = error.what();
          const auto name = text.find(has_file ? ", process " : ". Choose");
          std::cout << text.substr(0, name) << (has_file ? " ..." : "")
                    << text.substr(text.find(". Choose")) << '\n';
        }
  });
  std::ofstream("mesh/results/.lock") << "process 1 on a host of old";
  print_error("a lock that was left", [&]() { use("mesh/results"); });
  std::ofstream("mesh/file") << "";
  print_error("a file", [&]() { use("mesh/file"); });
  for (const auto &item : std::filesystem::directory_iterator("mesh/results"))
    if (item.path().extension() != ".png" && item.path().extension() != ".bak")
      std::cout << item.path().filename() << '\n';
}



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
  for (const int signal : {SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2, SIGXCPU})
    {
      StopRequest request;
      request.arm("results");
      std::raise(SIGPIPE);
      std::raise(SIGXFSZ);
      ask(request);
      std::raise(signal);
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
    read_parameters("", {"Run control/Wall time limit=0.01"});
    request.arm("results");
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ask(request);
  }
}



void
test_stop_file()
{
  for (const std::string name : {"", "halt", "history.csv", "../notes"})
    {
      ParameterAcceptor::clear();
      StopRequest request;
      read_parameters("", {"Run control/Stop file=" + name});
      ParameterAcceptor::parse_all_parameters();
      print_error('"' + name + '"', [&]() { request.check_parameters(); });
    }
}



void
test_timing()
{
  title("timing");
  SectionTimer timer;
  timer.time("stress", []() {});
  for (unsigned int i = 0; i < 3; ++i)
    timer.time("points to grid", []() {
      std::this_thread::sleep_for(std::chrono::milliseconds(4));
    });
  timer.resume({{"time", 1e6}, {"seconds_of_points_to_grid", 1e5}});
  for (const auto &[name, seconds] : timer.seconds())
    std::cout << name << ' ' << (seconds >= 0.012) << (seconds < 1e4) << '\n';
  for (const auto &[name, seconds] : timer.state())
    std::cout << name << ' ' << (seconds >= 1e5 + 0.012) << '\n';
  std::cout << (peak_memory_bytes() > 1e6) << (peak_memory_bytes() < 1e12)
            << '\n';
}



void
test_console()
{
  constexpr double   nan    = std::numeric_limits<double>::quiet_NaN();
  const NamedNumbers body   = {{"penetration_m", 1.23456789},
                               {"tip_force_N", 1234567.89},
                               {"inner_friction_N", 12345.6789},
                               {"outer_friction_N", -1e-12},
                               {"total_force_N", 1246913.5689}},
                     model  = {{"penetration_m", .0123456}, // in N, Pa and mm
                               {"tip_force_N", 12.3456},
                               {"total_force_N", 999.9},
                               {"suction_Pa", 456.7},
                               {"critical_gradient", 0.}},
                     column = {{"time_s", 0.0123456789},
                               {"kinetic_energy_J", 1.23456789e-5},
                               {"max_speed_m_s", 0.0123456789}};

  for (const auto verbosity : {Console::Verbosity::full,
                               Console::Verbosity::plain,
                               Console::Verbosity::silent})
    {
      title("console");
      Console console(verbosity);
      console.header({{"version", "1.2.3"}, {"output", "results"}});
      console.summary({{"cells", "12"}, {"material points", "108"}});
      console.record({body, 0.2345678, 83.4});
      console.record({model, 0., 0., .2});
      console.record({column, 0., nan});
      console.message("checkpoint written");
      console.warning("two points left their \x1b[31mcell by more than a cell");
    }
}



/** MPI's settings are replaced in a process that is alone, and kept in one of
 * several. */
void
test_mpi_settings()
{
  title("settings of MPI");
  for (const char *sign : {"PMIX_RANK", "PMI_RANK", "SLURM_PROCID", ""})
    {
      setenv("OMPI_MCA_btl", "tcp", 1);
      if (*sign != 0)
        setenv(sign, "0", 1);
      std::cout << '"' << sign << "\" " << set_up_mpi() << ' '
                << std::getenv("OMPI_MCA_btl") << '\n';
      if (*sign != 0)
        unsetenv(sign);
    }
}



int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_expressions();
  test_numbers();
  test_foreign_text();
  test_output_directory();
  test_stop_request();
  test_stop_file();
  test_timing();
  test_console();
  test_mpi_settings();
  return 0;
}
