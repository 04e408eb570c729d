// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The only way in which the program turns numbers into text for its user, and
// what it does to text that comes from outside.
#ifndef caisson_mpm_base_text_h
#define caisson_mpm_base_text_h

#include <charconv>
#include <optional>
#include <string>
#include <type_traits>

namespace CaissonMPM
{
  /**
   * Write a number for a message: as short as it can be read back if that
   * takes at most 9 significant digits (0.1 becomes "0.1", 1.2e-7 becomes
   * "1.2e-07"), and with 6 significant digits otherwise.
   */
  std::string
  to_text(const double value);

  /** Write a number with so many significant digits, as printf("%.*g"). */
  std::string
  to_text(const double value, const int significant_digits);

  /** Write a number with two significant digits, and without an exponent where
   * it is large: 1300000. */
  std::string
  rough(const double value);

  /** Write a share as a percentage: 0.0123 becomes "1.2 %". */
  std::string
  percent(const double share, const int significant_digits);

  /** Return the number that stands alone in its text, if there is one. */
  std::optional<double>
  number_in(const std::string &text);

  /** Return whether the character at this place is one that controls a
   * terminal, in ASCII or, of two bytes, in UTF-8. Line feeds and tabs count.
   */
  bool
  is_control(const std::string &text, const std::size_t place);

  /** Write a text for the terminal: what would control it becomes "?", but for
   * line feeds. */
  std::string
  printable(const std::string &text);

  /** Return the text in UTF-8: if it is not, it is taken for Latin-1. */
  std::string
  as_utf8(const std::string &text);

  /** Write a whole number with all its digits. */
  template <typename Integer>
  std::enable_if_t<std::is_integral<Integer>::value, std::string>
  to_text(const Integer value)
  {
    char buffer[32];
    return {buffer, std::to_chars(buffer, buffer + sizeof(buffer), value).ptr};
  }
} // namespace CaissonMPM

#endif
