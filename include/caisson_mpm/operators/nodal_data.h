// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The values of a distributed nodal vector as the kernels see them, and what
// follows from them at one node.
#ifndef caisson_mpm_operators_nodal_data_h
#define caisson_mpm_operators_nodal_data_h

#include <caisson_mpm/domain/background_grid.h>
#include <caisson_mpm/kernels/layout.h>

#include <cmath>

namespace CaissonMPM
{
  /** Return share |f| sign(v) for one component of force and velocity: local
   * damping (Cundall 1987). */
  inline double
  damping_force(const double share, const double force, const double velocity)
  {
    const double sign = velocity > 0. ? 1. : velocity < 0. ? -1. : 0.;
    return share * std::abs(force) * sign;
  }

  /** View a vector with two components per node as velocities or forces. */
  inline Kernels::NodalVector *
  nodal_vectors(NodalData &v)
  {
    return reinterpret_cast<Kernels::NodalVector *>(v.begin());
  }

  inline const Kernels::NodalVector *
  nodal_vectors(const NodalData &v)
  {
    return reinterpret_cast<const Kernels::NodalVector *>(v.begin());
  }
} // namespace CaissonMPM

#endif
