// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/water/coupled_water.h>
#include <caisson_mpm/water/pore_water.h>
#include <caisson_mpm/water/steady_seepage.h>
#include <caisson_mpm/water/undrained_water.h>

namespace CaissonMPM
{
  std::unique_ptr<PoreWater>
  make_pore_water(const WaterScene &scene)
  {
    switch (scene.settings.level)
      {
        case WaterLevel::undrained:
          return std::make_unique<UndrainedWater>(scene);
        case WaterLevel::seepage:
          return std::make_unique<SteadySeepage>(scene);
        case WaterLevel::coupled:
          return std::make_unique<CoupledWater>(scene);
        case WaterLevel::drained:
          if (scene.asks_for_suction())
            return std::make_unique<SteadySeepage>(scene);
          break;
      }
    return std::make_unique<PoreWater>(scene);
  }
} // namespace CaissonMPM
