// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A rectangle in (r, z).
#ifndef caisson_mpm_bodies_box_h
#define caisson_mpm_bodies_box_h

#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/bodies/body_shape.h>

#include <deal.II/base/patterns.h>

namespace CaissonMPM
{
  /**
   * Its lower face is flat. The cells at it are those of the mesh.
   */
  class Box : public BodyShape
  {
  public:
    Box()
      : BodyShape("box", "a rectangle in (r, z)")
    {
      add_parameter("Box left",
                    left_,
                    "m",
                    "The smallest r of a box.",
                    dealii::Patterns::Double(0.));
      add_parameter("Box right", right_, "m", "The largest r of a box.");
      add_parameter("Box bottom", bottom_, "m", "The lowest z of a box.");
      add_parameter("Box top", top_, "m", "The highest z of a box.");
    }

    void
    check_parameters() const override
    {
      if (left_ >= right_ || bottom_ >= top_)
        throw BadInput(
          "Rigid body/Box: left must lie below right and bottom below top; "
          "found r from " +
          to_text(left_) + " to " + to_text(right_) + " m and z from " +
          to_text(bottom_) + " to " + to_text(top_) + " m.");
    }

    bool
    has_flat_base() const override
    {
      return true;
    }

    BodyPart
    extent() const override
    {
      return {left_, right_, bottom_, top_};
    }

  private:
    double left_ = 0., right_ = 1., bottom_ = -1., top_ = 0.;
  };
} // namespace CaissonMPM

#endif
