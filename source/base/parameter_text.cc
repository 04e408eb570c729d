// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/nearest_names.h>
#include <caisson_mpm/base/parameter_text.h>
#include <caisson_mpm/base/text.h>

#include <boost/algorithm/string/replace.hpp>
#include <boost/algorithm/string/trim_all.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace CaissonMPM::ParameterText
{
  namespace
  {
    /** The parameter files in the directory of the one that is missing. */
    std::vector<std::string>
    neighboring_files(const std::filesystem::path &missing_file)
    {
      namespace fs                     = std::filesystem;
      const fs::path           parent  = missing_file.parent_path();
      const fs::path           to_list = parent.empty() ? "." : parent;
      std::vector<std::string> result;
      std::error_code          error;
      for (const auto &item : fs::directory_iterator(to_list, error))
        if (item.path().extension() == ".prm")
          result.push_back((parent / item.path().filename()).string());
      return result;
    }
  } // namespace

  std::string
  condense(const std::string &text)
  {
    return boost::trim_fill_copy(text, " ");
  }

  std::string
  quote(const std::string &text)
  {
    std::string result = printable(text.substr(0, 60));
    std::replace(result.begin(), result.end(), '\n', '?');
    return "\"" + result + (text.size() > 60 ? "..." : "") + "\"";
  }

  std::string
  in_one_line(const std::string &value,
              const std::string &path,
              const std::string &place)
  {
    std::string line;
    for (std::size_t i = 0; i < value.size(); ++i)
      if (std::isspace(static_cast<unsigned char>(value[i])) != 0)
        line += ' ';
      else if (is_control(value, i))
        throw BadInput(place + ": " + quote(path) +
                       " has a control character, which would act on a "
                       "terminal: number " +
                       to_text(i + 1) + " of " + quote(value) +
                       ".\n  Remove it.");
      else
        line += value[i];
    return boost::trim_copy(line);
  }

  std::string
  with_plain_spaces(const std::string &text)
  {
    std::string result = text;
    for (const char *const space : {"\xC2\xA0", "\xE2\x80\x87", "\xE2\x80\xAF"})
      boost::replace_all(result, space, " ");
    return result;
  }

  std::string
  normalize_path(const std::string &path)
  {
    std::string        result;
    std::istringstream stream(path);
    for (std::string part; std::getline(stream, part, '/');)
      result += (result.empty() ? "" : "/") + condense(part);
    return result;
  }

  std::string
  read_text(const std::string &file_name, const std::string &place)
  {
    constexpr std::size_t largest_size = 16 * 1024 * 1024; // bytes
    const std::string     file = (place.empty() ? "The" : place + ": the") +
                             " parameter file " + quote(file_name);
    std::error_code error;
    if (file_name == "-")
      throw BadInput(file + " does not exist.\n  To read the standard input, "
                            "give /dev/stdin.");
    if (std::filesystem::is_directory(file_name, error))
      throw BadInput(file + " is a directory.\n  Give a file in it.");
    if (!std::filesystem::exists(file_name, error))
      throw BadInput(
        file + " does not exist." +
        did_you_mean(nearest_names(file_name, neighboring_files(file_name))) +
        "\n  A path is relative to the directory " +
        (place.empty() ? "in which caisson_mpm is started." :
                         "of the file that includes it."));

    std::ifstream stream(file_name, std::ios::binary);
    if (!stream)
      throw BadInput(file + " cannot be opened.\n  Is reading permitted?");
    std::string text(largest_size + 1, ' ');
    stream.read(text.data(), text.size());
    text.resize(stream.gcount());
    if (text.find('\0') != std::string::npos)
      throw BadInput(file + " is not a text file.");
    if (text.compare(0, 3, "\xEF\xBB\xBF") == 0) // byte order mark
      text.erase(0, 3);
    if (text.size() > largest_size)
      throw BadInput(file + " has more than 16 MB. Is it the right file?");
    boost::replace_all(text, "\r\n", "\n");
    boost::replace_all(text, "\r", "\n");
    return with_plain_spaces(text);
  }

  std::vector<Line>
  read_lines(const std::string &content)
  {
    std::vector<Line>  lines;
    std::istringstream stream(content);
    bool               continues = false;
    unsigned int       number    = 0;
    for (std::string raw; std::getline(stream, raw);)
      {
        ++number;
        const std::size_t mark = std::min(raw.find('#'), raw.size());
        std::string       text = boost::trim_copy(raw.substr(0, mark));
        if (!continues)
          lines.push_back({number, "", ""});
        continues = !text.empty() && text.back() == '\\';
        if (continues)
          text.pop_back();
        lines.back().text += text;
        lines.back().comment += raw.substr(mark);
      }
    return lines;
  }
} // namespace CaissonMPM::ParameterText
