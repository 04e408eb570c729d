// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/bodies/dropped_motion.h>

#include <deal.II/base/patterns.h>

#include <algorithm>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    // What a step could not foresee acts in the next steps, by this share in
    // each: at once, it would throw a light body about.
    constexpr double share_of_unforeseen = .05;
    // The resistance is smoothed over this time when rest is looked for.
    constexpr double smoothing     = .02;  // s
    constexpr double speed_at_rest = 2e-3; // m/s
  }                                        // namespace

  DroppedMotion::DroppedMotion()
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
      "auto takes that of its own material, without lid and ballast where the "
      "mesh has none. Time/Mass scaling does not change it.",
      Patterns::Double(1e-9));
    add_parameter(
      "Release time",
      release,
      "s",
      "The weight of a body that is dropped, and the suction, act in full from "
      "this time on, and grow linearly until then: from 0, or after an "
      "installation from the load that the soil bore at its end.",
      Patterns::Double(0.));
  }

  void
  DroppedMotion::start()
  {
    LoadedMotion::start();
    last_step = expected_force = unforeseen = 0.;
  }

  void
  DroppedMotion::move(const double dt, const double force)
  {
    const auto &[load, mass, response] = surroundings;
    unforeseen += last_step * (force - expected_force);
    const double between  = .5 * (last_step + dt), // the middles of both steps
      impulse             = share_of_unforeseen * unforeseen,
                 share    = release > 0. ? std::min(time_ / release, 1.) : 1.,
                 before   = beginning().load,
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

  void
  DroppedMotion::register_totals(RunTotals &totals)
  {
    LoadedMotion::register_totals(totals);
    totals.carry("dropped_mean_velocity", mean_velocity_);
    totals.carry("dropped_expected_force", expected_force);
    totals.carry("dropped_unforeseen_impulse", unforeseen);
    totals.carry("dropped_last_step", last_step);
  }
} // namespace CaissonMPM
