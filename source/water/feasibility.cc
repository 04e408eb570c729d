// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/water/feasibility.h>

#include <deal.II/base/patterns.h>

namespace CaissonMPM
{
  namespace
  {
    // Of the penetration, which a plug that is lifted rises.
    constexpr double lifted = .5;
  } // namespace

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
      dealii::Patterns::Double(0.));
  }

  void
  Feasibility::update(const double penetration,
                      const double extra_heave,
                      const double suction,
                      const double gradient,
                      const double window)
  {
    if (suction <= 0.)
      at = -1.;
    else if (piping < 0. && gradient >= 1.)
      piping = penetration;
    if (suction <= 0. || (at >= 0. && penetration < at + window))
      return;
    const double rise = extra_heave - heave_there;
    if (at >= 0. && lift < 0. && rise > lifted * (penetration - at))
      lift = at;
    at          = penetration;
    heave_there = extra_heave;
  }

  std::optional<Feasibility::Place>
  Feasibility::place() const
  {
    if (piping >= 0. && (lift < 0. || piping <= lift))
      return Place{piping, "piping"};
    if (lift >= 0.)
      return Place{lift, "plug lift"};
    return {};
  }

  std::string
  Feasibility::reason_to_end(const double penetration) const
  {
    const auto from = place();
    if (!from || !settings.distance ||
        penetration < from->penetration + *settings.distance)
      return "";
    return "the installation has not been feasible since " +
           to_text(from->penetration, 4) + " m (" + from->reason +
           "), and Installation/End where infeasible is " +
           to_text(*settings.distance) + " m";
  }

  void
  Feasibility::register_totals(RunTotals &totals)
  {
    totals.keep("piping_since", piping);
    totals.keep("plug_lifted_since", lift);
    totals.keep("plug_rise_measured_at", at);
    totals.keep("plug_rise_measured", heave_there);
  }
} // namespace CaissonMPM
