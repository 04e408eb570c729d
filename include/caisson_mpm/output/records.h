// SPDX-License-Identifier: LGPL-2.1-or-later
//
// All records of a run: the files history.csv and observations.csv.
#ifndef caisson_mpm_output_records_h
#define caisson_mpm_output_records_h

#include <caisson_mpm/output/history.h>
#include <caisson_mpm/output/observations.h>
#include <caisson_mpm/output/row_file.h>

#include <memory>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * One row per record in each. observations.csv is written where there are
   * observations. Owned by one rank; not collective.
   */
  class Records
  {
  public:
    /** @p counts are the names of the counts of RunTotals. */
    Records(const std::string              &directory,
            const Observations             &observations,
            const SceneParts               &scene,
            const std::vector<std::string> &counts);

    /** Begin new files. Throws RunFailure where that is not possible. */
    void
    create();

    /** Go on after the rows up to this time; see RowFile::resume(). Units: s.
     */
    void
    resume(const double time);

    /** The time of the last row that resume() would keep of history.csv,
     * negative where there is none; changes no file. Units: s. */
    double
    last_time_until(const double time) const;

    /** Tell all rows of history.csv, or of observations.csv, from others; 0
     * where there is no such file. */
    double
    history_fingerprint() const
    {
      return history.fingerprint();
    }

    double
    observations_fingerprint() const
    {
      return observed_file ? observed_file->fingerprint() : 0.;
    }

    /** Add the record of this row, and the values of the observations. */
    void
    append(const HistoryRow &row, const std::vector<double> &observed);

  private:
    const SceneParts         scene;
    RowFile                  history;
    std::unique_ptr<RowFile> observed_file;
  };
} // namespace CaissonMPM

#endif
