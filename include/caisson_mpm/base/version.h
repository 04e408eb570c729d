// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The version of the program, which CMakeLists.txt states.
#ifndef caisson_mpm_base_version_h
#define caisson_mpm_base_version_h

namespace CaissonMPM
{
  /** Return the version, as in 1.2.3. One source contains it, so that a new
   * version recompiles no other. */
  const char *
  program_version();
} // namespace CaissonMPM

#endif
