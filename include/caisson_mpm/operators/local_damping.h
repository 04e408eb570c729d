// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Local damping (Cundall 1987): a share of the out-of-balance force acts
// against the velocity.
#ifndef caisson_mpm_operators_local_damping_h
#define caisson_mpm_operators_local_damping_h

#include <cmath>

namespace CaissonMPM
{
  /** Return share |f| sign(v) for one component of force and velocity. */
  inline double
  damping_force(const double share, const double force, const double velocity)
  {
    const double sign = velocity > 0. ? 1. : velocity < 0. ? -1. : 0.;
    return share * std::abs(force) * sign;
  }
} // namespace CaissonMPM

#endif
