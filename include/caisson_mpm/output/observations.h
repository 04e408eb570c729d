// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Named numbers that are read from the material points at every record.
//
// With the values q of a quantity at all points, or at those whose initial
// position lies in a region, their volumes V and masses m:
//   point q at R Z:   q of the point whose initial position is the nearest to
//                     (R, Z),
//   mean q:           sum V q / sum V,
//   rms q:            sqrt(sum V q^2 / sum V),
//   min q, max q:     the smallest, the largest,
//   quantile F q:     the smallest value that the q of at least the share F of
//                     the mass do not exceed,
//   projection q on f:  sum m q f / sum m f^2, the amplitude of the shape f,
//                     a function of the initial coordinates.
#ifndef caisson_mpm_output_observations_h
#define caisson_mpm_output_observations_h

#include <caisson_mpm/base/expression.h>
#include <caisson_mpm/base/section.h>
#include <caisson_mpm/domain/all_points.h>
#include <caisson_mpm/output/point_quantities.h>

#include <string>
#include <vector>

namespace CaissonMPM
{
  struct ObservationKind;

  /** One observation, as read from its text. */
  struct Observation
  {
    std::string            name;
    const ObservationKind *kind = nullptr;
    PointQuantity          quantity;
    double                 share = 0.;    // of a quantile
    dealii::Point<2>       place;         // of a point
    Expression             shape, region; // or empty
  };

  /**
   * The observations of a scene.
   *
   * @code
   * subsection Verification
   *   set Observations = top  = point displacement_z at 0.01 -0.005 ; \
   *                      x99  = quantile 0.99 position_r ; \
   *                      mode = projection velocity_r on sin(pi*r)
   * end
   * @endcode
   *
   * The values are those of the points of all ranks, on the first one; not
   * collective.
   */
  class Observations : public Section
  {
  public:
    Observations();

    /** Read the entries. Throws BadInput for an observation that cannot be
     * understood, or whose name is among @p taken, and for a quantity of a
     * check that does not exist. */
    void
    initialize(const std::vector<std::string> &taken);

    /** In the order of the entry. */
    std::vector<std::string>
    names() const;

    /** The value of each observation. Throws RunFailure where a region has no
     * points. */
    std::vector<double>
    values(const AllPoints &points, const double time) const;

    /** The quantities of the checks of points. */
    const std::vector<std::string> &
    checked_quantities() const
    {
      return quantities;
    }

    /** Write these quantities of all points to a file, with their initial
     * positions, their volumes and the time, in all digits: who compares them
     * with an exact solution needs no more. Throws RunFailure. */
    void
    write_points(const std::string &path,
                 const AllPoints   &points,
                 const double       time) const;

  private:
    std::string              entry, checks;
    std::vector<std::string> quantities;
    std::vector<Observation> observations;
  };
} // namespace CaissonMPM

#endif
