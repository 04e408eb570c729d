// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A thin wrapper around the vector extensions of GCC and clang: the number
// types on which every kernel is templated.
//
// Lanes<n> holds n doubles (n = 1, 2, 4, 8); Lanes<1> is for tests and for work
// on one material point. A kernel is
// compiled once per instruction set. To keep these objects apart (the same
// template, compiled with other flags, must not be merged by the linker), all
// kernel code lives in a namespace named by CAISSON_KERNEL_ISA.
//
// The instructions of x86-64 are named where the compiler does not find them by
// itself; every operation has a generic form beside, for all other processors.
//
// No deal.II and no std containers may be included from here.
#ifndef caisson_mpm_kernels_simd_h
#define caisson_mpm_kernels_simd_h

#include <caisson_mpm/kernels/instruction_set.h>

#ifdef CAISSON_X86_64
#  include <immintrin.h>
#endif

#ifndef CAISSON_KERNEL_ISA
#  define CAISSON_KERNEL_ISA isa_default
#endif

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** The compiler's types of n doubles and of their masks. */
    template <int n>
    struct VectorExtension
    {
      typedef double    values __attribute__((vector_size(n * sizeof(double))));
      typedef long long bits __attribute__((vector_size(n * sizeof(double))));
    };

#ifdef CAISSON_AVX512DQ
    /** With AVX-512 a mask is a register of its own, with a bit for each
     * lane. */
    template <>
    struct VectorExtension<8>
    {
      typedef double   values __attribute__((vector_size(8 * sizeof(double))));
      typedef __mmask8 bits;
    };
