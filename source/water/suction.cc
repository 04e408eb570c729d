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
  }

  Suction::Suction()
    : ParameterAcceptor("/Water")
  {
    add_choice(*this,
               "Suction control",
               control,
               {{"required", Control::required}, {"table", Control::table}},
               "The suction is the one that the body requires to move as "
               "prescribed (required), or that of Suction table. Units: none.");
    add_parameter("Suction table",
                  table_text,
                  "Pairs time : suction, separated by commas; linear in "
                  "between and constant beyond. The time of a body that is "
                  "lowered begins when it rests. Units: s : Pa.",
                  prm,
                  Patterns::List(Patterns::List(Patterns::Double(), 2, 2, ":"),
                                 0,
                                 10000));
    add_parameter("Suction delay",
                  delay,
                  "The suction follows the required one with this time "
                  "constant. Units: s.",
                  prm,
                  Patterns::Double(1e-6));
    add_word_or_number(*this,
                       "Largest suction",
                       largest,
                       "unlimited",
                       0.,
                       "The run ends where the required suction exceeds that "
                       "of the pump. Units: Pa.",
                       Patterns::Double(0.));
    add_parameter("Water depth",
                  water_depth,
                  "The depth of the mudline below the sea sets the suction at "
                  "which water boils beneath the lid, where a run ends. Units: "
                  "m.",
                  prm,
                  Patterns::Double(0.));
    parse_parameters_call_back.connect([this]() { fill_table(); });
  }

  void
  Suction::fill_table()
  {
    table = parse_time_table(table_text);
  }

  void
  Suction::check_parameters() const
  {
    if (control == Control::table && table.empty())
      throw BadInput("Water/Suction control is table, but Water/Suction table "
                     "is empty. List pairs time : suction.");
    check_time_table(table, "Water/Suction table");
  }

  void
  Suction::name_unused_entries(ParameterOrigins &origins) const
  {
    if (control == Control::required)
      origins.add_unused({"Water/Suction table"},
                         "Water/Suction control is required: the suction is a "
                         "result");
    else
      origins.add_unused({"Water/Suction delay"},
                         "Water/Suction control is table");
  }

  void
  Suction::advance(const double time, const double dt, const SuctionLoad &load)
  {
    required_ = (load.resistance - load.weight) / load.area;
    if (control == Control::required)
      {
        suction -= std::expm1(-dt / delay) * (required_ - suction);
        suction = std::max(suction, 0.);
        return;
      }
    suction = value_at(table, time);
  }

  double
  Suction::cavitation(const double unit_weight_of_water) const
  {
    return atmosphere - vapor_pressure + unit_weight_of_water * water_depth;
  }

  std::string
  Suction::limit_reached(const double unit_weight_of_water) const
  {
    const auto kilopascals = [](const double p) {
      return to_text(1e-3 * p, 4) + " kPa";
    };
    if (largest && suction > *largest)
      return "the suction exceeds Water/Largest suction = " +
             kilopascals(*largest) + ", that of the pump";
    const double boiling = cavitation(unit_weight_of_water);
    if (suction > boiling)
      return "the suction exceeds " + kilopascals(boiling) +
             ", where water boils beneath the lid (cavitation) at Water/Water "
             "depth = " +
             to_text(water_depth) + " m";
    return "";
  }

  void
  Suction::register_totals(RunTotals &totals)
  {
    totals.keep("suction", suction);
    totals.keep("required_suction", required_);
  }
} // namespace CaissonMPM
