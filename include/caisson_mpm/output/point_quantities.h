// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What can be read at a material point, by name: for checks and observations.
#ifndef caisson_mpm_output_point_quantities_h
#define caisson_mpm_output_point_quantities_h

#include <caisson_mpm/domain/material_points.h>

#include <map>
#include <string>

namespace CaissonMPM
{
  using PointQuantity = double (*)(const MaterialPoint &);

  /** All quantities by name. SI units; stresses tension positive. */
  const std::map<std::string, PointQuantity> &
  point_quantities();

  /** Their names with the meaning of those that need one, for the text of a
   * parameter. */
  std::string
  point_quantities_text();
} // namespace CaissonMPM

#endif
