// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Compiled once per instruction set, with CAISSON_KERNEL_ISA naming it.
#include <caisson_mpm/kernels/apply_mass.h>
#include <caisson_mpm/kernels/dispatch.h>
#include <caisson_mpm/kernels/grid_to_points.h>
#include <caisson_mpm/kernels/largest_moduli.h>
#include <caisson_mpm/kernels/points_to_grid.h>
#include <caisson_mpm/kernels/pressure_force.h>
#include <caisson_mpm/kernels/pressure_gradient_force.h>

#define CAISSON_CONCATENATE(a, b) a##b
#define CAISSON_TABLE(isa) CAISSON_CONCATENATE(kernels_, isa)
#define CAISSON_QUOTE_(text) #text
#define CAISSON_QUOTE(text) CAISSON_QUOTE_(text)

namespace CaissonMPM::Kernels
{
  const KernelTable &
  CAISSON_TABLE(CAISSON_KERNEL_ISA)()
  {
    static constexpr KernelTable table = {CAISSON_QUOTE(CAISSON_KERNEL_ISA),
                                          NativeLanes::width,
                                          &points_to_grid<NativeLanes>,
                                          &pressure_force<NativeLanes>,
                                          &pressure_gradient_force<NativeLanes>,
                                          &apply_mass,
                                          &grid_to_points<NativeLanes>,
                                          &largest_moduli<NativeLanes>};
    return table;
  }
} // namespace CaissonMPM::Kernels
