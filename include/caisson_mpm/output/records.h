// SPDX-License-Identifier: LGPL-2.1-or-later
//
// All records of a run: the files history.csv and observations.csv, and the
// same numbers in memory for the checks over time.
#ifndef caisson_mpm_output_records_h
#define caisson_mpm_output_records_h

#include <caisson_mpm/output/history.h>
#include <caisson_mpm/output/observations.h>
#include <caisson_mpm/output/row_file.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /** One number over time. */
  struct Series
  {
    std::vector<double> time, value; // [n_records]
  };

  /**
   * The columns are those of history.csv and then the observations, in one row
   * per record. observations.csv is written where there are observations.
   * Owned by one rank; not collective.
   */
  class Records
  {
  public:
    /** @p observations must outlive this object; @p counts are the names of
     * the counts of RunTotals. */
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

    /** The names of all columns but the time: of history.csv of this scene with
     * these counts, and of the observations. */
    static std::vector<std::string>
    names(const SceneParts               &scene,
          const std::vector<std::string> &counts,
          const std::vector<std::string> &observed);

    /** The names of all columns but the time. */
    std::vector<std::string>
    names() const;

    /** A column by its name, from @p begin to @p end. Units: s. */
    Series
    series(const std::string &name,
           const double       begin = 0.,
           const double       end   = std::numeric_limits<double>::max()) const;

  private:
    const Observations              &observations;
    const SceneParts                 scene;
    const std::vector<std::string>   counts;
    RowFile                          history;
    std::unique_ptr<RowFile>         observed_file;
    std::vector<std::vector<double>> rows; // of both files
  };
} // namespace CaissonMPM

#endif
