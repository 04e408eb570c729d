// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/domain/cell_geometry.h>
#include <caisson_mpm/domain/point_generator.h>
#include <caisson_mpm/materials/umat_law.h>

#include <deal.II/base/patterns.h>

#include <cmath>
#include <random>

namespace CaissonMPM
{
  using namespace dealii;

  PointGenerator::PointGenerator()
    : Section("/Material points")
  {
    declare_numbers();
    declare_region();
    add_parameter(
      "Random positions",
      randomness,
      "",
      "Material points lie this far from their regular lattice, at random: 0 "
      "on it, 1 anywhere in their part of the cell.",
      Patterns::Double(0., 1.));
    add_parameter("Random seed",
                  seed,
                  "",
                  "Equal seeds give equal random positions.",
                  Patterns::Integer(0));
    add_parameter(
      "Split and merge",
      adaptive,
      "",
      "The run begins with the material points that the mesh needs at the "
      "start, splits those that move into smaller cells and merges those that "
      "move into larger ones; otherwise it begins with all that the smallest "
      "cells on the way will need.");
  }

  void
  PointGenerator::declare_numbers()
  {
    const Patterns::Integer number(1, 16);
    const Patterns::Double  not_negative(0.);
    add_parameter(
      "Per direction in path",
      per_direction[0],
      "",
      "Cells in the path of the wall hold this many material points per "
      "direction.",
      number);
    add_parameter(
      "Per direction near",
      per_direction[1],
      "",
      "Cells near the wall hold this many material points per direction.",
      number);
    add_parameter(
      "Per direction far",
      per_direction[2],
      "",
      "Cells neither in the path of the wall nor near it hold this many "
      "material points per direction.",
      number);
    add_parameter(
      "Largest number of points",
      largest_number,
      "",
      "More material points than this are refused before they are created; a "
      "point takes about 220 bytes of memory.",
      Patterns::Integer(1))
      .influence = Influence::motion;
    add_parameter(
      "Path margin",
      path_margin,
      "m",
      "The path of the wall reaches this far beyond both of its faces.",
      not_negative);
    add_parameter(
      "Near distance",
      near_distance,
      "m",
      "Cells within this distance of the wall's faces count as near the wall.",
      not_negative);
  }

  void
  PointGenerator::declare_region()
  {
    add_parameter("Region left",
                  region_left,
                  "m",
                  "The soil begins at this r.",
                  Patterns::Double(0.));
    add_parameter("Region right",
                  region_right,
                  "m",
                  "The soil ends at this r.");
    add_parameter("Region bottom",
                  region_bottom,
                  "m",
                  "The soil begins at this z.");
    add_parameter("Region top", region_top, "m", "The soil ends at this z.");
    add_parameter(
      "Region",
      region,
      "",
      "Soil is generated only where this expression in r, z and pi is "
      "positive; an empty one sets no further limit.");
  }

  Expression
  PointGenerator::parse_region() const
  {
    return region.empty() ? Expression() :
                            Expression(region, "Material points/Region");
  }

  void
  PointGenerator::name_unused_entries(ParameterOrigins &origins) const
  {
    if (randomness == 0.)
      origins.add_unused({"Material points/Random seed"},
                         "Material points/Random positions is 0");
  }

  void
  PointGenerator::check_parameters() const
  {
    parse_region();
  }

  PointGenerator::PointZone
  PointGenerator::zone_of(const Kernels::CellGeometry &g,
                          const BodyShape             &body,
                          const double                 travel) const
  {
    if (!body.exists())
      return PointZone::far;
    const double middle = g.left + .5 * g.width;
    const double distance =
      std::max({body.left() - middle, middle - body.right(), 0.});
    constexpr double path_below = .5; // the deepest position of the tip, m
    if (distance < path_margin &&
        g.bottom_left + g.height_left > body.bottom() - travel - path_below)
      return PointZone::path;
    return distance < near_distance ? PointZone::near : PointZone::far;
  }

  unsigned int
  PointGenerator::points_per_direction(const Kernels::CellGeometry &g,
                                       const BodyShape             &body,
                                       const double travel) const
  {
    return per_direction[static_cast<unsigned int>(zone_of(g, body, travel))];
  }

  std::array<double, 2>
  PointGenerator::wanted_size(const Kernels::CellGeometry &g,
                              const BodyShape             &body,
                              const double                 travel) const
  {
    const unsigned int n = points_per_direction(g, body, travel);
    return {{g.width / n, height_of(g) / n}};
  }

  namespace
  {
    /** Integrals of r^k height(r) dr over a part of a cell, k = 0, 1, 2. */
    std::array<double, 3>
    radial_moments(const Kernels::CellGeometry &g,
                   const double                 a,
                   const double                 b)
    {
      // three Gauss points are exact up to degree 5
      constexpr double      offset  = 0.7745966692414834; // sqrt(3/5)
      const double          x[3]    = {-offset, 0., offset};
      const double          w[3]    = {5. / 18., 8. / 18., 5. / 18.};
      std::array<double, 3> moments = {{0., 0., 0.}};
      for (unsigned int q = 0; q < 3; ++q)
        {
          const double r = .5 * (a + b) + .5 * (b - a) * x[q];
          const double height =
            g.height_left +
            (g.height_right - g.height_left) * (r - g.left) / g.width;
          const double weight = w[q] * (b - a) * height;
          moments[0] += weight;
          moments[1] += weight * r;
          moments[2] += weight * r * r;
        }
      return moments;
    }

