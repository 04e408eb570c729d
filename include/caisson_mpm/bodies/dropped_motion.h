// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A body that is dropped: its loads and the resistance of the soil accelerate
// its mass.
#ifndef caisson_mpm_bodies_dropped_motion_h
#define caisson_mpm_bodies_dropped_motion_h

#include <caisson_mpm/bodies/loaded_motion.h>

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
    DroppedMotion();

    void
    start() override;

    void
    register_totals(RunTotals &totals) override;

  protected:
    void
    move(const double dt, const double force) override;

  private:
    std::optional<double> inertia; // or the mass of the body's cells
    double                release = 0.;

    double last_step      = 0.; // its length, s
    double expected_force = 0.; // of the soil, in the last step; N
    double unforeseen     = 0.; // impulse that has not acted yet, N s
  };
} // namespace CaissonMPM

#endif
