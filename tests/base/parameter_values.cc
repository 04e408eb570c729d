// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The values of entries: choices and words for numbers, where they were set,
// and how all entries are described.
#include <caisson_mpm/base/nearest_names.h>
#include <caisson_mpm/base/stop_request.h>
#include <caisson_mpm/base/text.h>

#include <iostream>
#include <limits>
#include <memory>

#include "sample_entries.h"

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
        read_sample("subsection Method\n" + text + "\nend\n");
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
    read_sample("include sand.prm\nsubsection Soil\n  set Youngs modulus = 1\n"
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
    std::make_shared<Patterns::List>(Patterns::Double(0.), 1, 1),
    std::make_shared<Patterns::List>(Patterns::Anything()),
    std::make_shared<Patterns::List>(Patterns::Integer(), 2),
    std::make_shared<Patterns::List>(
      Patterns::List(Patterns::Double(), 2, 2), 0, 4, ";"),
    std::make_shared<Patterns::Anything>(),
    std::make_shared<WordOrNumber>("auto", -1., Patterns::Double(0., 10.)),
    std::make_shared<WordOrNumber>("never", std::nullopt, Patterns::Double())};
  for (const auto &pattern : patterns)
    std::cout << allowed_values(*pattern) << '\n';

  title("all entries, readable as a parameter file");
  const std::string text = describe_parameters();
  std::cout << text;
  read_sample(text);
  std::cout << "read again: " << (describe_parameters() == text) << '\n';

  title("entries with a word");
  for (const char *word : {"friction", "INTERNAL friction", "Frcition angle"})
    print_error(word, [&]() { std::cout << describe_parameters(word); });
}



/** More of the section of SoilEntries. */
struct MoreOfSoil : public Section
{
  MoreOfSoil()
    : Section("Soil")
  {
    add_parameter("Porosity", porosity, "", "The share of the pores.");
  }

  double porosity = .4;
};



void
test_late_entry()
{
  title("an entry that is declared late, and gone");
  {
    const MoreOfSoil more;
    for (const std::string &path : entry_paths())
      std::cout << path << '\n';
  }
  std::cout << (find_entry("Soil/Porosity") == nullptr) << '\n';
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
main(int, char **)
{
  {
    SoilEntries soil;
    Grid        grid;
    Method      method;
    StopRequest stop_request;
    test_choices(method);
    test_places();
    read_sample("subsection Grid\nsubsection Fine zone\n"
                "  set Points per cell = 4\nend\nend\n",
                {"Soil/Friction angle=38"});
    test_descriptions();
    test_late_entry();
  }
  test_nearest_names();
  return 0;
}