    /** Numbers from 0 to 1 that are the same on all machines. */
    class RandomNumbers
    {
    public:
      RandomNumbers(const unsigned int seed)
        : engine(seed)
      {}

      double
      operator()()
      {
        return (engine() >> 11) * 0x1p-53; // the upper 53 of 64 bits
      }

    private:
      std::mt19937_64 engine;
    };
  } // namespace

  Kernels::CellGeometry
  PointGenerator::soil_of(const GridLines &lines, const GlobalCell cell) const
  {
    constexpr double nothing = 1e-6; // of a cell
    const auto       whole   = lines.initial_geometry(cell);
    // rows that bend around a tip cross the soil surface
    auto         g      = region_top > 0. ? whole : part_below(whole, 0.);
    const double center = g.bottom_left + .5 * g.height_left;
    if (lines.is_body_cell(cell) || center > region_top ||
        center < region_bottom || height_of(g) < nothing * height_of(whole))
      g.height_left = g.height_right = 0.;
    return g;
  }

  PointGenerator::Parts
  PointGenerator::number_of_parts(const GridLines &lines,
                                  const BodyShape &body,
                                  const GlobalCell cell,
                                  const bool       splits) const
  {
    const auto   g      = soil_of(lines, cell);
    const double height = std::max(g.height_left, g.height_right);
    if (height == 0.)
      return {{0, 0}};
    const auto         whole = lines.initial_geometry(cell);
    const unsigned int n =
      points_per_direction(whole, body, lines.total_travel());
    const auto parts = [n](const double size, const double smallest) {
      return static_cast<unsigned int>(std::ceil(n * size / smallest - 1e-6));
    };
    if (splits)
      return {
        {n, parts(height, std::max(whole.height_left, whole.height_right))}};
    return {{parts(g.width, lines.smallest_width_met(cell)),
             parts(height, lines.smallest_height_met(cell))}};
  }

  std::vector<PointGenerator::Parts>
  PointGenerator::number_of_parts(const GridLines &lines,
                                  const BodyShape &body) const
  {
    std::vector<Parts>    parts;
    std::array<double, 3> n_points = {{0., 0., 0.}}; // by zone
    for (unsigned int c = 0; c < lines.n_cells(); ++c)
      {
        const auto      g    = lines.initial_geometry(GlobalCell(c));
        const PointZone zone = zone_of(g, body, lines.total_travel());
        parts.push_back(number_of_parts(lines, body, GlobalCell(c), adaptive));
        n_points[static_cast<unsigned int>(zone)] +=
          double(parts[c][radial]) * parts[c][vertical];
      }
    check_number(n_points);
    return parts;
  }

  double
  PointGenerator::n_points_that_split(const GridLines &lines,
                                      const BodyShape &body) const
  {
    double n = 0.;
    for (unsigned int c = 0; c < lines.n_cells(); ++c)
      {
        const Parts parts = number_of_parts(lines, body, GlobalCell(c), true);
        n += double(parts[radial]) * parts[vertical];
      }
    return n;
  }

  void
  PointGenerator::check_number(const std::array<double, 3> &n_points) const
  {
    const double n = n_points[0] + n_points[1] + n_points[2];
    if (n <= largest_number)
      return;
    constexpr double      bytes_per_point = 220.;
    constexpr const char *names[]         = {"in path", "near", "far"};
    const unsigned int    most =
      std::max_element(n_points.begin(), n_points.end()) - n_points.begin();
    throw BadInput(
      "The soil would have up to " + to_text(n, 6) +
      " material points and take about " +
      to_text(n * bytes_per_point * 1e-9, 3) +
      " GB of memory, more than Material points/Largest number of points = " +
      to_text(largest_number) + ". Most of them, " +
      to_text(n_points[most], 6) +
      ", are those of Material points/Per direction " + names[most] + " = " +
      to_text(per_direction[most]) +
      (adaptive ? ": reduce it, or take larger cells." :
                  ": reduce it, take larger cells, or set Split and merge = "
                  "true where the rows below the body are compressed."));
  }

  namespace
  {
    /** A part of a cell, which becomes a material point. */
    struct Part
    {
      Point<2> position;
      double   volume;
      double   size[2]; // in r and z
    };

