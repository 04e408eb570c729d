// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A body that is lowered: it sinks as slowly as its loads let it.
#ifndef caisson_mpm_bodies_lowered_motion_h
#define caisson_mpm_bodies_lowered_motion_h

#include <caisson_mpm/bodies/loaded_motion.h>

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
    LoweredMotion();

    void
    start() override;

    void
    register_totals(RunTotals &totals) override;

    double
    usual_velocity() const override
    {
      return largest_velocity;
    }

  protected:
    void
    move(const double dt, const double force) override;

  private:
    double largest_velocity = 0.1;
  };
} // namespace CaissonMPM

#endif
