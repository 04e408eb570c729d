// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Where the entries of a run were set, for messages about them.
#ifndef caisson_mpm_base_parameter_origins_h
#define caisson_mpm_base_parameter_origins_h

#include <map>
#include <set>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * Knows for each entry where it got its value, and collects notes on the
   * input for the user. A check need not ask for places: it names entries by
   * their paths, and the program adds with places_of_entries_in() where they
   * were set.
   */
  class ParameterOrigins
  {
  public:
    /**
     * Remember that the entry "Section/Sub/Entry" was set at this place;
     * @p may_be_unused says that add_unused() passes it over, @p is_assumed
     * that the comment behind it says ASSUMED, and @p directory where the file
     * lies that sets it.
     */
    void
    record(const std::string &path,
           const std::string &place,
           const bool         may_be_unused = false,
           const bool         is_assumed    = false,
           const std::string &directory     = "");

    /** Warn of what may be a mistake in the input. */
    void
    add_warning(const std::string &text);

    /** Warn of what may be a mistake, but changes no result. */
    void
    add_cosmetic_warning(const std::string &text);

    /** Warn of what the program is known to do less well in such a scene; it is
     * no mistake to ask for it. */
    void
    add_limit(const std::string &text);

    /**
     * Warn if the user has set entries that this run does not use; each path
     * is that of an entry or of a section. @p reason is a clause ("Rigid
     * body/Tip is flat"); the entries that it names are used. What an included
     * file sets is passed over, because it may serve other runs, and so is an
     * entry that is set to its default, as --print-parameters does.
     */
    void
    add_unused(const std::vector<std::string> &paths,
               const std::string              &reason);

    /** Return "set in prm/jack.prm:12", "set by --set" or another option, or
     * "the default". */
    std::string
    origin(const std::string &path) const;

    bool
    is_set(const std::string &path) const;

    /** Return the directory of the file that sets the entry, for a path in it;
     * of --set, that of the scene. Empty is the working directory. */
    std::string
    directory_of(const std::string &path) const;

    /**
     * Return lines to append to a message (each after a line break) that say
     * where the entries were set that the message names by their paths.
     */
    std::string
    places_of_entries_in(const std::string &message) const;

    /** The entries whose comments say ASSUMED. */
    std::vector<std::string>
    assumed() const;

    /** All warnings, to be printed. */
    const std::vector<std::string> &
    warnings() const
    {
      return notes;
    }

    /** Whether a warning is one of add_cosmetic_warning(). */
    bool
    is_cosmetic(const std::string &warning) const
    {
      return cosmetic.count(warning) > 0;
    }

    /** The warnings of add_warning() and add_unused(). */
    const std::vector<std::string> &
    mistakes() const
    {
      return doubts;
    }

  private:
    struct Setting
    {
      std::string text;
      bool        may_be_unused, is_assumed;
      std::string directory;
    };

    std::map<std::string, Setting> places;
    std::vector<std::string>       notes, doubts;
    std::set<std::string>          cosmetic;
  };
} // namespace CaissonMPM

#endif
