// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/output/records.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace CaissonMPM
{
  namespace
  {
    std::vector<std::string>
    with_time(std::vector<std::string> names)
    {
      names.insert(names.begin(), "time_s");
      return names;
    }
  } // namespace

  Records::Records(const std::string              &directory,
                   const Observations             &observations,
                   const SceneParts               &scene,
                   const std::vector<std::string> &counts)
    : observations(observations)
    , scene(scene)
    , counts(counts)
    , history(directory + "/history.csv", history_names(scene, counts), 10)
  {
    // all digits, so that a restart sees the same numbers
    if (!observations.names().empty())
      observed_file = std::make_unique<RowFile>(directory + "/observations.csv",
                                                with_time(observations.names()),
                                                17);
  }

  void
  Records::create()
  {
    history.create();
    if (observed_file)
      observed_file->create();
  }

  double
  Records::last_time_until(const double time) const
  {
    const auto found = history.rows_until(time);
    return found.empty() ? -1. : found.back()[0];
  }

  void
  Records::resume(const double time)
  {
    rows = history.resume(time);
    if (!observed_file)
      return;
    const auto others = observed_file->resume(time);
    if (others.size() != rows.size())
      throw BadInput("observations.csv has " + to_text(others.size()) +
                     " rows up to the checkpoint and history.csv " +
                     to_text(rows.size()) +
                     ", so that the run cannot continue them. Run without "
                     "--restart, or without Verification/Observations.");
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i].insert(rows[i].end(), others[i].begin() + 1, others[i].end());
  }

  void
  Records::append(const HistoryRow &row, const std::vector<double> &observed)
  {
    std::vector<double> values = history.append(history_values(scene, row));
    if (observed_file)
      {
        std::vector<double> more = observed;
        more.insert(more.begin(), row.time);
        observed_file->append(more);
        values.insert(values.end(), observed.begin(), observed.end());
      }
    rows.push_back(values);
  }

  std::vector<std::string>
  Records::names(const SceneParts               &scene,
                 const std::vector<std::string> &counts,
                 const std::vector<std::string> &observed)
  {
    std::vector<std::string> result = history_names(scene, counts);
    result.erase(result.begin());
    result.insert(result.end(), observed.begin(), observed.end());
    return result;
  }

  std::vector<std::string>
  Records::names() const
  {
    return names(scene, counts, observations.names());
  }

  Series
  Records::series(const std::string &name,
                  const double       begin,
                  const double       end) const
  {
    const auto all   = names();
    const auto found = std::find(all.begin(), all.end(), name);
    Assert(found != all.end(), dealii::ExcMessage("unknown column " + name));
    const std::size_t column = 1 + (found - all.begin());
    Series            result;
    for (const auto &row : rows)
      if (row[0] >= begin - 1e-9 * begin && row[0] <= end * (1. + 1e-9))
        {
          result.time.push_back(row[0]);
          result.value.push_back(row[column]);
        }
    return result;
  }
} // namespace CaissonMPM
