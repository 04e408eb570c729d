// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/base/time_table.h>
#include <caisson_mpm/water/suction.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    constexpr double atmosphere = 101.3e3, vapor_pressure = 1.2e3; // Pa, 10 C
    // s, after which the suction follows the required one, and in which it
    // changes by a tenth of weight and suction where no water follows the pump
    constexpr double delay = .02, pump_delay = .1;
  } // namespace

  SeaSettings::SeaSettings()
    : Section("/Water", Influence::motion)
  {
    add_parameter(
      "Water depth",
      depth,
      "m",
      "The depth of the mudline below the sea sets the pressure at which water "
      "boils: beneath the lid, whose height takes from it, where a run ends, "
      "and in the soil, where it warns.",
      Patterns::Double(0.));
  }

  double
  SeaSettings::ambient_pressure(const double unit_weight) const
  {
    return atmosphere + unit_weight * depth;
  }

  double
  SeaSettings::cavitation(const double unit_weight, const double height) const
  {
    // a lid high above the sea draws up no water, but may stand there
    return std::max(ambient_pressure(unit_weight) - vapor_pressure -
                      unit_weight * height,
                    0.);
  }

  SuctionSettings::SuctionSettings()
    : Section("/Water", Influence::motion)
  {
    add_choice(
      *this,
      "Suction control",
      control,
      {{"automatic", Control::automatic},
       {"required", Control::required},
       {"table", Control::table},
       {"flow", Control::flow},
       {"sealed", Control::sealed}},
      "",
      "The suction is the one that the body requires to move as prescribed "
      "(required; set so by name, it is an overpressure, which is negative, "
      "where the body moves up), that of Suction table (table), the one at which the pump "
      "takes the flow of Pumped flow table (flow), or the one of water that no "
      "pump takes and that only the plug and a leak let in or out (sealed). "
      "Automatic is required where water flows (Level = seepage or coupled), "
      "and no suction elsewhere.");
    add_parameter(
      "Suction table",
      table_text,
      "s : Pa",
      "Pairs time : suction, separated by commas; linear in between and "
      "constant beyond. A body that its loads move rests first: there the time "
      "begins.",
      Patterns::List(Patterns::List(Patterns::Double(), 2, 2, ":"), 0, 10000));
    add_entries_of_pump();
    add_entries_of_water_beneath_lid();
  }

  void
  SuctionSettings::add_entries_of_pump()
  {
    add_parameter(
      "Pumped flow table",
      flow_text,
      "s : m3/s",
      "Pairs time : flow of the water that the pump takes from beneath the "
      "lid, separated by commas; linear in between and constant beyond. The "
      "time of a body that weight and suction move begins when it rests.",
      Patterns::List(Patterns::List(Patterns::Double(0.), 2, 2, ":"),
                     0,
                     10000));
    add_word_or_number(
      *this,
      "Largest suction",
      largest,
      "unlimited",
      0.,
      "Pa",
      "The run ends where the required suction exceeds that of the pump.",
      Patterns::Double(0.));
  }

  void
  SuctionSettings::add_entries_of_water_beneath_lid()
  {
    add_parameter(
      "Trapped gas",
      gas,
      "m3",
      "The volume of gas beneath the lid at the pressure of the open water on "
      "the mudline. It expands under suction at constant temperature, which "
      "delays the suction; the pump takes it, too.",
      Patterns::Double(0.));
    add_parameter(
      "Lid water modulus",
      bulk_modulus,
      "Pa",
      "The bulk modulus of the water beneath a sealed lid, which may contain "
      "how far the lid gives way.",
      Patterns::Double(1e3));
    add_parameter(
      "Lid leak",
      leak,
      "m3/(s Pa)",
      "The flow of water through a valve that is not tight into the space "
      "beneath a sealed lid, over the suction.",
      Patterns::Double(0.));
    parse_parameters_call_back.connect([this]() {
      table        = parse_time_table(table_text);
      flow_table   = parse_time_table(flow_text);
      largest_flow = 0.;
      for (const auto &entry : flow_table)
        largest_flow = std::max(largest_flow, entry.second);
    });
  }

  void
  SuctionSettings::check_parameters() const
  {
    if (control == Control::table && table.empty())
      throw BadInput("Water/Suction control is table, but Water/Suction table "
                     "is empty. List pairs time : suction.");
    check_time_table(table, "Water/Suction table");
    check_time_table(flow_table, "Water/Pumped flow table");
    if (control == Control::flow && largest_flow <= 0.)
      throw BadInput("Water/Suction control is flow, but Water/Pumped flow "
                     "table has no flow. List pairs time : flow, in m3/s.");
  }

  void
  SuctionSettings::name_unused_entries(ParameterOrigins &origins) const
  {
    const std::vector<std::pair<Control, std::vector<std::string>>> entries = {
      {Control::table, {"Water/Suction table"}},
      {Control::flow, {"Water/Pumped flow table"}},
      {Control::sealed, {"Water/Lid water modulus", "Water/Lid leak"}}};
    const std::string required = "required: the suction is a result",
                      why[] = {required, required, "table", "flow", "sealed"},
                      now   = "Water/Suction control is " +
                            why[static_cast<int>(control)];
    for (const auto &[other, names] : entries)
      if (other != control)
        origins.add_unused(names, now);
    if (control == Control::sealed)
      origins.add_unused({"Water/Largest suction"},
                         "Water/Suction control is sealed: there is no pump");
  }

  double
  SuctionSettings::largest_of_table() const
  {
    double result = 0.;
    if (control == Control::table)
      for (const auto &row : table)
        result = std::max(result, row.second);
    return result;
  }

  Suction::Suction(const SuctionSettings &settings,
                   const SeaSettings     &sea,
                   const Soil            &soil)
    : settings(settings)
    , sea(sea)
    , soil(soil)
  {}

  void
  Suction::advance(const double time, const double dt, const SuctionLoad &load)
  {
    using Control = SuctionSettings::Control;
    required_     = (load.resistance - load.weight) / load.area;
    if (settings.is_required())
      {
        suction -= std::expm1(-dt / delay) * (required_ - suction);
        if (!load.rises || settings.control != Control::required)
          suction = std::max(suction, 0.);
        return;
      }
    if (settings.control == Control::sealed)
      return;
    if (time > 0.) // until then, a body that its loads move comes to rest
      {
        if (settings.control == Control::flow)
          pump(time, dt, load);
        else
          suction = value_at(settings.table, time);
      }
    last_volume = load.volume;
  }

  void
  Suction::pump(const double time, const double dt, const SuctionLoad &load)
  {
    const double missing =
      dt * value_at(settings.flow_table, time) - (load.volume - last_volume);
    constexpr double share = .1; // at which a body that is lowered is fastest
    const double     rate  = share * (load.weight / load.area + suction) /
                        (settings.largest_flow * pump_delay); // Pa/m3
    const double ambient = sea.ambient_pressure(soil.unit_weight_of_water()),
                 left    = ambient - suction,
                 volume  = settings.gas * ambient / left;
    if (volume * rate > left) // gas gives way more
      suction = ambient - settings.gas * ambient / (volume + missing);
    else
      suction += rate * missing;
    suction = std::max(suction, 0.);
  }

  double
  Suction::gas_expansion() const
  {
    return settings.gas * suction /
           (sea.ambient_pressure(soil.unit_weight_of_water()) - suction);
  }

  double
  Suction::cavitation(const double height) const
  {
    return sea.cavitation(soil.unit_weight_of_water(), height);
  }

  std::string
  Suction::limit_reached(const double height) const
  {
    const auto kilopascals = [](const double p) {
      return to_text(1e-3 * p, 4) + " kPa";
    };
    if (exceeds_pump())
      return "the suction exceeds Water/Largest suction = " +
             kilopascals(*settings.largest) + ", that of the pump";
    const double boiling = cavitation(height);
    if (suction > boiling)
      return "the suction exceeds " + kilopascals(boiling) +
             ", where water boils beneath the lid (cavitation), " +
             to_text(height, 4) +
             " m above the mudline at Water/Water depth = " +
             to_text(sea.depth) + " m";
    return "";
  }

  void
  Suction::register_totals(RunTotals &totals)
  {
    totals.carry("suction", suction);
    totals.carry("required_suction", required_);
    totals.keep("volume_of_last_step", last_volume);
  }
} // namespace CaissonMPM
