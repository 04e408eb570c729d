// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Pieces of JSON (RFC 8259) as text, for the few small files that are written.
#ifndef caisson_mpm_output_json_h
#define caisson_mpm_output_json_h

#include <string>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  namespace Json
  {
    /** Names and values of an object; the values are JSON already. */
    using Members = std::vector<std::pair<std::string, std::string>>;

    /** Quoted and escaped. */
    std::string
    text(const std::string &value);

    /** The shortest text that gives the same double; null if not finite. */
    std::string
    number(const double value);

    std::string
    integer(const unsigned long value);

    std::string
    boolean(const bool value);

    /** One member per line, indented by @p indent and two more blanks. */
    std::string
    object(const Members &members, const unsigned int indent = 0);

    /** One object per line; @p items are JSON already. */
    std::string
    list(const std::vector<std::string> &items);

    /** All members on one line. */
    std::string
    flat_object(const Members &members);

    /** The members with numbers as values. */
    Members
    numbers(const std::vector<std::pair<std::string, double>> &values);
  } // namespace Json
} // namespace CaissonMPM

#endif
