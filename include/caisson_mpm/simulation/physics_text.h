// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The parameters of a scene that its state depends on, as text.
#ifndef caisson_mpm_simulation_physics_text_h
#define caisson_mpm_simulation_physics_text_h

#include <string>
#include <vector>

namespace CaissonMPM
{
  /** Return all entries that influence the state at a given time, one per line
   * in the order of their declaration: a run may only be continued with the
   * same ones. */
  std::string
  physics();

  /** Return those that are not defaults, in alphabetical order: a new entry or
   * another order of declaration does not change the text. */
  std::string
  changed_physics();

  /** An entry that differs between two texts of physics(). */
  struct ChangedEntry
  {
    std::string path, before, now;
  };

  /** Return the entries that differ between two texts of physics(), in the
   * order of the second; an entry that one of them lacks has an empty value
   * there. */
  std::vector<ChangedEntry>
  changes_between(const std::string &before, const std::string &now);

  /** Return the value of an entry in a text of physics(), empty where it is not
   * there. */
  std::string
  value_of(const std::string &path, const std::string &physics);
} // namespace CaissonMPM

#endif
