// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Grid lines along one direction from a wanted cell size.
#ifndef caisson_mpm_domain_graded_lines_h
#define caisson_mpm_domain_graded_lines_h

#include <functional>
#include <vector>

namespace CaissonMPM
{
  /**
   * Return lines from the smallest to the largest of @p fixed, through all of
   * them, with cells about as large as @p size says at their place. Between two fixed
   * lines the number of cells is int dx / size(x), rounded up, and the lines
   * share this integral evenly: exact for a constant size, and a constant ratio
   * of neighbors for a size that grows linearly. Units: m.
   */
  std::vector<double>
  graded_lines(std::vector<double>                  fixed,
               const std::function<double(double)> &size);

  /** Return how many cells graded_lines() makes between two fixed lines, which
   * may be more than memory holds. */
  double
  number_of_cells(const double                         a,
                  const double                         b,
                  const std::function<double(double)> &size);
} // namespace CaissonMPM

#endif
