// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The entries that have been declared in a ParameterHandler, as a list that
// can be searched and printed.
#ifndef caisson_mpm_base_declared_entries_h
#define caisson_mpm_base_declared_entries_h

#include <caisson_mpm/base/section.h>

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /** One entry; its path is "Section/Sub/Entry". */
  struct DeclaredEntry
  {
    std::vector<std::string> subsections;
    std::string              name;
    std::string              path;
    std::string              value;
    std::string              default_value;
    std::string              documentation;
    std::string              unit; // empty where there is none
    /** As Patterns::PatternBase::description() writes it. */
    std::string pattern;
    Influence   influence = Influence::ground;
  };

  /**
   * All declared entries, in the order of declaration, and all subsections.
   * A snapshot: values that are set later are not seen.
   *
   * @code
   * const DeclaredEntries entries(prm);
   * if (const DeclaredEntry *entry = entries.find("Soil/Density"))
   *   std::cout << entry->documentation;
   * @endcode
   */
  class DeclaredEntries
  {
  public:
    explicit DeclaredEntries(const dealii::ParameterHandler &prm);

    /** The entry of this path, or a null pointer. */
    const DeclaredEntry *
    find(const std::string &path) const;

    bool
    has_subsection(const std::string &path) const
    {
      return subsections.count(path) > 0;
    }

    /** The paths of all entries. */
    std::vector<std::string>
    entry_paths() const;

    std::vector<std::string>
    subsection_paths() const
    {
      return {subsections.begin(), subsections.end()};
    }

    const std::vector<DeclaredEntry> &
    all() const
    {
      return entries;
    }

  private:
    /** Add all that the tree holds below the subsections @p above. */
    void
    collect(const boost::property_tree::ptree &tree,
            const std::vector<std::string>    &above);

    std::vector<DeclaredEntry>         entries;
    std::map<std::string, std::size_t> index;
    std::set<std::string>              subsections;
  };

  /**
   * The values that a pattern accepts, in words: "a number from 0 to 90" for
   * "[Double 0...90 (inclusive)]".
   */
  std::string
  allowed_values(const std::string &pattern);

  /** The words among which a pattern lets the user choose; none where it is
   * another kind of pattern. */
  std::vector<std::string>
  choices_of(const std::string &pattern);

  /**
   * All entries with their documentation, the values allowed, the default
   * and the value in effect, in the order of declaration. The text can be
   * read again as a parameter file.
   */
  std::string
  describe_parameters(const dealii::ParameterHandler &prm);

  /**
   * The same for those entries alone with a word in their path, or, where
   * there are none, in their documentation; capitals do not count. Of sections
   * that repeat the same entries, such as layers, the first one stands for
   * those in which an entry has its default. Throws BadInput, with the nearest
   * names, where no entry has the word.
   */
  std::string
  describe_parameters(const dealii::ParameterHandler &prm,
                      const std::string              &word);
} // namespace CaissonMPM

#endif
