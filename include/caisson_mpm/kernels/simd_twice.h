// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Two numbers that are computed with at once. Where each operation waits for
// the one before, two chains of them take little longer than one.
#ifndef caisson_mpm_kernels_simd_twice_h
#define caisson_mpm_kernels_simd_twice_h

#include <caisson_mpm/kernels/simd_math.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** Two numbers with the interface of Lanes<n>, as far as laws need it. */
    template <typename Number>
    struct Twice
    {
      Number a, b;

      struct Mask
      {
        typename Number::Mask a, b;

        [[gnu::always_inline]] friend inline Mask
        operator&(const Mask x, const Mask y)
        {
          return {x.a & y.a, x.b & y.b};
        }
        [[gnu::always_inline]] friend inline Mask
        operator|(const Mask x, const Mask y)
        {
          return {x.a | y.a, x.b | y.b};
        }
        [[gnu::always_inline]] friend inline Mask
        operator!(const Mask x)
        {
          return {!x.a, !x.b};
        }
        [[gnu::always_inline]] friend inline bool
        any(const Mask x)
        {
          return any(x.a | x.b);
        }
      };

      Twice() = default;
      [[gnu::always_inline]] inline Twice(const Number a, const Number b)
        : a(a)
        , b(b)
      {}
      [[gnu::always_inline]] inline Twice(const double x)
        : a(x)
        , b(x)
      {}

      [[gnu::always_inline]] static inline Twice
      load(const double *p, const double *q)
      {
        return {Number::load(p), Number::load(q)};
      }
      [[gnu::always_inline]] inline void
      store(double *p, double *q) const
      {
        a.store(p);
        b.store(q);
      }

      [[gnu::always_inline]] friend inline Twice
      operator+(const Twice x, const Twice y)
      {
        return {x.a + y.a, x.b + y.b};
      }
      [[gnu::always_inline]] friend inline Twice
      operator-(const Twice x, const Twice y)
      {
        return {x.a - y.a, x.b - y.b};
      }
      [[gnu::always_inline]] friend inline Twice
      operator*(const Twice x, const Twice y)
      {
        return {x.a * y.a, x.b * y.b};
      }
      [[gnu::always_inline]] friend inline Twice
      operator/(const Twice x, const Twice y)
      {
        return {x.a / y.a, x.b / y.b};
      }
      [[gnu::always_inline]] friend inline Mask
      operator<(const Twice x, const Twice y)
      {
        return {x.a < y.a, x.b < y.b};
      }
      [[gnu::always_inline]] friend inline Mask
      operator>(const Twice x, const Twice y)
      {
        return {x.a > y.a, x.b > y.b};
      }
      [[gnu::always_inline]] friend inline Mask
      operator>=(const Twice x, const Twice y)
      {
        return {x.a >= y.a, x.b >= y.b};
      }
      [[gnu::always_inline]] friend inline Twice
      max(const Twice x, const Twice y)
      {
        return {max(x.a, y.a), max(x.b, y.b)};
      }
      [[gnu::always_inline]] friend inline Twice
      min(const Twice x, const Twice y)
      {
        return {min(x.a, y.a), min(x.b, y.b)};
      }
      [[gnu::always_inline]] friend inline Twice
      operator-(const Twice x)
      {
        return {-x.a, -x.b};
      }
      [[gnu::always_inline]] inline Twice &
      operator+=(const Twice y)
      {
        return *this = *this + y;
      }
      [[gnu::always_inline]] friend inline Twice
      abs(const Twice x)
      {
        return {abs(x.a), abs(x.b)};
      }
      [[gnu::always_inline]] friend inline Twice
      sqrt(const Twice x)
      {
        return {sqrt(x.a), sqrt(x.b)};
      }
      [[gnu::always_inline]] friend inline Twice
      exp(const Twice x)
      {
        return {exp(x.a), exp(x.b)};
      }
      [[gnu::always_inline]] friend inline Twice
      exp2(const Twice x)
      {
        return {exp2(x.a), exp2(x.b)};
      }
      [[gnu::always_inline]] friend inline Twice
      log2(const Twice x)
      {
        return {log2(x.a), log2(x.b)};
      }
      [[gnu::always_inline]] friend inline Twice
      select(const Mask m, const Twice x, const Twice y)
      {
        return {select(m.a, x.a, y.a), select(m.b, x.b, y.b)};
      }
    };
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
