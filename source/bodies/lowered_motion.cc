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
    constexpr double ramp          = .5; // s, from 0 to v0
    constexpr double time_of_rest  = .2; // s, over which rest is judged

    /** What a mean over the time @p tau takes of the present in a step. */
    double
    share_of_present(const double dt, const double tau)
    {
      return -std::expm1(-dt / tau);
    }
  } // namespace

  LoweredMotion::LoweredMotion()
    : BodyMotion("/Rigid body")
  {
    add_parameter("Lowering velocity",
                  largest_velocity,
                  "The largest velocity of a body that is lowered. Units: m/s.",
                  prm,
                  Patterns::Double(1e-9));
    add_parameter("Lowering delay",
                  delay,
                  "The velocity of a body that is lowered follows the "
                  "resistance of the soil with this time constant. Units: s.",
                  prm,
                  Patterns::Double(1e-6));
  }

  void
  LoweredMotion::start()
  {
    BodyMotion::start();
    resistance = mean_speed = rested_travel = 0.;
    rests                                   = false;
  }

  void
  LoweredMotion::move(const double dt, const double force)
  {
    resistance += share_of_present(dt, delay) * (-force - resistance);
    const double scale = std::max(share_of_load * std::abs(load()), 1.),
                 wanted =
                   largest_velocity *
                   std::clamp((load() - resistance) / scale, slowest_rise, 1.),
                 change = largest_velocity * dt / ramp;
    velocity_ += std::clamp(wanted - velocity_, -change, change);
    travel_ += dt * velocity_;
    look_for_rest(dt);
  }

  void
  LoweredMotion::look_for_rest(const double dt)
  {
    mean_speed +=
      share_of_present(dt, time_of_rest) * (std::abs(velocity_) - mean_speed);
    // A body may be slow for a moment, or balanced while it still moves.
    if (!rests && mean_speed < .02 * largest_velocity && time_ > ramp &&
        std::abs(load() - resistance) < .01 * std::abs(load()))
      {
        rests         = true;
        rested_travel = travel_;
      }
  }

  std::optional<double>
  LoweredMotion::travel_at_rest() const
  {
    return rests ? std::optional<double>(rested_travel) :
                   std::optional<double>();
  }

  void
  LoweredMotion::register_totals(RunTotals &totals)
  {
    BodyMotion::register_totals(totals);
    totals.keep("lowered_resistance", resistance);
    totals.keep("lowered_mean_speed", mean_speed);
    totals.keep("lowered_rests", rests);
    totals.keep("lowered_rested_travel", rested_travel);
  }
} // namespace CaissonMPM
