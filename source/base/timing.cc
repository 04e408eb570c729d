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

  double &
  SectionTimer::seconds_of(const std::string &section)
  {
    for (auto &[name, seconds] : sections)
      if (name == section)
        return seconds;
    return sections.emplace_back(section, 0.).second;
  }

  NamedNumbers
  SectionTimer::state() const
  {
    NamedNumbers result = sections;
    for (auto &[name, seconds] : result)
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
          seconds_of(name) += seconds;
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
