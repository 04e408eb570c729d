// SPDX-License-Identifier: LGPL-2.1-or-later
//
// history.csv: forces, energies and counts against time and penetration.
#ifndef caisson_mpm_output_history_h
#define caisson_mpm_output_history_h

#include <cstdio>
#include <memory>
#include <string>

namespace CaissonMPM
{
  /** One row. SI units; forces on the body, upward positive, on the whole
   * circumference; the energies and the largest speed are those of the soil. */
  struct HistoryRow
  {
    double        time           = 0.;
    double        penetration    = 0.;
    double        tip            = 0.;
    double        inner          = 0.;
    double        outer          = 0.;
    double        top            = 0.;
    double        total          = 0.;
    double        kinetic_energy = 0.;
    double        external_work  = 0.;
    double        added_mass     = 0.;
    double        max_speed      = 0.;
    double        time_step      = 0.;
    unsigned long limiter_count  = 0;
    unsigned long held_back      = 0;
    unsigned int  points_in_body = 0;
    unsigned int  contact_nodes  = 0;
    unsigned int  sticking_nodes = 0;
    unsigned long step           = 0;
  };

  /**
   * The file of rows, one per record. Every row is in the file when append()
   * returns, so that a run can be followed, and a killed one read; a row that
   * does not fit on the disk is taken back. In parallel one rank owns it; it
   * is not collective.
   *
   * @code
   * HistoryFile history(directory + "/history.csv");
   * if (restart)
   *   history.resume(checkpoint.time);
   * else
   *   history.create();
   * history.append(row);
   * @endcode
   */
  class HistoryFile
  {
  public:
    explicit HistoryFile(const std::string &path);

    /** Begin a new file with its header; one of a previous run is replaced.
     * Throws RunFailure where that cannot be written. */
    void
    create();

    /** Keep the complete rows up to this time, and go on after them; as
     * create() where there is no file. Throws RunFailure, and BadInput if the
     * file has other columns. Units: s. */
    void
    resume(const double time);

    /** Add a row. Throws RunFailure where it cannot be written. */
    void
    append(const HistoryRow &row);

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

    std::string                       path;
    std::unique_ptr<std::FILE, Close> file;
    long                              size = 0; // bytes in complete rows
  };
} // namespace CaissonMPM

#endif
