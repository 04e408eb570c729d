// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The trapezoidal cell with vertical sides: its closed-form inverse map and
// its bilinear shape functions, those of FE_Q<2>(1) under MappingQ1,
//   N_0 = (1-xi)(1-eta), N_1 = xi(1-eta), N_2 = (1-xi)eta, N_3 = xi eta.
// A field is kept as its coefficients of {1, xi, eta, xi eta}.
#ifndef caisson_mpm_kernels_cell_map_h
#define caisson_mpm_kernels_cell_map_h

#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/kernels/simd.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      /** A point in a cell: reference coordinates and the map's derivatives. */
      template <typename Number>
      struct LocalPoint
      {
        Number xi, eta;
        Number height; // dz/deta
        Number inverse_height;
        Number slope; // (dz/dxi) / height
      };

      /** The geometry of one cell, prepared for many points. */
      struct CellMap
      {
        double left, width, inverse_width;
        double bottom, bottom_slope; // bottom(xi) = bottom + bottom_slope xi
        double height, height_slope;

        CAISSON_INLINE explicit CellMap(const CellGeometry &g)
          : left(g.left)
          , width(g.width)
          , inverse_width(1. / g.width)
          , bottom(g.bottom_left)
          , bottom_slope(g.bottom_right - g.bottom_left)
          , height(g.height_left)
          , height_slope(g.height_right - g.height_left)
        {}

        template <typename Number>
        CAISSON_INLINE LocalPoint<Number>
                       at_reference(const Number xi, const Number eta) const
        {
          LocalPoint<Number> p;
          p.xi             = xi;
          p.eta            = eta;
          p.height         = Number(height) + Number(height_slope) * xi;
          p.inverse_height = Number(1.) / p.height;
          p.slope = (Number(bottom_slope) + Number(height_slope) * eta) *
                    p.inverse_height;
          return p;
        }

        template <typename Number>
        CAISSON_INLINE LocalPoint<Number>
                       at_position(const Number r, const Number z) const
        {
          LocalPoint<Number> p;
          p.xi             = (r - Number(left)) * Number(inverse_width);
          p.height         = Number(height) + Number(height_slope) * p.xi;
          p.inverse_height = Number(1.) / p.height;
          p.eta = (z - Number(bottom) - Number(bottom_slope) * p.xi) *
                  p.inverse_height;
          p.slope = (Number(bottom_slope) + Number(height_slope) * p.eta) *
                    p.inverse_height;
          return p;
        }

        /** The volume per radian (in plane strain: the area) of the cell. */
        CAISSON_INLINE double
        volume(const double axisymmetric) const
        {
          const double area = width * (height + .5 * height_slope);
          const double first_moment =
            left * area + width * width * (.5 * height + height_slope / 3.);
          return axisymmetric * first_moment + (1. - axisymmetric) * area;
        }

        CAISSON_INLINE double
        mean_height() const
        {
          return height + .5 * height_slope;
        }

        /** How far the middle of the cell rises from left to right, over the
         * mean height. */
        CAISSON_INLINE double
        rise() const
        {
          return (bottom_slope + .5 * height_slope) / mean_height();
        }

        CAISSON_INLINE double
        center_z() const
        {
          return bottom + .5 * (bottom_slope + mean_height());
        }
      };

      /** c0 + c1 xi + c2 eta + c3 xi eta. */
      template <typename Number>
      CAISSON_INLINE Number
      evaluate(const double *c, const LocalPoint<Number> &p)
      {
        return Number(c[0]) + Number(c[1]) * p.xi +
               (Number(c[2]) + Number(c[3]) * p.xi) * p.eta;
      }

      /** d/dr and d/dz of a field, in that order. */
      template <typename Number>
      CAISSON_INLINE void
      gradient(const double             *c,
               const LocalPoint<Number> &p,
               const double              inverse_width,
               Number                   &d_dr,
               Number                   &d_dz)
      {
        const Number d_dxi  = Number(c[1]) + Number(c[3]) * p.eta;
        const Number d_deta = Number(c[2]) + Number(c[3]) * p.xi;
        d_dr = (d_dxi - d_deta * p.slope) * Number(inverse_width);
        d_dz = d_deta * p.inverse_height;
      }

      /** The coefficients of the field with corner values v[4]. */
      CAISSON_INLINE void
      coefficients(const double *v, double *c)
      {
        c[0] = v[0];
        c[1] = v[1] - v[0];
        c[2] = v[2] - v[0];
        c[3] = v[3] - v[2] - v[1] + v[0];
      }

      /** Sums of q {1, xi, eta, xi eta} to sums of q N_I. */
      CAISSON_INLINE void
      moments_to_corners(const double *m, double *corner)
      {
        corner[0] = m[0] - m[1] - m[2] + m[3];
        corner[1] = m[1] - m[3];
        corner[2] = m[2] - m[3];
        corner[3] = m[3];
      }

      /**
       * Sums of {a, a eta, b, b xi} to sums of a dN_I/dxi + b dN_I/deta.
       */
      CAISSON_INLINE void
      gradient_moments_to_corners(const double *m, double *corner)
      {
        corner[0] = -(m[0] - m[1]) - (m[2] - m[3]);
        corner[1] = (m[0] - m[1]) - m[3];
        corner[2] = -m[1] + (m[2] - m[3]);
        corner[3] = m[1] + m[3];
      }

