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

namespace CaissonMPM::Kernels
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

    /**
     * The geometry of a cell, prepared for many points. Real is double for
     * one cell, or a number of lanes, one cell in each.
     */
    template <typename Real = double>
    struct CellMap
    {
      Real   left, width, inverse_width;
      Real   bottom, bottom_slope; // bottom(xi) = bottom + bottom_slope xi
      Real   height, height_slope;
      bool   is_parallel    = false; // height is the same everywhere,
      double inverse_height = 0.;    // and this its inverse

      CellMap() = default;

      [[gnu::always_inline]] inline explicit CellMap(const CellGeometry &g)
        : left(g.left)
        , width(g.width)
        , inverse_width(1. / g.width)
        , bottom(g.bottom_left)
        , bottom_slope(g.bottom_right - g.bottom_left)
        , height(g.height_left)
        , height_slope(g.height_right - g.height_left)
        , is_parallel(g.height_right == g.height_left)
        , inverse_height(1. / g.height_left)
      {}

      template <typename Number>
      [[gnu::always_inline]] inline LocalPoint<Number>
      at_reference(const Number xi, const Number eta) const
      {
        LocalPoint<Number> p;
        p.xi             = xi;
        p.eta            = eta;
        p.height         = Number(height) + Number(height_slope) * xi;
        p.inverse_height = Number(1.) / p.height;
        p.slope          = (Number(bottom_slope) + Number(height_slope) * eta) *
                  p.inverse_height;
        return p;
      }

      template <typename Number>
      [[gnu::always_inline]] inline LocalPoint<Number>
      at_position(const Number r, const Number z) const
      {
        LocalPoint<Number> p;
        p.xi     = (r - Number(left)) * Number(inverse_width);
        p.height = Number(height) + Number(height_slope) * p.xi;
        p.inverse_height =
          is_parallel ? Number(inverse_height) : Number(1.) / p.height;
        p.eta =
          (z - Number(bottom) - Number(bottom_slope) * p.xi) * p.inverse_height;
        p.slope = (Number(bottom_slope) + Number(height_slope) * p.eta) *
                  p.inverse_height;
        return p;
      }

      /** Whether places lie in the cell; a NaN does not. */
      template <typename Number>
      [[gnu::always_inline]] inline typename Number::Mask
      contains(const Number r, const Number z) const
      {
        const Number zero(0.), xi = (r - Number(left)) * Number(inverse_width);
        const Number above = z - Number(bottom) - Number(bottom_slope) * xi;
        return (xi >= zero) & (xi <= Number(1.)) & (above >= zero) &
               (above <= Number(height) + Number(height_slope) * xi);
      }

      /** The volume per radian (in plane strain: the area) of the cell. */
      [[gnu::always_inline]] inline Real
      volume(const double axisymmetric) const
      {
        const Real area = width * (height + Real(.5) * height_slope);
        const Real first_moment =
          left * area +
          width * width * (Real(.5) * height + height_slope * Real(1. / 3.));
        return Real(axisymmetric) * first_moment +
               Real(1. - axisymmetric) * area;
      }

      /** The center of the volume (in plane strain: of the area), in xi less
       * 1/2. In eta it is in the middle. */
      [[gnu::always_inline]] inline Real
      center_of_volume(const double axisymmetric) const
      {
        // r and the height are linear in x = xi - 1/2
        const Real r = Real(axisymmetric) * (left + Real(.5) * width) +
                       Real(1. - axisymmetric),
                   r_slope = Real(axisymmetric) * width;
        return (r * height_slope + r_slope * mean_height()) /
               (Real(12.) * r * mean_height() + r_slope * height_slope);
      }

      [[gnu::always_inline]] inline Real
      mean_height() const
      {
        return height + Real(.5) * height_slope;
      }

      /** How far the middle of the cell rises from left to right, over the
       * mean height. */
      [[gnu::always_inline]] inline Real
      rise() const
      {
        return (bottom_slope + Real(.5) * height_slope) / mean_height();
      }

      [[gnu::always_inline]] inline Real
      center_z() const
      {
        return bottom + Real(.5) * (bottom_slope + mean_height());
      }
    };

    /** c0 + c1 xi + c2 eta + c3 xi eta. */
    template <typename Real, typename Number>
    [[gnu::always_inline]] inline Number
    evaluate(const Real *c, const LocalPoint<Number> &p)
    {
      return Number(c[0]) + Number(c[1]) * p.xi +
             (Number(c[2]) + Number(c[3]) * p.xi) * p.eta;
    }

    /** d/dr and d/dz of a field, in that order. */
    template <typename Real, typename Number>
    [[gnu::always_inline]] inline void
    gradient(const Real               *c,
             const LocalPoint<Number> &p,
             const Real                inverse_width,
             Number                   &d_dr,
             Number                   &d_dz)
    {
      const Number d_dxi  = Number(c[1]) + Number(c[3]) * p.eta;
      const Number d_deta = Number(c[2]) + Number(c[3]) * p.xi;
      d_dr                = (d_dxi - d_deta * p.slope) * Number(inverse_width);
      d_dz                = d_deta * p.inverse_height;
    }

    /** The coefficients of the field with corner values v[4]. */
    template <typename Real>
    [[gnu::always_inline]] inline void
    coefficients(const Real *v, Real *c)
    {
      c[0] = v[0];
      c[1] = v[1] - v[0];
      c[2] = v[2] - v[0];
      c[3] = v[3] - v[2] - v[1] + v[0];
    }

    /** Sums of q {1, xi, eta, xi eta} to sums of q N_I. */
    template <typename Real>
    [[gnu::always_inline]] inline void
    moments_to_corners(const Real *m, Real *corner)
    {
      corner[0] = m[0] - m[1] - m[2] + m[3];
      corner[1] = m[1] - m[3];
      corner[2] = m[2] - m[3];
      corner[3] = m[3];
    }

    /**
     * Sums of {a, a eta, b, b xi} to sums of a dN_I/dxi + b dN_I/deta.
     */
    template <typename Real>
    [[gnu::always_inline]] inline void
    gradient_moments_to_corners(const Real *m, Real *corner)
    {
      corner[0] = -(m[0] - m[1]) - (m[2] - m[3]);
      corner[1] = (m[0] - m[1]) - m[3];
      corner[2] = -m[1] + (m[2] - m[3]);
      corner[3] = m[1] + m[3];
    }

  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
