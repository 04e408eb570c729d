// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The shape of a rigid body.
#ifndef caisson_mpm_bodies_body_shape_h
#define caisson_mpm_bodies_body_shape_h

#include <caisson_mpm/base/conventions.h>
#include <caisson_mpm/base/named_numbers.h>
#include <caisson_mpm/base/section.h>

#include <deal.II/base/point.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /** A rectangle in r and z at the start. Units: m. */
  struct BodyPart
  {
    double left, right, bottom, top;
  };

  /**
   * What the grid, the points and the output ask of a body's shape. A shape is
   * one class in one file; it declares its own entries in section Rigid body
   * and has one line in the list of rigid_body.cc.
   *
   * A shape is exact, and the background grid follows it: the cells inside the
   * body are rigid, and its surface consists of faces of the grid. Lengths are
   * those at the start; a travel says how far the body has moved since. Nothing
   * here is in a loop of the time step, and nothing is collective.
   */
  class BodyShape : public Alternative
  {
  public:
    using Point = dealii::Point<2>;

    BodyShape(const std::string &name, const std::string &description)
      : Alternative("/Rigid body", Influence::ground, name, description)
    {}

    /** Throw BadInput where an entry asks for something that only this shape
     * has, and another one is chosen. */
    virtual void
    check_not_chosen() const
    {}

    /** Whether there is a body at all. */
    virtual bool
    exists() const
    {
      return true;
    }

    /** Return the extent in r and z: of the skirt of a caisson, with its
     * thickness at the tip, else of the whole body. Units: m. */
    virtual BodyPart
    extent() const = 0;

    double
    left() const
    {
      return extent().left;
    }
    double
    right() const
    {
      return extent().right;
    }
    double
    bottom() const
    {
      return extent().bottom;
    }
    double
    top() const
    {
      return extent().top;
    }

    /** Return the width of what goes down, 0 without any. Units: m. */
    double
    width_of_tip() const
    {
      return exists() && !expands() ? right() - left() : 0.;
    }

    /** Return the depth of the body's lowest point, 0 where the body does not
     * penetrate. Units: m. */
    virtual double
    initial_depth() const
    {
      return -bottom();
    }

    /** Return the height of a pointed tip, 0 for a flat one. Units: m. */
    virtual double
    tip_height() const
    {
      return 0.;
    }

    /** Return the height of the zone below and above a pointed tip in which
     * rows of cells that follow the tip become level again. Units: m. */
    virtual double
    height_of_bent_rows() const
    {
      return 8. * tip_height(); // rows below keep 7/8 of their height
    }

    /** Return the height of the lower surface at radius r between left() and
     * right(). Units: m. */
    virtual double
    lower_surface(const double /*r*/) const
    {
      return bottom();
    }

    /** Return the radii between left() and right() at which the tip needs a
     * node. Units: m. */
    virtual std::vector<double>
    radii_of_tip() const
    {
      return {};
    }

    /** Return how many rectangles the body consists of, a lid aside. */
    virtual unsigned int
    n_parts() const
    {
      return 1;
    }

    /** Return one of them. The first one ends at the lower surface. */
    virtual BodyPart
    part(const unsigned int /*i*/) const
    {
      return extent();
    }

    /** Whether a part is a ring inside the wall. */
    virtual bool
    is_ring(const unsigned int /*i*/) const
    {
      return false;
    }

    /** Whether faces above the tip look down, besides those of a lid. */
    virtual bool
    has_ledges() const
    {
      return false;
    }

    virtual bool
    has_lid() const
    {
      return false;
    }

    /** Return the inner radius of the body at its top. Units: m. */
    virtual double
    left_at_top() const
    {
      return left();
    }

    /** Return the height of the lid's lower face. Units: m. */
    virtual double
    lower_face_of_lid() const
    {
      return top();
    }

    /** Whether the radius of the body grows instead of its depth. The body then
     * has the height of the mesh. */
    virtual bool
    expands() const
    {
      return false;
    }

    /** Divide the cells that the shape asks for by a number, before
     * check_parameters(). */
    void
    refine(const double number)
    {
      refinement = number;
    }

    /** Say whether some of the soil has a friction angle, before
     * check_parameters(). */
    void
    enter_soil(const bool has_friction)
    {
      soil_has_friction = has_friction;
    }

    /** Return the width of the cells at the body that the shape asks for; 0 if
     * it does not. Units: m. */
    virtual double
    cell_width() const
    {
      return 0.;
    }

    /** Return the entry that sets cell_width(), with its value, for messages.
     */
    virtual std::string
    entry_of_cell_width() const
    {
      return "";
    }

    /** Whether the lower face is level: on the surface the body is a footing.
     */
    virtual bool
    has_flat_base() const
    {
      return false;
    }

    /** Return the number of cells across a thin wall; 0 without one. */
    virtual unsigned int
    cells_across_wall() const
    {
      return 0;
    }

    /** Whether a place is inside the body, by more than round-off, after a
     * travel. */
    virtual bool
    contains(const Point &p, const double travel) const
    {
      return is_within_extent(Point(p[0], p[1] + travel));
    }

    /** Return the direction of a positive travel. */
    virtual Vector2
    direction() const
    {
      return Vector2({0., -1.});
    }

    /** Return where a place of the body is after a travel. */
    virtual Point
    moved(const Point &p, const double travel) const
    {
      return Point(p[0], p[1] - travel);
    }

    /** Return the lengths that pictures and design methods need, with their
     * names in run.json. */
    virtual NamedNumbers
    dimensions() const
    {
      return {};
    }

  protected:
    /** A length below which a place counts as on the surface. Units: m. */
    static constexpr double round_off = 1e-9;

    /** Return the number of cells for the one that an entry asks for. */
    unsigned int
    refined(const unsigned int n) const
    {
      return std::max(1l, std::lround(n * refinement));
    }

    /** Throw BadInput if the refinement does not make @p n cells across a whole
     * number, or a multiple of @p multiple. */
    void
    check_cells_across(const unsigned int n,
                       const unsigned int multiple = 1) const;

    static bool
    is_within(const Point &p, const BodyPart &part)
    {
      return p[0] > part.left + round_off && p[0] < part.right - round_off &&
             p[1] < part.top - round_off && p[1] > part.bottom + round_off;
    }

    /** Whether a place is inside extent(). */
    bool
    is_within_extent(const Point &p) const
    {
      return is_within(p, extent());
    }

    // Entries that several shapes have. Each declares them for itself, so that
    // it has its own copy; the words are the same.
    void
    add_outer_diameter(double &diameter);
    void
    add_skirt_length(double &length);
    void
    add_initial_penetration(double &depth);
    void
    add_cells_across(unsigned int &n);

    bool soil_has_friction = true;

  private:
    double refinement = 1.;
  };
} // namespace CaissonMPM

#endif
