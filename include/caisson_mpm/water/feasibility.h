// SPDX-License-Identifier: LGPL-2.1-or-later
//
// From which penetration on an installation by suction is not feasible.
#ifndef caisson_mpm_water_feasibility_h
#define caisson_mpm_water_feasibility_h

#include <caisson_mpm/base/run_totals.h>
#include <caisson_mpm/base/section.h>

#include <optional>
#include <string>

namespace CaissonMPM
{
  /** Where a run ends that has become infeasible. */
  struct FeasibilitySettings : public Section
  {
    FeasibilitySettings();

    std::optional<double> distance; // m
  };

  /**
   * Notes where piping begins, and where the suction lifts the plug. A plug is
   * lifted where its surface rises, beyond what the wall displaces, by more
   * than half of what the caisson goes down: the suction then draws in soil
   * rather than the caisson. Whether the pump or boiling ends the run is the
   * matter of Suction. Not collective.
   */
  class Feasibility
  {
  public:
    explicit Feasibility(const FeasibilitySettings &settings)
      : settings(settings)
    {}

    /** See the state at a record: the heave of the plug beyond what the wall
     * displaces, the gradient over the critical one, and in which @p window of
     * penetration a rise is measured. Units: m, m, Pa, none, m. */
    void
    update(const double penetration,
           const double extra_heave,
           const double suction,
           const double gradient,
           const double window);

    /** Where it became infeasible, and why. */
    struct Place
    {
      double      penetration; // m
      std::string reason;      // in one or two words
    };

    std::optional<Place>
    place() const;

    /** Return why a run ends that is at this @p penetration, or an empty text.
     * Units: m. */
    std::string
    reason_to_end(const double penetration) const;

    void
    register_totals(RunTotals &totals);

  private:
    const FeasibilitySettings &settings;
    double piping = -1., lift = -1.;   // penetration where it began; m
    double at = -1., heave_there = 0.; // where the last rise was measured; m
  };
} // namespace CaissonMPM

#endif
