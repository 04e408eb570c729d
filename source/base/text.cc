// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/text.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace CaissonMPM
{
  std::string
  to_text(const double value)
  {
    for (int n_digits = 6; n_digits <= 9; ++n_digits)
      {
        const std::string text = to_text(value, n_digits);
        if (std::strtod(text.c_str(), nullptr) == value)
          return text;
      }
    return to_text(value, 6);
  }

  std::string
  to_text(const double value, const int significant_digits)
  {
    char buffer[64];
    std::snprintf(buffer, sizeof(buffer), "%.*g", significant_digits, value);
    return buffer;
  }

  std::string
  rough(const double value)
  {
    if (value < 100. || value > 1e15)
      return to_text(value, 2);
    const double unit = std::pow(10., std::floor(std::log10(value)) - 1.);
    return to_text(static_cast<unsigned long>(std::round(value / unit) * unit));
  }

  std::optional<double>
  number_in(const std::string &text)
  {
    char        *end   = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0')
      return {};
    return value;
  }

  bool
  is_control(const std::string &text, const std::size_t place)
  {
    const unsigned char c    = text[place],
                        next = place + 1 < text.size() ? text[place + 1] : 0;
    return c < 0x20 || c == 0x7f || (c == 0xc2 && next >= 0x80 && next < 0xa0);
  }

  std::string
  printable(const std::string &text)
  {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] == '\n' || !is_control(text, i))
        result += text[i];
      else
        {
          result += '?';
          i += text[i] == '\xc2'; // two bytes
        }
    return result;
  }

  namespace
  {
    /** The bytes of the UTF-8 character that begins with this one, 0 if none
     * does. */
    std::size_t
    length_of_character(const unsigned char first)
    {
      return first < 0x80                  ? 1 :
             first >= 0xc2 && first < 0xe0 ? 2 :
             first >= 0xe0 && first < 0xf0 ? 3 :
             first >= 0xf0 && first < 0xf5 ? 4 :
                                             0;
    }

    bool
    is_utf8(const std::string &text)
    {
      for (std::size_t i = 0; i < text.size();)
        {
          const std::size_t n = length_of_character(text[i]);
          if (n == 0 || i + n > text.size())
            return false;
          for (std::size_t k = 1; k < n; ++k)
            if ((text[i + k] & 0xc0) != 0x80)
              return false;
          i += n;
        }
      return true;
    }
  } // namespace

  std::string
  as_utf8(const std::string &text)
  {
    if (is_utf8(text))
      return text;
    std::string result;
    for (const char c : text)
      if (const unsigned char code = c; code < 0x80)
        result += c;
      else
        result += {static_cast<char>(0xc0 | code >> 6),
                   static_cast<char>(0x80 | (code & 0x3f))};
    return result;
  }

  std::string
  percent(const double share, const int significant_digits)
  {
    return to_text(100. * share, significant_digits) + " %";
  }
} // namespace CaissonMPM
