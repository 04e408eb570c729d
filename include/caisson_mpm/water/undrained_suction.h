// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Suction beneath the lid of a caisson in soil that lets no water through.
//
// The water presses less on the surface of the plug, by the suction s: a
// traction that lifts the plug. With any field p that is -s on this surface and
// 0 on the mudline outside, Gauss's theorem makes the traction a body force
// -grad p and an isotropic stress -p. Clay whose strength depends on no mean
// stress, and whose volume does not change, feels only the body force. So the
// field may be chosen: it is -s in the plug, down to the tip, and harmonic
// below, as if water seeped through soil that is far more permeable in the
// plug. The pressure of the water in the pores of clay falls in much the same
// way. Therefore the plug keeps its contact with the wall, and bears no
// tension, although the suction takes its total stress.
//
// In layers of sand and clay the same is done for clay as long as the tip is in
// clay: the flow in the sand does not depend on the field in the clay.
#ifndef caisson_mpm_water_undrained_suction_h
#define caisson_mpm_water_undrained_suction_h

#include <caisson_mpm/water/steady_seepage.h>

#include <string>
#include <vector>

namespace CaissonMPM
{
  /** Nothing flows: the only volume that the pump takes is that of the lid and
   * of the heave of the plug. */
  class UndrainedSuction : public SteadySeepage
  {
  public:
    explicit UndrainedSuction(const WaterScene &scene);

    /** Whether the scene asks for suction beneath a lid: its level has none of
     * itself. */
    static bool
    is_wanted(const WaterScene &scene);

    double
    resistance_to_body() const override
    {
      return FlowingWater::resistance_to_body();
    }

    NamedNumbers
    present_columns() const override
    {
      return FlowingWater::present_columns();
    }

  private:
    std::vector<const Section *>
    used_groups() const override;
    /** Throws BadInput where a layer lets water through. */
    void
    reinit() override;
    void
    find_permeability() override;
    WaterFlow
    flow() const override;
  };
} // namespace CaissonMPM

#endif
