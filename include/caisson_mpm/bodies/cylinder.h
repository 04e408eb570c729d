// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A cylinder on the axis, as high as the mesh, with a radius that grows.
#ifndef caisson_mpm_bodies_cylinder_h
#define caisson_mpm_bodies_cylinder_h

#include <caisson_mpm/base/text.h>
#include <caisson_mpm/bodies/body_shape.h>

#include <limits>

namespace CaissonMPM
{
  /** The travel is the growth of the radius. */
  class Cylinder : public BodyShape
  {
  public:
    Cylinder()
      : BodyShape(
          "cylinder",
          "on the axis, as high as the mesh, with a radius that grows by "
          "Velocity")
    {
      add_outer_diameter(outer_diameter);
      add_cells_across(cells_across);
    }

    BodyPart
    extent() const override
    {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      return {0., .5 * outer_diameter, -infinity, infinity};
    }

    double
    initial_depth() const override
    {
      return 0.;
    }

    bool
    expands() const override
    {
      return true;
    }

    double
    cell_width() const override
    {
      return right() / refined(cells_across);
    }

    std::string
    entry_of_cell_width() const override
    {
      return "Rigid body/Outer diameter = " + to_text(outer_diameter) + " m";
    }

    bool
    contains(const Point &p, const double travel) const override
    {
      return p[0] < right() + travel - round_off;
    }

    Vector2
    direction() const override
    {
      return Vector2({1., 0.});
    }

    Point
    moved(const Point &p, const double travel) const override
    {
      return Point(p[0] * (1. + travel / right()), p[1]);
    }

  private:
    double       outer_diameter = 6.;
    unsigned int cells_across   = 2;
  };
} // namespace CaissonMPM

#endif
