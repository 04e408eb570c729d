// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the tests of parameter files share: entries as the classes of the
// program declare them, and how a text is read.
#ifndef caisson_mpm_tests_sample_entries_h
#define caisson_mpm_tests_sample_entries_h

#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/declared_entries.h>
#include <caisson_mpm/base/parameter_file.h>

#include <deal.II/base/parameter_acceptor.h>

#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "../shared/messages.h"

using namespace CaissonMPM;
using dealii::ParameterAcceptor;
namespace Patterns = dealii::Patterns;



/** Entries as the classes of the program declare them. */
struct SoilEntries : public Section
{
  SoilEntries()
    : Section("Soil")
  {
    add_parameter("Friction angle",
                  friction_angle,
                  "degree",
                  "Angle of internal friction of the sand.",
                  Patterns::Double(0., 90.));
    add_parameter("Youngs modulus",
                  youngs_modulus,
                  "Pa",
                  "Stiffness of the skeleton.",
                  Patterns::Double(0.));
    add_parameter("Model",
                  model,
                  "",
                  "The constitutive model.",
                  Patterns::Selection("elastic|Mohr-Coulomb|Tresca"));
  }

  double      friction_angle = 31.;
  double      youngs_modulus = 1e7;
  std::string model          = "Mohr-Coulomb";
};



struct Grid : public Section
{
  Grid()
    : Section("Grid/Fine zone")
  {
    add_parameter("Points per cell",
                  n_points,
                  "",
                  "Material points per cell and direction.");
    add_parameter("Columns",
                  n_columns,
                  "",
                  "Cells from the axis to the rim.",
                  Patterns::Integer(1, 1000));
    add_parameter("Rows",
                  rows,
                  "m",
                  "Height of each row.",
                  Patterns::List(Patterns::Double(0.), 1, 4));
    add_parameter("Moves", moves, "", "Whether the zone moves with the body.");
  }

  unsigned int        n_points  = 3;
  int                 n_columns = 8;
  std::vector<double> rows      = {0.1, 0.2};
  bool                moves     = true;
};



/** A choice, and words in the place of numbers. */
struct Method : public Section
{
  enum class Transfer
  {
    flip,
    pic
  };

  Method()
    : Section("/Method")
  {
    add_choice(*this,
               "Velocity transfer",
               transfer,
               {{"FLIP", Transfer::flip}, {"PIC", Transfer::pic}},
               "",
               "How points take the velocity of the grid.");
    add_word_or_number(*this,
                       "Record interval",
                       interval,
                       "every step",
                       0.,
                       "s",
                       "Time between records.",
                       Patterns::Double(0.));
    add_word_or_number(*this,
                       "K0",
                       k0,
                       "auto",
                       {},
                       "",
                       "Ratio of stresses.",
                       Patterns::Double(0., 10.));
  }

  Transfer              transfer = Transfer::pic;
  std::optional<double> interval = 0.1;
  std::optional<double> k0;
};



inline ParameterOrigins
read_sample(const std::string              &text,
            const std::vector<std::string> &overrides = {})
{
  std::ofstream("jack.prm", std::ios::binary) << text;
  return read_parameters("jack.prm", overrides);
}

#endif
