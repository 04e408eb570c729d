// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/fingerprint.h>

#include <cstdint>
#include <cstdio>

namespace CaissonMPM
{
  std::string
  fingerprint_of(const std::string &text)
  {
    std::uint64_t hash = 14695981039346656037u;
    for (const unsigned char c : text)
      hash = (hash ^ c) * 1099511628211u;
    char digits[17];
    std::snprintf(digits,
                  sizeof(digits),
                  "%016llx",
                  static_cast<unsigned long long>(hash));
    return digits;
  }
} // namespace CaissonMPM
