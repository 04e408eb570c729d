// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The volume change of a cell that strains its points: the mean divergence of
// the nodal velocities (B-bar), or one that is prescribed for the cell.
#ifndef caisson_mpm_kernels_volume_change_h
#define caisson_mpm_kernels_volume_change_h

#include <caisson_mpm/kernels/cell_sums.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/kernels/update_stress.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** One of the fields in @p update [group.n], one cell in each lane. */
    template <typename Number>
    [[gnu::always_inline]] inline CellField<Number>
    field_of_group(const CellGroup<Number> &group,
                   const CellUpdate        *update,
                   CellField<> CellUpdate::*field)
    {
      const double *rows[Number::width];
      for (int i = 0; i < Number::width; ++i)
        rows[i] = (update[i < group.n ? i : 0].*field).r; // and then z
      LaneSums<Number, 8> values;
      values.load_lanes(rows);
      CellField<Number> result;
      for (int k = 0; k < 4; ++k)
        {
          result.r[k] = values.sum[k];
          result.z[k] = values.sum[4 + k];
        }
      return result;
    }

    /**
     * The mean divergence of each cell of a group. In soil with a large bulk
     * modulus vibrations of the volume decay only with the new velocities,
     * @p advection: those that the points bring back (MUSL) are smoother, and
     * keep them.
     */
    template <typename Number>
    [[gnu::always_inline]] inline void
    find_mean_divergence(const StepContext       &step,
                         const CellGroup<Number> &group,
                         const CellMap<Number>   &map,
                         const CellField<Number> &advection,
                         CellUpdate              *update)
    {
      CellField<Number> v = field_of_group(group, update, &CellUpdate::strain);
      v.approach(advection, group.lanes([&](const unsigned int cell) {
        const CellMoments &moments = step.moments[cell];
        return moments.full * step.materials[moments.material].volume_damping;
      }));
      const Number mean = mean_divergence(map, step.grid.axisymmetric, v);
      for (int i = 0; i < group.n; ++i)
        update[i].mean_divergence = mean[i];
    }

    /**
     * Find what makes the divergence of the velocity that moves the points of
     * a cell the same everywhere in it. B-bar gives them the mean change of
     * volume; where they moved apart and together in one cell all the same,
     * volumes and places would part, and gaps open. Added are
     *   dxi/dt += a xi (xi - 1),   deta/dt += b eta (eta - 1),
     * which vanish at the sides that they point to, so that no flow through a
     * side changes (conservative velocity interpolation: Wang, Agrusta & van
     * Hunen 2015, doi:10.1002/2015GC005824). At most @p largest (1/s), since
     * the velocity of a node with hardly any mass has no bound.
     */
    template <typename Number>
    [[gnu::always_inline]] inline void
    find_bubbles(const CellGroup<Number> &group,
                 const CellMap<Number>   &map,
                 const double             axisymmetric,
                 const CellField<Number> &v,
                 const double             largest,
                 CellUpdate              *update)
    {
      // div v and 1, times r dz/deta, in the middle of the sides
      constexpr double xi[4] = {0., 1., .5, .5}, eta[4] = {.5, .5, 0., 1.};
      Number           flow[4], weight[4], sum_of_flow(0.), total(0.);
      for (int i = 0; i < 4; ++i)
        {
          const LocalPoint<Number> p =
            map.at_reference(Number(xi[i]), Number(eta[i]));
          const VelocityGradient<Number> L(v, p, map.inverse_width, Number(0.));
          const Number                   r =
            Number(axisymmetric) * (map.left + map.width * p.xi) +
            Number(1. - axisymmetric);
          weight[i] = r * p.height;
          flow[i]   = weight[i] * (L.rr + L.zz) +
                    Number(axisymmetric) * p.height * evaluate(v.r, p);
          sum_of_flow += flow[i];
          total += weight[i];
        }
      const Number mean = sum_of_flow / total, scale = Number(-2.) / total;
      const auto   bounded = [&](const Number &x) {
        return min(max(x, Number(-largest)), Number(largest));
      };
      const Number a =
        bounded(scale * (flow[1] - flow[0] - mean * (weight[1] - weight[0])));
      const Number b =
        bounded(scale * (flow[3] - flow[2] - mean * (weight[3] - weight[2])));
      for (int i = 0; i < group.n; ++i)
        {
          update[i].bubble[0] = a[i];
          update[i].bubble[1] = b[i];
        }
    }

    /** Both for B-bar: the volume change of points, and where they move. */
    template <typename Number>
    [[gnu::always_inline]] inline void
    make_volume_change_uniform(const StepContext       &step,
                               const CellGroup<Number> &group,
                               const CellMap<Number>   &map,
                               const double             time_step,
                               CellUpdate              *update)
    {
      const CellField<Number> advection =
        field_of_group(group, update, &CellUpdate::advection);
      find_mean_divergence(step, group, map, advection, update);
      // no further than a quarter of the cell in a step
      find_bubbles(
        group, map, step.grid.axisymmetric, advection, 1. / time_step, update);
    }

    /** Take the mean divergence of cells from the list @p rates [n_cells],
     * if there is one, where it has a value. */
    template <typename Number>
    [[gnu::always_inline]] inline void
    take_volume_rates(const CellGroup<Number> &group,
                      const double            *rates,
                      CellUpdate              *update)
    {
      for (int i = 0; rates != nullptr && i < group.n; ++i)
        {
          const double rate = rates[group.cell[i]];
          if (rate == rate)
            update[i].mean_divergence = rate;
        }
    }

    /** Find the volume changes of the cells of a group, by all of these. */
    template <typename Number>
    [[gnu::always_inline]] inline void
    find_volume_changes(const StepContext       &step,
                        const CellGroup<Number> &group,
                        const CellMap<Number>   &map,
                        const PointUpdate       &how,
                        CellUpdate              *update)
    {
      if (how.settings.mean_volume_change)
        make_volume_change_uniform(
          step, group, map, how.settings.time_step, update);
      take_volume_rates(group, how.volume_rates, update);
    }
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
