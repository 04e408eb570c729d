// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Whether the kernels use the intrinsics of x86-64. On other processors, and
// with CAISSON_GENERIC_LANES (the option CAISSON_MPM_GENERIC_LANES of cmake),
// they use nothing but the vector extensions of the compiler.
#ifndef caisson_mpm_kernels_instruction_set_h
#define caisson_mpm_kernels_instruction_set_h

#if defined(__x86_64__) && !defined(CAISSON_GENERIC_LANES)
#  define CAISSON_X86_64
#  ifdef __AVX__
#    define CAISSON_AVX
#  endif
#  ifdef __AVX512F__
#    define CAISSON_AVX512F
#  endif
#  ifdef __AVX512DQ__
#    define CAISSON_AVX512DQ
#  endif
#endif

#endif
