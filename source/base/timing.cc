// SPDX-License-Identifier: LGPL-2.1-or-later

#include <caisson_mpm/base/timing.h>

#include <sys/resource.h>

#include <algorithm>

namespace CaissonMPM
{
  namespace
  {
    const std::string beginning = "seconds_of_"; // of a name in a checkpoint
  }

  unsigned int
  SectionTimer::section(const std::string &name)
  {
    for (unsigned int i = 0; i < sections.size(); ++i)
      if (sections[i].first == name)
        return i;
    sections.emplace_back(name, 0);
    return sections.size() - 1;
  }

  NamedNumbers
  SectionTimer::seconds() const
  {
    NamedNumbers result;
    for (const auto &[name, time] : sections)
      result.emplace_back(name, std::chrono::duration<double>(time).count());
    return result;
  }

  NamedNumbers
  SectionTimer::state() const
  {
    NamedNumbers result = seconds();
    for (auto &[name, time] : result)
      {
        std::replace(name.begin(), name.end(), ' ', '_');
        name = beginning + name;
      }
    return result;
  }

  void
  SectionTimer::resume(const NamedNumbers &state)
  {
    for (const auto &[key, seconds] : state)
      if (key.compare(0, beginning.size(), beginning) == 0)
        {
          std::string name = key.substr(beginning.size());
          std::replace(name.begin(), name.end(), '_', ' ');
          sections[section(name)].second +=
            std::chrono::duration_cast<std::chrono::steady_clock::duration>(
              std::chrono::duration<double>(seconds));
        }
  }

  double
  peak_memory_bytes()
  {
    struct rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return 1024. * usage.ru_maxrss; // Linux counts in units of 1024 bytes
  }
} // namespace CaissonMPM
