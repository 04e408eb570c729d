// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Compiled once per instruction set, with CAISSON_KERNEL_ISA naming it.
#include "limits.h"

#include <caisson_mpm/kernels/simd.h>

#define CAISSON_CONCATENATE(a, b) a##b
#define CAISSON_LIMITS(isa) CAISSON_CONCATENATE(limits_, isa)

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    // r, z, velocity, stress, mass, volume, plastic strains
    constexpr int n_read = 12, mass_field = 8;

    /** Each written field takes the values of the next one that is read. */
    inline void
    stream(PointBlock *blocks, const unsigned int n)
    {
      constexpr int width = NativeLanes::width;
      for (unsigned int i = 0; i < n; ++i)
        {
          double *const fields = blocks[i].r;
          for (int lane = 0; lane < block_size; lane += width)
            {
              NativeLanes values[n_read];
              for (int k = 0; k < n_read; ++k)
                values[k] = NativeLanes::load(fields + k * block_size + lane);
              for (int k = 0; k < n_read; ++k)
                if (k != mass_field)
                  values[(k + 1) % n_read].store(fields + k * block_size +
                                                 lane);
            }
        }
    }

    /** Enough sums that none waits for the one before it. */
    inline double
    multiply_and_add(const unsigned long n)
    {
      constexpr int n_sums = 12;
      NativeLanes   sums[n_sums];
      for (int k = 0; k < n_sums; ++k)
        sums[k] = NativeLanes(k);
      const NativeLanes factor(.999), term(1e-3);
      for (unsigned long i = 0; i < n; i += n_sums * NativeLanes::width)
        for (NativeLanes &value : sums)
          value = value * factor + term;
      for (int k = 1; k < n_sums; ++k)
        sums[0] += sums[k];
      return sum(sums[0]);
    }
  } // namespace CAISSON_KERNEL_ISA

  const Limits &
  CAISSON_LIMITS(CAISSON_KERNEL_ISA)()
  {
    static constexpr Limits limits = {&stream, &multiply_and_add};
    return limits;
  }
} // namespace CaissonMPM::Kernels
