// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Point to grid and grid to point, one cell at a time.
//
// Equations (per radian; kappa = 1 axisymmetric, 0 plane strain; Sulsky, Chen
// & Schreyer 1994, doi:10.1016/0045-7825(94)90112-0):
//   m_I = sum m_p N_I,  p_I = sum m_p v_p N_I,
//   f_I = sum m_p b N_I - int (sigma . grad N_I + e_r kappa sigma_tt N_I/r) dV.
// The integral runs over the MPs in partly filled cells, and over 2 x 2 Gauss
// points in full ones, with the stress reconstructed from the MPs by an affine
// least-squares fit in (r, z), which is exact for a K0 state. A cell is full
// when its MPs fill at least a given share of its volume, which is smaller
// inside the soil than at its surface.
//
// Stress rate: Jaumann with the in-plane spin, strain increment with the mean
// volume change of the cell (B-bar).
#ifndef caisson_mpm_kernels_transfer_h
#define caisson_mpm_kernels_transfer_h

#include <caisson_mpm/kernels/cell_map.h>
#include <caisson_mpm/kernels/laws.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      // -------------------------------------------------- accumulators

      /** Moments of the MPs of one cell and one material. */
      template <typename Number>
      struct PointSums
      {
        // mass: 1, xi, eta, xi eta, xi2, eta2, xi2 eta, xi eta2, xi2 eta2;
        // then momentum r and z: 1, xi, eta, xi eta
        static constexpr int momentum = 9;
        static constexpr int size     = 24;
        Number               sum[size];

        CAISSON_INLINE void
        clear()
        {
          for (int i = 0; i < size; ++i)
            sum[i] = Number(0.);
        }

        CAISSON_INLINE void
        add(const LocalPoint<Number> &p,
            const Number              mass,
            const Number              velocity_r,
            const Number              velocity_z)
        {
          const Number m_xi = mass * p.xi, m_eta = mass * p.eta;
          const Number m_xi_eta = m_xi * p.eta;
          sum[0] += mass;
          sum[1] += m_xi;
          sum[2] += m_eta;
          sum[3] += m_xi_eta;
          sum[4] += m_xi * p.xi;
          sum[5] += m_eta * p.eta;
          sum[6] += m_xi_eta * p.xi;
          sum[7] += m_xi_eta * p.eta;
          sum[8] += m_xi_eta * p.xi * p.eta;
          Number *const q = sum + momentum;
          q[0] += mass * velocity_r;
          q[1] += m_xi * velocity_r;
          q[2] += m_eta * velocity_r;
          q[3] += m_xi_eta * velocity_r;
          q[4] += mass * velocity_z;
          q[5] += m_xi * velocity_z;
          q[6] += m_eta * velocity_z;
          q[7] += m_xi_eta * velocity_z;
        }
      };

      /** Moments of the internal force. */
      template <typename Number>
      struct ForceSums
      {
        // hoop: 1, xi, eta, xi eta; r: a, a eta, b, b xi; z: likewise;
        // then the four corners' stiffness
        static constexpr int stiffness = 12;
        static constexpr int size      = 16;
        Number               sum[size];

        CAISSON_INLINE void
        clear()
        {
          for (int i = 0; i < size; ++i)
            sum[i] = Number(0.);
        }

        CAISSON_INLINE void
        add(const LocalPoint<Number>  &p,
            const double               inverse_width,
            const Number               inverse_r, // 0 in plane strain
            const Number               volume,
            const StressState<Number> &stress)
        {
          const Number hoop = volume * stress.tt * inverse_r;
          sum[0] += hoop;
          sum[1] += hoop * p.xi;
          sum[2] += hoop * p.eta;
          sum[3] += hoop * p.xi * p.eta;
          add_component(
            sum + 4, p, inverse_width, volume, stress.rr, stress.rz);
          add_component(
            sum + 8, p, inverse_width, volume, stress.rz, stress.zz);
        }

        /**
         * A bound of the row sums of the stiffness, sum_J |K_IJ|, from the
         * 1-norms of the gradients (see NodalSums::stiffness).
         */
        CAISSON_INLINE void
        add_stiffness(const LocalPoint<Number> &p,
                      const double              inverse_width,
                      const Number              inverse_r,
                      const Number              volume_times_modulus)
        {
          const Number one(1.);
          const Number x[2] = {one - p.xi, p.xi}, y[2] = {one - p.eta, p.eta};
          Number       norm[4], total(0.);
          for (int i = 0; i < 4; ++i)
            {
              const Number d_dxi =
                Number(i % 2 ? inverse_width : -inverse_width) * y[i / 2];
              const Number d_deta = (i / 2 ? x[i % 2] : -x[i % 2]);
              norm[i] = abs(d_dxi - d_deta * p.slope * Number(inverse_width)) +
                        abs(d_deta * p.inverse_height) +
                        x[i % 2] * y[i / 2] * inverse_r;
              total += norm[i];
            }
          for (int i = 0; i < 4; ++i)
            sum[stiffness + i] += volume_times_modulus * norm[i] * total;
        }

      private:
        static CAISSON_INLINE void
        add_component(Number                   *s,
                      const LocalPoint<Number> &p,
                      const double              inverse_width,
                      const Number              volume,
                      const Number              stress_r,
                      const Number              stress_z)
        {
          const Number a = volume * stress_r * Number(inverse_width);
          const Number b = volume * stress_z * p.inverse_height - a * p.slope;
          s[0] += a;
          s[1] += a * p.eta;
          s[2] += b;
          s[3] += b * p.xi;
        }
      };

      /** Moments of the stress for the affine fit in x = xi - 1/2 and
       * y = (z - z_center) / mean height, weighted by mass. */
      template <typename Number>
      struct FitSums
      {
        // m x, m y, m x2, m x y, m y2; then per component s, s x, s y
        static constexpr int stress = 5;
        static constexpr int size   = 24;
        Number               sum[size];

        CAISSON_INLINE void
        clear()
        {
          for (int i = 0; i < size; ++i)
            sum[i] = Number(0.);
        }

        CAISSON_INLINE void
        add(const Number x, const Number y, const Number mass, const Number *s)
        {
          const Number m_x = mass * x, m_y = mass * y;
          sum[0] += m_x;
          sum[1] += m_y;
          sum[2] += m_x * x;
          sum[3] += m_x * y;
          sum[4] += m_y * y;
          for (int c = 0; c < 4; ++c)
            {
              sum[stress + 3 * c] += mass * s[c];
              sum[stress + 3 * c + 1] += m_x * s[c];
              sum[stress + 3 * c + 2] += m_y * s[c];
            }
        }
      };

      /** The affine function with the coefficients fit[0 .. 2]. */
      template <typename Number>
      CAISSON_INLINE Number
      evaluate_fit(const double *fit, const Number x, const Number y)
      {
        return Number(fit[0]) + Number(fit[1]) * x + Number(fit[2]) * y;
      }

      /**
       * The affine stress of a cell, into fit[12] (see CellMoments): the
       * least-squares fit, or the mean where the points do not span the cell.
       * With @p mean_pressure the mean stress keeps its mean only.
       */
      CAISSON_INLINE void
      fit_stress(const double  mass,
                 const double *s,
                 const bool    mean_pressure,
                 double       *fit)
      {
        const double x = s[0] / mass, y = s[1] / mass;
        const double xx = s[2] - mass * x * x, xy = s[3] - mass * x * y,
                     yy          = s[4] - mass * y * y;
        const double determinant = xx * yy - xy * xy;
        const bool   spans       = determinant > 1e-5 * mass * mass;
        const double inverse     = spans ? 1. / determinant : 0.;
        double       slope[2][4], trace[2] = {0., 0.};
        for (int c = 0; c < 4; ++c)
          {
            const double *const t  = s + FitSums<Lanes<1>>::stress + 3 * c;
            const double        sx = t[1] - t[0] * x, sy = t[2] - t[0] * y;
            slope[0][c] = (yy * sx - xy * sy) * inverse;
            slope[1][c] = (xx * sy - xy * sx) * inverse;
            for (int d = 0; d < 2 && c < 3; ++d)
              trace[d] += slope[d][c];
          }
        for (int c = 0; c < 4; ++c)
          {
            for (int d = 0; d < 2; ++d)
              fit[3 * c + 1 + d] =
                slope[d][c] - (mean_pressure && c < 3 ? trace[d] / 3. : 0.);
            const double mean = s[FitSums<Lanes<1>>::stress + 3 * c] / mass;
            fit[3 * c]        = mean - fit[3 * c + 1] * x - fit[3 * c + 2] * y;
          }
      }

      /** The 2 x 2 Gauss points, padded to eight lanes of weight 0. */
      struct GaussPoints
      {
        static constexpr double a = .21132486540518712, b = .78867513459481288;
        static constexpr double xi[8]     = {a, b, a, b, .5, .5, .5, .5};
        static constexpr double eta[8]    = {a, a, b, b, .5, .5, .5, .5};
        static constexpr double weight[8] = {.25, .25, .25, .25, 0, 0, 0, 0};
        static constexpr int    n         = 4;
      };

      /** A group of Gauss points of a cell. */
      template <typename Number>
      struct GaussLanes
      {
        LocalPoint<Number> point;
        Number             inverse_r; // 0 in plane strain
        Number             volume;

        CAISSON_INLINE
        GaussLanes(const CellMap &map,
                   const double   axisymmetric,
                   const int      lane)
        {
          point = map.at_reference(Number::load(GaussPoints::xi + lane),
                                   Number::load(GaussPoints::eta + lane));
          const Number r = Number(map.left) + Number(map.width) * point.xi;
          inverse_r      = Number(axisymmetric) / r;
          volume         = Number::load(GaussPoints::weight + lane) *
                   Number(map.width) * point.height *
                   (Number(axisymmetric) * r + Number(1. - axisymmetric));
        }
      };

      // -------------------------------------------------- points to grid

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

      /** The internal force of a full cell, from the fitted stress. */
      template <typename Number>
      CAISSON_INLINE void
      integrate_full_cell(const CellMap    &map,
                          const double      axisymmetric,
                          const double     *fit,
                          CellContribution &contribution)
      {
        ForceSums<Number> forces;
        forces.clear();
        const double inverse_mean_height = 1. / map.mean_height();
        for (int lane = 0; lane < GaussPoints::n; lane += Number::width)
          {
            const GaussLanes<Number> gauss(map, axisymmetric, lane);
            const Number             z = Number(map.bottom) +
                             Number(map.bottom_slope) * gauss.point.xi +
                             gauss.point.height * gauss.point.eta;
            const Number x = gauss.point.xi - Number(.5),
                         y = (z - Number(map.center_z())) *
                             Number(inverse_mean_height);
            forces.add(gauss.point,
                       map.inverse_width,
                       gauss.inverse_r,
                       gauss.volume,
                       StressState<Number>{evaluate_fit(fit, x, y),
                                           evaluate_fit(fit + 3, x, y),
                                           evaluate_fit(fit + 6, x, y),
                                           evaluate_fit(fit + 9, x, y)});
          }
        double sums[ForceSums<Number>::size];
        sum_lanes<ForceSums<Number>::size>(forces.sum, sums);
        contribution.add_forces(sums);
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
                                   StressState<Number>{s[0], s[1], s[2], s[3]});
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
                double fit[24] = {};
                for (int block = first; block >= 0;)
                  block = add_run<Number, true>(points,
                                                materials,
                                                settings,
                                                map,
                                                grid.axisymmetric,
                                                block,
                                                contribution,
                                                fit);
                fit_stress(contribution.mass[0],
                           fit,
                           settings.mean_pressure,
                           moments[i].fit);
                integrate_full_cell<Number>(map,
                                            grid.axisymmetric,
                                            moments[i].fit,
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

      // -------------------------------------------------- grid to points

      /** Coefficients of both components of a nodal field in one cell. */
      struct CellField
      {
        double r[4], z[4];

        CAISSON_INLINE
        CellField(const NodalVector *field, const CellNodes &cell)
        {
          double vr[4], vz[4];
          for (int i = 0; i < 4; ++i)
            {
              vr[i] = field[cell.node[i]].value[0];
              vz[i] = field[cell.node[i]].value[1];
            }
          coefficients(vr, r);
          coefficients(vz, z);
        }
      };

      /** The velocity gradient at a point, L_tt included. */
      template <typename Number>
      struct VelocityGradient
      {
        Number rr, rz, zr, zz, tt;

        CAISSON_INLINE
        VelocityGradient(const CellField          &v,
                         const LocalPoint<Number> &p,
                         const double              inverse_width,
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

      /** The mean of div v over the cell's volume, by Gauss integration. */
      template <typename Number>
      CAISSON_INLINE double
      mean_divergence(const CellMap   &map,
                      const double     axisymmetric,
                      const CellField &v)
      {
        Number change(0.), volume(0.);
        for (int lane = 0; lane < GaussPoints::n; lane += Number::width)
          {
            const GaussLanes<Number>       gauss(map, axisymmetric, lane);
            const VelocityGradient<Number> L(v,
                                             gauss.point,
                                             map.inverse_width,
                                             gauss.inverse_r);
            change += gauss.volume * L.trace();
            volume += gauss.volume;
          }
        return sum(change) / sum(volume);
      }

      /** What all points of a cell share. */
      struct CellUpdate
      {
        CellMap       map, moved;
        CellField     advection, transfer, strain;
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

      /** New stress and volume of the points in the given lanes. */
      template <typename Law, typename Number>
      CAISSON_INLINE void
      update_stress(PointBlock                     &b,
                    const int                       lane,
                    const LocalPoint<Number>       &p,
                    const CellUpdate               &cell,
                    const UpdateSettings           &settings,
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
        Number              deviatoric = load(b.plastic_deviatoric),
               volumetric              = load(b.plastic_volumetric);
        Law::update(stress, strain, deviatoric, volumetric, parameters);
        stress.rr.store(b.stress[0] + lane);
        stress.zz.store(b.stress[1] + lane);
        stress.tt.store(b.stress[2] + lane);
        stress.rz.store(b.stress[3] + lane);
        deviatoric.store(b.plastic_deviatoric + lane);
        volumetric.store(b.plastic_volumetric + lane);
        (load(b.volume) * (Number(1.) + volume_change)).store(b.volume + lane);
      }

      /** Update one block; returns its lanes outside the moved cell. */
      template <typename Law, typename Number>
      CAISSON_INLINE unsigned int
      update_block(PointBlock                     &b,
                   const CellUpdate               &cell,
                   const UpdateSettings           &settings,
                   const typename Law::Parameters &parameters,
                   unsigned int                   &limited)
      {
        unsigned int outside = 0;
        limited              = 0;
        const Number dt(settings.time_step), zero(0.), one(1.);
        for (int lane = 0; lane < block_size; lane += Number::width)
          {
            Number r = Number::load(b.r + lane), z = Number::load(b.z + lane);
            const LocalPoint<Number> p = cell.map.at_position(r, z);
            update_stress<Law>(b, lane, p, cell, settings, parameters);

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
            const LocalPoint<Number> q = cell.moved.at_position(r, z);
            // written so that a NaN counts as outside
            outside |= to_integer(!((q.xi >= zero) & (q.xi <= one) &
                                    (q.eta >= zero) & (q.eta <= one)))
                       << lane;
          }
        return outside;
      }

      template <typename Number>
      CAISSON_INLINE CellUpdate
      prepare_cell(const unsigned int    cell,
                   const CellMoments    &moments,
                   const GridView       &grid,
                   const GridView       &moved,
                   const UpdateSettings &settings,
                   const NodalFields    &fields)
      {
        const CellNodes &nodes = grid.nodes[cell];
        CellUpdate       update{CellMap(grid.geometry[cell]),
                          CellMap(moved.geometry[cell]),
                          CellField(fields.advection, nodes),
                          CellField(fields.transfer, nodes),
                          CellField(fields.strain, nodes),
                          grid.axisymmetric,
                          0.,
                          0.,
                          nullptr,
                          0.};
        if (settings.mean_volume_change)
          update.mean_divergence = mean_divergence<Number>(update.map,
                                                           grid.axisymmetric,
                                                           update.strain);
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
        return update;
      }

      template <typename Number>
      void
      grid_to_points(const PointsView     &points,
                     const GridView       &grid,
                     const GridView       &moved,
                     const Material       *materials,
                     const CellMoments    *moments,
                     const UpdateSettings &settings,
                     const NodalFields    &fields,
                     LeavingPoints        &leaving)
      {
        leaving.n = leaving.n_limited = 0;
        for (unsigned int i = 0; i < points.n_active_cells; ++i)
          {
            const unsigned int cell   = points.active_cells[i];
            const CellUpdate   update = prepare_cell<Number>(
              cell, moments[i], grid, moved, settings, fields);
            for (int block = points.first_block[cell]; block >= 0;
                 block     = points.headers[block].next)
              {
                    const BlockHeader header  = points.headers[block];
                    unsigned int      outside = 0, limited = 0;
                    with_law(materials[header.material],
                         [&](auto law, const auto &parameters) CAISSON_LAMBDA {
                           outside = update_block<decltype(law), Number>(
                             points.blocks[block],
                             update,
                             settings,
                             parameters,
                             limited);
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
              }
          }
      }
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
