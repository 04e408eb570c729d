// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The text of a parameter file, before anyone knows what it means.
#ifndef caisson_mpm_base_parameter_text_h
#define caisson_mpm_base_parameter_text_h

#include <string>
#include <vector>

namespace CaissonMPM::ParameterText
{
  /** Trim, and make one space of each run of white space. */
  std::string
  condense(const std::string &text);

  /** Return a piece of the user's text, safe to print and in quotation
   * marks. */
  std::string
  quote(const std::string &text);

  /** Return the value of an entry in one line: line feeds and tabs become
   * blanks. Throws BadInput for other control characters. */
  std::string
  in_one_line(const std::string &value,
              const std::string &path,
              const std::string &place);

  /** Make plain spaces of no-break spaces (UTF-8), which text that was copied
   * from a document has. */
  std::string
  with_plain_spaces(const std::string &text);

  /** Make "Soil/Friction angle" of " Soil /  Friction angle". */
  std::string
  normalize_path(const std::string &path);

  /** Read a file, with plain spaces and line ends; @p place is the line that
   * includes it, empty if none. Throws BadInput where it cannot be read. */
  std::string
  read_text(const std::string &file_name, const std::string &place);

  /** A line of the file, continuation lines joined to it, without white space
   * at its ends, and its comment. */
  struct Line
  {
    unsigned int number;
    std::string  text, comment;
  };

  std::vector<Line>
  read_lines(const std::string &content);
} // namespace CaissonMPM::ParameterText

#endif
