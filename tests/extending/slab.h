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
      : BodyShape("slab", "a circular slab that lies on the soil")
    {
      add_outer_diameter(diameter);
      add_cells_across(cells_across);
      add_parameter("Slab thickness",
                    thickness,
                    "m",
                    "The thickness of a slab.",
                    dealii::Patterns::Double(1e-9));
    }

    void
    check_parameters() const override
    {
      if (thickness > diameter)
        throw BadInput("Rigid body/Slab thickness = " + to_text(thickness) +
                       " m exceeds the diameter, " + to_text(diameter) +
                       " m. Reduce the thickness.");
    }

    BodyPart
    extent() const override
    {
      return {0., .5 * diameter, 0., thickness};
    }

    double
    cell_width() const override
    {
      return right() / cells_across;
    }

  private:
    double       diameter     = 6.;
    double       thickness    = 1.;
    unsigned int cells_across = 2;
  };
} // namespace CaissonMPM

#endif
