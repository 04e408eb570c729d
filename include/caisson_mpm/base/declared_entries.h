// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The entries that the sections of the program have declared, as a list that
// can be searched and printed.
#ifndef caisson_mpm_base_declared_entries_h
#define caisson_mpm_base_declared_entries_h

#include <deal.II/base/patterns.h>

#include <list>
#include <memory>
#include <string>
#include <vector>

namespace CaissonMPM
{
  class Section;

  /** What an entry decides. */
  enum class Influence
  {
    ground, // the state of the ground, too
    motion, // how the body moves, and what its walls and the water do to it: it
            // may change in a run after an installation
    none    // nothing of the state at a given time
  };

  /** An entry as it was declared; its path is "Section/Sub/Entry". */
  struct EntryRecord
  {
    const Section           *owner;
    std::vector<std::string> subsections;
    std::string              name, path;
    std::string              default_value;
    std::string              unit;          // empty where there is none
    std::string              documentation; // with the unit
    Influence                influence;

    std::shared_ptr<const dealii::Patterns::PatternBase> pattern;

    /** The value that it has now. */
    std::string
    value() const;
  };

  /** All entries in the order of declaration, those of a section together. */
  const std::list<EntryRecord> &
  declared_entries();

  /** The entry of this path, or a null pointer. */
  const EntryRecord *
  find_entry(const std::string &path);

  std::vector<std::string>
  entry_paths();

  /** The paths of all sections with entries, and of those around them. */
  std::vector<std::string>
  section_paths();

  bool
  has_section(const std::string &path);

  /**
   * All entries with their documentation, the values allowed, the default
   * and the value in effect, in the order of declaration. The text can be
   * read again as a parameter file.
   */
  std::string
  describe_parameters();

  /**
   * The same for those entries alone with a word in their path, or, where
   * there are none, in their documentation; capitals do not count. Of sections
   * that repeat the same entries, such as layers, the first one stands for
   * those in which an entry has its default. Throws BadInput, with the nearest
   * names, where no entry has the word.
   */
  std::string
  describe_parameters(const std::string &word);
} // namespace CaissonMPM

#endif
