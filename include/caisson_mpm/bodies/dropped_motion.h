// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A body that is dropped: its loads and the resistance of the soil accelerate
// its mass.
#ifndef caisson_mpm_bodies_dropped_motion_h
#define caisson_mpm_bodies_dropped_motion_h

#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/bodies/loaded_motion.h>

#include <deal.II/base/patterns.h>

#include <algorithm>

namespace CaissonMPM
{
  /**
   * With the mass M, the load F and the force R of the soil, positive upward,
   *   M dV/dt = F - R.
   * The velocity is that of the middle of a step (leapfrog), so that a fall is
   * exact and an oscillation on a spring keeps its energy.
   *
   * R contains the inertia of the soil that the body holds, M_s dV/dt. Taken
   * from the previous step, it would make a body that is lighter than that soil
   * swing from step to step. It is therefore taken of the present step: with
   * the force R_0 that the soil would exert if the body kept its velocity,
   *   (M + M_s) dV/dt = F - R_0.
   * Nodes may come into contact or begin to slip by the new velocity. What this
   * changes in R acts over the next twenty steps or so, so that no momentum is
   * lost.
   */
  class DroppedMotion : public LoadedMotion
  {
  public:
    DroppedMotion()
      : LoadedMotion(
          "dropped",
          "weight and suction accelerate the body, and the soil slows it down",
          true)
    {
      add_word_or_number(
        *this,
        "Inertia",
        inertia,
        "auto",
        -1.,
        "kg",
        "The mass of a body that is dropped, with everything that it carries; "
        "auto takes that of its own material, without lid and ballast where "
        "the mesh has none. Time/Mass scaling does not change it.",
        dealii::Patterns::Double(1e-9));
      add_parameter(
        "Release time",
        release,
        "s",
        "The weight of a body that is dropped, and the suction, act in full "
        "from this time on, and grow linearly until then: from 0, or after an "
        "installation from the load that the soil bore at its end.",
        dealii::Patterns::Double(0.));
    }

    void
    start() override
    {
      LoadedMotion::start();
      last_step = expected_force = unforeseen = 0.;
    }

    void
    register_totals(RunTotals &totals) override
    {
      LoadedMotion::register_totals(totals);
      totals.carry("dropped_mean_velocity", mean_velocity_);
      totals.carry("dropped_expected_force", expected_force);
      totals.carry("dropped_unforeseen_impulse", unforeseen);
      totals.carry("dropped_last_step", last_step);
    }

  protected:
    void
    move(const double dt, const double force) override
    {
      const auto &[load, mass, response] = surroundings;
      unforeseen += last_step * (force - expected_force);
      const double between = .5 * (last_step + dt), // the middles of both steps
        impulse            = share_of_unforeseen * unforeseen,
                   share   = release > 0. ? std::min(time_ / release, 1.) : 1.,
                   before  = beginning().load,
                   released = before + share * (load - before),
                   soil     = response.mass * between / dt,
                   a        = (released + response.force + impulse / between) /
                       (inertia.value_or(mass) + soil),
                   middle = mean_velocity_ + between * a;
      unforeseen -= impulse;
      travel_ += dt * middle;
      velocity_      = middle + .5 * dt * a;
      expected_force = response.force - soil * a;
      last_step      = dt;
      resistance.add(dt, smoothing, -force);
      rest.look(dt,
                {load, resistance.value(), velocity_, travel_},
                speed_at_rest);
    }

  private:
    // What a step could not foresee acts in the next steps, by this share in
    // each: at once, it would throw a light body about.
    static constexpr double share_of_unforeseen = .05;
    // The resistance is smoothed over this time when rest is looked for.
    static constexpr double smoothing     = .02;  // s
    static constexpr double speed_at_rest = 2e-3; // m/s

    std::optional<double> inertia; // or the mass of the body's cells
    double                release = 0.;

    double last_step      = 0.; // its length, s
    double expected_force = 0.; // of the soil, in the last step; N
    double unforeseen     = 0.; // impulse that has not acted yet, N s
  };
} // namespace CaissonMPM

#endif
