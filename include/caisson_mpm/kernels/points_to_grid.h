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
      /** All that one cell adds to its four corners. */
      struct CellContribution
      {
        double mass[9]        = {};
        double momentum[2][4] = {};
        double force[2][4]    = {};
        double stiffness[4]   = {};

        CAISSON_INLINE void
        add_points(const double *sums, const double *body_force)
        {
          double corner[4];
          for (int i = 0; i < 9; ++i)
            mass[i] += sums[i];
          moments_to_corners(sums, corner);
          for (int c = 0; c < 2; ++c)
            for (int i = 0; i < 4; ++i)
              force[c][i] += corner[i] * body_force[c];
          for (int c = 0; c < 2; ++c)
            {
              moments_to_corners(sums + 9 + 4 * c, corner);
              for (int i = 0; i < 4; ++i)
                momentum[c][i] += corner[i];
            }
        }

        CAISSON_INLINE void
        add_forces(const double *sums)
        {
          double corner[4];
          moments_to_corners(sums, corner);
          for (int i = 0; i < 4; ++i)
            force[0][i] -= corner[i];
          for (int c = 0; c < 2; ++c)
            {
              gradient_moments_to_corners(sums + 4 + 4 * c, corner);
              for (int i = 0; i < 4; ++i)
                force[c][i] -= corner[i];
            }
          for (int i = 0; i < 4; ++i)
            stiffness[i] += sums[ForceSums<Lanes<1>>::stiffness + i];
        }

        CAISSON_INLINE void
        scatter(const CellNodes &cell, NodalSums *nodes) const
        {
          double corner_mass[4];
          moments_to_corners(mass, corner_mass);
          for (int i = 0; i < 4; ++i)
            {
              NodalSums &node = nodes[cell.node[i]];
              node.mass += corner_mass[i];
              for (int c = 0; c < 2; ++c)
                {
                  node.momentum[c] += momentum[c][i];
                  node.force[c] += force[c][i];
                }
              node.stiffness += stiffness[i];
            }
        }
      };

      /**
       * The bound of sum_J |K_IJ| of a full cell, from the gradients at its
       * center: sharp for lumped mass on a regular grid, where the floor that
       * follows from it is below the mass for any Courant number below one.
       */
      inline void
      add_full_stiffness(const CellMap &map,
                         const double   axisymmetric,
                         const double   modulus,
                         double        *stiffness)
      {
        const double inverse_height = 1. / map.mean_height();
        const double slope          = map.rise();
        const double hoop = .25 * axisymmetric / (map.left + .5 * map.width);
        double       norm[4], total = 0.;
        for (int i = 0; i < 4; ++i)
          {
            const double half_r = i % 2 ? .5 : -.5, half_z = i / 2 ? .5 : -.5;
            const double g_r = (half_r - half_z * slope) * map.inverse_width,
                         g_z = half_z * inverse_height;
            norm[i] = __builtin_sqrt(g_r * g_r + g_z * g_z + hoop * hoop);
            total += norm[i];
          }
        const double scale = modulus * map.volume(axisymmetric) * total;
        for (int i = 0; i < 4; ++i)
          stiffness[i] += scale * norm[i];
      }

      /**
       * The internal force of a full cell, from the fitted stress and the
       * surrounding pressure, and the stiffness bound for the given modulus
       * where that is not 0.
       */
      template <typename Number>
      CAISSON_INLINE void
      integrate_full_cell(const CellMap    &map,
                          const double      axisymmetric,
                          const double     *fit,
                          const double      modulus,
                          const double      surrounding_pressure,
                          CellContribution &contribution)
      {
        ForceSums<Number> forces;
        forces.clear();
        const double inverse_mean_height = 1. / map.mean_height();
        const Number pressure(surrounding_pressure);
        for (int lane = 0; lane < GaussPoints::n; lane += Number::width)
          {
            const GaussLanes<Number> gauss(map, axisymmetric, lane);
            const Number             z = Number(map.bottom) +
                             Number(map.bottom_slope) * gauss.point.xi +
                             gauss.point.height * gauss.point.eta;
            const Number x = gauss.point.xi - Number(.5),
                         y = (z - Number(map.center_z())) *
                             Number(inverse_mean_height);
            forces.add(
              gauss.point,
              map.inverse_width,
              gauss.inverse_r,
              gauss.volume,
              StressState<Number>{evaluate_fit(fit, x, y) + pressure,
                                  evaluate_fit(fit + 3, x, y) + pressure,
                                  evaluate_fit(fit + 6, x, y) + pressure,
                                  evaluate_fit(fit + 9, x, y)});
          }
        double sums[ForceSums<Number>::size];
        sum_lanes<ForceSums<Number>::size>(forces.sum, sums);
        contribution.add_forces(sums);
        if (modulus > 0.)
          add_full_stiffness(map,
                             axisymmetric,
                             modulus,
                             contribution.stiffness);
      }

      /** The sums of one run of blocks (same cell, same material). */
      template <typename Number, bool full>
      CAISSON_INLINE int
      add_run(const PointsView          &points,
              const Material            *materials,
              const IntegrationSettings &settings,
              const CellMap             &map,
              const double               axisymmetric,
              int                        block,
              CellContribution          &contribution,
              double                    *fit_sums)
      {
        PointSums<Number> point_sums;
        ForceSums<Number> force_sums;
        FitSums<Number>   fit;
        point_sums.clear();
        force_sums.clear();
        fit.clear();
        const int       material_id         = points.headers[block].material;
        const Material &material            = materials[material_id];
        const double    center_z            = map.center_z();
        const double    inverse_mean_height = 1. / map.mean_height();
        const Number    pressure(settings.surrounding_pressure);
        for (; block >= 0 && points.headers[block].material == material_id;
             block = points.headers[block].next)
          {
            const PointBlock &b = points.blocks[block];
            for (int lane = 0; lane < block_size; lane += Number::width)
              {
                const auto load = [lane](const double *field) {
                  return Number::load(field + lane);
                };
                const Number             r = load(b.r), z = load(b.z);
                const LocalPoint<Number> p    = map.at_position(r, z);
                const Number             mass = load(b.mass);
                point_sums.add(p, mass, load(b.velocity_r), load(b.velocity_z));
                const Number s[4] = {load(b.stress[0]),
                                     load(b.stress[1]),
                                     load(b.stress[2]),
                                     load(b.stress[3])};
                if constexpr (full)
                  fit.add(p.xi - Number(.5),
                          (z - Number(center_z)) * Number(inverse_mean_height),
                          mass,
                          s);
                else
                  {
                    const Number inverse_r = Number(axisymmetric) / r;
                    const Number volume    = load(b.volume);
                    force_sums.add(p,
                                   map.inverse_width,
                                   inverse_r,
                                   volume,
                                   StressState<Number>{s[0] + pressure,
                                                       s[1] + pressure,
                                                       s[2] + pressure,
                                                       s[3]});
                    if (settings.floor_mass)
                      force_sums.add_stiffness(
                        p,
                        map.inverse_width,
                        inverse_r,
                        volume * Number(material.p_wave_modulus));
                  }
              }
          }
        double sums[24];
        sum_lanes<24>(point_sums.sum, sums);
        contribution.add_points(sums, material.body_force);
        if constexpr (full)
          {
            sum_lanes<24>(fit.sum, sums);
            for (int i = 0; i < 24; ++i)
              fit_sums[i] += sums[i];
          }
        else
          {
            sum_lanes<ForceSums<Number>::size>(force_sums.sum, sums);
            contribution.add_forces(sums);
          }
        return block;
      }

      template <typename Number>
      CAISSON_INLINE double
      volume_of_points(const PointsView &points, int block)
      {
        Number volume(0.);
        for (; block >= 0; block = points.headers[block].next)
          for (int lane = 0; lane < block_size; lane += Number::width)
            volume += Number::load(points.blocks[block].volume + lane);
        return sum(volume);
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

      template <typename Number>
      void
      points_to_grid(const PointsView          &points,
                     const GridView            &grid,
                     const Material            *materials,
                     const IntegrationSettings &settings,
                     NodalSums                 *nodes,
                     CellMoments               *moments)
      {
        for (unsigned int i = 0; i < points.n_active_cells; ++i)
          {
            const unsigned int cell  = points.active_cells[i];
            const int          first = points.first_block[cell];
            const CellMap      map(grid.geometry[cell]);
            CellContribution   contribution;
            const bool         full = moments[i].full =
              is_full(points,
                      grid,
                      settings,
                      cell,
                      volume_of_points<Number>(points, first) /
                        map.volume(grid.axisymmetric));
            if (full)
              {
                double fit[24] = {}, modulus = 0.;
                for (int block = first; block >= 0;)
                  {
                    const double own =
                      materials[points.headers[block].material].p_wave_modulus;
                    modulus = own > modulus ? own : modulus;
                    block   = add_run<Number, true>(points,
                                                  materials,
                                                  settings,
                                                  map,
                                                  grid.axisymmetric,
                                                  block,
                                                  contribution,
                                                  fit);
                  }
                fit_stress(contribution.mass[0],
                           fit,
                           map.rise(),
                           settings.mean_pressure,
                           moments[i].fit);
                integrate_full_cell<Number>(map,
                                            grid.axisymmetric,
                                            moments[i].fit,
                                            settings.floor_mass ? modulus : 0.,
                                            settings.surrounding_pressure,
                                            contribution);
              }
            else
              for (int block = first; block >= 0;)
                block = add_run<Number, false>(points,
                                               materials,
                                               settings,
                                               map,
                                               grid.axisymmetric,
                                               block,
                                               contribution,
                                               nullptr);
            contribution.scatter(grid.nodes[cell], nodes);
            for (int k = 0; k < 9; ++k)
              moments[i].mass[k] = contribution.mass[k];
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
            const unsigned int *const node =
              grid.nodes[points.active_cells[i]].node;
            const double *const m    = moments[i].mass;
            const auto          load = [&](const int k) {
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
