// SPDX-License-Identifier: LGPL-2.1-or-later

#include <caisson_mpm/base/timing.h>

#include <sys/resource.h>

namespace CaissonMPM
{
  unsigned int
  SectionTimer::section(const std::string &name)
  {
    for (unsigned int i = 0; i < sections.size(); ++i)
      if (sections[i].first == name)
        return i;
    sections.emplace_back(name, 0);
    return sections.size() - 1;
  }

  std::vector<std::pair<std::string, double>>
  SectionTimer::seconds() const
  {
    std::vector<std::pair<std::string, double>> result;
    for (const auto &[name, time] : sections)
      result.emplace_back(name, std::chrono::duration<double>(time).count());
    return result;
  }

  double
  peak_memory_bytes()
  {
    struct rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return 1024. * usage.ru_maxrss; // Linux counts in units of 1024 bytes
  }
} // namespace CaissonMPM