#endif

    /**
     * n doubles that are computed with at once. Comparisons give a Mask, and
     * select(mask, a, b) takes a where the mask is set, b elsewhere.
     */
    template <int n>
    class Lanes
    {
    public:
      static constexpr int width = n;
      using Values               = typename VectorExtension<n>::values;
      using Bits                 = typename VectorExtension<n>::bits;

      struct Mask
      {
        Bits bits;

        [[gnu::always_inline]] friend inline Mask
        operator&(const Mask a, const Mask b)
        {
          return {static_cast<Bits>(a.bits & b.bits)};
        }
        [[gnu::always_inline]] friend inline Mask
        operator|(const Mask a, const Mask b)
        {
          return {static_cast<Bits>(a.bits | b.bits)};
        }
        [[gnu::always_inline]] friend inline Mask
        operator!(const Mask a)
        {
          return {static_cast<Bits>(~a.bits)};
        }
        /** Whether any lane is set. */
        [[gnu::always_inline]] friend inline bool
        any(const Mask a)
        {
          return to_integer(a) != 0;
        }
        /** Lane i as bit i of an integer. */
        [[gnu::always_inline]] friend inline unsigned int
        to_integer(const Mask a)
        {
          if constexpr (sizeof(Bits) == 1)
            return a.bits;
#ifdef CAISSON_AVX
          else if constexpr (n == 4)
            return _mm256_movemask_pd(reinterpret_cast<__m256d>(a.bits));
#endif
#ifdef CAISSON_X86_64
          else if constexpr (n == 2)
            return _mm_movemask_pd(reinterpret_cast<__m128d>(a.bits));
#endif
          else
            {
              unsigned int result = 0;
              for (int i = 0; i < n; ++i)
                {
                  const auto bit = a.bits[i];
                  result |= (bit != 0 ? 1u : 0u) << i;
                }
              return result;
            }
        }
      };

      Lanes() = default;
      [[gnu::always_inline]] inline Lanes(const Values v)
        : values(v)
      {}
      [[gnu::always_inline]] inline Lanes(const double x)
        : values(x - Values{})
      {}

      [[gnu::always_inline]] static inline Lanes
      load(const double *p)
      {
        Lanes result;
        __builtin_memcpy(&result.values, p, sizeof(Values));
        return result;
      }
      [[gnu::always_inline]] inline void
      store(double *p) const
      {
        __builtin_memcpy(p, &values, sizeof(Values));
      }
      [[gnu::always_inline]] inline double
      operator[](const int i) const
      {
        return values[i];
      }
      [[gnu::always_inline]] inline Values
      get() const
      {
        return values;
      }

      [[gnu::always_inline]] friend inline Lanes
      operator+(const Lanes a, const Lanes b)
      {
        return Lanes(a.values + b.values);
      }
      [[gnu::always_inline]] friend inline Lanes
      operator-(const Lanes a, const Lanes b)
      {
        return Lanes(a.values - b.values);
      }
      [[gnu::always_inline]] friend inline Lanes
      operator*(const Lanes a, const Lanes b)
      {
        return Lanes(a.values * b.values);
      }
      [[gnu::always_inline]] friend inline Lanes
      operator/(const Lanes a, const Lanes b)
      {
        return Lanes(a.values / b.values);
      }
      [[gnu::always_inline]] friend inline Lanes
      operator-(const Lanes a)
      {
        return Lanes(-a.values);
      }
      [[gnu::always_inline]] inline Lanes &
      operator+=(const Lanes b)
      {
        values += b.values;
        return *this;
      }
      [[gnu::always_inline]] inline Lanes &
      operator-=(const Lanes b)
      {
        values -= b.values;
        return *this;
      }
      [[gnu::always_inline]] inline Lanes &
      operator*=(const Lanes b)
      {
        values *= b.values;
        return *this;
      }
      [[gnu::always_inline]] friend inline Mask
      operator<(const Lanes a, const Lanes b)
      {
#ifdef CAISSON_AVX512DQ
        if constexpr (n == 8)
          return {_mm512_cmp_pd_mask(__m512d(a.values),
                                     __m512d(b.values),
                                     _CMP_LT_OS)};
        else
#endif
          return {a.values < b.values};
      }
      [[gnu::always_inline]] friend inline Mask
      operator>(const Lanes a, const Lanes b)
      {
        return b < a;
      }
      [[gnu::always_inline]] friend inline Mask
      operator<=(const Lanes a, const Lanes b)
      {
#ifdef CAISSON_AVX512DQ
        if constexpr (n == 8)
          return {_mm512_cmp_pd_mask(__m512d(a.values),
                                     __m512d(b.values),
                                     _CMP_LE_OS)};
        else
#endif
          return {a.values <= b.values};
      }
      [[gnu::always_inline]] friend inline Mask
      operator>=(const Lanes a, const Lanes b)
      {
        return b <= a;
      }
      [[gnu::always_inline]] friend inline Lanes
      select(const Mask m, const Lanes a, const Lanes b)
      {
#ifdef CAISSON_AVX512DQ
        if constexpr (n == 8)
          return Lanes(Values(_mm512_mask_blend_pd(m.bits,
                                                   __m512d(b.values),
                                                   __m512d(a.values))));
        else
#endif
          return Lanes(m.bits ? a.values : b.values);
      }
      [[gnu::always_inline]] friend inline Lanes
      max(const Lanes a, const Lanes b)
      {
#ifdef CAISSON_AVX512F
        if constexpr (n == 8)
          return Lanes(
            Values(_mm512_max_pd(__m512d(a.values), __m512d(b.values))));
        else
#endif
          return select(a > b, a, b);
      }
      [[gnu::always_inline]] friend inline Lanes
      min(const Lanes a, const Lanes b)
      {
#ifdef CAISSON_AVX512F
        if constexpr (n == 8)
          return Lanes(
            Values(_mm512_min_pd(__m512d(a.values), __m512d(b.values))));
        else
#endif
          return select(a < b, a, b);
      }
      [[gnu::always_inline]] friend inline Lanes
      abs(const Lanes a)
      {
        return max(a, -a);
      }
      [[gnu::always_inline]] friend inline Lanes
      sqrt(const Lanes a)
      {
#ifdef CAISSON_AVX512F
        if constexpr (n == 8)
          return Lanes(Values(_mm512_sqrt_pd(__m512d(a.values))));
#endif
#ifdef CAISSON_AVX
        if constexpr (n == 4)
          return Lanes(Values(_mm256_sqrt_pd(__m256d(a.values))));
#endif
#ifdef CAISSON_X86_64
        if constexpr (n == 2)
          return Lanes(Values(_mm_sqrt_pd(__m128d(a.values))));
#endif
        Lanes result;
        for (int i = 0; i < n; ++i)
          result.values[i] = __builtin_sqrt(a.values[i]);
        return result;
      }
      /** The sum over all lanes. */
      [[gnu::always_inline]] friend inline double
      sum(const Lanes a)
      {
#ifdef CAISSON_AVX512F
        if constexpr (n == 8)
          return _mm512_reduce_add_pd(__m512d(a.values));
#endif
        double result = a.values[0];
        for (int i = 1; i < n; ++i)
          result += a.values[i];
        return result;
      }

    private:
      Values values;
    };

    /** Lane i holds value(i). */
    template <typename Number, typename Value>
    [[gnu::always_inline]] inline Number
    make_lanes(const Value &value)
    {
      typename Number::Values lanes = {};
      for (int i = 0; i < Number::width; ++i)
        lanes[i] = value(i);
      return Number(lanes);
    }

