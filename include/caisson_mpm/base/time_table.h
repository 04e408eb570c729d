// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A quantity over time, as the user lists it: pairs time : value.
#ifndef caisson_mpm_base_time_table_h
#define caisson_mpm_base_time_table_h

#include <string>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  /** (t, value): linear in between, constant at both ends. Units of t: s. */
  using TimeTable = std::vector<std::pair<double, double>>;

  /** Return the table of an entry whose pattern has checked the text. */
  TimeTable
  parse_time_table(const std::string &text);

  /** Throw BadInput, which names the @p entry, unless the times increase. */
  void
  check_time_table(const TimeTable &table, const std::string &entry);

  /** Return the value of a table, which is not empty, at any time. */
  double
  value_at(const TimeTable &table, const double time);
} // namespace CaissonMPM

#endif
