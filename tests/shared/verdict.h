// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a C++ test prints: a heading for each topic, and a line for each check.
#ifndef caisson_mpm_tests_verdict_h
#define caisson_mpm_tests_verdict_h

#include <cstdio>

/** Print what the following lines are about. */
inline void
heading(const char *what)
{
  std::printf("\n=== %s\n", what);
}

/** Print whether an error is small enough; if not, also the error. */
inline void
verdict(const char *what, const double error, const double tolerance)
{
  std::printf("%s <= %g: %s\n",
              what,
              tolerance,
              error <= tolerance ? "yes" : "no");
  if (!(error <= tolerance))
    std::printf("  found %.3e\n", error);
}

#endif
