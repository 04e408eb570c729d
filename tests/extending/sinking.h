// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A body that sinks by its own weight: m dv/dt = W + F, with the force F of the
// soil on the body, which is negative where the soil holds the body up.
#ifndef caisson_mpm_bodies_sinking_h
#define caisson_mpm_bodies_sinking_h

#include <caisson_mpm/bodies/body_motion.h>

#include <deal.II/base/patterns.h>

namespace CaissonMPM
{
  /** The force of a step moves the body in the next one. */
  class Sinking : public BodyMotion
  {
  public:
    Sinking()
      : BodyMotion("sinking", "the body sinks by its own weight", {false, true})
    {
      add_parameter(
        "Sinking mass",
        mass,
        "kg",
        "The mass of a body that sinks by its own weight, on the whole "
        "circumference.",
        dealii::Patterns::Double(1e-9));
      add_parameter(
        "Sinking weight",
        weight,
        "N",
        "The submerged weight of a body that sinks by its own weight, on the "
        "whole circumference.",
        dealii::Patterns::Double(0.));
    }

  protected:
    void
    move(const double dt, const double force) override
    {
      velocity_ += dt * (weight + force) / mass;
      travel_ += dt * velocity_;
    }

  private:
    double mass   = 1e5;
    double weight = 1e6;
  };
} // namespace CaissonMPM

#endif
