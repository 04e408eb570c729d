// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/bodies/lowered_motion.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    constexpr double share_of_load = .1; // excess at which v = v0
    constexpr double slowest_rise  = -.2;
    constexpr double delay         = .02; // s, over which R is averaged
    constexpr double ramp          = .5;  // s, from 0 to v0
    constexpr double share_at_rest = .02; // of v0
  }                                       // namespace

  LoweredMotion::LoweredMotion()
    : LoadedMotion(
        "lowered",
        "weight and suction let the body sink until the soil carries it")
  {
    add_parameter("Lowering velocity",
                  largest_velocity,
                  "m/s",
                  "The largest velocity of a body that is lowered.",
                  Patterns::Double(1e-9));
  }

  void
  LoweredMotion::start()
  {
    LoadedMotion::start();
    velocity_ = 0.;
  }

  void
  LoweredMotion::register_totals(RunTotals &totals)
  {
    LoadedMotion::register_totals(totals);
    totals.carry("lowered_velocity", velocity_);
  }

  void
  LoweredMotion::move(const double dt, const double force)
  {
    const double load = surroundings.load;
    resistance.add(dt, delay, -force);
    const double excess = load - resistance.value(),
                 scale  = std::max(share_of_load * std::abs(load), 1.),
                 wanted = largest_velocity *
                          std::clamp(excess / scale, slowest_rise, 1.),
                 change = largest_velocity * dt / ramp;
    velocity_ += std::clamp(wanted - velocity_, -change, change);
    travel_ += dt * velocity_;
    rest.look(dt,
              {load, resistance.value(), velocity_, travel_},
              share_at_rest * largest_velocity);
  }
} // namespace CaissonMPM
