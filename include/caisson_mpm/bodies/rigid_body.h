// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The rigid body: its shape, its contact properties and its prescribed motion.
#ifndef caisson_mpm_bodies_rigid_body_h
#define caisson_mpm_bodies_rigid_body_h

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  /** The surfaces of a body, for friction and for the split of its forces. */
  enum Surface : unsigned int
  {
    tip        = 0, // faces that look down, but for those of a lid
    inner_wall = 1, // vertical faces towards the axis
    outer_wall = 2, // vertical faces away from the axis
    top        = 3, // faces that look up
    lid        = 4, // the lower face of a lid
    n_surfaces = 5
  };

  /**
   * A rigid body that moves with a prescribed velocity: along the axis, down
   * or up, or, a cylinder, outward.
   *
   * Its shape is exact, and the background grid follows it: the cells inside
   * the body are rigid, and its surface consists of faces of the grid. A
   * caisson is a tube with a triangular or flat tip, open or closed by a lid; a
   * cone has a shaft of its radius above it; a cylinder has the height of the
   * mesh and a radius that grows; a box is a rectangle in (r, z). Nothing here
   * is collective.
   */
  class RigidBody : public dealii::ParameterAcceptor
  {
  public:
    enum class Kind
    {
      none,
      caisson,
      box,
      cone,
      cylinder
    };

    /** How a node on an edge of the body, with two normals, is treated. */
    enum class CornerNormals
    {
      average, // the mean of both normals
      both,    // not into either face
      wall,    // the normal of the vertical face
      tip      // the normal of the other face
    };

    RigidBody();

    /** Throws BadInput where the entries contradict each other. */
    void
    check_parameters() const;

    Kind
    kind() const
    {
      return kind_;
    }

    /** Initial extent in r and z: of the skirt of a caisson, else of the whole
     * body. Units: m. */
    double
    left() const;
    double
    right() const;
    double
    bottom() const;
    double
    top_of_body() const;

    /** Depth of the body's lowest point at the start, 0 without a body and for
     * a cylinder. Units: m. */
    double
    initial_depth() const
    {
      return kind_ == Kind::none || kind_ == Kind::cylinder ? 0. : -bottom();
    }

    /** Height of the triangular tip or the cone, 0 for a flat one. Units: m. */
    double
    tip_height() const;

    /** Height of the lid's lower face at the start. Units: m. */
    double
    lower_face_of_lid() const
    {
      return top_of_body() - lid_thickness;
    }
    bool
    has_lid() const
    {
      return kind_ == Kind::caisson && lid_thickness > 0.;
    }

    /** Width of the cells that the body asks for: of those across the wall of a
     * caisson, or across the radius of a cone or cylinder; 0 for a box. Units:
     * m. */
    double
    cell_width() const;

    /**
     * Initial height of the body's lower surface at radius r between left()
     * and right(). Units: m.
     */
    double
    lower_surface(const double r) const;

    /** Whether a place is inside the body, by more than round-off, after a
     * travel. */
    bool
    contains(const dealii::Point<2> &p, const double travel) const;

    /** The direction of a positive velocity: down, or outward for a cylinder.
     */
    dealii::Tensor<1, 2>
    direction() const;

    /** Where a place of the body at the start is after a travel. */
    dealii::Point<2>
    moved(const dealii::Point<2> &p, const double travel) const;

    /** Velocity at time t, positive in direction(). Units: m/s. */
    double
    velocity(const double t) const;

    /** How far the body has moved in direction() at time t. Units: m. */
    double
    travel(const double t) const;

    /** The smallest and the largest travel from 0 to time t. Units: m. */
    std::pair<double, double>
    travel_range(const double t) const;

    /** The first time at which it has moved by d; infinity if never. */
    double
    time_of_travel(const double d) const;

    /** The largest velocity of the whole motion. Units: m/s. */
    double
    max_velocity() const;

    double
    friction_coefficient(const Surface surface) const;

    double initial_penetration = 0.5;
    double outer_diameter      = 6.;
    double skirt_length        = 7.;
    double wall_thickness      = 0.1;
    double tip_angle           = 45.;
    double apex_angle          = 60.;
    double lid_thickness       = 0.;
    double density             = 7850.;

    unsigned int cells_across = 2;

    /** Contact friction angles by surface. Units: degrees. */
    std::array<double, n_surfaces> friction_angle = {{20., 20., 20., 20., 20.}};
    /** Contact adhesion by surface. Units: Pa. */
    std::array<double, n_surfaces> adhesion = {{0., 0., 0., 0., 0.}};

    CornerNormals corner_normals = CornerNormals::average;

  private:
    void
    parse_texts();
    void
    check_caisson() const;
    std::vector<double>
    turning_times(const double end) const;

    Kind        kind_             = Kind::none;
    std::string kind_text         = "none";
    std::string tip_text          = "triangular";
    std::string corner_text       = "average";
    double      constant_velocity = 0.1;
    double      ramp_time         = 0.;
    std::string table_text;
    double      box_left = 0., box_right = 1., box_bottom = -1., box_top = 0.;

    /** (t, v), linear in between, constant at both ends. */
    std::vector<std::pair<double, double>> velocity_table;
  };
} // namespace CaissonMPM

#endif
