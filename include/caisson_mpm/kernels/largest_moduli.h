// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The largest stiffness of the points, for the stability limit of the step.
#ifndef caisson_mpm_kernels_largest_moduli_h
#define caisson_mpm_kernels_largest_moduli_h

#include <caisson_mpm/kernels/for_each_block.h>
#include <caisson_mpm/kernels/user_points.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** See KernelTable. */
    template <typename Number>
    void
    largest_moduli(const PointsView &points,
                   const Material   *materials,
                   double           *largest)
    {
      const auto look_at = [&](const int block) CAISSON_LAMBDA {
        const PointBlock &b        = points.blocks[block];
        const int         m        = points.material(block);
        const Material   &material = materials[m];
        with_law(material, [&](auto law, const auto &p) CAISSON_LAMBDA {
          using Law = decltype(law);
          if constexpr (Law::is_external)
            for (int lane = 0; lane < points.count(block); ++lane)
              {
                const double modulus =
                  user_state_of(points, block, lane)[UserState::modulus];
                largest[m] = modulus > largest[m] ? modulus : largest[m];
              }
          else if constexpr (Law::stiffness_varies)
            for (int lane = 0; lane < block_size; lane += Number::width)
              {
                const Number volume  = Number::load(b.volume + lane);
                const Number modulus = Law::p_wave_modulus(
                  load_stress<Number>(b, lane),
                  void_ratio_of(volume,
                                points.histories[block],
                                lane,
                                material.initial_void_ratio),
                  p);
                for (int i = 0; i < Number::width; ++i)
                  // empty lanes have no volume
                  if (volume[i] > 0. && modulus[i] > largest[m])
                    largest[m] = modulus[i];
              }
        });
      };
      for (unsigned int i = 0; i < points.n_active_cells; ++i)
        for_each_block(points, points.active_cells[i], look_at);
    }
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
