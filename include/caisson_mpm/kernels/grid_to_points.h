// SPDX-License-Identifier: LGPL-2.1-or-later
//
// From the nodes of each cell to its points: stress (update_stress.h), velocity
// and place, and the sums over the points for the next step.
//
//   V_p <- keep V_p + sum_I N_I(x_p) v_I^transfer,
//   x_p <- x_p + dt (sum_I N_I(x_p) v_I^advection + bubbles).
#ifndef caisson_mpm_kernels_grid_to_points_h
#define caisson_mpm_kernels_grid_to_points_h

#include <caisson_mpm/kernels/cell_pressure.h>
#include <caisson_mpm/kernels/cell_sums.h>
#include <caisson_mpm/kernels/deferred_blocks.h>
#include <caisson_mpm/kernels/loosest_state.h>
#include <caisson_mpm/kernels/move_points.h>
#include <caisson_mpm/kernels/packed_points.h>
#include <caisson_mpm/kernels/user_points.h>
#include <caisson_mpm/kernels/volume_change.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** Sums over the points of a cell after the update. */
    template <typename Number>
    struct UpdateSums : LaneSums<Number, 5>
    {
      // m q, m q xi, m q eta and V q of the work q per volume, and the new
      // volume
      using LaneSums<Number, 5>::sum;

      [[gnu::always_inline]] inline void
      add_work(const LocalPoint<Number> &p,
               const Number              mass,
               const Number              volume,
               const Number              work)
      {
        const Number q = mass * work;
        sum[0] += q;
        sum[1] += q * p.xi;
        sum[2] += q * p.eta;
        sum[3] += volume * work;
      }
    };

    /**
     * The work of the stress on the points of full cells in a step. The
     * internal force is integrated over the volume of a full cell, from a fit
     * to the stress of its points, wherever they are and whatever volume they
     * have; so is the work, from the fit to the work per volume. @p s: of
     * UpdateSums, of points with the moments @p mass. The volume has its
     * @p center in xi less 1/2 and in the middle of eta.
     */
    template <typename Number>
    [[gnu::always_inline]] inline Number
    work_in_full_cells(const Number *s,
                       const Number *mass,
                       const Number  center,
                       const Number  volume,
                       const Number  bounded)
    {
      const Number inverse_mass = Number(1.) / mass[0], half(.5);
      const Number x = mass[1] * inverse_mass, y = mass[2] * inverse_mass,
                   mean    = s[0] * inverse_mass;
      const Number slope_x = s[1] - mean * mass[1],
                   slope_y = s[2] - mean * mass[2];
      Number xx            = mass[4] * inverse_mass - x * x,
             xy            = mass[3] * inverse_mass - x * y,
             yy            = mass[5] * inverse_mass - y * y;
      add_distance_of_centers(bounded, x - half - center, y - half, xx, xy, yy);
      const auto inverse = inverse_covariance(mass[0], xx, xy, yy);
      return volume *
             (mean +
              (half + center - x) *
                (inverse.xx * slope_x + inverse.xy * slope_y) +
              (half - y) * (inverse.xy * slope_x + inverse.yy * slope_y));
    }

    /** What grid_to_points() keeps while it goes through the cells. */
    template <typename Number>
    struct UpdateInProgress
    {
      BlocksAhead            ahead;
      DeferredBlocks<Number> deferred;
      PackedPoints<Number>  &packed;
      // row i: sum i of UpdateSums of the cells of a group
      Number        of_group[UpdateSums<Number>::size][Number::width];
      UpdateResult &result;

      [[gnu::always_inline]] inline UpdateInProgress(
        const PointsView     &points,
        PackedPoints<Number> &packed,
        UpdateResult         &result)
        : ahead(points)
        , packed(packed)
        , result(result)
      {}
    };

    /** Update stress and volume of the points in the lanes from @p lane on, or
     * let them wait. */
    template <typename Law, typename Number, typename Waiting>
    [[gnu::always_inline]] inline void
    update_stress_of_lanes(const BlockUpdate        &u,
                           const int                 lane,
                           const LocalPoint<Number> &p,
                           UpdateSums<Number>       &sums,
                           Waiting                  &waiting)
    {
      PointBlock     &b        = u.points;
      const Material &material = u.material;
      const auto     &parameters =
        reinterpret_cast<const typename Law::Parameters &>(material.parameters);
      StressStep<Number> s = begin_stress_step(b, lane, p, u.cell, u.settings);
      bool               is_loose = false;
      if constexpr (Law::has_loosest_state)
        if (u.cell.has_loose_points && material.has_loosest_state)
          is_loose =
            hold_loose_points<Law, Number>(u, lane, parameters, s.step);
      if constexpr (Law::is_packed)
        return waiting.template add<Law>(
          b, u.history, lane, u.count - lane, s, p, parameters, u.in_group);
      const Number mass   = Number::load(b.mass + lane),
                   volume = Number::load(b.volume + lane),
                   after  = volume * (Number(1.) + s.step.volume_change);
      sums.sum[4] += after;
      if constexpr (may_be_deferred<Law, Number>)
        if (material.stress_measure == StressMeasure::cauchy)
          {
            StressState<Number> stress = s.old;
            if (!is_loose &&
                Law::update_elastic(stress, s.step.strain, parameters))
              {
                store_stress(s.half_turn(stress), b, lane);
                after.store(b.volume + lane);
                sums.add_work(p,
                              mass,
                              volume,
                              work_per_volume(s.old, stress, s.step));
                return;
              }
            if (!Law::needs_void_ratio(parameters))
              return waiting.add(b, s, p, material, u.in_group);
          }
      sums.add_work(p,
                    mass,
                    volume,
                    update_stress<Law>(b,
                                       u.history,
                                       lane,
                                       s,
                                       {material.initial_void_ratio,
                                        material.stress_measure,
                                        parameters}));
    }

    /** Update the first @p n_lanes of a block; returns those outside the moved
     * cell. */
    template <typename Law, int n_lanes, typename Number, typename Waiting>
    [[gnu::always_inline]] inline unsigned int
    update_block(const BlockUpdate  &u,
                 unsigned int       &limited,
                 UpdateSums<Number> &sums,
                 Waiting            &waiting)
    {
      PointBlock  &b       = u.points;
      unsigned int outside = 0;
      limited              = 0;
      for (int lane = 0; lane < n_lanes; lane += Number::width)
        {
          Number r = Number::load(b.r + lane), z = Number::load(b.z + lane);
          const LocalPoint<Number> p = u.cell.map.at_position(r, z);
          update_stress_of_lanes<Law>(u, lane, p, sums, waiting);
          limited |= move_points(b, lane, p, u.cell, u.settings, r, z) << lane;
          outside |= to_integer(!u.cell.moved.contains(r, z)) << lane;
        }
      return outside;
    }

    /** Update a block of a law that is packed. What a kernel does for the
     * points of other laws stays as short as it is without this. */
    template <typename Law, typename Number>
    [[gnu::noinline]] unsigned int
    update_packed_block(const BlockUpdate                        &u,
                        unsigned int                             &limited,
                        const typename PackedPoints<Number>::Sums sums,
                        PackedPoints<Number>                     &packed)
    {
      unsigned int       outside = 0;
      UpdateSums<Number> no_sums; // packed points are added later
      packed.prepare(u.material, sums);
      with_lanes<Number>(u.count, [&](auto n_lanes) CAISSON_LAMBDA {
        outside = update_block<Law, n_lanes>(u, limited, no_sums, packed);
      });
      return outside;
    }

    /** Give a field the value at a corner that the cell sees, if it has this
     * share of the body's velocity. */
    [[gnu::always_inline]] inline void
    see_corner(const CornerView  &corner,
               const NodalVector &at_node,
               const double       share_of_body,
               CellField<>       &field)
    {
      const auto relative = [&](const int d) {
        return at_node.value[d] - share_of_body * corner.velocity[d];
      };
      const double free   = relative(corner.free);
      const auto   change = [&](const int d, double *of_field) {
        double at_corners[4]      = {}, c[4];
        at_corners[corner.corner] = free * corner.q[d] - relative(d);
        coefficients(at_corners, c);
        for (int k = 0; k < 4; ++k)
          of_field[k] += c[k];
      };
      change(0, field.r);
      change(1, field.z);
    }

    /** The same in all fields of a cell at the body. */
    [[gnu::always_inline]] inline void
    see_corners(const StepContext &step,
                const NodalFields &fields,
                const unsigned int cell,
                CellUpdate        &update)
    {
      for (unsigned int i = 0; i < step.n_corners; ++i)
        if (step.corners[i].cell == cell)
          {
            const CornerView  &corner = step.corners[i];
            const unsigned int node = step.grid.nodes[cell].node[corner.corner];
            see_corner(corner, fields.advection[node], 1., update.advection);
            see_corner(corner, fields.strain[node], 1., update.strain);
            see_corner(corner,
                       fields.transfer[node],
                       fields.transfer_of_body,
                       update.transfer);
          }
    }

    /** Whether a cell has soil that is much softer than other soil in it. The
     * stress that a filter moves from stiff to soft points would be energy
     * from nowhere there, which makes the boundary of a soft layer unstable.
     */
    [[gnu::always_inline]] inline bool
    mixes_stiffness(const StepContext &step, const unsigned int cell)
    {
      constexpr double much  = 2.;
      double           least = no_limit, largest = 0.;
      if (!step.moments[cell].several_materials)
        return false;
      for_each_block(step.points, cell, [&](const int block) CAISSON_LAMBDA {
        const Material &m       = step.materials[step.points.material(block)];
        const double    modulus = m.p_wave_modulus - m.water_modulus;
        least                   = modulus < least ? modulus : least;
        largest                 = modulus > largest ? modulus : largest;
      });
      return largest > much * least;
    }

    /** Prepare the update of a cell, all but the mean divergence. */
    [[gnu::always_inline]] inline void
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
      if (grid.flags[cell] & next_to_body)
        see_corners(step, fields, cell, update);
      update.axisymmetric = grid.axisymmetric;
      update.bubble[0] = update.bubble[1] = 0.;
      update.speed_limit                  = 0.;
      update.fit                          = nullptr;
      if (settings.stress_filter > 0. && moments.full > 0. &&
          !mixes_stiffness(step, cell))
        {
          update.fit                 = moments.fit;
          update.filtered_share      = settings.stress_filter * moments.full;
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

    /** Append the points of a block in the lanes @p outside to the list. */
    [[gnu::always_inline]] inline void
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

    /** Update the points of cell @p in_group of a group; list those that left
     * it, and return their number. */
    template <typename Number>
    [[gnu::always_inline]] inline unsigned int
    update_points(const StepContext        &step,
                  const unsigned int        cell,
                  const int                 in_group,
                  const CellUpdate         &update,
                  const UpdateSettings     &settings,
                  UpdateInProgress<Number> &progress)
    {
      const PointsView  &points   = step.points;
      UpdateResult      &result   = progress.result;
      const unsigned int before   = result.n_leaving,
                         deferred = progress.deferred.total();
      UpdateSums<Number> sums;
      sums.clear();
      for (int block = points.first_block[cell]; block >= 0;)
        {
          const int count = points.count(block);
          progress.ahead.advance();
          if (progress.deferred.is_full())
            progress.deferred.update(progress.of_group);
          unsigned int      outside = 0, limited = 0;
          const BlockUpdate u = {points.blocks[block],
                                 points.histories[block],
                                 step.materials[points.material(block)],
                                 update,
                                 settings,
                                 count,
                                 in_group};
          with_law(u.material, [&](auto law, const auto &) CAISSON_LAMBDA {
            using Law = decltype(law);
            if constexpr (Law::is_external)
              outside =
                update_user_block<Number>(points, block, u, limited, sums);
            else if constexpr (Law::is_packed)
              outside = update_packed_block<Law>(u,
                                                 limited,
                                                 progress.of_group,
                                                 progress.packed);
            else
              with_lanes<Number>(count, [&](auto n_lanes) CAISSON_LAMBDA {
                outside = update_block<Law, n_lanes>(u,
                                                     limited,
                                                     sums,
                                                     progress.deferred);
              });
          });
          // padding moves like the point that it repeats, but is none
          const unsigned int real = (1u << count) - 1u;
          result.n_limited += __builtin_popcount(limited & real);
          list_leaving(cell, block, outside & real, result);
          block = points.next[block];
        }
      for (int k = 0; k < sums.size; ++k)
        progress.of_group[k][in_group] += sums.sum[k];
      points.n_yielding[cell] =
        static_cast<unsigned short>(progress.deferred.total() - deferred);
      return result.n_leaving - before;
    }

    /** Update the points of all cells of a group. */
    template <typename Number>
    [[gnu::always_inline]] inline void
    update_group(const StepContext        &step,
                 const PointUpdate        &how,
                 const CellGroup<Number>  &group,
                 CellUpdate               *update,
                 UpdateInProgress<Number> &progress)
    {
      for (auto &sums : progress.of_group)
        for (Number &of_cell : sums)
          of_cell = Number(0.);
      unsigned int n_leaving[Number::width];
      for (int i = 0; i < group.n; ++i)
        {
          // just before the points are in the cache
          share_out_growth<Number>(step,
                                   group.cell[i],
                                   how.settings,
                                   update[i]);
          n_leaving[i] = update_points(
            step, group.cell[i], i, update[i], how.settings, progress);
        }
      progress.deferred.update(progress.of_group);
      progress.packed.update(progress.of_group);
      // The sums for the next step, while the points are in the cache. A
      // cell that points leave is summed by points_to_grid instead.
      for (int i = 0; i < group.n; ++i)
        if (n_leaving[i] == 0)
          sum_points<Number>(step,
                             how.moved.geometry[group.cell[i]],
                             group.cell[i]);
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
      PackedPoints<Number>     packed;
      UpdateInProgress<Number> progress(step.points, packed, result);
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
          find_volume_changes(step, group, map, how, update);
          if (step.pore_pressure != nullptr)
            result.stress_work +=
              work_on_water(step, group, update, how.settings.time_step);

          // 3. Stress, volume, velocity and place of the points.
          update_group(step, how, group, update, progress);

          // 4. The work of the stress, integrated as the internal force was,
          //    and the volume that the points fill now.
          Number sums[n_sums];
          for (int k = 0; k < n_sums; ++k)
            sums[k] = sum_each(progress.of_group[k]);
          const Number in_full =
            work_in_full_cells(sums,
                               mass.sum,
                               map.center_of_volume(step.grid.axisymmetric),
                               map.volume(step.grid.axisymmetric),
                               group.lanes([&](const unsigned int c) {
                                 return step.moments[c].bounded;
                               }));
          for (int i = 0; i < group.n; ++i)
            {
              const double full = step.moments[group.cell[i]].full;
              if (full > 0.)
                result.stress_work += full * in_full[i];
              result.stress_work += (1. - full) * sums[3][i];
              step.points.filled_volume[group.cell[i]] = sums[4][i];
            }
        }
    }
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