    /** Call action(part) for all parts of a cell, column by column. */
    template <typename Action>
    void
    for_each_part(const Kernels::CellGeometry       &g,
                  const bool                         axisymmetric,
                  const std::array<unsigned int, 2> &n,
                  RandomNumbers                     &random,
                  const double                       randomness,
                  const Action                      &action)
    {
      const unsigned int k = axisymmetric ? 1 : 0;
      for (unsigned int i = 0; i < n[radial]; ++i)
        {
          const auto moments =
            radial_moments(g,
                           g.left + g.width * i / n[radial],
                           g.left + g.width * (i + 1) / n[radial]);
          const double center =
            (moments[k + 1] / moments[k] - g.left) / g.width;
          for (unsigned int j = 0; j < n[vertical]; ++j)
            {
              double xi = center, eta = (j + .5) / n[vertical];
              if (randomness > 0.)
                {
                  xi += randomness * ((i + random()) / n[radial] - xi);
                  eta += randomness * ((j + random()) / n[vertical] - eta);
                }
              action(
                Part{to_position(g, Point<2>(xi, eta)),
                     moments[k] / n[vertical],
                     {g.width / n[radial],
                      std::max(g.height_left, g.height_right) / n[vertical]}});
            }
        }
    }

    /** Makes material points of the undisturbed soil. */
    class PointMaker
    {
    public:
      explicit PointMaker(const Soil &soil)
        : soil(soil)
        , velocity(soil.initial_velocity())
      {
        for (unsigned int i = 0; i < soil.n_materials(); ++i)
          {
            const SoilMaterial &m = soil.material(i);
            states.push_back(m.start_of_state());
            user_states.push_back(
              m.umat ? m.umat->start_of_state(m.umat_stiffness.p_wave_modulus,
                                              soil.n_user_state()) :
                       std::vector<double>(soil.n_user_state(), no_state));
          }
      }

      MaterialPoint
      operator()(const Part &part, const double id) const
      {
        MaterialPoint p;
        p.position = p.initial_position = part.position;
        p.material = soil.material_at(part.position[vertical]);
        p.stress   = soil.initial_stress(part.position);
        for (unsigned int d = 0; d < 2; ++d)
          {
            if (!velocity[d].is_zero())
              p.velocity[d] = velocity_at(p.position, d);
            p.size[d] = part.size[d];
          }
        p.state      = states[p.material];
        p.user_state = user_states[p.material];
        if (const auto &umat = soil.material(p.material).umat)
          umat->initialize(p.position[radial],
                           p.position[vertical],
                           id,
                           p.user_state.data());
        p.volume = p.initial_volume = part.volume;
        p.mass = soil.inertial_density(p.material) * p.volume;
        p.id   = id;
        return p;
      }

    private:
      double
      velocity_at(const Point<2> &place, const unsigned int component) const
      {
        const double v = velocity[component](place, 0.);
        if (!std::isfinite(v))
          throw BadInput("Soil/Initial velocity is " + to_text(v) +
                         " m/s at r = " + to_text(place[radial]) +
                         " m, z = " + to_text(place[vertical]) +
                         " m. Write an expression that is finite where there "
                         "is soil.");
        return v;
      }

      const Soil                 &soil;
      const VectorExpression      velocity;
      std::vector<StateVariables> states;
      // [material], of user materials
      std::vector<std::vector<double>> user_states;
    };
  } // namespace

  bool
  PointGenerator::is_in_region(const Point<2>   &place,
                               const Expression &further) const
  {
    const double r                = place[radial];
    const bool   is_above_surface = region_top <= 0. && place[vertical] > 0.;
    if (r < region_left || r > region_right || is_above_surface)
      return false;
    if (further.empty())
      return true;
    const double value = further(place, 0.);
    if (!std::isfinite(value))
      throw BadInput("Material points/Region = " + region + " is " +
                     to_text(value) + " at r = " + to_text(r) +
                     " m, z = " + to_text(place[vertical]) +
                     " m. Write an expression that is finite everywhere.");
    return value > 0.;
  }

  void
  PointGenerator::generate(const BackgroundGrid &grid,
                           const BodyShape      &body,
                           const Soil           &soil,
                           MaterialPoints       &points) const
  {
    const GridLines          &lines = grid.lines();
    const auto                parts = number_of_parts(lines, body);
    std::vector<unsigned int> n_in_cell;
    for (const Parts &n : parts)
      n_in_cell.push_back(n[radial] * n[vertical]);
    points.reset(n_in_cell);

    const PointMaker make_point(soil);
    const Expression further = parse_region();
    RandomNumbers    random(seed);
    unsigned int     n_points = 0;
    // Every rank goes through all cells, so that a point's number and random
    // position do not depend on the number of ranks.
    for (unsigned int c = 0; c < lines.n_cells(); ++c)
      for_each_part(soil_of(lines, GlobalCell(c)),
                    lines.axisymmetric(),
                    parts[c],
                    random,
                    randomness,
                    [&](const Part &part) {
                      if (!is_in_region(part.position, further))
                        return;
                      const double id = n_points++;
                      if (grid.is_owned(GlobalCell(c)))
                        points.add(grid.local_number(GlobalCell(c)),
                                   make_point(part, id));
                    });
    if (n_points == 0)
      throw BadInput("No material point lies in the region of the soil: check "
                     "Material points/Region left, right, bottom and top, and "
                     "Region, against the mesh.");
    points.settle();
  }
} // namespace CaissonMPM
