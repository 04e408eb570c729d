// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/text.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace CaissonMPM
{
  std::string
  to_text(const double value)
  {
    for (int n_digits = 6; n_digits <= 9; ++n_digits)
      {
        const std::string text = to_text(value, n_digits);
        if (std::strtod(text.c_str(), nullptr) == value)
          return text;
      }
    return to_text(value, 6);
  }

  std::string
  to_text(const double value, const int significant_digits)
  {
    char buffer[64];
    std::snprintf(buffer, sizeof(buffer), "%.*g", significant_digits, value);
    return buffer;
  }

  std::string
  rough(const double value)
  {
    if (value < 100. || value > 1e15)
      return to_text(value, 2);
    const double unit = std::pow(10., std::floor(std::log10(value)) - 1.);
    return to_text(static_cast<unsigned long>(std::round(value / unit) * unit));
  }

  std::string
  percent(const double share, const int significant_digits)
  {
    return to_text(100. * share, significant_digits) + " %";
  }
} // namespace CaissonMPM
