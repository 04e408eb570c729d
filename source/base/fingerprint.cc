// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/fingerprint.h>

#include <cstdio>

namespace CaissonMPM
{
  void
  Fingerprint::add(const std::string &text)
  {
    for (const unsigned char c : text)
      hash = (hash ^ c) * 1099511628211u;
  }

  std::string
  Fingerprint::digits() const
  {
    char digits[17];
    std::snprintf(digits,
                  sizeof(digits),
                  "%016llx",
                  static_cast<unsigned long long>(hash));
    return digits;
  }

  double
  Fingerprint::number() const
  {
    return static_cast<double>(hash & ((std::uint64_t(1) << 52) - 1));
  }

  std::string
  fingerprint_of(const std::string &text)
  {
    Fingerprint fingerprint;
    fingerprint.add(text);
    return fingerprint.digits();
  }
} // namespace CaissonMPM
