// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The integrals of a pressure over one cell that make its nodal forces, at the
// places where the stress is integrated.
#ifndef caisson_mpm_kernels_pressure_integrals_h
#define caisson_mpm_kernels_pressure_integrals_h

#include <caisson_mpm/kernels/cell_sums.h>
#include <caisson_mpm/kernels/layout.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** An isotropic stress. */
    template <typename Number>
    [[gnu::always_inline]] inline StressState<Number>
    isotropic(const Number p)
    {
      return {p, p, p, Number(0.)};
    }

    /** The integrals over the points of a cell, of the pressure with the
     * @p coefficients of {1, xi, eta, xi eta}. */
    template <typename Number>
    void
    integrate_pressure_at_points(const StepContext &step,
                                 const unsigned int cell,
                                 const double      *coefficients,
                                 double            *out)
    {
      const CellMap<>   map(step.grid.geometry[cell]);
      ForceSums<Number> sums;
      sums.clear();
      for_each_block(step.points, cell, [&](const int block) CAISSON_LAMBDA {
        for (int lane = 0; lane < block_size; lane += Number::width)
          {
            const LoadedPoints<Number> p(step.points.blocks[block], lane, map);
            sums.add(p.local,
                     Number(map.inverse_width),
                     Number(step.grid.axisymmetric) / p.r,
                     p.volume,
                     isotropic(evaluate(coefficients, p.local)));
          }
      });
      sums.store(out);
    }

    /** The integrals over the Gauss points of cells, one in each lane. */
    template <typename Number>
    [[gnu::always_inline]] inline void
    integrate_pressure_in_full_cells(const CellMap<Number> &map,
                                     const double           axisymmetric,
                                     const Number          *coefficients,
                                     ForceSums<Number>     &sums)
    {
      sums.clear();
      for (int i = 0; i < GaussPoint<Number>::n; ++i)
        {
          const GaussPoint<Number> gauss(map, axisymmetric, i);
          sums.add(gauss.point,
                   map.inverse_width,
                   gauss.inverse_r,
                   gauss.volume,
                   isotropic(evaluate(coefficients, gauss.point)));
        }
    }
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
