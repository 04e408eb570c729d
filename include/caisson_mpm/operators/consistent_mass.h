// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Products with the consistent mass matrix of the points of all ranks.
#ifndef caisson_mpm_operators_consistent_mass_h
#define caisson_mpm_operators_consistent_mass_h

#include <caisson_mpm/domain/hanging_nodes.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/nodal_data.h>

#include <functional>

namespace CaissonMPM
{
  using MassCorrection = std::function<void(Kernels::NodalVector *product)>;

  /** to = M from at all nodes that this rank knows, of the active cells of
   * @p step. Both have two components per node; hanging nodes follow their
   * masters in @p from, and give them their part of @p to. @p correct, if
   * given, adds to the product of the points of this rank. Collective over MPI.
   */
  void
  apply_consistent_mass(const Kernels::KernelTable &kernels,
                        const Kernels::StepContext &step,
                        const HangingNodes         &hanging_nodes,
                        const NodalData            &from,
                        NodalData                  &to,
                        const MassCorrection       &correct = MassCorrection());
} // namespace CaissonMPM

#endif
