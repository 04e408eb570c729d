// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What flowing pore water does to the soil: minus the gradient of its excess
// pressure, per volume.
#ifndef caisson_mpm_water_pore_pressure_force_h
#define caisson_mpm_water_pore_pressure_force_h

#include <caisson_mpm/kernels/kernel_table.h>
#include <caisson_mpm/kernels/nodal_sums.h>
#include <caisson_mpm/operators/nodal_force.h>
#include <caisson_mpm/water/ground_water.h>

#include <string>

namespace CaissonMPM
{
  class PorePressureForce : public NodalForce
  {
  public:
    /** @p water must outlive this object. */
    explicit PorePressureForce(GroundWater &water)
      : water(water)
    {}

    std::string
    name() const override
    {
      return "pore pressure";
    }

    bool
    acts() const override
    {
      return water.has_pressure();
    }

    bool
    is_corrected() const override
    {
      return water.is_coupled();
    }

    Vector2
    at_corner(const unsigned int cell, const unsigned int corner) const override
    {
      return water.is_coupled() ? water.coupled_force_at(cell, corner) :
                                  Vector2();
    }

  private:
    void
    add(const ForceContext &context, Kernels::NodalVector *force) override
    {
      if (water.is_coupled())
        water.add_coupled_force(force);
      else
        context.kernels.pressure_gradient_force(context.step,
                                                water.pressure().data(),
                                                water.filled().data(),
                                                force);
    }

    GroundWater &water;
  };
} // namespace CaissonMPM

#endif
