// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Reading a parameter file (and --set) into a ParameterHandler, with messages
// from which the user can repair the input.
#ifndef caisson_mpm_base_parameter_file_h
#define caisson_mpm_base_parameter_file_h

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * Where each entry got its value, for the messages of checks that come
   * later:
   *
   * @code
   * throw BadInput("The tip starts at " + ... + " m (" +
   *                origins.origin("Caisson/Initial embedment") + "), ...");
   * @endcode
   */
  class ParameterOrigins
  {
  public:
    /** Remember that the entry "Section/Sub/Entry" was set at this place. */
    void
    record(const std::string &path, const std::string &place);

    /** Add a note for the user that is not an error. */
    void
    add_warning(const std::string &text);

    /** "set in prm/jack.prm:12", "set by --set", or "the default". */
    std::string
    origin(const std::string &path) const;

    bool
    is_set(const std::string &path) const;

    /** Notes on the input, to be printed: old names of entries. */
    const std::vector<std::string> &
    warnings() const;

  private:
    std::map<std::string, std::string> places;
    std::vector<std::string>           notes;
  };

  /**
   * Read the file and then the overrides ("Section/Sub/Entry=value") into
   * @p prm, in which all entries have been declared; classes derived from
   * ParameterAcceptor declare theirs in ParameterAcceptor::prm. An empty file
   * name reads the overrides only. An override replaces the file's value.
   *
   * The syntax is deal.II's (subsection, set, end; "#" begins a comment, "\"
   * at the end of a line continues it), with three differences that keep
   * mistakes from passing silently: "include" is refused, an entry may be set
   * only once, and a comment always ends with its line.
   *
   * Throws BadInput at the first thing that is wrong: a file that cannot be
   * read or that sets nothing, a line that cannot be read, an unknown
   * subsection or entry (with the nearest known ones), a value that is not
   * allowed (with those that are, and the entry's documentation), an entry
   * set twice, an unbalanced subsection. Not collective: every rank reads
   * the file and comes to the same result.
   */
  ParameterOrigins
  read_parameters(dealii::ParameterHandler       &prm,
                  const std::string              &file_name,
                  const std::vector<std::string> &overrides = {});
} // namespace CaissonMPM

#endif