#define CAISSON_SHUFFLE(a, b, ...) \
  Number(__builtin_shufflevector((a).get(), (b).get(), __VA_ARGS__))

      /**
       * The sums over all lanes of @p n accumulators, n a multiple of eight:
       * a transposition by halves, with one addition per level.
       */
      template <int n, typename Number>
      CAISSON_INLINE void
      sum_lanes(const Number *a, double *out)
      {
        static_assert(n % 8 == 0, "pad the accumulators to a multiple of 8");
        if constexpr (Number::width == 8)
          for (int i = 0; i < n; i += 8)
            {
              Number pair[4], quad[2];
              for (int k = 0; k < 4; ++k)
                {
                  const Number x = a[i + 2 * k], y = a[i + 2 * k + 1];
                  pair[k] = CAISSON_SHUFFLE(x, y, 0, 8, 2, 10, 4, 12, 6, 14) +
                            CAISSON_SHUFFLE(x, y, 1, 9, 3, 11, 5, 13, 7, 15);
                }
              for (int k = 0; k < 2; ++k)
                {
                  const Number x = pair[2 * k], y = pair[2 * k + 1];
                  quad[k] = CAISSON_SHUFFLE(x, y, 0, 1, 8, 9, 4, 5, 12, 13) +
                            CAISSON_SHUFFLE(x, y, 2, 3, 10, 11, 6, 7, 14, 15);
                }
              (CAISSON_SHUFFLE(quad[0], quad[1], 0, 1, 2, 3, 8, 9, 10, 11) +
               CAISSON_SHUFFLE(quad[0], quad[1], 4, 5, 6, 7, 12, 13, 14, 15))
                .store(out + i);
            }
        else if constexpr (Number::width == 4)
          for (int i = 0; i < n; i += 4)
            {
              Number pair[2];
              for (int k = 0; k < 2; ++k)
                {
                  const Number x = a[i + 2 * k], y = a[i + 2 * k + 1];
                  pair[k] = CAISSON_SHUFFLE(x, y, 0, 4, 2, 6) +
                            CAISSON_SHUFFLE(x, y, 1, 5, 3, 7);
                }
              (CAISSON_SHUFFLE(pair[0], pair[1], 0, 1, 4, 5) +
               CAISSON_SHUFFLE(pair[0], pair[1], 2, 3, 6, 7))
                .store(out + i);
            }
        else if constexpr (Number::width == 2)
          for (int i = 0; i < n; i += 2)
            (CAISSON_SHUFFLE(a[i], a[i + 1], 0, 2) +
             CAISSON_SHUFFLE(a[i], a[i + 1], 1, 3))
              .store(out + i);
        else
          for (int i = 0; i < n; ++i)
            a[i].store(out + i);
      }
#undef CAISSON_SHUFFLE
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
