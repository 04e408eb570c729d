// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The choice among the models of the pore water.
#ifndef caisson_mpm_water_pore_water_factory_h
#define caisson_mpm_water_pore_water_factory_h

#include <caisson_mpm/water/pore_water.h>

#include <memory>

namespace CaissonMPM
{
  /** Return the model that Water/Level chooses. */
  std::unique_ptr<PoreWater>
  make_pore_water(const WaterScene &scene);
} // namespace CaissonMPM

#endif
