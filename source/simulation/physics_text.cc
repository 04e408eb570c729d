// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/declared_entries.h>
#include <caisson_mpm/simulation/physics_text.h>

#include <map>
#include <numeric>
#include <set>
#include <sstream>

namespace CaissonMPM
{
  namespace
  {
    /** The entries of a text of physics(), in its order. */
    std::vector<std::pair<std::string, std::string>>
    entries_of(const std::string &physics)
    {
      const std::string                                equals = " = ";
      std::vector<std::pair<std::string, std::string>> entries;
      std::istringstream                               lines(physics);
      for (std::string line; std::getline(lines, line);)
        if (const auto place = line.find(equals); place != std::string::npos)
          entries.emplace_back(line.substr(0, place),
                               line.substr(place + equals.size()));
      return entries;
    }
  } // namespace

  std::string
  physics()
  {
    std::string result;
    for (const EntryRecord &entry : declared_entries())
      if (entry.influence != Influence::none)
        result += entry.path + " = " + entry.value() + "\n";
    return result;
  }

  std::string
  changed_physics()
  {
    std::set<std::string> lines;
    for (const EntryRecord &entry : declared_entries())
      if (entry.influence != Influence::none &&
          entry.value() != entry.default_value && entry.path != "Title" &&
          entry.path != "Method/Instruction set")
        lines.insert(entry.path + " = " + entry.value() + "\n");
    return std::accumulate(lines.begin(), lines.end(), std::string());
  }

  std::vector<ChangedEntry>
  changes_between(const std::string &before, const std::string &now)
  {
    std::map<std::string, std::string> old;
    for (const auto &entry : entries_of(before))
      old.insert(entry);
    std::vector<ChangedEntry> changes;
    for (const auto &[path, value] : entries_of(now))
      {
        const auto found = old.find(path);
        if (found == old.end() || found->second != value)
          changes.push_back(
            {path, found == old.end() ? "" : found->second, value});
        if (found != old.end())
          old.erase(found);
      }
    for (const auto &[path, value] : old)
      changes.push_back({path, value, ""});
    return changes;
  }

  std::string
  value_of(const std::string &path, const std::string &physics)
  {
    for (const auto &entry : entries_of(physics))
      if (entry.first == path)
        return entry.second;
    return "";
  }
} // namespace CaissonMPM
