// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The sums over the points of a cell that the transfer needs: moments of mass,
// momentum and force, and the affine fit of the stress with its Gauss points.
//
// Points lie in the lanes while the sums are made, cells after that: what
// follows from the sums is computed for as many cells at once as there are
// lanes.
#ifndef caisson_mpm_kernels_moments_h
#define caisson_mpm_kernels_moments_h

#include <caisson_mpm/kernels/cell_map.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/kernels/stress_state.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    template <typename Number>
    [[gnu::always_inline]] inline double
    sum_of_lanes(const Number x)
    {
      return sum(x);
    }

    /** n sums, over points lane by lane, or of one cell in each lane. */
    template <typename Number, int n>
    struct LaneSums
    {
      static constexpr int size = n;
      Number               sum[n];

      [[gnu::always_inline]] inline void
      clear()
      {
        for (int i = 0; i < n; ++i)
          sum[i] = Number(0.);
      }

      /** The sums over all lanes, into out[n]. */
      [[gnu::always_inline]] inline void
      store(double *out) const
      {
        constexpr int width = Number::width;
        for (int i = 0; i + width <= n; i += width)
          sum_each(sum + i).store(out + i);
        for (int i = n - n % width; i < n; ++i)
          out[i] = sum_of_lanes(sum[i]);
      }

      /** Lane i into row i of the first @p n_rows, each n numbers. */
      [[gnu::always_inline]] inline void
      store_lanes(const int n_rows, double *const *rows) const
      {
        constexpr int width = Number::width;
        static_assert(n % width == 0);
        for (int i = 0; i < n; i += width)
          {
            Number out[width];
            transpose(sum + i, out);
            for (int k = 0; k < n_rows; ++k)
              out[k].store(rows[k] + i);
          }
      }

      /** Row i of @p rows [width], each n numbers, into lane i. */
      [[gnu::always_inline]] inline void
      load_lanes(const double *const *rows)
      {
        constexpr int width = Number::width;
        for (int i = 0; i + width <= n; i += width)
          {
            Number in[width];
            for (int k = 0; k < width; ++k)
              in[k] = Number::load(rows[k] + i);
            transpose(in, sum + i);
          }
        for (int i = n - n % width; i < n; ++i)
          sum[i] = make_lanes<Number>([&](const int k) { return rows[k][i]; });
      }
    };

    /** Goes through the blocks of all active cells, some blocks ahead of the
     * kernel, and asks for them: they need not lie side by side. */
    class BlocksAhead
    {
    public:
      [[gnu::always_inline]] inline explicit BlocksAhead(
        const PointsView &points)
        : points(points)
      {
        constexpr int n_ahead = 8;
        enter_cell();
        for (int i = 0; i < n_ahead; ++i)
          advance();
      }

      /** Ask for the next block: to be called once per block. */
      [[gnu::always_inline]] inline void
      advance()
      {
        if (block < 0)
          return;
        constexpr int       n_fields = sizeof(PointBlock) / sizeof(double[8]);
        const double *const fields   = points.blocks[block].r;
        __builtin_prefetch(&points.headers[block]);
        for (int i = 0; i < n_fields; ++i)
          __builtin_prefetch(fields + i * block_size);
        block = points.next[block];
        if (block < 0)
          {
            ++active;
            enter_cell();
          }
      }

    private:
      [[gnu::always_inline]] inline void
      enter_cell()
      {
        if (active < points.n_active_cells)
          block = points.first_block[points.active_cells[active]];
      }

      const PointsView &points;
      unsigned int      active = 0;
      int               block  = -1; // the next one; -1: none
    };

    /** Consecutive active cells, one in each lane; lanes beyond the end
     * repeat the last one. */
    template <typename Number>
    struct CellGroup
    {
      int          n; // cells
      unsigned int cell[Number::width];

      [[gnu::always_inline]] inline CellGroup(const PointsView  &points,
                                              const unsigned int begin)
      {
        const unsigned int left = points.n_active_cells - begin;
        n = left < Number::width ? static_cast<int>(left) : Number::width;
        for (int i = 0; i < Number::width; ++i)
          cell[i] = points.active_cells[begin + (i < n ? i : n - 1)];
      }

      /** Lane i: value(number of its cell). */
      template <typename Value>
      [[gnu::always_inline]] inline Number
      lanes(const Value &value) const
      {
        return make_lanes<Number>([&](const int i) { return value(cell[i]); });
      }

      [[gnu::always_inline]] inline CellMap<Number>
      map(const CellGeometry *geometry) const
      {
        const double *rows[Number::width];
        for (int i = 0; i < Number::width; ++i)
          rows[i] = &geometry[cell[i]].left;
        LaneSums<Number, 8> g; // in the order of CellGeometry
        g.load_lanes(rows);
        CellMap<Number> m;
        m.left          = g.sum[0];
        m.width         = g.sum[1];
        m.bottom        = g.sum[2];
        m.bottom_slope  = g.sum[3] - g.sum[2];
        m.height        = g.sum[4];
        m.height_slope  = g.sum[5] - g.sum[4];
        m.inverse_width = Number(1.) / m.width;
        return m;
      }
    };

    /** Moments of mass and momentum. */
    template <typename Number>
    struct PointSums : LaneSums<Number, 17>
    {
      // in the order of CellMoments::mass and momentum
      static constexpr int momentum = 9;
      using LaneSums<Number, 17>::sum;

      [[gnu::always_inline]] inline void
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
    struct ForceSums : LaneSums<Number, 16>
    {
      // hoop: 1, xi, eta, xi eta; r: a, a eta, b, b xi; z: likewise;
      // then the four corners' stiffness
      static constexpr int stiffness = 12;
      using LaneSums<Number, 16>::sum;

      [[gnu::always_inline]] inline void
      add(const LocalPoint<Number>  &p,
          const Number               inverse_width,
          const Number               inverse_r, // 0 in plane strain
          const Number               volume,
          const StressState<Number> &stress)
      {
        const Number hoop = volume * stress.tt * inverse_r;
        sum[0] += hoop;
        sum[1] += hoop * p.xi;
        sum[2] += hoop * p.eta;
        sum[3] += hoop * p.xi * p.eta;
        add_component(sum + 4, p, inverse_width, volume, stress.rr, stress.rz);
        add_component(sum + 8, p, inverse_width, volume, stress.rz, stress.zz);
      }

      /**
       * A bound of the row sums of the stiffness, sum_J |K_IJ|, from the
       * 1-norms of the gradients (see NodalSums::stiffness).
       */
      [[gnu::always_inline]] inline void
      add_stiffness(const LocalPoint<Number> &p,
                    const Number              inverse_width,
                    const Number              inverse_r,
                    const Number              volume_times_modulus)
      {
        const Number one(1.);
        const Number x[2] = {one - p.xi, p.xi}, y[2] = {one - p.eta, p.eta};
        Number       norm[4], total(0.);
        for (int i = 0; i < 4; ++i)
          {
            const Number d_dxi =
              (i % 2 ? inverse_width : -inverse_width) * y[i / 2];
            const Number d_deta = (i / 2 ? x[i % 2] : -x[i % 2]);
            norm[i] = abs(d_dxi - d_deta * p.slope * inverse_width) +
                      abs(d_deta * p.inverse_height) +
                      x[i % 2] * y[i / 2] * inverse_r;
            total += norm[i];
          }
        for (int i = 0; i < 4; ++i)
          sum[stiffness + i] += volume_times_modulus * norm[i] * total;
      }

    private:
      [[gnu::always_inline]] static inline void
      add_component(Number                   *s,
                    const LocalPoint<Number> &p,
                    const Number              inverse_width,
                    const Number              volume,
                    const Number              stress_r,
                    const Number              stress_z)
      {
        const Number a = volume * stress_r * inverse_width;
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
    struct FitSums : LaneSums<Number, 16>
    {
      // per component m s, m s x, m s y; padded to the size of ForceSums
      using LaneSums<Number, 16>::sum;

      [[gnu::always_inline]] inline void
      add(const Number x, const Number y, const Number mass, const Number *s)
      {
        const Number m_x = mass * x, m_y = mass * y;
        for (int c = 0; c < 4; ++c)
          {
            sum[3 * c] += mass * s[c];
            sum[3 * c + 1] += m_x * s[c];
            sum[3 * c + 2] += m_y * s[c];
          }
      }
    };

    /** The affine function with the coefficients fit[0 .. 2]. */
    template <typename Real, typename Number>
    [[gnu::always_inline]] inline Number
    evaluate_fit(const Real *fit, const Number x, const Number y)
    {
      return Number(fit[0]) + Number(fit[1]) * x + Number(fit[2]) * y;
    }

    /** A symmetric 2 x 2 matrix. */
    template <typename Number>
    struct SymmetricMatrix
    {
      Number xx, xy, yy;
    };

    /**
     * Raise the covariance C of points whose center is off that of the volume
     * of their cell by the vector d = (dx, dy), in parts of the cell:
     *   C <- C + 192 s max(2/27 - tr C / 2, 0) d d^T,
     * where s is the share to which the fit is @p bounded.
     * Over this distance the affine fit is extrapolated. Two points per
     * direction, with the variance 1/16, come as far as 1/4 off before one
     * of them leaves the cell. Their weights at the center change from 1/2
     * and 1/2 to 1 and 0 and back while the soil moves, those at the Gauss
     * points even become negative, and free surfaces are unstable. With the
     * factor of 2.2 that follows for two points, a third of the slope is left
     * then. It is 0 for three points and more, whose variance is at least
     * 2/27.
     */
    template <typename Number>
    [[gnu::always_inline]] inline void
    add_distance_of_centers(const Number bounded,
                            const Number dx,
                            const Number dy,
                            Number      &xx,
                            Number      &xy,
                            Number      &yy)
    {
      const Number share =
        Number(192.) * bounded *
        max(Number(2. / 27.) - Number(.5) * (xx + yy), Number(0.));
      xx += share * dx * dx;
      xy += share * dx * dy;
      yy += share * dy * dy;
    }

    /**
     * The inverse of mass times the covariance of the points' places in a
     * cell of size one, its eigenvalues bounded from below: points that lie
     * in a narrow band say little of the slope across it, and the Gauss
     * points lie far outside it. Where the variance in a direction is below
     * smallest_variance (points that fill half the cell have 0.021), the
     * slope in this direction is thus reduced in proportion, down to none for
     * points on a line.
     */
    template <typename Number>
    [[gnu::always_inline]] inline SymmetricMatrix<Number>
    inverse_covariance(const Number mass,
                       const Number xx,
                       const Number xy,
                       const Number yy)
    {
      const Number smallest_variance(.02), one(1.), half_of(.5);
      const Number center = half_of * (xx + yy), half = half_of * (xx - yy),
                   radius = sqrt(half * half + xy * xy);
      const Number major =
                     one / (mass * max(center + radius, smallest_variance)),
                   minor =
                     one / (mass * max(center - radius, smallest_variance));
      const Number mean = half_of * (major + minor),
                   turn =
                     half_of * (major - minor) / max(radius, Number(1e-300));
      return {mean + turn * half, turn * xy, mean - turn * half};
    }

    /** Moments of mass with y = (z - z_center) / mean height. */
    template <typename Number>
    struct MassOverHeight
    {
      Number y, xi_y, y2;

      /** From the moments in xi and eta, @p m [9]: y is bilinear. */
      [[gnu::always_inline]] inline MassOverHeight(const CellMap<Number> &map,
                                                   const Number          *m)
      {
        const Number inverse = Number(1.) / map.mean_height();
        const Number a0      = (map.bottom - map.center_z()) * inverse,
                     a1 = map.bottom_slope * inverse, a2 = map.height * inverse,
                     a3    = map.height_slope * inverse;
        const auto times_y = [=](const Number q,
                                 const Number q_xi,
                                 const Number q_eta,
                                 const Number q_xi_eta) {
          return a0 * q + a1 * q_xi + a2 * q_eta + a3 * q_xi_eta;
        };
        y                     = times_y(m[0], m[1], m[2], m[3]);
        xi_y                  = times_y(m[1], m[4], m[3], m[6]);
        const Number eta_y    = times_y(m[2], m[3], m[5], m[7]),
                     xi_eta_y = times_y(m[3], m[6], m[7], m[8]);
        y2                    = times_y(y, xi_y, eta_y, xi_eta_y);
      }
    };

    constexpr double unlimited = 1e300;

    /** What is kept of the slope of the mean stress in a cell. */
    template <typename Number>
    struct KeptPressureSlope
    {
      Number share; // of the slope
      // of the change of the trace of the stress over the width and the mean
      // height of the cell, Pa
      Number largest[2] = {Number(unlimited), Number(unlimited)};
    };

    /**
     * The affine stress of a cell, into fit[12] (see CellMoments): the
     * least-squares fit to the sums @p s of FitSums, with the moments of mass
     * @p m [9]. Of the slope of the mean stress @p pressure_slope is kept. In
     * a cell whose rows rise (over its mean height, from left to right) the
     * slopes are found along them, in x and y - rise x. A stress that is
     * affine is found as it is, unless it is @p bounded (0 to 1) and the
     * center of the points is not that of the volume.
     */
    template <typename Number>
    [[gnu::always_inline]] inline void
    fit_stress(const CellMap<Number>           &map,
               const double                     axisymmetric,
               const Number                    *m,
               const Number                    *s,
               const KeptPressureSlope<Number> &pressure_slope,
               const Number                     bounded,
               Number                          *fit)
    {
      const MassOverHeight<Number> over_height(map, m);
      const Number inverse_mass = Number(1.) / m[0], rise = map.rise(),
                   half(.5);
      const Number xi = m[1] * inverse_mass, x = xi - half,
                   y        = over_height.y * inverse_mass;
      const Number plain_xy = over_height.xi_y * inverse_mass - xi * y;
      Number xx = m[4] * inverse_mass - xi * xi, xy = plain_xy - rise * xx,
             yy =
               over_height.y2 * inverse_mass - y * y - rise * (plain_xy + xy);
      add_distance_of_centers(bounded,
                              x - map.center_of_volume(axisymmetric),
                              y - rise * x,
                              xx,
                              xy,
                              yy);
      const auto inverse = inverse_covariance(m[0], xx, xy, yy);
      Number     slope[2][4], trace[2] = {Number(0.), Number(0.)};
      for (int c = 0; c < 4; ++c)
        {
          const Number *const t = s + 3 * c;
          const Number sx = t[1] - t[0] * x, sy = t[2] - t[0] * y - rise * sx;
          slope[1][c] = inverse.xy * sx + inverse.yy * sy;
          slope[0][c] = inverse.xx * sx + inverse.xy * sy - rise * slope[1][c];
          for (int d = 0; d < 2 && c < 3; ++d)
            trace[d] += slope[d][c];
        }
      Number taken[2]; // of the slope of the mean stress
      for (int d = 0; d < 2; ++d)
        {
          const Number largest = pressure_slope.largest[d],
                       kept    = pressure_slope.share *
                              max(min(trace[d], largest), -largest);
          taken[d] = (trace[d] - kept) * Number(1. / 3.);
        }
      for (int c = 0; c < 4; ++c)
        {
          for (int d = 0; d < 2; ++d)
            fit[3 * c + 1 + d] = c < 3 ? slope[d][c] - taken[d] : slope[d][c];
          fit[3 * c] =
            s[3 * c] * inverse_mass - fit[3 * c + 1] * x - fit[3 * c + 2] * y;
        }
    }

    /** One of the 2 x 2 Gauss points of a cell. */
    template <typename Number>
    struct GaussPoint
    {
      static constexpr int n = 4;

      LocalPoint<Number> point;
      Number             inverse_r; // 0 in plane strain
      Number             volume;

      [[gnu::always_inline]] inline GaussPoint(const CellMap<Number> &map,
                                               const double axisymmetric,
                                               const int    i)
      {
        constexpr double x[2] = {.21132486540518712, .78867513459481288};
        point          = map.at_reference(Number(x[i % 2]), Number(x[i / 2]));
        const Number r = map.left + map.width * point.xi;
        inverse_r      = Number(axisymmetric) / r;
        volume         = Number(.25) * map.width * point.height *
                 (Number(axisymmetric) * r + Number(1. - axisymmetric));
      }
    };
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
