// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A short text that tells two longer ones apart.
#ifndef caisson_mpm_base_fingerprint_h
#define caisson_mpm_base_fingerprint_h

#include <string>

namespace CaissonMPM
{
  /** Return 16 hexadecimal digits that differ where @p text does: the hash
   * FNV-1a with 64 bits (Fowler, Noll and Vo). */
  std::string
  fingerprint_of(const std::string &text);
} // namespace CaissonMPM

#endif
