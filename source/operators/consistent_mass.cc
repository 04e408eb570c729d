// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/kernels/kernel_table.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/consistent_mass.h>

namespace CaissonMPM
{
  void
  apply_consistent_mass(const Kernels::KernelTable &kernels,
                        const Kernels::StepContext &step,
                        const HangingNodes         &hanging_nodes,
                        const NodalData            &from,
                        NodalData                  &to,
                        const MassCorrection       &correct)
  {
    to = 0.;
    to.zero_out_ghost_values();
    kernels.apply_mass(step, nodal_vectors(from), nodal_vectors(to));
    if (correct)
      correct(nodal_vectors(to));
    hanging_nodes.distribute(to, 2);
    to.compress(dealii::VectorOperation::add);
    to.update_ghost_values();
  }
} // namespace CaissonMPM
