// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A body that is lowered: it sinks as slowly as its loads let it.
#ifndef caisson_mpm_bodies_lowered_motion_h
#define caisson_mpm_bodies_lowered_motion_h

#include <caisson_mpm/bodies/loaded_motion.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  /**
   * Weight and suction press the body down, and the soil resists. While they
   * exceed the resistance by a tenth or more, the body sinks at the velocity of
   * the crane or the pump; closer to equilibrium it sinks more slowly, and it
   * rises slowly where the resistance is larger:
   *   v = v0 clamp((F - R) / (F / 10), -1/5, 1).
   * The mass of the body does not enter, so that neither the step nor the mass
   * scaling of the soil matters, and the body rests where R = F: it does not
   * overshoot as one that is dropped would. After another motion, it therefore
   * begins at rest.
   */
  class LoweredMotion : public LoadedMotion
  {
  public:
    LoweredMotion()
      : LoadedMotion(
          "lowered",
          "weight and suction let the body sink until the soil carries it")
    {
      add_parameter("Lowering velocity",
                    largest_velocity,
                    "m/s",
                    "The largest velocity of a body that is lowered.",
                    dealii::Patterns::Double(1e-9));
    }

    void
    start() override
    {
      LoadedMotion::start();
      velocity_ = 0.;
    }

    void
    register_totals(RunTotals &totals) override
    {
      LoadedMotion::register_totals(totals);
      totals.carry("lowered_velocity", velocity_);
    }

    double
    usual_velocity() const override
    {
      return largest_velocity;
    }

  protected:
    void
    move(const double dt, const double force) override
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

  private:
    static constexpr double share_of_load = .1; // excess at which v = v0
    static constexpr double slowest_rise  = -.2;
    static constexpr double delay         = .02; // s, over which R is averaged
    static constexpr double ramp          = .5;  // s, from 0 to v0
    static constexpr double share_at_rest = .02; // of v0

    double largest_velocity = 0.1;
  };
} // namespace CaissonMPM

#endif
