// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/water/undrained_pressure.h>

#include <cmath>

namespace CaissonMPM
{
  void
  UndrainedPressure::find(const double bulk_modulus, MaterialPoints &points)
  {
    points.level_volume_ratio(pressure_);
    for (double &value : pressure_)
      value = -bulk_modulus * std::log(value);
  }
} // namespace CaissonMPM
