// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/base/time_table.h>

#include <deal.II/base/utilities.h>

namespace CaissonMPM
{
  using namespace dealii;

  TimeTable
  parse_time_table(const std::string &text)
  {
    TimeTable table;
    for (const std::string &pair : Utilities::split_string_list(text))
      {
        const auto words = Utilities::split_string_list(pair, ':');
        table.emplace_back(Utilities::string_to_double(words[0]),
                           Utilities::string_to_double(words[1]));
      }
    return table;
  }

  void
  check_time_table(const TimeTable &table, const std::string &entry)
  {
    for (unsigned int i = 1; i < table.size(); ++i)
      if (table[i].first <= table[i - 1].first)
        throw BadInput(entry + ": time " + to_text(table[i].first) +
                       " s does not follow " + to_text(table[i - 1].first) +
                       " s. List the times in increasing order.");
  }

  double
  value_at(const TimeTable &table, const double t)
  {
    if (t <= table.front().first)
      return table.front().second;
    for (unsigned int i = 1; i < table.size(); ++i)
      if (t < table[i].first)
        {
          const auto &a = table[i - 1], &b = table[i];
          return a.second +
                 (b.second - a.second) * (t - a.first) / (b.first - a.first);
        }
    return table.back().second;
  }
} // namespace CaissonMPM
