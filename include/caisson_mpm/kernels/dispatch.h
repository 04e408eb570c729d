// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The choice of the instruction set at start-up.
#ifndef caisson_mpm_kernels_dispatch_h
#define caisson_mpm_kernels_dispatch_h

#include <caisson_mpm/kernels/instruction_set.h>
#include <caisson_mpm/kernels/layout.h>

namespace CaissonMPM::Kernels
{
#ifdef CAISSON_X86_64
  /** The names that select_kernels() knows besides "auto". */
  constexpr const char *instruction_sets = "SSE2|AVX2|AVX-512";

  /** The kernels for SSE2, AVX2 and AVX-512: one source, three objects. */
  const KernelTable &
  kernels_x86_64();
  const KernelTable &
  kernels_x86_64_v3();
  const KernelTable &
  kernels_x86_64_v4();
#else
  /** The names that select_kernels() knows besides "auto". */
  constexpr const char *instruction_sets = "generic";

  /** The kernels for what the compiler is asked for: one object. */
  const KernelTable &
  kernels_generic();
#endif

  /**
   * The kernels named @p instruction_set, one of instruction_sets, or the
   * widest that this CPU has for "auto". Null if the CPU lacks it or the
   * name is unknown.
   */
  const KernelTable *
  select_kernels(const char *instruction_set);
} // namespace CaissonMPM::Kernels

#endif
