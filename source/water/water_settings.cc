// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/water/water_settings.h>

#include <deal.II/base/patterns.h>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    const Choices<WaterLevel> levels = {{"drained", WaterLevel::drained},
                                        {"undrained", WaterLevel::undrained},
                                        {"seepage", WaterLevel::seepage},
                                        {"coupled", WaterLevel::coupled}};
  } // namespace

  UndrainedSettings::UndrainedSettings()
    : Section("/Water", Influence::motion)
  {
    add_parameter(
      "Bulk modulus",
      bulk_modulus,
      "Pa",
      "Bulk modulus of the water in undrained soil over the porosity: the "
      "excess pressure is this times the decrease of volume. 20 to 60 times "
      "the bulk modulus of the soil leaves hardly any change of volume.",
      Patterns::Double(1e-9));
  }

  SeepageSettings::SeepageSettings()
    : Section("/Water", Influence::motion)
  {
    add_parameter(
      "Renewal",
      renewal,
      "",
      "The flow is computed again when the body has moved, or the mudline "
      "changed, by this share of a cell.",
      Patterns::Double(1e-6, 1.));
  }

  CoupledSettings::CoupledSettings(OpenSides &sides)
    : Section("/Water", Influence::motion)
  {
    add_parameter(
      "Time compression",
      time_compression,
      "",
      "The scene runs this many times faster than what it stands for, and a "
      "coupled run multiplies all permeabilities with it, so that as much "
      "water flows.",
      Patterns::Double(1e-9));
    add_parameter(
      "Drained surface",
      sides.surface,
      "",
      "The free surface of the soil outside keeps the pressure of the open "
      "water; otherwise nothing flows through it.");
    add_parameter(
      "Bottom pressure",
      bottom_text,
      "Pa",
      "A drained bottom has this excess pressure in a coupled run, as an "
      "expression in the time t.");
  }

  OpenSideSettings::OpenSideSettings(OpenSides &sides)
    : Section("/Water", Influence::motion)
  {
    add_parameter(
      "Drained outer side",
      sides.outer,
      "",
      "The far side of the domain keeps the pressure of the open water; "
      "otherwise nothing flows through it.");
    add_parameter(
      "Drained bottom",
      sides.bottom,
      "",
      "The bottom of the domain keeps the pressure of the open water; "
      "otherwise nothing flows through it.");
  }

  FeasibilitySettings::FeasibilitySettings()
    : Section("/Installation", Influence::none)
  {
    add_word_or_number(
      *this,
      "End where infeasible",
      distance,
      "never",
      {},
      "m",
      "The run ends this far behind the penetration at which suction can "
      "install the caisson no more: the exit gradient is critical (piping), or "
      "the plug rises, beyond what the wall displaces, by more than half of "
      "the penetration (plug lift).",
      Patterns::Double(0.));
  }

  WaterSettings::WaterSettings()
    : Section("/Water", Influence::motion)
    , coupled(sides)
    , open_sides(sides)
  {
    add_choice(
      *this,
      "Level",
      level,
      levels,
      "",
      "The pore water has no excess pressure (drained), stays where it is and "
      "resists any change of volume (undrained), flows steadily under the "
      "suction beneath the lid of a caisson (seepage), or has the pressure "
      "that follows from the motion of the soil (coupled).");
  }

  std::string
  WaterSettings::level_name() const
  {
    return name_of(levels, level);
  }
} // namespace CaissonMPM
