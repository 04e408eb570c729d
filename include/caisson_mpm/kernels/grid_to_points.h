// SPDX-License-Identifier: LGPL-2.1-or-later
//
// From the nodes of each cell to its points: velocity, stress, position.
//
// Stress rate: Jaumann with the in-plane spin, strain increment with the mean
// volume change of the cell (B-bar).
#ifndef caisson_mpm_kernels_grid_to_points_h
#define caisson_mpm_kernels_grid_to_points_h

#include <caisson_mpm/kernels/laws.h>
#include <caisson_mpm/kernels/points_to_grid.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      /** Coefficients of both components of a nodal field, in one cell or in
       * one cell in each lane. */
      template <typename Real = double>
      struct CellField
      {
        Real r[4], z[4];

        CellField() = default;

        CAISSON_INLINE
        CellField(const NodalVector *field, const CellNodes &cell)
        {
          using Pair = Lanes<2>; // both components of a node
          Pair corner[4], coefficient[4];
          for (int i = 0; i < 4; ++i)
            corner[i] = Pair::load(field[cell.node[i]].value);
          coefficients(corner, coefficient);
          for (int i = 0; i < 4; i += 2)
            {
              Pair component[2];
              transpose(coefficient + i, component);
              component[0].store(r + i);
              component[1].store(z + i);
            }
        }
      };

      /** The velocity gradient at a point, L_tt included. */
      template <typename Number>
      struct VelocityGradient
      {
        Number rr, rz, zr, zz, tt;

        template <typename Real>
        CAISSON_INLINE
        VelocityGradient(const CellField<Real>    &v,
                         const LocalPoint<Number> &p,
                         const Real                inverse_width,
                         const Number              inverse_r)
        {
          gradient(v.r, p, inverse_width, rr, rz);
          gradient(v.z, p, inverse_width, zr, zz);
          tt = evaluate(v.r, p) * inverse_r;
        }

        CAISSON_INLINE Number
        trace() const
        {
          return rr + zz + tt;
        }
      };

      /** The mean of div v over the volume of cells, by Gauss integration. */
      template <typename Number>
      CAISSON_INLINE Number
      mean_divergence(const CellMap<Number>   &map,
                      const double             axisymmetric,
                      const CellField<Number> &v)
      {
        Number change(0.), volume(0.);
        for (int i = 0; i < GaussPoint<Number>::n; ++i)
          {
            const GaussPoint<Number>       gauss(map, axisymmetric, i);
            const VelocityGradient<Number> L(v,
                                             gauss.point,
                                             map.inverse_width,
                                             gauss.inverse_r);
            change += gauss.volume * L.trace();
            volume += gauss.volume;
          }
        return change / volume;
      }

      /** What all points of a cell share. */
      struct CellUpdate
      {
        CellMap<>     map, moved;
        CellField<>   advection, transfer, strain;
        bool          full;
        double        axisymmetric;
        double        mean_divergence; // used where B-bar is on
        double        speed_limit;     // 0: none
        const double *fit;             // of the stress filter; null: no filter
        double        inverse_mean_height;
      };

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

      /**
       * New stress and volume of the points in the given lanes. Returns the
       * work of the stress per volume, with the mean of old and new stress
       * (after the rotation) and volume, beyond the surrounding pressure.
       */
      template <typename Law, typename Number>
      CAISSON_INLINE Number
      update_stress(PointBlock                     &b,
                    PointHistory                   &history,
                    const int                       lane,
                    const LocalPoint<Number>       &p,
                    const CellUpdate               &cell,
                    const UpdateSettings           &settings,
                    const double                    initial_void_ratio,
                    const typename Law::Parameters &parameters)
      {
        const auto load = [lane](const double *field) {
          return Number::load(field + lane);
        };
        const Number dt(settings.time_step);
        const Number inverse_r = Number(cell.axisymmetric) / load(b.r);
        const VelocityGradient<Number> L(cell.strain,
                                         p,
                                         cell.map.inverse_width,
                                         inverse_r);
        StrainIncrement<Number>        strain{dt * L.rr,
                                       dt * L.zz,
                                       dt * L.tt,
                                       dt * Number(.5) * (L.rz + L.zr)};
        Number                         volume_change = dt * L.trace();
        if (settings.mean_volume_change)
          {
            const Number mean(settings.time_step * cell.mean_divergence);
            const Number third =
              (mean - volume_change) * Number(1. / (2. + cell.axisymmetric));
            strain.rr += third;
            strain.zz += third;
            strain.tt += third * Number(cell.axisymmetric);
            volume_change = mean;
          }
        const Number spin = dt * Number(.5) * (L.rz - L.zr);
        Number       rr = load(b.stress[0]), zz = load(b.stress[1]),
               tt = load(b.stress[2]), rz = load(b.stress[3]);
        if (cell.fit != nullptr)
          {
            const Number share(settings.stress_filter);
            const Number x = p.xi - Number(.5),
                         y = (load(b.z) - Number(cell.map.center_z())) *
                             Number(cell.inverse_mean_height);
            rr += share * (evaluate_fit(cell.fit, x, y) - rr);
            zz += share * (evaluate_fit(cell.fit + 3, x, y) - zz);
            tt += share * (evaluate_fit(cell.fit + 6, x, y) - tt);
            rz += share * (evaluate_fit(cell.fit + 9, x, y) - rz);
          }
        const Number        turn = Number(2.) * spin * rz;
        StressState<Number> stress{rr + turn,
                                   zz - turn,
                                   tt,
                                   rz + spin * (zz - rr)};
        LawState<Number>    state;
        state.plastic_deviatoric = load(b.plastic_deviatoric);
        state.plastic_volumetric = load(b.plastic_volumetric);
        const Number volume      = load(b.volume);
        if (Law::uses_void_ratio)
          state.void_ratio = Number(1. + initial_void_ratio) *
                               (volume / load(history.initial_volume)) -
                             Number(1.);
        for (int i = 0; i < Law::n_state; ++i)
          state.variable[i] = load(history.state[i]);
        const StressState<Number> old = stress;
        Law::update(stress, strain, state, parameters);
        stress.rr.store(b.stress[0] + lane);
        stress.zz.store(b.stress[1] + lane);
        stress.tt.store(b.stress[2] + lane);
        stress.rz.store(b.stress[3] + lane);
        state.plastic_deviatoric.store(b.plastic_deviatoric + lane);
        state.plastic_volumetric.store(b.plastic_volumetric + lane);
        for (int i = 0; i < Law::n_state; ++i)
          state.variable[i].store(history.state[i] + lane);
        (volume * (Number(1.) + volume_change)).store(b.volume + lane);
        const Number twice_power =
          (old.rr + stress.rr) * strain.rr + (old.zz + stress.zz) * strain.zz +
          (old.tt + stress.tt) * strain.tt +
          Number(2.) * (old.rz + stress.rz) * strain.rz +
          Number(2. * settings.surrounding_pressure) * volume_change;
        return (Number(.5) + Number(.25) * volume_change) * twice_power;
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

      /** Update one block; returns its lanes outside the moved cell. */
      template <typename Law, typename Number>
      CAISSON_INLINE unsigned int
      update_block(PointBlock                     &b,
                   PointHistory                   &history,
                   const CellUpdate               &cell,
                   const UpdateSettings           &settings,
                   const double                    initial_void_ratio,
                   const typename Law::Parameters &parameters,
                   unsigned int                   &limited,
                   UpdateSums<Number>             &sums)
      {
        unsigned int outside = 0;
        limited              = 0;
        const Number dt(settings.time_step);
        for (int lane = 0; lane < block_size; lane += Number::width)
          {
            Number r = Number::load(b.r + lane), z = Number::load(b.z + lane);
            const LocalPoint<Number> p = cell.map.at_position(r, z);
            const Number             weight =
              Number::load((cell.full ? b.mass : b.volume) + lane);
            sums.add_work(p,
                          weight,
                          update_stress<Law>(b,
                                             history,
                                             lane,
                                             p,
                                             cell,
                                             settings,
                                             initial_void_ratio,
                                             parameters));
            sums.sum[3] += Number::load(b.volume + lane);

            const Number keep(settings.keep_velocity);
            Number       velocity_r = keep * Number::load(b.velocity_r + lane) +
                                evaluate(cell.transfer.r, p);
            Number velocity_z = keep * Number::load(b.velocity_z + lane) +
                                evaluate(cell.transfer.z, p);
            Number move_r = evaluate(cell.advection.r, p),
                   move_z = evaluate(cell.advection.z, p);
            if (cell.speed_limit > 0.)
              {
                limited |= limit_speed(cell.speed_limit, velocity_r, velocity_z)
                           << lane;
                limited |= limit_speed(cell.speed_limit, move_r, move_z)
                           << lane;
              }
            velocity_r.store(b.velocity_r + lane);
            velocity_z.store(b.velocity_z + lane);
            r += dt * move_r;
            z += dt * move_z;
            r.store(b.r + lane);
            z.store(b.z + lane);
            outside |= to_integer(!cell.moved.contains(r, z)) << lane;
          }
        return outside;
      }

      /** All but the mean divergence. */
      CAISSON_INLINE void
      prepare_cell(const unsigned int    cell,
                   const CellMoments    &moments,
                   const GridView       &grid,
                   const GridView       &moved,
                   const UpdateSettings &settings,
                   const NodalFields    &fields,
                   CellUpdate           &update)
      {
        const CellNodes &nodes = grid.nodes[cell];
        update.map             = CellMap<>(grid.geometry[cell]);
        update.moved           = CellMap<>(moved.geometry[cell]);
        update.advection       = CellField<>(fields.advection, nodes);
        update.transfer        = CellField<>(fields.transfer, nodes);
        update.strain          = CellField<>(fields.strain, nodes);
        update.full            = moments.full;
        update.axisymmetric    = grid.axisymmetric;
        update.speed_limit     = 0.;
        update.fit             = nullptr;
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

      /** Update the points of an active cell and list those outside it, of
       * which there are so many. */
      template <typename Number>
      CAISSON_INLINE unsigned int
      update_points(const PointsView     &points,
                    const unsigned int    active,
                    const CellUpdate     &update,
                    const Material       *materials,
                    const UpdateSettings &settings,
                    UpdateSums<Number>   &sums,
                    LeavingPoints        &leaving)
      {
        const unsigned int cell   = points.active_cells[active];
        const unsigned int before = leaving.n;
        for (int block = points.first_block[cell]; block >= 0;)
          {
            const BlockHeader header = points.headers[block];
            prefetch(points, header.next, active);
            unsigned int    outside = 0, limited = 0;
            const Material &material = materials[header.material];
            with_law(material,
                     [&](auto law, const auto &parameters) CAISSON_LAMBDA {
                       outside = update_block<decltype(law), Number>(
                         points.blocks[block],
                         points.histories[block],
                         update,
                         settings,
                         material.initial_void_ratio,
                         parameters,
                         limited,
                         sums);
                     });
            const unsigned int real = (1u << header.count) - 1u;
            leaving.n_limited += __builtin_popcount(limited & real);
            for (outside &= real; outside != 0; outside &= outside - 1)
              {
                if (leaving.n < leaving.capacity)
                  leaving.points[leaving.n] = {cell,
                                               block,
                                               __builtin_ctz(outside)};
                ++leaving.n;
              }
            block = header.next;
          }
        return leaving.n - before;
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

      template <typename Number>
      void
      grid_to_points(const PointsView          &points,
                     const GridView            &grid,
                     const GridView            &moved,
                     const Material            *materials,
                     const UpdateSettings      &settings,
                     const IntegrationSettings &next,
                     const NodalFields         &fields,
                     CellMoments               *moments,
                     LeavingPoints             &leaving)
      {
        constexpr int width = Number::width;
        leaving.n = leaving.n_limited = 0;
        leaving.stress_work           = 0.;
        for (unsigned int begin = 0; begin < points.n_active_cells;
             begin += width)
          {
            const CellGroup<Number> group(points, begin);
            const CellMap<Number>   map = group.map(grid.geometry);
            CellUpdate              update[width];
            const double           *mass_rows[width];
            for (int i = 0; i < width; ++i)
              mass_rows[i] = moments[group.cell[i]].mass;
            LaneSums<Number, 8> mass;
            mass.load_lanes(mass_rows);
            for (int i = 0; i < group.n; ++i)
              prepare_cell(group.cell[i],
                           moments[group.cell[i]],
                           grid,
                           moved,
                           settings,
                           fields,
                           update[i]);
            if (settings.mean_volume_change)
              find_mean_divergence(group, map, grid.axisymmetric, update);

            constexpr int n_sums = UpdateSums<Number>::size;
            Number        of_points[n_sums][width];
            for (int i = 0; i < width; ++i)
              for (int k = 0; k < n_sums; ++k)
                of_points[k][i] = Number(0.);
            for (int i = 0; i < group.n; ++i)
              {
                const unsigned int cell = group.cell[i];
                UpdateSums<Number> own;
                own.clear();
                const unsigned int n_leaving = update_points(points,
                                                             begin + i,
                                                             update[i],
                                                             materials,
                                                             settings,
                                                             own,
                                                             leaving);
                for (int k = 0; k < n_sums; ++k)
                  of_points[k][i] = own.sum[k];
                // while they are in the cache, and if they stay as they are
                if (n_leaving == 0)
                  sum_points<Number>(
                    points, moved, materials, next, cell, moments[cell]);
              }
            Number sums[n_sums];
            for (int k = 0; k < n_sums; ++k)
              sums[k] = sum_each(of_points[k]);
            const Number in_full =
              work_in_full_cells(sums, mass.sum, map.volume(grid.axisymmetric));
            for (int i = 0; i < group.n; ++i)
              {
                leaving.stress_work += update[i].full ? in_full[i] : sums[0][i];
                points.filled_volume[group.cell[i]] = sums[3][i];
              }
          }
      }
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
