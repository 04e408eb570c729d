// SPDX-License-Identifier: LGPL-2.1-or-later
//
// exp, log, pow, sine and cosine on all lanes at once, by the same polynomials
// on every instruction set. Relative errors are a few units of round-off where
// the result is a normal number; the test is tests/kernels/vector_math.cc.
//
// exp(x) = 2^k exp(t) with |t| <= ln(2)/2, and log(x) = k ln 2 + log(m) with
// 1/sqrt(2) <= m <= sqrt(2), log(m) = 2 artanh((m - 1) / (m + 1)); exp(t),
// artanh, sin and cos are summed by their power series.
#ifndef caisson_mpm_kernels_simd_math_h
#define caisson_mpm_kernels_simd_math_h

#include <caisson_mpm/kernels/simd.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      /** The bits of the lanes as integers, and back. */
      template <int n>
      struct LaneBits
      {
        typedef unsigned long long Integers
          __attribute__((vector_size(n * sizeof(double))));

        static CAISSON_INLINE Integers
        of(const Lanes<n> x)
        {
          return reinterpret_cast<Integers>(x.get());
        }
        static CAISSON_INLINE Lanes<n>
                              to_lanes(const Integers bits)
        {
          return Lanes<n>(reinterpret_cast<typename Lanes<n>::Values>(bits));
        }
      };

      template <>
      struct LaneBits<1>
      {
        using Integers = unsigned long long;

        static CAISSON_INLINE Integers
        of(const Lanes<1> x)
        {
          const double value = x[0];
          Integers     bits;
          __builtin_memcpy(&bits, &value, sizeof(bits));
          return bits;
        }
        static CAISSON_INLINE Lanes<1>
                              to_lanes(const Integers bits)
        {
          double value;
          __builtin_memcpy(&value, &bits, sizeof(value));
          return Lanes<1>(value);
        }
      };

      /** sum_i c[i] x^i. */
      template <typename Number, int n>
      CAISSON_INLINE Number
      polynomial(const double (&c)[n], const Number x)
      {
        Number result(c[n - 1]);
        for (int i = n - 2; i >= 0; --i)
          result = result * x + Number(c[i]);
        return result;
      }

      /** For -700 <= x <= 700; beyond, and for NaN, the value at the limit. */
      template <int n>
      CAISSON_INLINE Lanes<n>
                     exp(const Lanes<n> x)
      {
        using Number                     = Lanes<n>;
        using Bits                       = LaneBits<n>;
        static constexpr double series[] = {1.,
                                            1.,
                                            1. / 2.,
                                            1. / 6.,
                                            1. / 24.,
                                            1. / 120.,
                                            1. / 720.,
                                            1. / 5040.,
                                            1. / 40320.,
                                            1. / 362880.,
                                            1. / 3628800.,
                                            1. / 39916800.,
                                            1. / 479001600.,
                                            1. / 6227020800.};
        const Number            y = min(max(x, Number(-700.)), Number(700.));
        // adding 1.5 2^52 rounds to an integer and leaves it in the low bits
        const Number round(6755399441055744.);
        const Number shifted = y * Number(1.4426950408889634) + round;
        const Number k       = shifted - round;
        const Number t       = (y - k * Number(0.693147180369123816490)) -
                         k * Number(1.90821492927058770002e-10);
        return Bits::to_lanes(Bits::of(polynomial(series, t)) +
                              (Bits::of(shifted) << 52));
      }

      /** For normal numbers x > 0; smaller ones, and NaN, count as 1e-300. */
      template <int n>
      CAISSON_INLINE Lanes<n>
                     log(const Lanes<n> x)
      {
        using Number                     = Lanes<n>;
        using Bits                       = LaneBits<n>;
        static constexpr double series[] = {2.,
                                            2. / 3.,
                                            2. / 5.,
                                            2. / 7.,
                                            2. / 9.,
                                            2. / 11.,
                                            2. / 13.,
                                            2. / 15.,
                                            2. / 17.,
                                            2. / 19.,
                                            2. / 21.};
        const Number            y        = max(x, Number(1e-300));
        const auto              bits     = Bits::of(y);
        // the exponent as a double: the low bits of 2^52 + exponent
        const Number exponent =
          Bits::to_lanes((bits >> 52) | 0x4330000000000000ull) -
          Number(4503599627370496. + 1023.);
        const Number mantissa = Bits::to_lanes((bits & 0x000fffffffffffffull) |
                                               0x3ff0000000000000ull);
        const auto   is_large = mantissa > Number(1.4142135623730951);
        const Number m = select(is_large, Number(.5) * mantissa, mantissa);
        const Number k = select(is_large, exponent + Number(1.), exponent);
        const Number f = (m - Number(1.)) / (m + Number(1.));
        return k * Number(0.693147180369123816490) +
               (f * polynomial(series, f * f) +
                k * Number(1.90821492927058770002e-10));
      }

      /** x^y for x > 0. */
      template <int n>
      CAISSON_INLINE Lanes<n>
                     pow(const Lanes<n> x, const double y)
      {
        return exp(Lanes<n>(y) * log(x));
      }

      /** For |x| <= pi / 2. */
      template <int n>
      CAISSON_INLINE Lanes<n>
                     sin(const Lanes<n> x)
      {
        static constexpr double series[] = {1.,
                                            -1. / 6.,
                                            1. / 120.,
                                            -1. / 5040.,
                                            1. / 362880.,
                                            -1. / 39916800.,
                                            1. / 6227020800.,
                                            -1. / 1307674368000.,
                                            1. / 355687428096000.,
                                            -1. / 121645100408832000.,
                                            1. / 51090942171709440000.};
        return x * polynomial(series, x * x);
      }

      /** For |x| <= pi / 2. */
      template <int n>
      CAISSON_INLINE Lanes<n>
                     cos(const Lanes<n> x)
      {
        static constexpr double series[] = {1.,
                                            -1. / 2.,
                                            1. / 24.,
                                            -1. / 720.,
                                            1. / 40320.,
                                            -1. / 3628800.,
                                            1. / 479001600.,
                                            -1. / 87178291200.,
                                            1. / 20922789888000.,
                                            -1. / 6402373705728000.,
                                            1. / 2432902008176640000.};
        return polynomial(series, x * x);
      }
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
