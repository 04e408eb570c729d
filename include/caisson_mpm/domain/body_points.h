// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The material points of the rigid body: one per cell of it.
#ifndef caisson_mpm_domain_body_points_h
#define caisson_mpm_domain_body_points_h

#include <caisson_mpm/bodies/rigid_body.h>
#include <caisson_mpm/domain/background_grid.h>

#include <deal.II/base/point.h>

#include <vector>

namespace CaissonMPM
{
  /** Its place at the start; the body's motion is that of all its points. */
  struct BodyPoint
  {
    dealii::Point<2> position;
    double           volume = 0.; // m3, whole circumference
    double           mass   = 0.; // kg, whole circumference
    unsigned int     cell   = 0;
  };

  /**
   * Make one point in every cell of the body that this rank owns. The points
   * carry the mass of the body, and take no part in the time step. The grid
   * must be in its initial position.
   */
  std::vector<BodyPoint>
  generate_body_points(const BackgroundGrid &grid, const RigidBody &body);
} // namespace CaissonMPM

#endif
