// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A table that grows while the program runs (CSV): a header, then one row per
// record, the first column being the time.
#ifndef caisson_mpm_output_row_file_h
#define caisson_mpm_output_row_file_h

#include <caisson_mpm/base/fingerprint.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * The file of rows. Every row is in the file when append() returns, so that a
   * run can be followed, and a killed one read; a row that does not fit on the
   * disk is taken back. In parallel one rank owns it; it is not collective.
   *
   * @code
   * RowFile file(directory + "/history.csv", {"time_s", "force_N"}, 10);
   * if (restart)
   *   file.resume(checkpoint.time);
   * else
   *   file.create();
   * file.append({time, force});
   * @endcode
   */
  class RowFile
  {
  public:
    using Rows = std::vector<std::vector<double>>;

    /** Numbers are written with so many significant @p digits. */
    RowFile(const std::string              &path,
            const std::vector<std::string> &columns,
            const int                       digits);

    /** Begin a new file with its header; one of a previous run is replaced.
     * Throws RunFailure where that cannot be written. */
    void
    create();

    /** Keep the complete rows up to this time, and go on after them; as
     * create() where there is no file. Returns the rows. Throws RunFailure, and
     * BadInput if the file has other columns. Units: s. */
    Rows
    resume(const double time);

    /** Return the complete rows up to this time, without a change of the file,
     * and add their text to @p kept if it is given. Throws as resume() does.
     * Units: s. */
    Rows
    rows_until(const double time, std::string *const kept = nullptr) const;

    /** Add a row, one value per column. Throws RunFailure where it cannot be
     * written. */
    void
    append(const std::vector<double> &values);

    /** Tells the header and all rows so far from others. */
    double
    fingerprint() const
    {
      return written.number();
    }

  private:
    struct Close
    {
      void
      operator()(std::FILE *file) const
      {
        std::fclose(file);
      }
    };

    /** Replace the file by this text and open it behind that. */
    void
    start_with(const std::string &text);

    std::string                       path, header;
    std::size_t                       n_columns;
    int                               digits;
    std::unique_ptr<std::FILE, Close> file;
    long                              size = 0; // bytes in complete rows
    Fingerprint                       written;  // of these
  };
} // namespace CaissonMPM

#endif
