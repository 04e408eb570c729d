// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A circular slab that lies on the soil: a footing.
#ifndef caisson_mpm_bodies_slab_h
#define caisson_mpm_bodies_slab_h

#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/bodies/body_shape.h>

#include <deal.II/base/patterns.h>

namespace CaissonMPM
{
  /** Its lower face is at the surface of the soil at the start. */
  class Slab : public BodyShape
  {
  public:
    Slab()
    {
      add_outer_diameter(diameter);
      add_cells_across(cells_across);
      add_parameter("Slab thickness",
                    thickness,
                    "The thickness of a slab. Units: m.",
                    prm,
                    dealii::Patterns::Double(1e-9));
    }

    std::string
    name() const override
    {
      return "slab";
    }

    std::string
    description() const override
    {
      return "a circular slab that lies on the soil";
    }

    void
    check_parameters() const override
    {
      if (thickness > diameter)
        throw BadInput("Rigid body/Slab thickness = " + to_text(thickness) +
                       " m exceeds the diameter, " + to_text(diameter) +
                       " m. Reduce the thickness.");
    }

    double
    left() const override
    {
      return 0.;
    }

    double
    right() const override
    {
      return .5 * diameter;
    }

    double
    bottom() const override
    {
      return 0.;
    }

    double
    top() const override
    {
      return thickness;
    }

    double
    cell_width() const override
    {
      return right() / cells_across;
    }

    bool
    contains(const Point &p, const double travel) const override
    {
      return is_within_extent(Point(p[0], p[1] + travel));
    }

  private:
    double       diameter     = 6.;
    double       thickness    = 1.;
    unsigned int cells_across = 2;
  };
} // namespace CaissonMPM

#endif
