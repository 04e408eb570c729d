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
    {
      add_parameter("Box left",
                    left_,
                    "The smallest r of a box. Units: m.",
                    prm,
                    dealii::Patterns::Double(0.));
      add_parameter("Box right", right_, "The largest r of a box. Units: m.");
      add_parameter("Box bottom", bottom_, "The lowest z of a box. Units: m.");
      add_parameter("Box top", top_, "The highest z of a box. Units: m.");
    }

    std::string
    name() const override
    {
      return "box";
    }

    std::string
    description() const override
    {
      return "a rectangle in (r, z)";
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

    double
    left() const override
    {
      return left_;
    }

    double
    right() const override
    {
      return right_;
    }

    double
    bottom() const override
    {
      return bottom_;
    }

    double
    top() const override
    {
      return top_;
    }

    bool
    has_flat_base() const override
    {
      return true;
    }

    bool
    contains(const Point &p, const double travel) const override
    {
      return is_within_extent(Point(p[0], p[1] + travel));
    }

  private:
    double left_ = 0., right_ = 1., bottom_ = -1., top_ = 0.;
  };
} // namespace CaissonMPM

#endif
