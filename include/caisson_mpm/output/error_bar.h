// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The error bar of an installation's forces and suction: the companion of
// history.csv.
//
// The errors come from a study of mesh, points, mass scaling and more
// (scripts/caisson error-bar), as a file beside the scene. They hold for the
// scene of the study only, which the file names by its fingerprint.
#ifndef caisson_mpm_output_error_bar_h
#define caisson_mpm_output_error_bar_h

#include <caisson_mpm/base/named_numbers.h>

#include <deal.II/base/parameter_acceptor.h>

#include <optional>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * Reads the file of errors and writes history_error.csv: for each row of
   * history.csv within the depths of the study the quantities of the file, with
   * their lower and upper bounds, and with the limit of all meshes where the
   * file has it. The file of errors is CSV with the line
   *   # fingerprint: TEXT
   * and the columns penetration_m (increasing), tip_below, tip_above,
   * total_below and total_above: how far the force may be too high and too low,
   * as a share of it. tip_shift and total_shift lead to the limit. Those of a
   * run with suction may be added, in the units of history.csv: for example
   * required_suction_below_Pa, exit_gradient_axis_below and plug_heave_below_m.
   * Called by one rank; not collective.
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

    /** How far a quantity may lie below and above what was computed, and what
     * leads to the limit of all meshes; 0 where that is not known. */
    struct Error
    {
      double below, above, shift;
    };

    /** The relative error of the total force at a depth, nothing where none is
     * known. Units: m. */
    std::optional<Error>
    of_total_force(const double penetration) const;

    /** Return the lower and the upper bound of a quantity of history.csv by
     * their columns, empty where none are known. Units: m for @p penetration.
     */
    NamedNumbers
    bounds(const std::string &column,
           const double       penetration,
           const double       value) const;

    /**
     * Write history_error.csv from the history.csv of @p directory, if read()
     * found errors that hold. Throws RunFailure where that is not possible.
     */
    void
    write(const std::string &directory) const;

  private:
    /** A quantity of history.csv, and which columns have its error. */
    struct Quantity;

    /** A depth with the errors of all quantities that the file has. */
    struct Row
    {
      double             penetration;
      std::vector<Error> errors;
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
    bool                          has_limit = false;
  };
} // namespace CaissonMPM

#endif
