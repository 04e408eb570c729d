// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/kernels/dispatch.h>

#include <cstring>

namespace CaissonMPM::Kernels
{
#ifdef CAISSON_X86_64
  const KernelTable *
  select_kernels(const char *instruction_set)
  {
    const bool has_v4 =
      __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd");
    const bool has_v3 = __builtin_cpu_supports("avx2") &&
                        __builtin_cpu_supports("fma") &&
                        __builtin_cpu_supports("bmi2");

    const bool automatic = std::strcmp(instruction_set, "auto") == 0;
    if (has_v4 && (automatic || !std::strcmp(instruction_set, "AVX-512")))
      return &kernels_x86_64_v4();
    if (has_v3 && (automatic || !std::strcmp(instruction_set, "AVX2")))
      return &kernels_x86_64_v3();
    if (automatic || !std::strcmp(instruction_set, "SSE2"))
      return &kernels_x86_64();
    return nullptr;
  }
#else
  const KernelTable *
  select_kernels(const char *instruction_set)
  {
    const bool is_known = std::strcmp(instruction_set, "auto") == 0 ||
                          std::strcmp(instruction_set, "generic") == 0;
    return is_known ? &kernels_generic() : nullptr;
  }
#endif
} // namespace CaissonMPM::Kernels
