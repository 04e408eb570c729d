// SPDX-License-Identifier: LGPL-2.1-or-later
//
// From the nodes of each cell to its points: stress (update_stress.h), velocity
// and place, and the sums over the points for the next step.
//
//   V_p <- keep V_p + sum_I N_I(x_p) v_I^transfer,
//   x_p <- x_p + dt sum_I N_I(x_p) v_I^advection.
#ifndef caisson_mpm_kernels_grid_to_points_h
#define caisson_mpm_kernels_grid_to_points_h

#include <caisson_mpm/kernels/cell_sums.h>
#include <caisson_mpm/kernels/update_stress.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      /** Reduce a velocity above the limit to it; returns the lanes cut. */
      template <typename Number>
      CAISSON_INLINE unsigned int
      limit_speed(const double limit, Number &r, Number &z)
      {
        const Number speed = sqrt(r * r + z * z);
        const auto   fast  = speed > Number(limit);
        const Number scale = select(fast, Number(limit) / speed, Number(1.));
        r *= scale;
        z *= scale;
        return to_integer(fast);
      }

      /** Sums over the points of a cell after the update. */
      template <typename Number>
      struct UpdateSums : LaneSums<Number, 4>
      {
        // w q, w q xi, w q eta of the work q per volume with weights w, and the
        // new volume
        using LaneSums<Number, 4>::sum;

        CAISSON_INLINE void
        add_work(const LocalPoint<Number> &p,
                 const Number              weight,
                 const Number              work)
        {
          const Number q = weight * work;
          sum[0] += q;
          sum[1] += q * p.xi;
          sum[2] += q * p.eta;
        }
      };

      /**
       * The work of the stress on the points of full cells in a step. The
       * internal force is integrated over the volume of a full cell, from a fit
       * to the stress of its points, wherever they are and whatever volume they
       * have; so is the work, from the fit to the work per volume. @p s: of
       * UpdateSums, where the weights are the masses with the moments @p mass.
       */
      template <typename Number>
      CAISSON_INLINE Number
      work_in_full_cells(const Number *s,
                         const Number *mass,
                         const Number  volume)
      {
        const Number inverse_mass = Number(1.) / mass[0], half(.5);
        const Number x = mass[1] * inverse_mass, y = mass[2] * inverse_mass,
                     mean    = s[0] * inverse_mass;
        const Number slope_x = s[1] - mean * mass[1],
                     slope_y = s[2] - mean * mass[2];
        const auto inverse   = inverse_covariance(mass[0],
                                                mass[4] * inverse_mass - x * x,
                                                mass[3] * inverse_mass - x * y,
                                                mass[5] * inverse_mass - y * y);
        return volume *
               (mean +
                (half - x) * (inverse.xx * slope_x + inverse.xy * slope_y) +
                (half - y) * (inverse.xy * slope_x + inverse.yy * slope_y));
      }

      /** New velocity and place of the points in the lanes from @p lane on;
       * returns the lanes whose velocity was cut. */
      template <typename Number>
      CAISSON_INLINE unsigned int
      move_points(PointBlock               &b,
                  const int                 lane,
                  const LocalPoint<Number> &p,
                  const CellUpdate         &cell,
                  const UpdateSettings     &settings,
                  Number                   &r,
                  Number                   &z)
      {
        // V_p <- keep V_p + S v_transfer;  x_p <- x_p + dt S v_advection
        const Number dt(settings.time_step), keep(settings.keep_velocity);
        Number       velocity_r = keep * Number::load(b.velocity_r + lane) +
                            evaluate(cell.transfer.r, p);
        Number velocity_z = keep * Number::load(b.velocity_z + lane) +
                            evaluate(cell.transfer.z, p);
        Number move_r = evaluate(cell.advection.r, p),
               move_z = evaluate(cell.advection.z, p);
        // Beside the body a cell may be squeezed flat: |v| <= k H / dt keeps a
        // point from passing more than a share of it in a step.
        unsigned int limited = 0;
        if (cell.speed_limit > 0.)
          limited = limit_speed(cell.speed_limit, velocity_r, velocity_z) |
                    limit_speed(cell.speed_limit, move_r, move_z);
        velocity_r.store(b.velocity_r + lane);
        velocity_z.store(b.velocity_z + lane);
        r += dt * move_r;
        z += dt * move_z;
        r.store(b.r + lane);
        z.store(b.z + lane);
        return limited;
      }

      /** Update one block; returns its lanes outside the moved cell. */
      template <typename Law, typename Number>
      CAISSON_INLINE unsigned int
      update_block(PointBlock            &b,
                   PointHistory          &history,
                   const CellUpdate      &cell,
                   const UpdateSettings  &settings,
                   const MaterialOf<Law> &material,
                   unsigned int          &limited,
                   UpdateSums<Number>    &sums)
      {
        unsigned int outside = 0;
        limited              = 0;
        for (int lane = 0; lane < block_size; lane += Number::width)
          {
            Number r = Number::load(b.r + lane), z = Number::load(b.z + lane);
            const LocalPoint<Number> p = cell.map.at_position(r, z);
            const Number             weight =
              Number::load((cell.full ? b.mass : b.volume) + lane);
            sums.add_work(p,
                          weight,
                          update_stress<Law>(
                            b, history, lane, p, cell, settings, material));
            sums.sum[3] += Number::load(b.volume + lane);
            limited |= move_points(b, lane, p, cell, settings, r, z) << lane;
            outside |= to_integer(!cell.moved.contains(r, z)) << lane;
          }
        return outside;
      }

      /** Prepare the update of a cell, all but the mean divergence. */
      CAISSON_INLINE void
      prepare_cell(const StepContext &step,
                   const PointUpdate &how,
                   const unsigned int cell,
                   CellUpdate        &update)
      {
        const GridView       &grid     = step.grid;
        const CellMoments    &moments  = step.moments[cell];
        const UpdateSettings &settings = how.settings;
        const NodalFields    &fields   = how.fields;
        const CellNodes      &nodes    = grid.nodes[cell];
        update.map                     = CellMap<>(grid.geometry[cell]);
        update.moved                   = CellMap<>(how.moved.geometry[cell]);
        update.advection               = CellField<>(fields.advection, nodes);
        update.transfer                = CellField<>(fields.transfer, nodes);
        update.strain                  = CellField<>(fields.strain, nodes);
        update.full                    = moments.full;
        update.axisymmetric            = grid.axisymmetric;
        update.speed_limit             = 0.;
        update.fit                     = nullptr;
        if (settings.stress_filter > 0. && moments.full)
          {
            update.fit                 = moments.fit;
            update.inverse_mean_height = 1. / update.map.mean_height();
          }
        if (settings.limiter > 0. && (grid.flags[cell] & next_to_body))
          {
            const CellGeometry &g = grid.geometry[cell];
            double              h = g.width;
            h                     = g.height_left < h ? g.height_left : h;
            h                     = g.height_right < h ? g.height_right : h;
            update.speed_limit    = settings.limiter * h / settings.time_step;
          }
      }

      /** The mean divergence of each cell of a group, from the strain fields of
       * @p update [group.n]. */
      template <typename Number>
      CAISSON_INLINE void
      find_mean_divergence(const CellGroup<Number> &group,
                           const CellMap<Number>   &map,
                           const double             axisymmetric,
                           CellUpdate              *update)
      {
        const double *rows[Number::width];
        for (int i = 0; i < Number::width; ++i)
          rows[i] = update[i < group.n ? i : 0].strain.r; // and then z
        LaneSums<Number, 8> fields;
        fields.load_lanes(rows);
        CellField<Number> strain;
        for (int k = 0; k < 4; ++k)
          {
            strain.r[k] = fields.sum[k];
            strain.z[k] = fields.sum[4 + k];
          }
        const Number mean = mean_divergence(map, axisymmetric, strain);
        for (int i = 0; i < group.n; ++i)
          update[i].mean_divergence = mean[i];
      }

      /** Append the points of a block in the lanes @p outside to the list. */
      CAISSON_INLINE void
      list_leaving(const unsigned int cell,
                   const int          block,
                   unsigned int       outside,
                   UpdateResult      &result)
      {
        for (; outside != 0; outside &= outside - 1)
          {
            if (result.n_leaving < result.capacity)
              result.leaving[result.n_leaving] = {cell,
                                                  block,
                                                  __builtin_ctz(outside)};
            ++result.n_leaving;
          }
      }

      /** Update the points of an active cell; list those that left it, and
       * return their number. */
      template <typename Number>
      CAISSON_INLINE unsigned int
      update_points(const StepContext    &step,
                    const unsigned int    active,
                    const CellUpdate     &update,
                    const UpdateSettings &settings,
                    UpdateSums<Number>   &sums,
                    UpdateResult         &result)
      {
        const PointsView  &points = step.points;
        const unsigned int cell   = points.active_cells[active];
        const unsigned int before = result.n_leaving;
        for (int block = points.first_block[cell]; block >= 0;)
          {
            const BlockHeader header = points.headers[block];
            prefetch(points, header.next, active);
            unsigned int    outside = 0, limited = 0;
            const Material &material = step.materials[header.material];
            with_law(material,
                     [&](auto law, const auto &parameters) CAISSON_LAMBDA {
                       outside = update_block<decltype(law), Number>(
                         points.blocks[block],
                         points.histories[block],
                         update,
                         settings,
                         {material.initial_void_ratio, parameters},
                         limited,
                         sums);
                     });
            // padding moves like the point that it repeats, but is none
            const unsigned int real = (1u << header.count) - 1u;
            result.n_limited += __builtin_popcount(limited & real);
            list_leaving(cell, block, outside & real, result);
            block = header.next;
          }
        return result.n_leaving - before;
      }

      /** Update the points of all cells of a group; row i of @p sums takes the
       * UpdateSums of cell i, and 0 beyond the last one. */
      template <typename Number>
      CAISSON_INLINE void
      update_group(const StepContext       &step,
                   const PointUpdate       &how,
                   const CellGroup<Number> &group,
                   const unsigned int       begin,
                   const CellUpdate        *update,
                   Number (*sums)[Number::width],
                   UpdateResult &result)
      {
        constexpr int n_sums = UpdateSums<Number>::size;
        for (int i = 0; i < Number::width; ++i)
          for (int k = 0; k < n_sums; ++k)
            sums[k][i] = Number(0.);
        for (int i = 0; i < group.n; ++i)
          {
            UpdateSums<Number> own;
            own.clear();
            const unsigned int n_leaving = update_points(
              step, begin + i, update[i], how.settings, own, result);
            for (int k = 0; k < n_sums; ++k)
              sums[k][i] = own.sum[k];
            // The sums for the next step, while the points are in the cache. A
            // cell that points leave is summed by points_to_grid instead.
            if (n_leaving == 0)
              sum_points<Number>(step,
                                 how.moved.geometry[group.cell[i]],
                                 group.cell[i]);
          }
      }

      /** See KernelTable. Lanes are points in update_group(), and cells in the
       * rest. */
      template <typename Number>
      void
      grid_to_points(const StepContext &step,
                     const PointUpdate &how,
                     UpdateResult      &result)
      {
        constexpr int width = Number::width, n_sums = UpdateSums<Number>::size;
        result.n_leaving = result.n_limited = 0;
        result.stress_work                  = 0.;
        for (unsigned int begin = 0; begin < step.points.n_active_cells;
             begin += width)
          {
            const CellGroup<Number> group(step.points, begin);
            const CellMap<Number>   map = group.map(step.grid.geometry);

            // 1. The moments of mass, before those of the next step replace
            //    them: the work of full cells needs them.
            const double *mass_rows[width];
            for (int i = 0; i < width; ++i)
              mass_rows[i] = step.moments[group.cell[i]].mass;
            LaneSums<Number, 8> mass;
            mass.load_lanes(mass_rows);

            // 2. The nodal fields in the basis {1, xi, eta, xi eta} of each
            //    cell, and the mean of div v over its volume for B-bar.
            CellUpdate update[width];
            for (int i = 0; i < group.n; ++i)
              prepare_cell(step, how, group.cell[i], update[i]);
            if (how.settings.mean_volume_change)
              find_mean_divergence(group, map, step.grid.axisymmetric, update);

            // 3. Stress, volume, velocity and place of the points.
            Number of_points[n_sums][width];
            update_group(step, how, group, begin, update, of_points, result);

            // 4. The work of the stress, integrated as the internal force was,
            //    and the volume that the points fill now.
            Number sums[n_sums];
            for (int k = 0; k < n_sums; ++k)
              sums[k] = sum_each(of_points[k]);
            const Number in_full =
              work_in_full_cells(sums,
                                 mass.sum,
                                 map.volume(step.grid.axisymmetric));
            for (int i = 0; i < group.n; ++i)
              {
                result.stress_work += update[i].full ? in_full[i] : sums[0][i];
                step.points.filled_volume[group.cell[i]] = sums[3][i];
              }
          }
      }
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