#define CAISSON_SHUFFLE(a, b, ...) \
  Number(__builtin_shufflevector((a).get(), (b).get(), __VA_ARGS__))

    /**
     * Of the runs of @p length lanes of a and b: the even ones of both into
     * even, the odd ones into odd, in turn from a and b.
     */
    template <int length, typename Number>
    [[gnu::always_inline]] inline void
    exchange_runs(const Number a, const Number b, Number &even, Number &odd)
    {
      if constexpr (Number::width == 8 && length == 1)
        {
          even = CAISSON_SHUFFLE(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
          odd  = CAISSON_SHUFFLE(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
        }
      else if constexpr (Number::width == 8 && length == 2)
        {
          even = CAISSON_SHUFFLE(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
          odd  = CAISSON_SHUFFLE(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
        }
      else if constexpr (Number::width == 8)
        {
          even = CAISSON_SHUFFLE(a, b, 0, 1, 2, 3, 8, 9, 10, 11);
          odd  = CAISSON_SHUFFLE(a, b, 4, 5, 6, 7, 12, 13, 14, 15);
        }
      else if constexpr (Number::width == 4 && length == 1)
        {
          even = CAISSON_SHUFFLE(a, b, 0, 4, 2, 6);
          odd  = CAISSON_SHUFFLE(a, b, 1, 5, 3, 7);
        }
      else if constexpr (Number::width == 4)
        {
          even = CAISSON_SHUFFLE(a, b, 0, 1, 4, 5);
          odd  = CAISSON_SHUFFLE(a, b, 2, 3, 6, 7);
        }
      else
        {
          even = CAISSON_SHUFFLE(a, b, 0, 2);
          odd  = CAISSON_SHUFFLE(a, b, 1, 3);
        }
    }

#undef CAISSON_SHUFFLE

    /** Lane i of out[k] is lane k of in[i]. */
    template <typename Number, int length = 1>
    [[gnu::always_inline]] inline void
    transpose(const Number *in, Number *out)
    {
      constexpr int width = Number::width;
      if constexpr (length < width)
        {
          Number next[width];
          for (int k = 0; k < width; ++k)
            if ((k & length) == 0)
              exchange_runs<length>(in[k],
                                    in[k + length],
                                    next[k],
                                    next[k + length]);
          transpose<Number, 2 * length>(next, out);
        }
      else
        for (int k = 0; k < width; ++k)
          out[k] = in[k];
    }

    /** Lane i of the result is the sum over all lanes of a[i]. */
    template <typename Number, int length = 1>
    [[gnu::always_inline]] inline Number
    sum_each(const Number *a)
    {
      constexpr int n = Number::width / length;
      if constexpr (n > 1)
        {
          Number next[n / 2];
          for (int k = 0; k < n; k += 2)
            {
              Number even, odd;
              exchange_runs<length>(a[k], a[k + 1], even, odd);
              next[k / 2] = even + odd;
            }
          return sum_each<Number, 2 * length>(next);
        }
      else
        return a[0];
    }

    /** The widest number type of the instruction set being compiled for; the
     * registers of most other processors have two lanes, as those of SSE2. */
#if defined(CAISSON_AVX512F)
    using NativeLanes = Lanes<8>;
#elif defined(CAISSON_AVX)
    using NativeLanes = Lanes<4>;
#else
    using NativeLanes = Lanes<2>;
#endif
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
