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
   *
   * A node at the edge of a footing moves with it, and the velocity falls to
   * that of the free surface within the next cell, of width h. The pressure p
   * of the footing does the work p V int N ds = p V h / 2 there: the mesh
   * carries the load of a footing that is half a cell wider. With inset edges,
   * the sides of the mesh's body are therefore h / 2 inside those of the box.
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
      add_parameter("Inset edges",
                    inset_edges,
                    "The mesh puts the sides of a box half a cell inside Box "
                    "left and Box right, since the nodes at the edges of a "
                    "footing bear on half a cell more on either side. Units: "
                    "none.");
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

    double
    inset_of_sides() const override
    {
      return inset_edges ? .5 : 0.;
    }

    bool
    contains(const Point &p, const double travel) const override
    {
      return is_within_extent(Point(p[0], p[1] + travel));
    }

  private:
    double left_ = 0., right_ = 1., bottom_ = -1., top_ = 0.;
    bool   inset_edges = false;
  };
} // namespace CaissonMPM

#endif
