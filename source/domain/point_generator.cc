// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/domain/point_generator.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace CaissonMPM
{
  using namespace dealii;

  PointGenerator::PointGenerator()
    : ParameterAcceptor("/Material points")
  {
    const Patterns::Integer per_direction(1, 16);
    const Patterns::Double  not_negative(0.);
    add_parameter("Per direction in path",
                  in_path,
                  "Material points per cell and direction in the path of the "
                  "wall. Units: none.",
                  prm,
                  per_direction);
    add_parameter("Per direction near",
                  near,
                  "Material points per cell and direction near the wall. "
                  "Units: none.",
                  prm,
                  per_direction);
    add_parameter("Per direction far",
                  far,
                  "Material points per cell and direction elsewhere. Units: "
                  "none.",
                  prm,
                  per_direction);
    add_parameter("Path margin",
                  path_margin,
                  "The path reaches this far beyond both faces of the wall. "
                  "Units: m.",
                  prm,
                  not_negative);
    add_parameter("Path below final depth",
                  path_below,
                  "The path ends this far below the deepest position of the "
                  "tip. Units: m.",
                  prm,
                  not_negative);
    add_parameter("Near distance",
                  near_distance,
                  "Cells within this distance of the wall's faces count as "
                  "near. Units: m.",
                  prm,
                  not_negative);
    add_parameter("Region left",
                  region_left,
                  "Smallest r with soil. Units: m.",
                  prm,
                  not_negative);
    add_parameter("Region right",
                  region_right,
                  "Largest r with soil. Units: m.");
    add_parameter("Region bottom",
                  region_bottom,
                  "Lowest z with soil. Units: m.");
    add_parameter("Region top", region_top, "Highest z with soil. Units: m.");
    add_parameter("Region",
                  region,
                  "Further limit of the soil: an expression in r, z and pi; "
                  "points lie where it is positive. Empty: no further limit. "
                  "Units: none.");
    add_parameter("Random positions",
                  randomness,
                  "How far points lie from the regular lattice, at random: 0 "
                  "on it, 1 anywhere in their part of the cell. Units: none.",
                  prm,
                  Patterns::Double(0., 1.));
    add_parameter("Random seed",
                  seed,
                  "Equal seeds give equal random positions. Units: none.",
                  prm,
                  Patterns::Integer(0));
    add_parameter("Split and merge",
                  adaptive,
                  "Begin with the points that the mesh needs at the start, "
                  "split those that come into smaller cells and merge those "
                  "that come into larger ones; else begin with all that the "
                  "smallest cells on the way will need. Units: none.");
  }

  Expression
  PointGenerator::parse_region() const
  {
    return region.empty() ? Expression() :
                            Expression(region, "Material points/Region");
  }

  void
  PointGenerator::check_parameters() const
  {
    parse_region();
  }

  unsigned int
  PointGenerator::points_per_direction(const Kernels::CellGeometry &g,
                                       const RigidBody             &body,
                                       const double travel) const
  {
    if (body.kind() == RigidBody::Kind::none)
      return far;
    const double middle = g.left + .5 * g.width;
    const double distance =
      std::max({body.left() - middle, middle - body.right(), 0.});
    if (distance < path_margin &&
        g.bottom_left + g.height_left > body.bottom() - travel - path_below)
      return in_path;
    return distance < near_distance ? near : far;
  }

  std::array<double, 2>
  PointGenerator::wanted_size(const Kernels::CellGeometry &g,
                              const RigidBody             &body,
                              const double                 travel) const
  {
    const unsigned int n = points_per_direction(g, body, travel);
    return {{g.width / n, .5 * (g.height_left + g.height_right) / n}};
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

  std::vector<std::string>
  PointGenerator::known_limits(const RigidBody &body) const
  {
    if (body.kind() == RigidBody::Kind::caisson && body.cells_across > 3 &&
        in_path < 7)
      return {"with four cells or more across the wall and fewer than seven "
              "points per direction in the path, the tip has been seen to "
              "break loose: set Material points/Per direction in path = 7; see "
              "doc/limitations.md, Snaps"};
    return {};
  }

  bool
  PointGenerator::may_hold_soil(const BackgroundGrid &grid,
                                const unsigned int    global_cell) const
  {
    const auto   g        = grid.initial_geometry(global_cell);
    const double center_z = g.bottom_left + .5 * g.height_left;
    return !grid.is_body_cell(global_cell) && center_z <= region_top &&
           center_z >= region_bottom;
  }

  PointGenerator::Parts
  PointGenerator::number_of_parts(const BackgroundGrid &grid,
                                  const RigidBody      &body,
                                  const unsigned int    global_cell) const
  {
    if (!may_hold_soil(grid, global_cell))
      return {{0, 0}};
    const auto         g = grid.initial_geometry(global_cell);
    const unsigned int n = points_per_direction(g, body, grid.total_travel());
    if (adaptive)
      return {{n, n}};
    const auto parts = [n](const double size, const double smallest) {
      return static_cast<unsigned int>(std::ceil(n * size / smallest - 1e-6));
    };
    return {{parts(g.width, grid.smallest_width_met(global_cell)),
             parts(std::max(g.height_left, g.height_right),
                   grid.smallest_height_met(global_cell))}};
  }

  void
  PointGenerator::generate(const BackgroundGrid &grid,
                           const RigidBody      &body,
                           const Soil           &soil,
                           const double          mass_scaling,
                           MaterialPoints       &points) const
  {
    const unsigned int n_cells  = grid.n_global_cells();
    const auto         is_owned = [&grid](const unsigned int cell) {
      const unsigned int local = grid.local_number(cell);
      return local != numbers::invalid_unsigned_int && grid.is_owned(local);
    };
    std::vector<Parts> parts;
    unsigned long      n_blocks = 0;
    for (unsigned int cell = 0; cell < n_cells; ++cell)
      {
        parts.push_back(number_of_parts(grid, body, cell));
        const unsigned int n = parts[cell][radial] * parts[cell][vertical];
        if (is_owned(cell))
          n_blocks += (n + Kernels::block_size - 1) / Kernels::block_size;
      }
    points.reset(n_blocks + n_blocks / 16);

    const Expression       in_region = parse_region();
    const VectorExpression velocity  = soil.initial_velocity();
    RandomNumbers          random(seed);
    const unsigned int     k  = grid.axisymmetric() ? 1 : 0;
    unsigned int           id = 0;

    std::vector<StateVariables> states;
    for (unsigned int i = 0; i < soil.n_layers(); ++i)
      states.push_back(soil.layer(i).start_of_state());
    // Every rank goes through all cells, so that a point's number and random
    // position do not depend on the number of ranks.
    for (unsigned int cell = 0; cell < n_cells; ++cell)
      {
        const auto         g     = grid.initial_geometry(cell);
        const unsigned int local = grid.local_number(cell);
        const bool         owned = is_owned(cell);
        const unsigned int n_r   = parts[cell][radial],
                           n_z   = parts[cell][vertical];
        for (unsigned int i = 0; i < n_r; ++i)
          {
            const auto moments =
              radial_moments(g,
                             g.left + g.width * i / n_r,
                             g.left + g.width * (i + 1) / n_r);
            const double center =
              (moments[k + 1] / moments[k] - g.left) / g.width;
            for (unsigned int j = 0; j < n_z; ++j)
              {
                double xi = center, eta = (j + .5) / n_z;
                if (randomness > 0.)
                  {
                    xi += randomness * ((i + random()) / n_r - xi);
                    eta += randomness * ((j + random()) / n_z - eta);
                  }
                const Point<2> place = to_position(g, Point<2>(xi, eta));
                const double   r = place[0], z = place[1];
                if (r < region_left || r > region_right ||
                    (!in_region.empty() &&
                     !(in_region(Point<2>(r, z), 0.) > 0.)))
                  continue;
                const double number = id++;
                if (!owned)
                  continue;
                MaterialPoint p;
                p.position = p.initial_position = Point<2>(r, z);
                p.material                      = soil.layer_at(z);
                p.stress                        = soil.initial_stress(z);
                for (unsigned int d = 0; d < 2; ++d)
                  if (!velocity[d].is_zero())
                    p.velocity[d] = velocity[d](p.position, 0.);
                p.state  = states[p.material];
                p.volume = p.initial_volume = moments[k] / n_z;
                p.size[radial]              = g.width / n_r;
                p.size[vertical] =
                  std::max(g.height_left, g.height_right) / n_z;
                p.mass =
                  mass_scaling * soil.inertial_density(p.material) * p.volume;
                p.id = number;
                points.add(local, p);
              }
          }
      }
    if (id == 0)
      throw BadInput("No material point lies in the region of the soil: check "
                     "Material points/Region left, right, bottom and top, and "
                     "Region, against the mesh.");
    points.settle();
  }
} // namespace CaissonMPM
