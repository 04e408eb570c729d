// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The error bar of an installation's forces: the companion of history.csv.
//
// The relative errors come from a study of mesh, points, mass scaling and
// velocity (scripts/caisson study), as a file beside the scene. They hold for
// the scene of the study only, which the file names by its fingerprint.
#ifndef caisson_mpm_output_error_bar_h
#define caisson_mpm_output_error_bar_h

#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * Reads the file of errors and writes history_error.csv: for each row of
   * history.csv within the depths of the study the tip and total force with
   * their lower and upper bounds. The file of errors is CSV with the line
   *   # fingerprint: TEXT
   * and the columns penetration_m (increasing), tip_error and total_error
   * (relative half-widths). Called by one rank; not collective.
   */
  class ErrorBar : public dealii::ParameterAcceptor
  {
  public:
    ErrorBar();

    /**
     * Read the file, whose path is relative to that of the scene file. Throws
     * BadInput where it cannot be read. Returns an empty text, or why it does
     * not hold for the scene with the given fingerprint.
     */
    std::string
    read(const std::string &scene_file, const std::string &fingerprint);

    /**
     * Write history_error.csv from the history.csv of @p directory, if read()
     * found errors that hold. Throws RunFailure where that is not possible.
     */
    void
    write(const std::string &directory) const;

  private:
    struct Row
    {
      double penetration, tip, total;
    };

    /** The errors at a depth that lies within those of the study. */
    Row
    at(const double penetration) const;

    std::string      file;
    std::vector<Row> rows;
  };
} // namespace CaissonMPM

#endif
