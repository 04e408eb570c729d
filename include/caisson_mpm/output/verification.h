// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Comparison of the material points with an exact solution at the end of a run.
//
// With the computed values v and the exact ones e at all points, the error is
//   max:       max |v - e| / max |e|,
//   pointwise: max (|v - e| / |e|),
//   mean:      |<v> - <e>| / |<e>|,  <.> the mean weighted with the volume.
// Where the exact value that would be divided by is 0 the error is absolute.
#ifndef caisson_mpm_output_verification_h
#define caisson_mpm_output_verification_h

#include <caisson_mpm/base/console.h>
#include <caisson_mpm/bodies/material_points.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>

namespace CaissonMPM
{
  /**
   * The checks of a verification scene. Each names a mode, a quantity, the
   * exact solution in the initial coordinates r and z of a point and the time
   * t, and the largest error:
   *
   * @code
   * subsection Verification
   *   set Checks = max displacement_z : -0.01*z*t : 0.005 ; \
   *                mean stress_ratio : 1 - sin(30*pi/180) : 1e-3
   * end
   * @endcode
   *
   * The values are those of all points of one rank; not collective.
   */
  class Verification : public dealii::ParameterAcceptor
  {
  public:
    Verification();

    /** Throws BadInput for a check that cannot be understood. */
    void
    check_parameters() const;

    /** Whether there is nothing to check. */
    bool
    empty() const;

    /**
     * Make all checks, print a line for each, and write them with the values
     * at the worst point (mode mean: the means) to verification.json. Returns
     * whether all errors are within their tolerance. Throws RunFailure where
     * the file cannot be written.
     */
    bool
    run(const MaterialPoints &points,
        const double          time,
        const std::string    &directory,
        Console              &console) const;

  private:
    std::string checks;
  };
} // namespace CaissonMPM

#endif
