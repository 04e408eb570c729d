// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The surface of a rigid body: what contact must know of the body.
#ifndef caisson_mpm_bodies_body_surface_h
#define caisson_mpm_bodies_body_surface_h

#include <caisson_mpm/base/parameter_origins.h>
#include <caisson_mpm/base/section.h>

#include <array>
#include <string>

namespace CaissonMPM
{
  class BodyShape;

  /** The surfaces of a body, for friction and for the split of its forces. */
  enum Surface : unsigned int
  {
    tip        = 0, // the lowest faces, which look down
    inner_wall = 1, // vertical faces towards the axis
    outer_wall = 2, // vertical faces away from the axis
    top        = 3, // faces that look up
    lid        = 4, // the lower face of a lid
    ring       = 5, // other faces above the tip that look down
    n_surfaces = 6
  };

  /** The name of a surface as in the entries, for instance "inner wall". */
  const std::string &
  name_of(const Surface surface);

  /**
   * Friction and adhesion of each surface, and the treatment of the edges
   * between them. Where the surfaces are follows from the grid. Not collective.
   */
  class BodySurface : public Section
  {
  public:
    BodySurface();

    /** Report the entries of surfaces that the body does not have. */
    void
    name_unused_surfaces(ParameterOrigins &origins,
                         const BodyShape  &shape) const;

    /** Contact friction angles by surface. Units: degrees. */
    std::array<double, n_surfaces> friction_angle = {
      {20., 20., 20., 20., 20., 20.}};

    /** Contact adhesion by surface. Units: Pa. */
    std::array<double, n_surfaces> adhesion = {};

    /** Whether at the edges of the body each face has a velocity of its own
     * (operators/contact_corners.h); else soil moves into neither face. */
    bool splits_corners = true;
  };
} // namespace CaissonMPM

#endif
