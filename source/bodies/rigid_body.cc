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
    add_parameter(
      "Kind",
      kind_text,
      "none; caisson: a tube that is pushed into the soil; cone: a "
      "cone on the axis with its point down and a shaft above; box: "
      "a rectangle in (r, z); cylinder: on the axis, as high as the "
      "mesh, with a radius that grows by Velocity. Units: none.",
      prm,
      Patterns::Selection("none|caisson|box|cone|cylinder"));
    add_parameter(
      "Outer diameter",
      outer_diameter,
      "Outer diameter of the caisson, of the cone and its shaft, or "
      "of the cylinder at the start. Units: m.",
      prm,
      positive);
    add_parameter("Skirt length",
                  skirt_length,
                  "Length of the skirt, or of the shaft of a cone; tip "
                  "included. Units: m.",
                  prm,
                  positive);
    add_parameter("Wall thickness",
                  wall_thickness,
                  "Thickness of the skirt. Units: m.",
                  prm,
                  positive);
    add_parameter(
      "Cells across the wall",
      cells_across,
      "Number of cells across the wall: the cell size at the tip "
      "is the thickness over this number. Even for a triangular "
      "tip. For a cone or cylinder: across its radius. Units: none.",
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
    add_parameter("Apex angle",
                  apex_angle,
                  "Full angle of the cone at its point. Units: degrees.",
                  prm,
                  Patterns::Double(20., 170.));
    add_parameter("Lid thickness",
                  lid_thickness,
                  "Thickness of the lid that closes the top of the caisson; 0: "
                  "none. Units: m.",
                  prm,
                  not_negative);
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
                  "or cone wished in place. Units: m.",
                  prm,
                  not_negative);
    add_parameter("Density",
                  density,
                  "Density of the body's material. Units: kg/m3.",
                  prm,
                  positive);
    add_parameter("Velocity",
                  constant_velocity,
                  "Velocity, downward positive (of a cylinder's radius: "
                  "outward), unless Velocity table is set. Units: m/s.",
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
                  "Pairs time : velocity, separated by commas, linear in "
                  "between and constant beyond; replaces Velocity and Ramp "
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
      {"tip", "inner wall", "outer wall", "top", "lid"}};
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
    kind_          = kind_text == "caisson"  ? Kind::caisson :
                     kind_text == "box"      ? Kind::box :
                     kind_text == "cone"     ? Kind::cone :
                     kind_text == "cylinder" ? Kind::cylinder :
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
      check_caisson();
    if (kind_ == Kind::cone && skirt_length <= tip_height())
      throw BadInput(
        "Rigid body/Skirt length = " + std::to_string(skirt_length) +
        " m must exceed the height of the cone, " +
        std::to_string(tip_height()) + " m.");
    if (kind_ == Kind::cone && initial_penetration <= tip_height())
      throw BadInput("Rigid body/Initial penetration = " +
                     std::to_string(initial_penetration) +
                     " m leaves the cone, which is " +
                     std::to_string(tip_height()) +
                     " m high, partly above the soil surface. Increase the "
                     "penetration.");
    if (kind_ == Kind::cylinder && adhesion[outer_wall] > 0.)
      throw BadInput("Rigid body/Adhesion of the outer wall: the area of an "
                     "expanding cylinder changes, adhesion on it is not "
                     "possible. Set it to 0.");
    if (lid_thickness > 0. && kind_ != Kind::caisson)
      throw BadInput("Rigid body/Lid thickness: only a caisson has a lid. Set "
                     "it to 0, or Kind = caisson.");
    if (kind_ == Kind::box && (box_left >= box_right || box_bottom >= box_top))
      throw BadInput(
        "Rigid body/Box: left must lie below right and bottom below "
        "top; found r from " +
        std::to_string(box_left) + " to " + std::to_string(box_right) +
        " m and z from " + std::to_string(box_bottom) + " to " +
        std::to_string(box_top) + " m.");
  }

  void
  RigidBody::check_caisson() const
  {
    if (2. * wall_thickness >= outer_diameter)
      throw BadInput(
        "Rigid body/Wall thickness = " + std::to_string(wall_thickness) +
        " m leaves no soil plug within Outer diameter = " +
        std::to_string(outer_diameter) + " m. Reduce the thickness.");
    if (tip_text == "triangular" && cells_across % 2 == 1)
      throw BadInput(
        "Rigid body/Cells across the wall = " + std::to_string(cells_across) +
        " puts no node at the edge of the triangular tip. Use "
        "an even number, or Tip = flat.");
    if (tip_height() >= skirt_length)
      throw BadInput("Rigid body/Tip angle = " + std::to_string(tip_angle) +
                     " degrees makes the tip longer than Skirt length = " +
                     std::to_string(skirt_length) + " m. Reduce the angle.");
    if (initial_penetration > 0. && initial_penetration <= tip_height())
      throw BadInput("Rigid body/Initial penetration = " +
                     std::to_string(initial_penetration) +
                     " m leaves the tip, which is " +
                     std::to_string(tip_height()) +
                     " m high, partly above the soil surface. Increase the "
                     "penetration, or set 0.");
    if (has_lid() && lower_face_of_lid() < -1e-9)
      throw BadInput(
        "Rigid body/Lid thickness = " + std::to_string(lid_thickness) +
        " m puts the lid's lower face at z = " +
        std::to_string(lower_face_of_lid()) +
        " m, below the soil surface. Reduce it or Initial "
        "penetration, or increase Skirt length.");
  }

  double
  RigidBody::left() const
  {
    return kind_ == Kind::box     ? box_left :
           kind_ == Kind::caisson ? right() - wall_thickness :
                                    0.;
  }

  double
  RigidBody::right() const
  {
    return kind_ == Kind::box ? box_right : .5 * outer_diameter;
  }

  double
  RigidBody::bottom() const
  {
    return kind_ == Kind::box      ? box_bottom :
           kind_ == Kind::cylinder ? -std::numeric_limits<double>::infinity() :
                                     -initial_penetration;
  }

  double
  RigidBody::top_of_body() const
  {
    return kind_ == Kind::box      ? box_top :
           kind_ == Kind::cylinder ? std::numeric_limits<double>::infinity() :
                                     skirt_length - initial_penetration;
  }

  double
  RigidBody::tip_height() const
  {
    if (kind_ == Kind::cone)
      return right() / std::tan(radians(.5 * apex_angle));
    return kind_ == Kind::caisson && tip_text == "triangular" ?
             .5 * wall_thickness * std::tan(radians(tip_angle)) :
             0.;
  }

  double
  RigidBody::cell_width() const
  {
    return kind_ == Kind::box     ? 0. :
           kind_ == Kind::caisson ? wall_thickness / cells_across :
                                    right() / cells_across;
  }

  double
  RigidBody::lower_surface(const double r) const
  {
    if (tip_height() == 0.)
      return bottom();
    const bool   is_cone   = kind_ == Kind::cone;
    const double edge      = is_cone ? 0. : .5 * (left() + right());
    const double half_base = is_cone ? right() : .5 * wall_thickness;
    return bottom() +
           tip_height() * std::min(1., std::abs(r - edge) / half_base);
  }

  bool
  RigidBody::contains(const Point<2> &p, const double travel) const
  {
    constexpr double round_off = 1e-9;
    if (kind_ == Kind::none)
      return false;
    if (kind_ == Kind::cylinder)
      return p[0] < right() + travel - round_off;
    const double z = p[1] + travel; // as seen at the start
    if (has_lid() && p[0] < left() + round_off)
      return z < top_of_body() - round_off &&
             z > lower_face_of_lid() + round_off;
    return p[0] > left() + round_off && p[0] < right() - round_off &&
           z < top_of_body() - round_off && z > bottom() + round_off &&
           z > lower_surface(p[0]) + round_off;
  }

  Tensor<1, 2>
  RigidBody::direction() const
  {
    return kind_ == Kind::cylinder ? Tensor<1, 2>({1., 0.}) :
                                     Tensor<1, 2>({0., -1.});
  }

  Point<2>
  RigidBody::moved(const Point<2> &p, const double travel) const
  {
    if (kind_ == Kind::cylinder)
      return Point<2>(p[0] * (1. + travel / right()), p[1]);
    return Point<2>(p[0], p[1] - travel);
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
    constexpr double never = std::numeric_limits<double>::infinity();
    if (kind_ == Kind::none)
      return never;
    if (d == 0.)
      return 0.;
    const double end  = std::max(velocity_table.back().first, 0.);
    double       from = 0.;
    for (const double to : turning_times(end))
      {
        // monotone from one of these times to the next
        const double sign = travel(to) > travel(from) ? 1. : -1.;
        if (sign * (d - travel(from)) >= 0. && sign * (travel(to) - d) >= 0.)
          {
            double low = from, high = to;
            for (unsigned int i = 0; i < 200 && low < high; ++i)
              {
                const double middle = .5 * (low + high);
                (sign * (travel(middle) - d) < 0. ? low : high) = middle;
              }
            return high;
          }
        from = to;
      }
    const double left = d - travel(end), v = velocity_table.back().second;
    return left * v > 0. ? end + left / v : never;
  }

  std::vector<double>
  RigidBody::turning_times(const double end) const
  {
    std::vector<double> times;
    for (unsigned int i = 0; i < velocity_table.size(); ++i)
      {
        const auto &b = velocity_table[i];
        if (i > 0)
          {
            const auto &a = velocity_table[i - 1];
            if (a.second * b.second < 0.)
              times.push_back(a.first + (b.first - a.first) * a.second /
                                          (a.second - b.second));
          }
        times.push_back(b.first);
      }
    times.push_back(end);
    times.erase(std::remove_if(times.begin(),
                               times.end(),
                               [end](const double t) {
                                 return t <= 0. || t > end;
                               }),
                times.end());
    std::sort(times.begin(), times.end());
    return times;
  }

  std::pair<double, double>
  RigidBody::travel_range(const double t) const
  {
    std::pair<double, double> range(0., 0.);
    for (const double turn : turning_times(t))
      {
        range.first  = std::min(range.first, travel(turn));
        range.second = std::max(range.second, travel(turn));
      }
    return range;
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
