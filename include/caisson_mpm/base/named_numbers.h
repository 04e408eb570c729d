// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A list of numbers with their names, in an order.
#ifndef caisson_mpm_base_named_numbers_h
#define caisson_mpm_base_named_numbers_h

#include <string>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  using NamedNumbers = std::vector<std::pair<std::string, double>>;
} // namespace CaissonMPM

#endif
