// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What flowing pore water does to the soil: minus the gradient of its excess
// pressure, per volume.
#ifndef caisson_mpm_water_seepage_force_h
#define caisson_mpm_water_seepage_force_h

#include <caisson_mpm/operators/nodal_force.h>
#include <caisson_mpm/water/ground_water.h>

#include <string>

namespace CaissonMPM
{
  class SeepageForce : public NodalForce
  {
  public:
    /** @p water must outlive this object. */
    explicit SeepageForce(GroundWater &water)
      : water(water)
    {}

    std::string
    name() const override
    {
      return "seepage";
    }

    bool
    acts() const override
    {
      return water.has_pressure();
    }

  private:
    void
    add(const ForceContext &context, Kernels::NodalVector *force) override
    {
      context.kernels.pressure_gradient_force(context.step,
                                              water.pressure().data(),
                                              water.filled().data(),
                                              force);
    }

    GroundWater &water;
  };
} // namespace CaissonMPM

#endif
