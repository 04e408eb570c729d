// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/output/json.h>

#include <charconv>
#include <cmath>
#include <cstdio>

namespace CaissonMPM
{
  namespace Json
  {
    std::string
    text(const std::string &value)
    {
      std::string result = "\"";
      for (const char c : as_utf8(value))
        if (c == '"' || c == '\\')
          result += std::string("\\") + c;
        else if (c == '\n')
          result += "\\n";
        else if (c == '\t')
          result += "\\t";
        else if (static_cast<unsigned char>(c) < 0x20)
          {
            char code[8];
            std::snprintf(code, sizeof(code), "\\u%04x", c);
            result += code;
          }
        else
          result += c;
      return result + "\"";
    }

    std::string
    number(const double value)
    {
      if (!std::isfinite(value))
        return "null";
      char       buffer[32];
      const auto end = std::to_chars(buffer, buffer + sizeof(buffer), value);
      return std::string(buffer, end.ptr);
    }

    std::string
    integer(const unsigned long value)
    {
      return to_text(value);
    }

    std::string
    boolean(const bool value)
    {
      return value ? "true" : "false";
    }

    namespace
    {
      std::string
      join(const std::string              &open,
           const std::vector<std::string> &items,
           const std::string              &separator,
           const std::string              &close)
      {
        std::string result = open;
        for (std::size_t i = 0; i < items.size(); ++i)
          result += items[i] + (i + 1 < items.size() ? separator : "");
        return result + close;
      }

      std::vector<std::string>
      lines(const Members &members)
      {
        std::vector<std::string> result;
        for (const auto &[name, value] : members)
          result.push_back(text(name) + ": " + value);
        return result;
      }
    } // namespace

    std::string
    object(const Members &members, const unsigned int indent)
    {
      if (members.empty())
        return "{}";
      const std::string outer = "\n" + std::string(indent, ' ');
      const std::string inner = outer + "  ";
      return join("{" + inner, lines(members), "," + inner, outer + "}");
    }

    std::string
    list(const std::vector<std::string> &items)
    {
      return items.empty() ? "[]" : join("[\n  ", items, ",\n  ", "\n]");
    }

    std::string
    flat_object(const Members &members)
    {
      return join("{", lines(members), ", ", "}");
    }

    Members
    numbers(const std::vector<std::pair<std::string, double>> &values)
    {
      Members result;
      for (const auto &[name, value] : values)
        result.emplace_back(name, number(value));
      return result;
    }
  } // namespace Json
} // namespace CaissonMPM
