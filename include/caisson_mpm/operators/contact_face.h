// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The faces of the rigid body that soil may touch.
#ifndef caisson_mpm_operators_contact_face_h
#define caisson_mpm_operators_contact_face_h

#include <caisson_mpm/base/conventions.h>
#include <caisson_mpm/bodies/body_surface.h>
#include <caisson_mpm/domain/background_grid.h>

#include <array>
#include <functional>
#include <vector>

namespace CaissonMPM
{
  /** A face between the body and a soil cell. */
  struct ContactFace
  {
    std::array<unsigned int, 2> nodes;
    std::array<unsigned int, 2> corners; // of the soil cell, at these nodes
    unsigned int                soil_cell;
    bool                        is_vertical;
    Vector2                     normal; // unit, out of the body
    std::array<double, 2>       areas;  // int N_I r ds
    Surface                     surface;
  };

  /** What a face bears along itself: the tangent of its friction angle, and its
   * adhesion in Pa. */
  struct FaceStrength
  {
    double friction, adhesion;
  };

  /** Gives the strength of a face. */
  using FaceStrengthOf = std::function<FaceStrength(const ContactFace &)>;

  /** The strength of a face by the entries of the body. */
  FaceStrength
  strength_of(const BodySurface &body, const ContactFace &face);

  /** Find all faces of the body in the cells that this rank knows. */
  std::vector<ContactFace>
  collect_contact_faces(const BackgroundGrid &grid);
} // namespace CaissonMPM

#endif
