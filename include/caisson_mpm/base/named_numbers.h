// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A list of numbers with their names, in an order.
#ifndef caisson_mpm_base_named_numbers_h
#define caisson_mpm_base_named_numbers_h

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  using NamedNumbers = std::vector<std::pair<std::string, double>>;

  /** Return the first number of this name, if there is one. */
  inline std::optional<double>
  number_named(const std::string &name, const NamedNumbers &numbers)
  {
    const auto found =
      std::find_if(numbers.begin(), numbers.end(), [&](const auto &entry) {
        return entry.first == name;
      });
    return found == numbers.end() ? std::nullopt :
                                    std::make_optional(found->second);
  }
} // namespace CaissonMPM

#endif
