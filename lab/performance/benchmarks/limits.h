// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What bounds the kernels: how fast blocks of points come from memory and go
// back, and how fast this CPU multiplies and adds.
#ifndef caisson_mpm_benchmarks_limits_h
#define caisson_mpm_benchmarks_limits_h

#include <caisson_mpm/kernels/instruction_set.h>
#include <caisson_mpm/kernels/layout.h>

namespace CaissonMPM::Kernels
{
  /** Two loops, compiled for one instruction set with the kernels' flags. */
  struct Limits
  {
    /** Read and write the fields of blocks [n] that grid_to_points reads and
     * writes under a law without state variables; nothing is computed. */
    void (*stream)(PointBlock *, unsigned int n);

    /** So many multiplications, and additions, of one number. */
    double (*multiply_and_add)(unsigned long n);
  };

#ifdef CAISSON_X86_64
  const Limits &
  limits_x86_64();
  const Limits &
  limits_x86_64_v3();
  const Limits &
  limits_x86_64_v4();
#else
  const Limits &
  limits_generic();
#endif

  /** Those of select_kernels(@p instruction_set), which must not be null. */
  const Limits &
  limits_of(const char *instruction_set);
} // namespace CaissonMPM::Kernels

#endif
