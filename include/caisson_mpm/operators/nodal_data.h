// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The values of a distributed nodal vector as the kernels see them.
#ifndef caisson_mpm_operators_nodal_data_h
#define caisson_mpm_operators_nodal_data_h

#include <caisson_mpm/domain/background_grid.h>
#include <caisson_mpm/kernels/forward.h>

namespace CaissonMPM
{
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
