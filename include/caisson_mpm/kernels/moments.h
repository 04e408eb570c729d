// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The sums over the points of a cell that the transfer needs: moments of mass,
// momentum and force, and the affine fit of the stress with its Gauss points.
#ifndef caisson_mpm_kernels_moments_h
#define caisson_mpm_kernels_moments_h

#include <caisson_mpm/kernels/cell_map.h>
#include <caisson_mpm/kernels/stress_state.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      /** Sums over points, lane by lane; sum_lanes() brings them together. */
      template <typename Number, int n>
      struct LaneSums
      {
        static constexpr int size = n;
        Number               sum[n];

        CAISSON_INLINE void
        clear()
        {
          for (int i = 0; i < n; ++i)
            sum[i] = Number(0.);
        }
      };

      /** Moments of the MPs of one cell and one material. */
      template <typename Number>
      struct PointSums : LaneSums<Number, 24>
      {
        // mass: 1, xi, eta, xi eta, xi2, eta2, xi2 eta, xi eta2, xi2 eta2;
        // then momentum r and z: 1, xi, eta, xi eta
        static constexpr int momentum = 9;
        using LaneSums<Number, 24>::sum;

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
      struct ForceSums : LaneSums<Number, 16>
      {
        // hoop: 1, xi, eta, xi eta; r: a, a eta, b, b xi; z: likewise;
        // then the four corners' stiffness
        static constexpr int stiffness = 12;
        using LaneSums<Number, 16>::sum;

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
      struct FitSums : LaneSums<Number, 24>
      {
        // m x, m y, m x2, m x y, m y2; then per component s, s x, s y
        static constexpr int stress = 5;
        using LaneSums<Number, 24>::sum;

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

      /** A symmetric 2 x 2 matrix. */
      struct SymmetricMatrix
      {
        double xx, xy, yy;
      };

      /**
       * The inverse of mass times the covariance of the points' places in a
       * cell of size one, its eigenvalues bounded from below: points that lie
       * in a narrow band say little of the slope across it, and the Gauss
       * points lie far outside it. Where the variance in a direction is below
       * smallest_variance (points that fill half the cell have 0.021), the
       * slope in this direction is thus reduced in proportion, down to none for
       * points on a line.
       */
      CAISSON_INLINE SymmetricMatrix
      inverse_covariance(const double mass,
                         const double xx,
                         const double xy,
                         const double yy)
      {
        constexpr double smallest_variance = .02;
        const auto       bounded           = [](const double variance) {
          return variance > smallest_variance ? variance : smallest_variance;
        };
        const double center = .5 * (xx + yy), half = .5 * (xx - yy),
                     radius = __builtin_sqrt(half * half + xy * xy);
        const double major  = 1. / (mass * bounded(center + radius)),
                     minor  = 1. / (mass * bounded(center - radius));
        const double mean   = .5 * (major + minor),
                     turn   = radius > 0. ? .5 * (major - minor) / radius : 0.;
        return {mean + turn * half, turn * xy, mean - turn * half};
      }

      /**
       * The affine stress of a cell, into fit[12] (see CellMoments): the
       * least-squares fit. With @p mean_pressure the mean stress keeps its mean
       * only. In a cell whose rows rise by @p rise (over its mean height, from
       * left to right) the slopes are found along them, in x and y - rise x.
       */
      CAISSON_INLINE void
      fit_stress(const double  mass,
                 const double *s,
                 const double  rise,
                 const bool    mean_pressure,
                 double       *fit)
      {
        const double x = s[0] / mass, y = s[1] / mass;
        const double xx = s[2] / mass - x * x, plain_xy = s[3] / mass - x * y,
                     xy    = plain_xy - rise * xx,
                     yy    = s[4] / mass - y * y - rise * (plain_xy + xy);
        const auto inverse = inverse_covariance(mass, xx, xy, yy);
        double     slope[2][4], trace[2] = {0., 0.};
        for (int c = 0; c < 4; ++c)
          {
            const double *const t = s + FitSums<Lanes<1>>::stress + 3 * c;
            const double sx = t[1] - t[0] * x, sy = t[2] - t[0] * y - rise * sx;
            slope[1][c] = inverse.xy * sx + inverse.yy * sy;
            slope[0][c] =
              inverse.xx * sx + inverse.xy * sy - rise * slope[1][c];
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
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
