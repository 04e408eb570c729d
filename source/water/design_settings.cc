// SPDX-License-Identifier: LGPL-2.1-or-later
//
// python/caisson/verdict/limits.py has the names.
#include <caisson_mpm/water/water_settings.h>

#include <deal.II/base/patterns.h>

namespace CaissonMPM
{
  namespace
  {
    struct Record
    {
      const char *name;
      double      value; // the default
      const char *text;
      const char *unit;
      double      least = 0.;
    };

    const Record records[] = {
      {"Factor on piping",
       1.,
       "The report divides the suctions at which piping begins by this factor, "
       "for the exit gradient computed and by Houlsby and Byrne. No factor is "
       "established for an installation.",
       "",
       .1},
      {"Factor on plug failure",
       1.5,
       "The report divides the suction at which a plug of clay fails, as "
       "reverse bearing, by this factor. 1.5 is custom (DNV-RP-E303).",
       "",
       .1},
      {"Factor on plug lift",
       1.,
       "The report divides the suction at which the water of sand below lifts "
       "a plug of clay by this factor. No factor is established.",
       "",
       .1},
      {"Factor on boiling",
       1.,
       "The report divides the suction at which water boils beneath the lid by "
       "this factor. No factor is established.",
       "",
       .1},
      {"Factor on pump",
       1.,
       "The report divides the largest suction of the pump by this factor. No "
       "factor is established.",
       "",
       .1},
      {"Factor on plug heave",
       1.,
       "The report multiplies the heave of the plug by this factor where it "
       "looks for the depth at which the plug meets the lid. No factor is "
       "established.",
       "",
       .1},
      {"Factor on set-up",
       1.,
       "The report multiplies the friction of the walls by this factor where "
       "an overpressure retrieves the caisson: clay regains strength after the "
       "installation. 1 is a retrieval at once.",
       "",
       .1},
      {"Factor on shell buckling",
       1.3,
       "The report multiplies suction, weight and pressure of the soil by this "
       "factor where it checks whether the wall buckles. 1.3 is the load "
       "factor of DNV-OS-C101; DNV-RP-C202 adds a factor on the strength.",
       "",
       .1},
      {"Steel yield strength",
       355e6,
       "Yield strength of the wall, of which only the check for buckling in "
       "the report knows.",
       "Pa",
       5e7},
      {"Steel Youngs modulus",
       210e9,
       "Young's modulus of the wall, of which only the check for buckling in "
       "the report knows.",
       "Pa",
       1e9},
      {"Fixity depth over diameter",
       .5,
       "The wall is held by the soil this many diameters below the mudline: "
       "the part above, up to the lid, may buckle.",
       ""},
      {"Ring stiffener spacing",
       0.,
       "Distance between ring stiffeners of the wall, from the lid down, which "
       "bounds the part that may buckle; 0 stands for a wall without rings.",
       "m"},
      {"Suction at the start",
       0.,
       "The pump begins with this suction, which the seal must bear where the "
       "caisson rests by its weight. 0 stands for not given.",
       "Pa"},
      {"Scour depth",
       0.,
       "Scour lowers the mudline by this depth after the installation: the "
       "report says how much of the embedment counts. 0 stands for not given.",
       "m"},
      {"Largest tilt",
       0.,
       "Tilt that the caisson may have: the vessel stops there, and the report "
       "counts it in the gap beneath the lid. 0 stands for not given.",
       "degrees"},
      {"Distance of buckets",
       0.,
       "Distance between the axes of neighboring buckets, which stand on a "
       "regular triangle or a square. 0 stands for not given.",
       "m"}};
  } // namespace

  DesignSettings::DesignSettings()
    : Section("/Design", Influence::none)
  {
    for (const Record &record : records)
      add_parameter(record.name,
                    values.emplace_back(record.value),
                    record.unit,
                    record.text,
                    dealii::Patterns::Double(record.least));
    add_parameter("Number of buckets",
                  number_of_buckets,
                  "",
                  "Buckets as that of the scene, each with its weight, which "
                  "stand under one rigid frame.",
                  dealii::Patterns::Selection("1|3|4"));
    add_parameter("Spread of buckets",
                  spread_of_buckets,
                  "",
                  "By how much the resistance of each bucket may differ from "
                  "that of the scene, as shares such as 0.1, 0.2, 0.15; one "
                  "number stands for all. If it is empty, the runs of low and "
                  "high resistance decide.",
                  dealii::Patterns::List(dealii::Patterns::Double(0., .9),
                                         0,
                                         4));
    add_parameter("Source of factors",
                  source_of_factors,
                  "",
                  "Document of the project, with its edition, that names the "
                  "factors given in this section; the report shows it.");
  }
} // namespace CaissonMPM
