// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/declared_entries.h>
#include <caisson_mpm/simulation/physics_text.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <sstream>

namespace CaissonMPM
{
  namespace
  {
    bool
    begins_with(const std::string &text, const std::string &word)
    {
      return text.compare(0, word.size(), word) == 0;
    }

    /** The entries that describe how the body moves, and what its walls and the
     * water do to it, as the beginnings of their paths. */
    const std::vector<std::string> free_after_installation = {
      "Title",
      "Installation/",
      "Rigid body/Motion",
      "Rigid body/Velocity",
      "Rigid body/Ramp time",
      "Rigid body/Largest Mach number",
      "Rigid body/Lowering",
      "Rigid body/Force table",
      "Rigid body/Inertia",
      "Rigid body/Release time",
      "Rigid body/Submerged weight",
      "Rigid body/Friction angle of the ",
      "Rigid body/Adhesion of the ",
      "Water/",
      "Loads/",
      "Method/Local damping",
      "Time/Courant number",
      "Time/Inertia tolerance",
      "Time/Time step",
      "Grid/Smallest row height",
      "Grid/Largest number of cells",
      "Material points/Largest number of points",
      "Method/Instruction set"};

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

    /** Whether an entry has no influence on the state at a given time. */
    bool
    is_not_physics(const DeclaredEntry &entry)
    {
      for (const std::string free : {"Output/",
                                     "Run control/",
                                     "Verification/",
                                     "Design/",
                                     "Time/End",
                                     "Installation/End"})
        if (begins_with(entry.path, free))
          return true;
      return false;
    }
  } // namespace



  std::string
  physics(const dealii::ParameterHandler &prm)
  {
    const DeclaredEntries entries(prm);
    std::string           result;
    for (const DeclaredEntry &entry : entries.all())
      if (!is_not_physics(entry))
        result += entry.path + " = " + entry.value + "\n";
    return result;
  }



  std::string
  changed_physics(const dealii::ParameterHandler &prm)
  {
    const DeclaredEntries entries(prm);
    std::set<std::string> lines;
    for (const DeclaredEntry &entry : entries.all())
      if (!is_not_physics(entry) && entry.value != entry.default_value &&
          entry.path != "Title" && entry.path != "Method/Instruction set")
        lines.insert(entry.path + " = " + entry.value + "\n");
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



  bool
  may_change_after_installation(const std::string &path)
  {
    const bool is_permeability =
      begins_with(path, "Soil/Layer ") &&
      path.find("/Permeability") != std::string::npos;
    return is_permeability || std::any_of(free_after_installation.begin(),
                                          free_after_installation.end(),
                                          [&](const std::string &free) {
                                            return begins_with(path, free);
                                          });
  }
} // namespace CaissonMPM
