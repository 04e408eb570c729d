// SPDX-License-Identifier: LGPL-2.1-or-later
//
// From the points of each cell to its nodes.
//
// Equations (per radian; kappa = 1 axisymmetric, 0 plane strain; Sulsky, Chen
// & Schreyer 1994, doi:10.1016/0045-7825(94)90112-0):
//   m_I = sum m_p N_I,  p_I = sum m_p v_p N_I,
//   f_I = sum m_p b N_I - int (sigma . grad N_I + e_r kappa sigma_tt N_I/r) dV,
// where sigma stands for sigma + p I under a surrounding pressure p.
// The integral runs over the MPs in partly filled cells, and over 2 x 2 Gauss
// points in full ones, with the stress reconstructed from the MPs by an affine
// least-squares fit in (r, z), which is exact for a K0 state. A cell is full
// when its MPs fill at least a given share of its volume, which is smaller
// inside the soil than at its surface.
#ifndef caisson_mpm_kernels_points_to_grid_h
#define caisson_mpm_kernels_points_to_grid_h

#include <caisson_mpm/kernels/moments.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      /** What cells add to their corners, one cell in each lane. */
      template <typename Number>
      struct CellContribution
      {
        Number mass[4], momentum[2][4], force[2][4], stiffness[4];

        CAISSON_INLINE
        CellContribution(const LaneSums<Number, 17> &sums,
                         const Number               *body_force)
        {
          moments_to_corners(sums.sum, mass);
          for (int c = 0; c < 2; ++c)
            {
              moments_to_corners(sums.sum + PointSums<Number>::momentum + 4 * c,
                                 momentum[c]);
              for (int i = 0; i < 4; ++i)
                force[c][i] = mass[i] * body_force[c];
            }
        }

        CAISSON_INLINE void
        add_forces(const LaneSums<Number, 16> &sums)
        {
          Number corner[4];
          moments_to_corners(sums.sum, corner);
          for (int i = 0; i < 4; ++i)
            force[0][i] -= corner[i];
          for (int c = 0; c < 2; ++c)
            {
              gradient_moments_to_corners(sums.sum + 4 + 4 * c, corner);
              for (int i = 0; i < 4; ++i)
                force[c][i] -= corner[i];
            }
          for (int i = 0; i < 4; ++i)
            stiffness[i] = sums.sum[ForceSums<Number>::stiffness + i];
        }

        CAISSON_INLINE void
        scatter(const CellGroup<Number> &group,
                const CellNodes         *nodes_of,
                NodalSums               *nodes) const
        {
          constexpr int width = Number::width, n_sums = 8;
          static_assert(sizeof(NodalSums) == n_sums * sizeof(double));
          for (int k = 0; k < 4; ++k)
            {
              // in the order of NodalSums
              const Number all[n_sums] = {mass[k],
                                          momentum[0][k],
                                          momentum[1][k],
                                          force[0][k],
                                          force[1][k],
                                          stiffness[k],
                                          Number(0.),
                                          Number(0.)};
              for (int j = 0; j < n_sums; j += width)
                {
                  Number of_cell[width];
                  transpose(all + j, of_cell);
                  for (int i = 0; i < group.n; ++i)
                    {
                      double *const node =
                        &nodes[nodes_of[group.cell[i]].node[k]].mass + j;
                      (Number::load(node) + of_cell[i]).store(node);
                    }
                }
            }
        }
      };

      /**
       * The bound of sum_J |K_IJ| of full cells, from the gradients at the
       * center: sharp for lumped mass on a regular grid, where the floor that
       * follows from it is below the mass for any Courant number below one.
       */
      template <typename Number>
      CAISSON_INLINE void
      find_full_stiffness(const CellMap<Number> &map,
                          const double           axisymmetric,
                          const Number           modulus,
                          Number                *stiffness)
      {
        const Number inverse_height = Number(1.) / map.mean_height();
        const Number slope          = map.rise();
        const Number hoop =
          Number(.25 * axisymmetric) / (map.left + Number(.5) * map.width);
        Number total(0.);
        for (int i = 0; i < 4; ++i)
          {
            const Number half_r(i % 2 ? .5 : -.5), half_z(i / 2 ? .5 : -.5);
            const Number g_r = (half_r - half_z * slope) * map.inverse_width,
                         g_z = half_z * inverse_height;
            stiffness[i]     = sqrt(g_r * g_r + g_z * g_z + hoop * hoop);
            total += stiffness[i];
          }
        const Number scale = modulus * map.volume(axisymmetric) * total;
        for (int i = 0; i < 4; ++i)
          stiffness[i] *= scale;
      }

      /** The internal force of full cells, from the fitted stress and the
       * surrounding pressure. */
      template <typename Number>
      CAISSON_INLINE void
      integrate_full_cells(const CellMap<Number> &map,
                           const double           axisymmetric,
                           const Number          *fit,
                           const Number           surrounding_pressure,
                           ForceSums<Number>     &forces)
      {
        forces.clear();
        const Number inverse_mean_height = Number(1.) / map.mean_height();
        for (int i = 0; i < GaussPoint<Number>::n; ++i)
          {
            const GaussPoint<Number> gauss(map, axisymmetric, i);
            const Number z = map.bottom + map.bottom_slope * gauss.point.xi +
                             gauss.point.height * gauss.point.eta;
            const Number x = gauss.point.xi - Number(.5),
                         y = (z - map.center_z()) * inverse_mean_height;
            forces.add(gauss.point,
                       map.inverse_width,
                       gauss.inverse_r,
                       gauss.volume,
                       StressState<Number>{
                         evaluate_fit(fit, x, y) + surrounding_pressure,
                         evaluate_fit(fit + 3, x, y) + surrounding_pressure,
                         evaluate_fit(fit + 6, x, y) + surrounding_pressure,
                         evaluate_fit(fit + 9, x, y)});
          }
      }

      /** The sums over the points of a cell into its moments: FitSums, or
       * ForceSums for a cell that is not full. */
      template <typename InternalSums, typename Number>
      CAISSON_INLINE void
      sum_points(const PointsView          &points,
                 const CellMap<>           &map,
                 const double               axisymmetric,
                 const Material            *materials,
                 const IntegrationSettings &settings,
                 const int                  first_block,
                 CellMoments               &moments)
      {
        constexpr bool    full     = __is_same(InternalSums, FitSums<Number>);
        const double      center_z = map.center_z();
        const double      inverse_mean_height = 1. / map.mean_height();
        const Number      pressure(settings.surrounding_pressure);
        const short       material = points.headers[first_block].material;
        bool              several  = false;
        int               block    = first_block;
        PointSums<Number> sums;
        InternalSums      internal;
        sums.clear();
        internal.clear();
        do // a cell with moments has points
          {
            const BlockHeader header = points.headers[block];
            const PointBlock &b      = points.blocks[block];
            for (int lane = 0; lane < block_size; lane += Number::width)
              {
                const auto load = [lane](const double *field) {
                  return Number::load(field + lane);
                };
                const Number             r = load(b.r), z = load(b.z);
                const LocalPoint<Number> p    = map.at_position(r, z);
                const Number             mass = load(b.mass);
                sums.add(p, mass, load(b.velocity_r), load(b.velocity_z));
                const Number s[4] = {load(b.stress[0]),
                                     load(b.stress[1]),
                                     load(b.stress[2]),
                                     load(b.stress[3])};
                if constexpr (full)
                  internal.add(p.xi - Number(.5),
                               (z - Number(center_z)) *
                                 Number(inverse_mean_height),
                               mass,
                               s);
                else
                  {
                    const Number inverse_r = Number(axisymmetric) / r;
                    const Number volume    = load(b.volume);
                    internal.add(p,
                                 Number(map.inverse_width),
                                 inverse_r,
                                 volume,
                                 StressState<Number>{s[0] + pressure,
                                                     s[1] + pressure,
                                                     s[2] + pressure,
                                                     s[3]});
                    if (settings.floor_mass)
                      internal.add_stiffness(
                        p,
                        Number(map.inverse_width),
                        inverse_r,
                        volume *
                          Number(materials[header.material].p_wave_modulus));
                  }
              }
            several |= header.material != material;
            block = header.next;
          }
        while (block >= 0);
        sums.store(moments.mass);
        internal.store(moments.internal);
        moments.several_materials = several;
        moments.material          = material;
      }

      /** The sums as the cell is integrated, over Gauss points or points. */
      template <typename Number>
      void
      sum_points(const PointsView          &points,
                 const GridView            &grid,
                 const Material            *materials,
                 const IntegrationSettings &settings,
                 const unsigned int         cell,
                 CellMoments               &moments)
      {
        const CellMap<> map(grid.geometry[cell]);
        const int       first = points.first_block[cell];
        if (moments.full)
          sum_points<FitSums<Number>, Number>(points,
                                              map,
                                              grid.axisymmetric,
                                              materials,
                                              settings,
                                              first,
                                              moments);
        else
          sum_points<ForceSums<Number>, Number>(points,
                                                map,
                                                grid.axisymmetric,
                                                materials,
                                                settings,
                                                first,
                                                moments);
      }

      /** In a cell of several materials, what the body force of each adds to
       * that of the first. */
      template <typename Number>
      void
      add_other_body_forces(const PointsView  &points,
                            const GridView    &grid,
                            const Material    *materials,
                            const unsigned int cell,
                            NodalSums         *nodes)
      {
        const CellMap<> map(grid.geometry[cell]);
        const int       first     = points.first_block[cell];
        const Material &reference = materials[points.headers[first].material];
        for (int block = first; block >= 0; block = points.headers[block].next)
          {
            const PointBlock &b   = points.blocks[block];
            const Material   &own = materials[points.headers[block].material];
            PointSums<Number> sums;
            sums.clear();
            for (int lane = 0; lane < block_size; lane += Number::width)
              sums.add(map.at_position(Number::load(b.r + lane),
                                       Number::load(b.z + lane)),
                       Number::load(b.mass + lane),
                       Number(0.),
                       Number(0.));
            double moments[4], corner[4];
            for (int i = 0; i < 4; ++i)
              moments[i] = sum(sums.sum[i]);
            moments_to_corners(moments, corner);
            for (int c = 0; c < 2; ++c)
              for (int i = 0; i < 4; ++i)
                nodes[grid.nodes[cell].node[i]].force[c] +=
                  corner[i] * (own.body_force[c] - reference.body_force[c]);
          }
      }

      /** The largest modulus among the materials of a cell. */
      CAISSON_INLINE double
      largest_modulus(const PointsView  &points,
                      const Material    *materials,
                      const unsigned int cell,
                      const CellMoments &moments)
      {
        double result = materials[moments.material].p_wave_modulus;
        if (moments.several_materials)
          for (int block = points.first_block[cell]; block >= 0;
               block     = points.headers[block].next)
            {
                  const double own =
                    materials[points.headers[block].material].p_wave_modulus;
                  result = own > result ? own : result;
            }
        return result;
      }

      /**
       * Whether a cell takes Gauss points. Inside the soil the number of points
       * in a cell scatters while the mesh moves, and a cell with fewer of them
       * is no less full; at a free surface it is.
       */
      CAISSON_INLINE bool
      is_full(const PointsView          &points,
              const GridView            &grid,
              const IntegrationSettings &settings,
              const unsigned int         cell,
              const double               filled_fraction)
      {
        if (filled_fraction >= settings.full_at_surface)
          return true;
        if (filled_fraction < settings.full_inside)
          return false;
        for (int face = 0; face < 4; ++face)
          {
            const int neighbor = grid.neighbors[4 * cell + face];
            if (neighbor >= 0 && points.first_block[neighbor] < 0)
              return false;
          }
        return true;
      }

      /** Renew the moments of the cells of a group where they are out of date.
       * */
      template <typename Number>
      CAISSON_INLINE void
      renew_moments(const CellGroup<Number>   &group,
                    const CellMap<Number>     &map,
                    const PointsView          &points,
                    const GridView            &grid,
                    const Material            *materials,
                    const IntegrationSettings &settings,
                    CellMoments               *moments)
      {
        const Number fraction = group.lanes([&](const unsigned int c) {
          return points.filled_volume[c];
        }) / map.volume(grid.axisymmetric);
        for (int i = 0; i < group.n; ++i)
          {
            const unsigned int cell = group.cell[i];
            const bool         full =
              is_full(points, grid, settings, cell, fraction[i]);
            if (!points.changed[cell] && full == moments[cell].full)
              continue;
            moments[cell].full = full;
            sum_points<Number>(
              points, grid, materials, settings, cell, moments[cell]);
            points.changed[cell] = false;
          }
      }

      template <typename Number>
      void
      points_to_grid(const PointsView          &points,
                     const GridView            &grid,
                     const Material            *materials,
                     const IntegrationSettings &settings,
                     NodalSums                 *nodes,
                     CellMoments               *moments)
      {
        constexpr int width = Number::width;
        for (unsigned int begin = 0; begin < points.n_active_cells;
             begin += width)
          {
            const CellGroup<Number> group(points, begin);
            const CellMap<Number>   map = group.map(grid.geometry);
            renew_moments(
              group, map, points, grid, materials, settings, moments);

            double *rows[width], *internal_rows[width];
            for (int i = 0; i < width; ++i)
              {
                rows[i]          = moments[group.cell[i]].mass;
                internal_rows[i] = moments[group.cell[i]].internal;
              }
            LaneSums<Number, 17> sums;
            LaneSums<Number, 16> internal;
            sums.load_lanes(rows);
            internal.load_lanes(internal_rows);
            const Number body_force[2] = {
              group.lanes([&](const unsigned int c) {
                return materials[moments[c].material].body_force[0];
              }),
              group.lanes([&](const unsigned int c) {
                return materials[moments[c].material].body_force[1];
              })};
            CellContribution<Number> contribution(sums, body_force);
            const auto full = group.lanes([&](const unsigned int c) {
              return moments[c].full ? 1. : 0.;
            }) > Number(0.);
            if (any(full))
              {
                LaneSums<Number, 16> fit;
                fit.clear();
                fit_stress(
                  map, sums.sum, internal.sum, settings.mean_pressure, fit.sum);
                fit.store_lanes(group.n, internal_rows);
                ForceSums<Number> forces;
                integrate_full_cells(map,
                                     grid.axisymmetric,
                                     fit.sum,
                                     Number(settings.surrounding_pressure),
                                     forces);
                if (settings.floor_mass)
                  find_full_stiffness(map,
                                      grid.axisymmetric,
                                      group.lanes([&](const unsigned int c) {
                                        return largest_modulus(points,
                                                               materials,
                                                               c,
                                                               moments[c]);
                                      }),
                                      forces.sum + forces.stiffness);
                for (int k = 0; k < forces.size; ++k)
                  internal.sum[k] =
                    select(full, forces.sum[k], internal.sum[k]);
              }
            contribution.add_forces(internal);
            contribution.scatter(group, grid.nodes, nodes);
            for (int i = 0; i < group.n; ++i)
              if (moments[group.cell[i]].several_materials)
                add_other_body_forces<Number>(
                  points, grid, materials, group.cell[i], nodes);
          }
      }

      // -------------------------------------------------- mass matrix

      /** out += M x; both components of a node are the two lanes. */
      inline void
      apply_mass(const PointsView  &points,
                 const GridView    &grid,
                 const CellMoments *moments,
                 const NodalVector *x,
                 NodalVector       *out)
      {
        using Pair = Lanes<2>;
        for (unsigned int i = 0; i < points.n_active_cells; ++i)
          {
            const unsigned int        cell = points.active_cells[i];
            const unsigned int *const node = grid.nodes[cell].node;
            const double *const       m    = moments[cell].mass;
            const auto                load = [&](const int k) {
              return Pair::load(x[node[k]].value);
            };
            const Pair v0 = load(0), v1 = load(1), v2 = load(2), v3 = load(3);
            const Pair c1 = v1 - v0, c2 = v2 - v0, c3 = v3 - v2 - c1;
            const auto row = [&](int a, int b, int c, int d) {
              return Pair(m[a]) * v0 + Pair(m[b]) * c1 + Pair(m[c]) * c2 +
                     Pair(m[d]) * c3;
            };
            const Pair t0 = row(0, 1, 2, 3), t1 = row(1, 4, 3, 6),
                       t2 = row(2, 3, 5, 7), t3 = row(3, 6, 7, 8);
            const auto add = [&](const int k, const Pair y) {
              (Pair::load(out[node[k]].value) + y).store(out[node[k]].value);
            };
            add(0, t0 - t1 - t2 + t3);
            add(1, t1 - t3);
            add(2, t2 - t3);
            add(3, t3);
          }
      }
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
