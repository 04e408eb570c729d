// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The values of a distributed nodal vector as the kernels see them, and what
// follows from them at one node.
#ifndef caisson_mpm_operators_nodal_data_h
#define caisson_mpm_operators_nodal_data_h

#include <caisson_mpm/domain/background_grid.h>
#include <caisson_mpm/kernels/layout.h>

#include <cmath>
#include <functional>

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
  /** to = M from with the consistent mass matrix of the points of all ranks, at
   * all nodes that this rank knows, of the active cells of @p step. Both have
   * two components per node; hanging nodes follow their masters in @p from, and
   * give them their part of @p to. @p correct, if given, adds to the product of
   * the points of this rank. Collective over MPI. */
  inline void
  apply_consistent_mass(
    const Kernels::KernelTable                        &kernels,
    const Kernels::StepContext                        &step,
    const HangingNodes                                &hanging_nodes,
    const NodalData                                   &from,
    NodalData                                         &to,
    const std::function<void(Kernels::NodalVector *)> &correct = {})
  {
    to = 0.;
    kernels.apply_mass(step, nodal_vectors(from), nodal_vectors(to));
    if (correct)
      correct(nodal_vectors(to));
    hanging_nodes.distribute(to, 2);
    to.compress(dealii::VectorOperation::add);
    to.update_ghost_values();
  }
} // namespace CaissonMPM

#endif
