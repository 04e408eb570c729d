// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/output/records.h>


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
    : scene(scene)
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
    const auto rows = history.resume(time);
    if (!observed_file)
      return;
    const auto others = observed_file->resume(time);
    if (others.size() != rows.size())
      throw BadInput("observations.csv has " + to_text(others.size()) +
                     " rows up to the checkpoint and history.csv " +
                     to_text(rows.size()) +
                     ", so that the run cannot continue them. Run without "
                     "--restart, or without Verification/Observations.");
  }

  void
  Records::append(const HistoryRow &row, const std::vector<double> &observed)
  {
    history.append(history_values(scene, row));
    if (!observed_file)
      return;
    std::vector<double> values = {row.time};
    values.insert(values.end(), observed.begin(), observed.end());
    observed_file->append(values);
  }
} // namespace CaissonMPM
