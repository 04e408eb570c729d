// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The entries of section Water.
#ifndef caisson_mpm_water_water_settings_h
#define caisson_mpm_water_water_settings_h

#include <caisson_mpm/base/section.h>
#include <caisson_mpm/water/soil_columns.h>
#include <caisson_mpm/water/suction.h>

#include <deque>
#include <optional>
#include <string>

namespace CaissonMPM
{
  /** Where the pore water goes; doc/theory.md, sections 15 to 17. */
  enum class WaterLevel
  {
    drained,
    undrained,
    seepage,
    coupled
  };

  /** Where a run ends that has become infeasible. */
  struct FeasibilitySettings : public Section
  {
    FeasibilitySettings();

    std::optional<double> distance; // m
  };

  /**
   * The factors on the limits of suction, the steel of the wall, and what a
   * certifier asks for. The program only hands them on to the report, in
   * run.json: nothing that it computes depends on them.
   */
  struct DesignSettings : public Section
  {
    DesignSettings();

  private:
    std::deque<double> values; // of the entries, which keep their places
    std::string        number_of_buckets = "1";
    std::string        spread_of_buckets;
    std::string        source_of_factors;
  };

  /** What an undrained model needs. */
  struct UndrainedSettings : public Section
  {
    UndrainedSettings();

    double bulk_modulus = 1e8; // of the water over the porosity, Pa
  };

  /** What steady seepage needs. */
  struct SeepageSettings : public Section
  {
    SeepageSettings();

    double renewal = 0.25; // share of a cell
  };

  /** What a coupled model needs. */
  struct CoupledSettings : public Section
  {
    explicit CoupledSettings(OpenSides &sides);

    double      time_compression = 1.;
    std::string bottom_text      = "0";
  };

  /** Sides of the domain, for all models in which water flows. */
  struct OpenSideSettings : public Section
  {
    explicit OpenSideSettings(OpenSides &sides);
  };

  /**
   * The level, and the entries in groups: each model of the water uses some of
   * the groups, and what a scene sets in the others has no effect.
   */
  class WaterSettings : public Section
  {
  public:
    WaterSettings();

    /** Return the level as its entry has it. */
    std::string
    level_name() const;

    WaterLevel          level = WaterLevel::drained;
    OpenSides           sides;
    UndrainedSettings   undrained;
    SeepageSettings     seepage;
    CoupledSettings     coupled;
    OpenSideSettings    open_sides;
    SeaSettings         sea;
    SuctionSettings     suction;
    FeasibilitySettings feasibility;
    DesignSettings      design; // of where feasibility counts
  };
} // namespace CaissonMPM

#endif
