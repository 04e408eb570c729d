// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The force of flowing pore water on the soil,
//   f_I -= sum_p V_p N_I(x_p) grad p(x_p),   p = sum_J N_J p_J,   per radian.
//
// The sum runs over the points in all cells, full ones too, because their
// weight is at the points: water that flows upward at the critical gradient
// then carries each point, wherever it is in its cell. A uniform pressure
// leaves no force, and a free surface needs no traction.
//
// In a cell that the free surface of the water cuts, the nodal values of the
// upper corners are those at the surface: the field is that of the lower part
// of the cell, and above the surface that at the surface.
#ifndef caisson_mpm_kernels_pressure_gradient_force_h
#define caisson_mpm_kernels_pressure_gradient_force_h

#include <caisson_mpm/kernels/cell_map.h>
#include <caisson_mpm/kernels/for_each_block.h>
#include <caisson_mpm/kernels/moments.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** The lower share @p filled of a cell. */
    [[gnu::always_inline]] inline CellGeometry
    lower_part(CellGeometry geometry, const double filled)
    {
      geometry.height_left *= filled;
      geometry.height_right *= filled;
      return geometry;
    }

    /** Sums of V dp/dr and V dp/dz, times {1, xi, eta, xi eta} each. */
    template <typename Number>
    struct GradientSums : LaneSums<Number, 8>
    {
      [[gnu::always_inline]] inline void
      add(const LocalPoint<Number> &p,
          const Number              volume,
          const Number             *gradient)
      {
        const Number product = p.xi * p.eta;
        for (int c = 0; c < 2; ++c)
          {
            const Number force = volume * gradient[c];
            Number      *out   = this->sum + 4 * c;
            out[0] += force;
            out[1] += force * p.xi;
            out[2] += force * p.eta;
            out[3] += force * product;
          }
      }
    };

    /** See KernelTable. */
    template <typename Number>
    void
    pressure_gradient_force(const StepContext &step,
                            const double      *pressure,
                            const double      *filled,
                            NodalVector       *out)
    {
      for (unsigned int i = 0; i < step.points.n_active_cells; ++i)
        {
          const unsigned int cell = step.points.active_cells[i];
          if (filled[cell] == 0.)
            continue;
          const CellNodes &nodes = step.grid.nodes[cell];
          double           corner[4], c[4];
          for (int k = 0; k < 4; ++k)
            corner[k] = pressure[nodes.node[k]];
          coefficients(corner, c);

          const CellMap<> map(step.grid.geometry[cell]);
          const CellMap<> below(
            lower_part(step.grid.geometry[cell], filled[cell]));
          GradientSums<Number> sums;
          sums.clear();
          for_each_block(
            step.points, cell, [&](const int block) CAISSON_LAMBDA {
              const PointBlock &b = step.points.blocks[block];
              for (int lane = 0; lane < block_size; lane += Number::width)
                {
                  const Number r                    = Number::load(b.r + lane),
                               z                    = Number::load(b.z + lane);
                  const LocalPoint<Number> local    = map.at_position(r, z);
                  LocalPoint<Number>       in_field = local;
                  if (filled[cell] < 1.)
                    in_field = below.at_reference(
                      local.xi, min(below.at_position(r, z).eta, Number(1.)));
                  Number slope[2];
                  gradient(c, in_field, map.inverse_width, slope[0], slope[1]);
                  // padding has no volume
                  sums.add(local, Number::load(b.volume + lane), slope);
                }
            });
          double of_cell[GradientSums<Number>::size];
          sums.store(of_cell);
          for (int d = 0; d < 2; ++d)
            {
              moments_to_corners(of_cell + 4 * d, corner);
              for (int k = 0; k < 4; ++k)
                out[nodes.node[k]].value[d] -= corner[k];
            }
        }
    }
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
