// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/declared_entries.h>
#include <caisson_mpm/simulation/physics_text.h>

#include <numeric>
#include <set>

namespace CaissonMPM
{
  namespace
  {
    /** Whether an entry has no influence on the state at a given time. */
    bool
    is_not_physics(const DeclaredEntry &entry)
    {
      for (const std::string free :
           {"Output/", "Run control/", "Verification/", "Time/End"})
        if (entry.path.compare(0, free.size(), free) == 0)
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
} // namespace CaissonMPM
