// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Suggestions for mistyped names: the known names with the smallest edit
// distance, and the sentence that offers them to the user.
#ifndef caisson_mpm_base_nearest_names_h
#define caisson_mpm_base_nearest_names_h

#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * The number of characters to insert, delete, replace or swap with their
   * neighbor that turn one name into the other. Upper and lower case count
   * as equal.
   */
  unsigned int
  edit_distance(const std::string &a, const std::string &b);

  /**
   * At most three of the known names that are close to the given one, the
   * nearest first; none where no name is close. Names may be paths
   * ("Soil/Friction angle"): a path in the same subsection is preferred, and
   * one with the same last part in another subsection is found as well.
   */
  std::vector<std::string>
  nearest_names(const std::string              &name,
                const std::vector<std::string> &known_names);

  /**
   * The known name that a symbol or an abbreviation of the field stands for, as
   * the last part of a path: "Time/Courant number" for "Time/CFL". Of names in
   * several subsections, that in the subsection of the path, else the first.
   * None where it is no symbol. Upper and lower case count as equal.
   */
  std::vector<std::string>
  names_of_symbol(const std::string              &path,
                  const std::vector<std::string> &known_names);

  /**
   * The line of an error message that offers the names (indented, with the
   * line break before it); empty where there are none.
   */
  std::string
  did_you_mean(const std::vector<std::string> &names);
} // namespace CaissonMPM

#endif
