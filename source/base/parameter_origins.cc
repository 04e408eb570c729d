// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/declared_entries.h>
#include <caisson_mpm/base/parameter_origins.h>
#include <caisson_mpm/base/text.h>

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <cctype>

namespace CaissonMPM
{
  namespace
  {
    /** Whether the path is this entry or a section that contains it. */
    bool
    contains(const std::string &path, const std::string &entry)
    {
      return entry == path || boost::starts_with(entry, path + "/");
    }

    bool
    is_part_of_name(const char c)
    {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '/';
    }

    /** Find the path as a whole, not as a part of a longer one. */
    std::size_t
    find_path(const std::string &text, const std::string &path)
    {
      std::size_t at = text.find(path);
      while (at != std::string::npos &&
             ((at > 0 && is_part_of_name(text[at - 1])) ||
              (at + path.size() < text.size() &&
               is_part_of_name(text[at + path.size()]))))
        at = text.find(path, at + 1);
      return at;
    }

    /** Return the paths of the entries that a text names, in its order. */
    std::vector<std::string>
    entries_named_in(const std::string &text)
    {
      // of two that begin at the same place, the longer one is meant
      std::map<std::size_t, std::string> found;
      for (const std::string &path : entry_paths())
        if (const std::size_t at = find_path(text, path);
            path.find('/') != std::string::npos && at != std::string::npos &&
            path.size() > found[at].size())
          found[at] = path;
      std::vector<std::string> result;
      for (const auto &[at, path] : found)
        if (!path.empty())
          result.push_back(path);
      return result;
    }
  } // namespace

  void
  ParameterOrigins::record(const std::string &path,
                           const std::string &place,
                           const bool         may_be_unused,
                           const bool         is_assumed,
                           const std::string &directory)
  {
    places[path] = {place, may_be_unused, is_assumed, directory};
  }

  std::vector<std::string>
  ParameterOrigins::assumed() const
  {
    std::vector<std::string> result;
    for (const auto &[path, setting] : places)
      if (setting.is_assumed)
        result.push_back(path);
    return result;
  }

  void
  ParameterOrigins::add_warning(const std::string &text)
  {
    notes.push_back(text);
    doubts.push_back(text);
  }

  void
  ParameterOrigins::add_cosmetic_warning(const std::string &text)
  {
    add_warning(text);
    cosmetic.insert(text);
  }

  void
  ParameterOrigins::add_limit(const std::string &text)
  {
    notes.push_back(text);
  }

  void
  ParameterOrigins::add_unused(const std::vector<std::string> &paths,
                               const std::string              &reason)
  {
    const std::vector<std::string> used = entries_named_in(reason);
    std::string                    first;
    unsigned int                   n_unused = 0;
    for (const auto &[entry, place] : places)
      {
        const auto has = [&entry = entry](const std::string &path) {
          return contains(path, entry);
        };
        if (place.may_be_unused ||
            std::none_of(paths.begin(), paths.end(), has) ||
            std::find(used.begin(), used.end(), entry) != used.end())
          continue;
        if (++n_unused == 1)
          first = place.text + ": \"" + entry + "\"";
      }
    if (n_unused == 0)
      return;
    const std::string others =
      n_unused == 1 ? " is" :
      n_unused == 2 ? " and one more entry are" :
                      " and " + to_text(n_unused - 1) + " more entries are";
    add_warning(first + others + " set but not used: " + reason + ".");
  }

  std::string
  ParameterOrigins::origin(const std::string &path) const
  {
    const auto place = places.find(path);
    if (place == places.end())
      return "the default";
    // The quoted text of --set would only repeat what a check says anyway.
    const std::string &text = place->second.text;
    return text.compare(0, 2, "--") == 0 ?
             "set by " + text.substr(0, text.find(' ')) :
             "set in " + text;
  }

  bool
  ParameterOrigins::is_set(const std::string &path) const
  {
    return places.count(path) > 0;
  }

  std::string
  ParameterOrigins::directory_of(const std::string &path) const
  {
    const auto place = places.find(path);
    return place == places.end() ? "" : place->second.directory;
  }

  std::string
  ParameterOrigins::places_of_entries_in(const std::string &message) const
  {
    std::string result;
    for (const std::string &path : entries_named_in(message))
      result += "\n  " + path +
                (is_set(path) ? " is " + origin(path) : " has its default") +
                ".";
    return result;
  }
} // namespace CaissonMPM
