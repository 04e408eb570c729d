// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The error bar of an installation's forces and suction: the companion of
// history.csv.
//
// The errors come from a study of mesh, points, mass scaling and more
// (scripts/lab study), as a file beside the scene. They hold for the scene
// of the study only, which the file names by its fingerprint.
#ifndef caisson_mpm_output_error_bar_h
#define caisson_mpm_output_error_bar_h

#include <deal.II/base/parameter_acceptor.h>

#include <optional>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * Reads the file of errors and writes history_error.csv: for each row of
   * history.csv within the depths of the study the quantities of the file, with
   * their lower and upper bounds. The file of errors is CSV with the line
   *   # fingerprint: TEXT
   * and the columns penetration_m (increasing), tip_error and total_error
   * (relative half-widths). Columns of a run with suction, with half-widths in
   * the units of history.csv, may be added: required_suction_half_width_Pa,
   * exit_gradient_axis_half_width and plug_heave_half_width_m. Called by one
   * rank; not collective.
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

    /** The relative half-width of the total force at a depth, nothing where no
     * error is known. Units: m. */
    std::optional<double>
    of_total_force(const double penetration) const;

    /**
     * Write history_error.csv from the history.csv of @p directory, if read()
     * found errors that hold. Throws RunFailure where that is not possible.
     */
    void
    write(const std::string &directory) const;

  private:
    /** A quantity of history.csv, and which column has its half-width. */
    struct Quantity;

    /** A depth with the half-widths of all quantities that the file has. */
    struct Row
    {
      double              penetration;
      std::vector<double> half_widths;
    };

    static const std::vector<Quantity> known_quantities;

    /** Whether a depth lies within those of the study. Units: m. */
    bool
    covers(const double penetration) const;

    /** The errors at a depth that lies within those of the study. */
    Row
    at(const double penetration) const;

    std::string                   file;
    std::vector<const Quantity *> quantities;
    std::vector<Row>              rows;
  };
} // namespace CaissonMPM

#endif
