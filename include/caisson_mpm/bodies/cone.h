// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A cone on the axis with its point down and a shaft above it.
#ifndef caisson_mpm_bodies_cone_h
#define caisson_mpm_bodies_cone_h

#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/bodies/body_shape.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  /** The shaft has the radius of the cone's base. */
  class Cone : public BodyShape
  {
  public:
    Cone()
      : Cone("cone",
             "a cone on the axis with its point down and a shaft above",
             60.)
    {
      add_parameter("Apex angle",
                    apex_angle,
                    "degrees",
                    "The full angle of a cone at its point.",
                    dealii::Patterns::Double(20., 170.));
    }

    void
    check_parameters() const override
    {
      check_cells_across(cells_across);
      if (length <= tip_height())
        throw BadInput("Rigid body/Skirt length = " + to_text(length) +
                       " m must exceed the height of the cone, " +
                       to_text(tip_height()) + " m.");
    }

    BodyPart
    extent() const override
    {
      return {0.,
              .5 * outer_diameter,
              -initial_penetration,
              length - initial_penetration};
    }

    double
    tip_height() const override
    {
      return right() / std::tan(radians(.5 * apex_angle));
    }

    double
    height_of_bent_rows() const override
    {
      return 4. * tip_height(); // rows at the axis keep 3/4 of their height
    }

    double
    lower_surface(const double r) const override
    {
      return bottom() + tip_height() * std::min(1., std::abs(r) / right());
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
      const Point start(p[0], p[1] + travel);
      return is_within_extent(start) &&
             start[1] > lower_surface(start[0]) + round_off;
    }

  protected:
    /** A cone of this full angle, in degrees, that declares no entry for it. */
    Cone(const std::string &name,
         const std::string &description,
         const double       apex_angle)
      : BodyShape(name, description)
      , apex_angle(apex_angle)
    {
      add_outer_diameter(outer_diameter);
      add_skirt_length(length);
      add_cells_across(cells_across);
      add_initial_penetration(initial_penetration);
    }

  private:
    double       outer_diameter = 6.;
    double       length         = 7.;
    unsigned int cells_across   = 2;
    double       apex_angle;
    double       initial_penetration = 0.5;
  };
} // namespace CaissonMPM

#endif
