// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Checks against an exact solution at the end of a run: of the material points
// as they are then, or of a series over the whole run. The errors are those of
// output/comparisons.h.
#ifndef caisson_mpm_checks_verification_h
#define caisson_mpm_checks_verification_h

#include <caisson_mpm/base/console.h>
#include <caisson_mpm/base/section.h>
#include <caisson_mpm/domain/all_points.h>
#include <caisson_mpm/output/records.h>

#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * The checks of a verification scene. One of the points names a mode, a
   * quantity, the exact solution in the initial coordinates r and z of a point
   * and the time t, and the largest error; one of a series names an observation
   * or a column of history.csv instead of the quantity:
   *
   * @code
   * subsection Verification
   *   set Checks = max displacement_z : -0.01*z*t : 0.005 ; \
   *                rms stress_rr where r < 1 : 0 : 1e-3 ; \
   *                trace total_force_N from 0.5 : 1e3*t : 0.01 ; \
   *                between x99 : 0.40 : 0.43
   * end
   * @endcode
   *
   * The values are those of the points of all ranks, on the first one; not
   * collective.
   */
  class Verification : public Section
  {
  public:
    Verification();

    /** Throws BadInput for a check that cannot be understood; @p series are
     * the names of all columns and observations. */
    void
    check_parameters(const std::vector<std::string> &series) const;

    /** Whether there is nothing to check. */
    bool
    empty() const;

    /**
     * Make all checks, print a line for each, and write them with the values
     * that decide to verification.json. Where errors exceed their tolerance, a
     * last line says how many, and the result is false. Throws RunFailure where
     * the file cannot be written, or a check finds no point or record.
     */
    bool
    run(const AllPoints   &points,
        const Records     &records,
        const double       time,
        const std::string &directory,
        Console           &console) const;

  private:
    std::string entry;
  };
} // namespace CaissonMPM

#endif
