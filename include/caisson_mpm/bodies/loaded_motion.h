// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What motions have in common in which loads move the body until it rests.
#ifndef caisson_mpm_bodies_loaded_motion_h
#define caisson_mpm_bodies_loaded_motion_h

#include <caisson_mpm/bodies/body_motion.h>
#include <caisson_mpm/bodies/rest.h>

namespace CaissonMPM
{
  /** Follows the loads, and knows the resistance of the soil and the rest. */
  class LoadedMotion : public BodyMotion
  {
  public:
    LoadedMotion(const std::string &name,
                 const std::string &description,
                 const bool         needs_response = false)
      : BodyMotion(name, description, {true, true, needs_response})
    {}

    void
    start() override
    {
      BodyMotion::start();
      resistance = RecentMean(beginning().load);
      rest       = RestDetector();
    }

    std::optional<double>
    travel_at_rest() const override
    {
      return rest.travel();
    }

    void
    register_totals(RunTotals &totals) override
    {
      BodyMotion::register_totals(totals);
      resistance.register_totals(totals, "resistance_to_loads");
      rest.register_totals(totals);
    }

  protected:
    RecentMean   resistance; // of the soil, N
    RestDetector rest;
  };
} // namespace CaissonMPM

#endif
