// SPDX-License-Identifier: LGPL-2.1-or-later
//
// exp, log, pow and sine on all lanes at once, by the same polynomials
// on every instruction set. Relative errors are a few units of round-off where
// the result is a normal number; the test is tests/kernels/vector_math.cc.
//
// With 1/sqrt(2) <= m < sqrt(2) and |t| <= 1/2,
//
//   2^x = 2^k 2^t,   log2 x = k + log2 m,
//   log2 m = (2 / ln 2) artanh(f),   f = (m - 1) / (m + 1).
//
// 2^t and artanh(f) / f are polynomials that interpolate them in Chebyshev's
// points, with relative errors below 2e-17; sin is summed by its power series.
#ifndef caisson_mpm_kernels_simd_math_h
#define caisson_mpm_kernels_simd_math_h

#include <caisson_mpm/kernels/simd.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** The bits of the lanes as integers, and back. */
    template <int n>
    struct LaneBits
    {
      typedef unsigned long long Integers
        __attribute__((vector_size(n * sizeof(double))));

      [[gnu::always_inline]] static inline Integers
      of(const Lanes<n> x)
      {
        return reinterpret_cast<Integers>(x.get());
      }
      [[gnu::always_inline]] static inline Lanes<n>
      to_lanes(const Integers bits)
      {
        return Lanes<n>(reinterpret_cast<typename Lanes<n>::Values>(bits));
      }
    };

    template <>
    struct LaneBits<1>
    {
      using Integers = unsigned long long;

      [[gnu::always_inline]] static inline Integers
      of(const Lanes<1> x)
      {
        const double value = x[0];
        Integers     bits;
        __builtin_memcpy(&bits, &value, sizeof(bits));
        return bits;
      }
      [[gnu::always_inline]] static inline Lanes<1>
      to_lanes(const Integers bits)
      {
        double value;
        __builtin_memcpy(&value, &bits, sizeof(value));
        return Lanes<1>(value);
      }
    };

    /** sum_i c[i] x^i. */
    template <typename Number, int n>
    [[gnu::always_inline]] inline Number
    polynomial(const double (&c)[n], const Number x)
    {
      Number result(c[n - 1]);
      for (int i = n - 2; i >= 0; --i)
        result = result * x + Number(c[i]);
      return result;
    }

    /** 2^k 2^t for |t| <= 1/2, with k in the low bits of @p shifted. */
    template <int n>
    [[gnu::always_inline]] inline Lanes<n>
    power_of_two(const Lanes<n> shifted, const Lanes<n> t)
    {
      using Bits                    = LaneBits<n>;
      static constexpr double fit[] = {1.,
                                       0.6931471805599453,
                                       0.24022650695910158,
                                       0.055504108664821625,
                                       0.009618129107587256,
                                       0.001333355814640647,
                                       0.00015403530463724353,
                                       1.5252733841556773e-05,
                                       1.3215432535912375e-06,
                                       1.0178057087733941e-07,
                                       7.074194297288521e-09,
                                       4.4558179083360645e-10};
      return Bits::to_lanes(Bits::of(polynomial(fit, t)) +
                            (Bits::of(shifted) << 52));
    }

    /** Adding this rounds to an integer and leaves it in the low bits. */
    constexpr double to_low_bits = 6755399441055744.; // 1.5 2^52

    /** 2^x for -1000 <= x <= 1000; beyond, and for NaN, the value at the
     * limit. */
    template <int n>
    [[gnu::always_inline]] inline Lanes<n>
    exp2(const Lanes<n> x)
    {
      using Number         = Lanes<n>;
      const Number y       = min(max(x, Number(-1000.)), Number(1000.)),
                   shifted = y + Number(to_low_bits);
      return power_of_two(shifted, y - (shifted - Number(to_low_bits)));
    }

    /** For -700 <= x <= 700; beyond, and for NaN, the value at the limit. */
    template <int n>
    [[gnu::always_inline]] inline Lanes<n>
    exp(const Lanes<n> x)
    {
      using Number         = Lanes<n>;
      const Number y       = min(max(x, Number(-700.)), Number(700.)),
                   to      = Number(to_low_bits), per_ln2(1.4426950408889634),
                   shifted = y * per_ln2 + to, k = shifted - to;
      return power_of_two(shifted,
                          ((y - k * Number(0.693147180369123816490)) -
                           k * Number(1.90821492927058770002e-10)) *
                            per_ln2);
    }

    /** For normal numbers x > 0; smaller ones, and NaN, count as 1e-300. */
    template <int n>
    [[gnu::always_inline]] inline Lanes<n>
    log2(const Lanes<n> x)
    {
      using Number                  = Lanes<n>;
      using Bits                    = LaneBits<n>;
      static constexpr double fit[] = {2.8853900817779268,
                                       0.9617966939259898,
                                       0.5770780163455203,
                                       0.4121985858409005,
                                       0.32059853491395984,
                                       0.262334352504183,
                                       0.2209130842311768,
                                       0.2136589569431927};
      const auto              bits  = Bits::of(max(x, Number(1e-300)));
      // 1023 + k, from sqrt(2) on one more than the exponent of x
      const auto   exponent = (bits + 0x00095f619980c433ull) >> 52;
      const Number m =
        Bits::to_lanes(bits - (exponent << 52) + 0x3ff0000000000000ull);
      // the low bits of 2^52 + exponent
      const Number k = Bits::to_lanes(exponent | 0x4330000000000000ull) -
                       Number(4503599627370496. + 1023.);
      const Number f = (m - Number(1.)) / (m + Number(1.));
      return k + f * polynomial(fit, f * f);
    }

    /** As log2(). */
    template <typename Number>
    [[gnu::always_inline]] inline Number
    log(const Number x)
    {
      return Number(0.6931471805599453) * log2(x);
    }

    /** x^y for x > 0. */
    template <typename Number>
    [[gnu::always_inline]] inline Number
    pow(const Number x, const double y)
    {
      return exp2(Number(y) * log2(x));
    }

    /** Whether x^y can be had from roots. */
    inline bool
    has_quarter_power(const double y)
    {
      return y >= 0. && y <= 16. && 4. * y == static_cast<int>(4. * y);
    }

    /** The same for x >= 0 where 4 y is a whole number: by square roots and
     * squares. */
    template <typename Number>
    [[gnu::always_inline]] inline Number
    quarter_power(Number x, const double y)
    {
      int    quarters = static_cast<int>(4. * y);
      Number result(1.);
      if ((quarters & 3) != 0)
        {
          const Number root = sqrt(x);
          if ((quarters & 2) != 0)
            result = root;
          if ((quarters & 1) != 0)
            result = result * sqrt(root);
        }
      for (quarters >>= 2; quarters > 0; quarters >>= 1)
        {
          if ((quarters & 1) != 0)
            result = result * x;
          x = x * x;
        }
      return result;
    }

    /** For |x| <= pi / 2. */
    template <int n>
    [[gnu::always_inline]] inline Lanes<n>
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
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
