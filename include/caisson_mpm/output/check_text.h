// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Reading the texts of checks and observations.
#ifndef caisson_mpm_output_check_text_h
#define caisson_mpm_output_check_text_h

#include <map>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /** A number that stands alone in its text. Throws BadInput with @p place and
   * what the number is. */
  double
  parse_number(const std::string &text,
               const std::string &place,
               const std::string &what);

  /** Throws BadInput with @p place where @p name is not among the names,
   * listing them and the nearest ones. */
  void
  check_known(const std::string              &name,
              const std::vector<std::string> &known,
              const std::string              &place,
              const std::string              &kind);

  /** The keys of a map. */
  template <typename Value>
  std::vector<std::string>
  names_of(const std::map<std::string, Value> &entries)
  {
    std::vector<std::string> names;
    for (const auto &entry : entries)
      names.push_back(entry.first);
    return names;
  }
} // namespace CaissonMPM

#endif
