// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/conventions.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/bodies/rigid_body.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace CaissonMPM
{
  using namespace dealii;

  RigidBody::RigidBody()
    : ParameterAcceptor("/Rigid body")
  {
    const Patterns::Double positive(1e-9), not_negative(0.);
    add_parameter("Kind",
                  kind_text,
                  "none; caisson: a tube that is pushed into the soil; box: a "
                  "rectangle in (r, z). Units: none.",
                  prm,
                  Patterns::Selection("none|caisson|box"));
    add_parameter("Outer diameter",
                  outer_diameter,
                  "Outer diameter of the caisson. Units: m.",
                  prm,
                  positive);
    add_parameter("Skirt length",
                  skirt_length,
                  "Length of the skirt, tip included. Units: m.",
                  prm,
                  positive);
    add_parameter("Wall thickness",
                  wall_thickness,
                  "Thickness of the skirt. Units: m.",
                  prm,
                  positive);
    add_parameter("Cells across the wall",
                  cells_across,
                  "Number of cells across the wall: the cell size at the tip "
                  "is the thickness over this number. Even for a triangular "
                  "tip. Units: none.",
                  prm,
                  Patterns::Integer(1, 64));
    add_parameter("Tip",
                  tip_text,
                  "Shape of the tip: a wedge with its edge in the middle of "
                  "the wall, or flat. Units: none.",
                  prm,
                  Patterns::Selection("triangular|flat"));
    add_parameter("Tip angle",
                  tip_angle,
                  "Angle of the triangular tip's faces to the horizontal. "
                  "Units: degrees.",
                  prm,
                  Patterns::Double(1., 80.));
    add_parameter("Corner normals",
                  corner_text,
                  "Normal at the nodes where two faces of the body meet: the "
                  "average of both, both (not into either), that of the wall, "
                  "or that of the tip. Units: none.",
                  prm,
                  Patterns::Selection("average|both|wall|tip"));
    add_parameter("Initial penetration",
                  initial_penetration,
                  "Depth of the tip's lowest point at the start, the caisson "
                  "wished in place. Units: m.",
                  prm,
                  not_negative);
    add_parameter("Density",
                  density,
                  "Density of the body's material. Units: kg/m3.",
                  prm,
                  positive);
    add_parameter("Velocity",
                  constant_velocity,
                  "Downward velocity, unless Velocity table is set. Units: "
                  "m/s.",
                  prm,
                  Patterns::Double());
    add_parameter("Ramp time",
                  ramp_time,
                  "Time in which the velocity grows linearly from 0 to "
                  "Velocity. Units: s.",
                  prm,
                  not_negative);
    add_parameter("Velocity table",
                  table_text,
                  "Pairs time : downward velocity, separated by commas, linear "
                  "in between and constant beyond; replaces Velocity and Ramp "
                  "time. Units: s : m/s.",
                  prm,
                  Patterns::List(Patterns::List(Patterns::Double(), 2, 2, ":"),
                                 0,
                                 10000));
    add_parameter("Box left",
                  box_left,
                  "Smallest r of the box. Units: m.",
                  prm,
                  not_negative);
    add_parameter("Box right", box_right, "Largest r of the box. Units: m.");
    add_parameter("Box bottom", box_bottom, "Lowest z of the box. Units: m.");
    add_parameter("Box top", box_top, "Highest z of the box. Units: m.");

    const std::array<std::string, n_surfaces> names = {
      {"tip", "inner wall", "outer wall", "top"}};
    for (unsigned int s = 0; s < n_surfaces; ++s)
      {
        add_parameter("Friction angle of the " + names[s],
                      friction_angle[s],
                      "Contact friction angle. Units: degrees.",
                      prm,
                      Patterns::Double(0., 89.));
        add_parameter("Adhesion of the " + names[s],
                      adhesion[s],
                      "Contact adhesion. Units: Pa.",
                      prm,
                      not_negative);
      }
    parse_parameters_call_back.connect([this]() { parse_texts(); });
  }

  void
  RigidBody::parse_texts()
  {
    kind_          = kind_text == "caisson" ? Kind::caisson :
                     kind_text == "box"     ? Kind::box :
                                              Kind::none;
    corner_normals = corner_text == "both" ? CornerNormals::both :
                     corner_text == "wall" ? CornerNormals::wall :
                     corner_text == "tip"  ? CornerNormals::tip :
                                             CornerNormals::average;
    velocity_table.clear();
    for (const std::string &pair : Utilities::split_string_list(table_text))
      {
        const auto words = Utilities::split_string_list(pair, ':');
        velocity_table.emplace_back(Utilities::string_to_double(words[0]),
                                    Utilities::string_to_double(words[1]));
      }
    if (velocity_table.empty() && ramp_time > 0.)
      velocity_table = {{0., 0.}, {ramp_time, constant_velocity}};
    else if (velocity_table.empty())
      velocity_table = {{0., constant_velocity}};
  }

  void
  RigidBody::check_parameters() const
  {
    for (unsigned int i = 1; i < velocity_table.size(); ++i)
      if (velocity_table[i].first <= velocity_table[i - 1].first)
        throw BadInput("Rigid body/Velocity table: time " +
                       std::to_string(velocity_table[i].first) +
                       " s does not follow " +
                       std::to_string(velocity_table[i - 1].first) +
                       " s. List the times in increasing order.");
    if (kind_ == Kind::caisson)
      {
        if (2. * wall_thickness >= outer_diameter)
          throw BadInput(
            "Rigid body/Wall thickness = " + std::to_string(wall_thickness) +
            " m leaves no soil plug within Outer diameter = " +
            std::to_string(outer_diameter) + " m. Reduce the thickness.");
        if (tip_text == "triangular" && cells_across % 2 == 1)
          throw BadInput("Rigid body/Cells across the wall = " +
                         std::to_string(cells_across) +
                         " puts no node at the edge of the triangular tip. Use "
                         "an even number, or Tip = flat.");
        if (tip_height() >= skirt_length)
          throw BadInput("Rigid body/Tip angle = " + std::to_string(tip_angle) +
                         " degrees makes the tip longer than Skirt length = " +
                         std::to_string(skirt_length) +
                         " m. Reduce the angle.");
        if (initial_penetration > 0. && initial_penetration <= tip_height())
          throw BadInput("Rigid body/Initial penetration = " +
                         std::to_string(initial_penetration) +
                         " m leaves the tip, which is " +
                         std::to_string(tip_height()) +
                         " m high, partly above the soil surface. Increase the "
                         "penetration, or set 0.");
      }
    if (kind_ == Kind::box && (box_left >= box_right || box_bottom >= box_top))
      throw BadInput(
        "Rigid body/Box: left must lie below right and bottom below "
        "top; found r from " +
        std::to_string(box_left) + " to " + std::to_string(box_right) +
        " m and z from " + std::to_string(box_bottom) + " to " +
        std::to_string(box_top) + " m.");
  }

  double
  RigidBody::left() const
  {
    return kind_ == Kind::box ? box_left : right() - wall_thickness;
  }

  double
  RigidBody::right() const
  {
    return kind_ == Kind::box ? box_right : .5 * outer_diameter;
  }

  double
  RigidBody::bottom() const
  {
    return kind_ == Kind::box ? box_bottom : -initial_penetration;
  }

  double
  RigidBody::top_of_body() const
  {
    return kind_ == Kind::box ? box_top : skirt_length - initial_penetration;
  }

  double
  RigidBody::tip_height() const
  {
    return kind_ == Kind::caisson && tip_text == "triangular" ?
             .5 * wall_thickness * std::tan(radians(tip_angle)) :
             0.;
  }

  double
  RigidBody::lower_surface(const double r) const
  {
    if (tip_height() == 0.)
      return bottom();
    const double from_edge = std::abs(r - .5 * (left() + right()));
    return bottom() +
           tip_height() * std::min(1., 2. * from_edge / wall_thickness);
  }

  bool
  RigidBody::contains(const Point<2> &p, const double travel) const
  {
    constexpr double round_off = 1e-9;
    const double     z         = p[1] + travel; // as seen at the start
    return kind_ != Kind::none && p[0] > left() + round_off &&
           p[0] < right() - round_off && z < top_of_body() - round_off &&
           z > lower_surface(p[0]) + round_off;
  }

  double
  RigidBody::velocity(const double t) const
  {
    if (kind_ == Kind::none)
      return 0.;
    if (t <= velocity_table.front().first)
      return velocity_table.front().second;
    for (unsigned int i = 1; i < velocity_table.size(); ++i)
      if (t < velocity_table[i].first)
        {
          const auto &a = velocity_table[i - 1], &b = velocity_table[i];
          return a.second +
                 (b.second - a.second) * (t - a.first) / (b.first - a.first);
        }
    return velocity_table.back().second;
  }

  double
  RigidBody::travel(const double t) const
  {
    // exact: the velocity is linear between the times of the table
    double distance = 0., from = 0.;
    for (const auto &entry : velocity_table)
      if (entry.first > from && entry.first < t)
        {
          distance += .5 * (velocity(from) + velocity(entry.first)) *
                      (entry.first - from);
          from = entry.first;
        }
    return distance + .5 * (velocity(from) + velocity(t)) * (t - from);
  }

  double
  RigidBody::time_of_travel(const double d) const
  {
    const double end = velocity_table.back().first,
                 v   = velocity_table.back().second;
    double high      = std::max(end, 0.);
    if (travel(high) < d)
      {
        if (kind_ == Kind::none || v <= 0.)
          return std::numeric_limits<double>::infinity();
        return high + (d - travel(high)) / v;
      }
    double low = 0.;
    for (unsigned int i = 0; i < 200 && low < high; ++i)
      {
        const double middle               = .5 * (low + high);
        (travel(middle) < d ? low : high) = middle;
      }
    return high;
  }

  double
  RigidBody::max_velocity() const
  {
    double result = 0.;
    for (const auto &entry : velocity_table)
      result = std::max(result, std::abs(entry.second));
    return kind_ == Kind::none ? 0. : result;
  }

  double
  RigidBody::friction_coefficient(const Surface surface) const
  {
    return std::tan(radians(friction_angle[surface]));
  }
} // namespace CaissonMPM
