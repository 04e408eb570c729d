// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The floor of the bodies: graded lines, the rigid body's motion and shape, the
// mesh that moves with it, the generated points, and the boundary conditions.
#include <caisson_mpm/domain/graded_lines.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>
#include <set>
#include <vector>

#include "scene.h"

const std::string caisson = R"(
  subsection Rigid body
    set Kind                  = caisson
    set Outer diameter        = 6
    set Skirt length          = 3
    set Wall thickness        = 0.2
    set Cells across the wall = 2
    set Tip angle             = 60
    set Initial penetration   = 0.5
  end
  subsection Grid
    set Outer radius          = 8
    set Bottom                = -7
    set Top                   = 4
    set Cell width            = 1
    set Cell height           = 0.5
    set Moving zone below tip = 2
  end
  )";

// ------------------------------------------------------------ lines

void
check_lines()
{
  const auto uniform = graded_lines({0., 1., 2.5}, [](double) { return .3; });
  bool       through = std::count(uniform.begin(), uniform.end(), 1.) == 1;
  double     largest = 0.;
  for (unsigned int i = 1; i < uniform.size(); ++i)
    largest = std::max(largest, uniform[i] - uniform[i - 1]);
  std::printf("lines: %d through 1: %d, largest %.4f\n",
              int(uniform.size()),
              through,
              largest);
  const auto graded =
    graded_lines({0., 10.}, [](const double x) { return .1 + .2 * x; });
  double smallest_ratio = 1e9, largest_ratio = 0.;
  for (unsigned int i = 2; i < graded.size(); ++i)
    {
      const double ratio =
        (graded[i] - graded[i - 1]) / (graded[i - 1] - graded[i - 2]);
      smallest_ratio = std::min(smallest_ratio, ratio);
      largest_ratio  = std::max(largest_ratio, ratio);
    }
  verdict("graded lines: spread of the ratio",
          largest_ratio - smallest_ratio,
          1e-2);
  std::printf("ratio %.2f\n", largest_ratio);
}

// ------------------------------------------------------------ rigid body

void
check_motion()
{
  Scene        s(caisson + "subsection Rigid body\n"
                           "set Velocity table = 0:0, 2:0.1, 4:0.1, 6:0.3\nend\n");
  double       distance = 0., speed = 0., time = 0.;
  const double exact[][3] = {{1., .025, .05},
                             {2., .1, .1},
                             {3., .2, .1},
                             {5., .45, .2},
                             {6., .7, .3},
                             {8., 1.3, .3}};
  for (const auto &e : exact)
    {
      distance = std::max(distance, std::abs(s.body.travel(e[0]) - e[1]));
      speed    = std::max(speed, std::abs(s.body.velocity(e[0]) - e[2]));
      time     = std::max(time, std::abs(s.body.time_of_travel(e[1]) - e[0]));
    }
  verdict("velocity table: travel error", distance, 1e-14);
  verdict("velocity table: velocity error", speed, 1e-14);
  verdict("velocity table: time of travel error", time, 1e-12);
  verdict("largest velocity error", std::abs(s.body.max_velocity() - .3), 0.);

  Scene ramp(caisson + "subsection Rigid body\nset Velocity = 0.1\n"
                       "set Ramp time = 0.5\nend\n");
  verdict("ramp: travel error",
          std::abs(ramp.body.travel(.25) - .00625) +
            std::abs(ramp.body.travel(2.) - .175),
          1e-14);
  Scene pulled(caisson + "subsection Rigid body\n"
                         "set Velocity table = 0:0.1, 2:-0.1, 3:-0.1\nend\n");
  // down by 0.05 m until 1 s, back at 2 s, and up from there
  const auto range = pulled.body.travel_range(4.);
  verdict("down and up: range error",
          std::abs(range.first + .2) + std::abs(range.second - .05),
          1e-14);
  verdict("down and up: time of travel error",
          std::abs(pulled.body.time_of_travel(.0375) - .5) +
            std::abs(pulled.body.time_of_travel(-.05) - 2.5) +
            std::abs(pulled.body.time_of_travel(-.15) - 3.5),
          1e-12);
  std::printf("a depth never reached: %s\n",
              std::isinf(pulled.body.time_of_travel(.051)) ? "infinite" :
                                                             "finite");
  Scene stops(caisson + "subsection Rigid body\n"
                        "set Velocity table = 0:0.1, 1:0\nend\n");
  std::printf("a depth never reached: %s\n",
              std::isinf(stops.body.time_of_travel(.051)) ? "infinite" :
                                                            "finite");
}

void
check_shape()
{
  Scene        s(caisson);
  const double h = .1 * std::tan(pi / 3.);
  verdict("tip height error", std::abs(s.body.tip_height() - h), 1e-14);
  verdict("tip surface error",
          std::abs(s.body.lower_surface(2.9) + .5) +
            std::abs(s.body.lower_surface(2.8) + .5 - h) +
            std::abs(s.body.lower_surface(2.95) + .5 - .5 * h),
          1e-14);
  const auto inside = [&s](const double r, const double z) {
    return s.body.contains(dealii::Point<2>(r, z), 1.);
  };
  std::printf("inside: %d%d%d%d%d%d\n",
              inside(2.9, 0.),
              inside(2.9, -1.49),
              inside(2.81, -1.45),
              inside(2.79, 0.),
              inside(2.9, 1.6),
              inside(3.01, 0.));

  // one point per cell, with the mass of the steel
  const auto   points = generate_body_points(s.grid, s.body);
  double       mass = 0., volume = 0.;
  unsigned int n = 0;
  for (const auto &p : points)
    {
      mass += p.mass;
      volume += p.volume;
      n += s.grid.is_rigid(p.cell) && s.body.contains(p.position, 0.);
    }
  const double exact =
    pi * (9. - 2.8 * 2.8) * (3. - h) + .5 * h * pi * (9. - 2.8 * 2.8);
  verdict("body points outside", points.size() - double(n), 0.);
  verdict("body volume error", std::abs(volume / exact - 1.), 1e-3);
  verdict("body density error", std::abs(mass / volume / 7850. - 1.), 1e-12);
}

// ------------------------------------------------------------ mesh

void
check_mesh(const std::string &upper, const bool fixed_top)
{
  const double travel = 3., d = 1.7;
  Scene s(caisson + "subsection Grid\nset Upper zone = " + upper + "\nend\n",
          travel);
  std::vector<double> z0;
  for (unsigned int n = 0; n < s.grid.n_nodes(); ++n)
    z0.push_back(s.grid.z_of(n));
  double rigid = 0., total = 0.;
  for (unsigned int c = 0; c < s.grid.n_cells(); ++c)
    {
      const auto  &g = s.grid.geometry(c);
      const double r = g.left + .5 * g.width,
                   V = 2. * pi * g.width *
                       (r * .5 * (g.height_left + g.height_right) +
                        g.width * (g.height_right - g.height_left) / 12.);
      total += V;
      if (s.grid.is_rigid(c))
        rigid += V;
    }
  const double h = s.body.tip_height();
  verdict("rigid cells: volume error",
          std::abs(rigid / (pi * (9. - 2.8 * 2.8) * (3. - .5 * h)) - 1.),
          1e-12);
  verdict("all cells: volume error",
          std::abs(total / (pi * 64. * 11.) - 1.),
          1e-12);

  s.grid.prepare_motion(d);
  s.grid.advance();
  s.grid.write_vertices();
  double        motion = 0., vertices = 0., smallest = 1e9;
  std::set<int> zones;
  const double  zone_bottom = -2.5;
  for (unsigned int c = 0; c < s.grid.n_cells(); ++c)
    {
      const auto &g    = s.grid.geometry(c);
      const auto &cell = s.grid.cell_iterator(c);
      zones.insert(static_cast<int>(s.grid.zone(c)));
      const double z[4] = {g.bottom_left,
                           g.bottom_right,
                           g.bottom_left + g.height_left,
                           g.bottom_right + g.height_right};
      smallest          = std::min({smallest, g.height_left, g.height_right});
      for (unsigned int k = 0; k < 4; ++k)
        {
          const unsigned int node = s.grid.cell_nodes(c).node[k];
          vertices                = std::max({vertices,
                                              std::abs(cell->vertex(k)[1] - z[k]),
                                              std::abs(cell->vertex(k)[0] - s.grid.r_of(node)),
                                              std::abs(s.grid.z_of(node) - z[k])});
          double exact            = z0[node] - d;
          if (z0[node] < zone_bottom - 1e-9)
            exact = -7. + (z0[node] + 7.) * (1. - d / (zone_bottom + 7.));
          else if (fixed_top && z0[node] > 2.5)
            exact = 4. - (4. - z0[node]) * (1. + d / 1.5);
          motion = std::max(motion, std::abs(z[k] - exact));
        }
    }
  std::printf("upper zone %s: %d zones\n", upper.c_str(), int(zones.size()));
  verdict("motion error", motion, 1e-12);
  verdict("vertices of deal.II: error", vertices, 1e-12);
  std::printf("all cells have height: %s\n", smallest > 0. ? "yes" : "no");
}

double
volume_of(const BackgroundGrid &grid, const bool rigid_only)
{
  double volume = 0.;
  for (unsigned int c = 0; c < grid.n_cells(); ++c)
    if (grid.is_rigid(c) || !rigid_only)
      {
        const auto  &g = grid.geometry(c);
        const double r = g.left + .5 * g.width;
        volume += 2. * pi * g.width *
                  (r * .5 * (g.height_left + g.height_right) +
                   g.width * (g.height_right - g.height_left) / 12.);
      }
  return volume;
}

/** The smallest height of a cell over that of its row. */
double
smallest_height_ratio(const BackgroundGrid &grid)
{
  std::vector<double> height(grid.n_rows(), 0.);
  double              smallest = 1e9;
  for (unsigned int pass = 0; pass < 2; ++pass)
    for (unsigned int c = 0; c < grid.n_cells(); ++c)
      {
        const auto &g   = grid.geometry(c);
        double     &row = height[grid.row_of(c)];
        if (pass == 0 && grid.column_of(c) + 1 == grid.n_columns())
          row = g.height_left;
        if (pass == 1)
          smallest =
            std::min({smallest, g.height_left / row, g.height_right / row});
      }
  return smallest;
}

void
check_cone()
{
  const double R = .2;
  for (const double angle : {30., 60., 120.})
    {
      const double h = R / std::tan(radians(.5 * angle));
      Scene        s(R"(
        subsection Rigid body
          set Kind                  = cone
          set Outer diameter        = 0.4
          set Skirt length          = 2
          set Cells across the wall = 4
          set Initial penetration   = 1
          set Apex angle            = )" +
                std::to_string(angle) + R"(
        end
        subsection Grid
          set Outer radius = 3
          set Bottom       = -5
          set Top          = 1.5
          set Cell width   = 0.3
          set Cell height  = 0.3
          set Moving zone below tip = 2.5
        end)",
              1.);
      std::printf("cone of %g degrees\n", angle);
      verdict("volume error",
              std::abs(volume_of(s.grid, true) /
                         (pi * R * R * (2. - h + h / 3.)) -
                       1.),
              1e-12);
      verdict("all cells: volume error",
              std::abs(volume_of(s.grid, false) / (pi * 9. * 6.5) - 1.),
              1e-12);
      verdict("surface error",
              std::abs(s.body.lower_surface(0.) + 1.) +
                std::abs(s.body.lower_surface(.05) + 1. - .25 * h) +
                std::abs(s.body.lower_surface(R) + 1. - h),
              1e-12);
      std::printf("smallest height of a cell over that of its row: %.3f\n",
                  smallest_height_ratio(s.grid));
      const auto inside = [&s](const double r, const double z) {
        return s.body.contains(dealii::Point<2>(r, z), 0.);
      };
      std::printf("inside: %d%d%d%d\n",
                  inside(.01, -.9),
                  inside(.1, -1. + .4 * h),
                  inside(.1, -1. + .6 * h),
                  inside(.21, 0.));
    }
}

void
check_lid()
{
  Scene s(caisson + "subsection Rigid body\nset Lid thickness = 0.25\nend\n");
  const double h = s.body.tip_height();
  verdict("lid: volume error",
          std::abs(
            volume_of(s.grid, true) /
              (pi * (9. - 2.8 * 2.8) * (3. - .5 * h) + pi * 2.8 * 2.8 * .25) -
            1.),
          1e-12);
  const auto inside = [&s](const double r, const double z) {
    return s.body.contains(dealii::Point<2>(r, z), 0.);
  };
  std::printf("inside: %d%d%d%d\n",
              inside(1., 2.4),
              inside(1., 2.2),
              inside(2.8, 2.3),
              inside(1., 2.6));
}

/** The mesh moves up: rows stretch below the zone, and with it, or are
 * compressed below a fixed top. */
void
check_mesh_going_up(const std::string &upper)
{
  const double uplift = .7;
  const bool   fixed  = upper == "extending";
  Scene s(caisson + "subsection Grid\nset Upper zone = " + upper + "\nend\n",
          0.,
          uplift);
  std::vector<double> z0;
  for (unsigned int n = 0; n < s.grid.n_nodes(); ++n)
    z0.push_back(s.grid.z_of(n));
  s.grid.prepare_motion(-uplift);
  s.grid.advance();
  double motion = 0.;
  for (unsigned int n = 0; n < s.grid.n_nodes(); ++n)
    {
      double exact = z0[n] + uplift;
      if (z0[n] < -2.5 - 1e-9)
        exact = -7. + (z0[n] + 7.) * (1. + uplift / 4.5);
      else if (fixed && z0[n] > 2.5)
        exact = 4. - (4. - z0[n]) * (1. - uplift / 1.5);
      motion = std::max(motion, std::abs(s.grid.z_of(n) - exact));
    }
  verdict(("up, " + upper + ": motion error").c_str(), motion, 1e-12);
}

void
check_cylinder()
{
  const double        a = .5, R = 4., d = .75;
  Scene               s(R"(
    subsection Rigid body
      set Kind                  = cylinder
      set Outer diameter        = 1
      set Cells across the wall = 10
    end
    subsection Grid
      set Inner radius = 0.4
      set Outer radius = 4
      set Bottom       = -0.1
      set Top          = 0
      set Cell width   = 0.4
      set Cell height  = 0.05
      set Growth ratio = 1.1
    end)",
          d);
  std::vector<double> r0;
  for (unsigned int n = 0; n < s.grid.n_nodes(); ++n)
    r0.push_back(s.grid.r_of(n));
  verdict("cylinder: volume error",
          std::abs(volume_of(s.grid, true) / (pi * (.25 - .16) * .1) - 1.),
          1e-12);
  s.grid.prepare_motion(d);
  s.grid.advance();
  s.grid.write_vertices();
  double motion = 0., vertices = 0., finest = 1e9, next = 0.;
  for (unsigned int c = 0; c < s.grid.n_cells(); ++c)
    for (unsigned int k = 0; k < 4; ++k)
      {
        const unsigned int node = s.grid.cell_nodes(c).node[k];
        const double       r =
          s.grid.geometry(c).left + (k % 2) * s.grid.geometry(c).width;
        const double exact = r0[node] < a - 1e-9 ?
                               r0[node] * (a + d) / a :
                               R - (R - r0[node]) * (R - a - d) / (R - a);
        motion             = std::max(
          {motion, std::abs(r - exact), std::abs(s.grid.r_of(node) - exact)});
        vertices =
          std::max(vertices,
                   std::abs(s.grid.cell_iterator(c)->vertex(k)[0] - r));
      }
  for (unsigned int n = 0; n < s.grid.n_nodes(); ++n)
    if (r0[n] > a + 1e-9)
      finest = std::min(finest, r0[n] - a);
  for (const double r : r0)
    if (r > a + finest + 1e-9 && (next == 0. || r < next))
      next = r;
  verdict("cylinder: motion error", motion, 1e-12);
  verdict("cylinder: vertices of deal.II: error", vertices, 1e-12);
  std::printf("cylinder: first columns %.4f %.4f\n", finest, next - a - finest);
  std::printf("inside: %d%d\n",
              s.body.contains(dealii::Point<2>(1.2, -.05), d),
              s.body.contains(dealii::Point<2>(1.3, -.05), d));
}

// ------------------------------------------------------------ points

void
check_points()
{
  Scene s(caisson + R"(
    subsection Soil
      set Number of layers = 2
      subsection Layer 2
        set Top depth     = 2
        set Solid density = 2700
        set Porosity      = 0.3
      end
    end)");
  s.generator.generate(s.grid, s.body, s.soil, 4., s.points);
  double volume = 0., mass = 0., mr = 0., mz = 0., stress = 0., wrong = 0.;
  std::set<double> ids;
  s.points.for_each([&](const MaterialPoint &p, const unsigned int) {
    volume += p.volume;
    mass += p.mass;
    mr += p.mass * p.position[0];
    mz += p.mass * p.position[1];
    ids.insert(p.id);
    wrong += s.body.contains(p.position, 0.) || p.position[1] > 0. ||
             p.material != (p.position[1] < -2. ? 1u : 0u);
    const double z = p.position[1];
    const double zz =
      8829. * std::max(z, -2.) + .7 * 1700. * 9.81 * std::min(z + 2., 0.);
    stress = std::max({stress,
                       std::abs(p.stress[1] / zz - 1.),
                       std::abs(p.stress[0] / zz - .5),
                       std::abs(p.stress[2] / zz - .5)});
  });
  // the soil: a cylinder without the wall, per radian and with inertia times 4
  const double h = s.body.tip_height(), wall = .5 * (9. - 2.8 * 2.8),
               rho[2] = {.6 * 2500. + .4 * 1000., .7 * 2700. + .3 * 1000.};
  const double V      = 32. * 7. - wall * (.5 - .5 * h);
  const double M      = 4. * (rho[0] * (V - 32. * 5.) + rho[1] * 32. * 5.);
  const double r2     = (27. - 2.8 * 2.8 * 2.8) / 3.;
  const double Mr     = 4. * (rho[0] * (512. / 3. * 2. - r2 * (.5 - .5 * h)) +
                          rho[1] * 512. / 3. * 5.);
  const double wedge =
    -.5 + h + (h - 2. * h) / 3.; // of its volume, near enough
  const double Mz =
    4. *
    (rho[0] * (-32. * 2. + wall * ((.5 - h) * (.5 - h) / 2. - .5 * h * wedge)) -
     rho[1] * 32. * 5. * 4.5);
  verdict("points: volume error", std::abs(volume / V - 1.), 1e-12);
  verdict("points: mass error", std::abs(mass / M - 1.), 1e-12);
  verdict("points: first moment in r, error", std::abs(mr / Mr - 1.), 1e-5);
  verdict("points: first moment in z, error", std::abs(mz / Mz - 1.), 1e-4);
  verdict("points: initial stress error", stress, 1e-12);
  verdict("points in the body, above ground, or in the wrong layer", wrong, 0.);
  verdict("points: ids used twice",
          s.points.n_points() - double(ids.size()),
          0.);
}

/** The spacing rule: soil at rest, and the mesh swept through it. In a column
 * beside the body no cell that is full of soil may be without points. */
void
check_spacing()
{
  const double travel = 3.5;
  Scene        s(caisson, travel);
  s.generator.generate(s.grid, s.body, s.soil, 1., s.points);
  std::vector<dealii::Point<2>> x;
  s.points.for_each([&](const MaterialPoint &p, const unsigned int) {
    x.push_back(p.position);
  });
  std::sort(x.begin(), x.end(), [](const auto &a, const auto &b) {
    return a[0] < b[0];
  });
  unsigned int empty = 0, few = 0, n_cells = 0;
  for (unsigned int k = 0; k <= 40; ++k)
    {
      s.grid.prepare_motion(travel * k / 40.);
      s.grid.advance();
      for (unsigned int c = 0; c < s.grid.n_cells(); ++c)
        {
          const auto &g = s.grid.geometry(c);
          // whole cells below the surface, outside the path of the wall
          if (s.grid.is_rigid(c) ||
              std::max(g.bottom_left + g.height_left,
                       g.bottom_right + g.height_right) > 0. ||
              (g.left > 2.7 && g.left < 2.99))
            continue;
          unsigned int n     = 0;
          const auto   first = std::lower_bound(
            x.begin(), x.end(), g.left, [](const auto &p, const double r) {
              return p[0] < r;
            });
          for (auto p = first; p != x.end() && (*p)[0] < g.left + g.width; ++p)
            {
              const double xi     = ((*p)[0] - g.left) / g.width,
                           bottom = g.bottom_left +
                                    xi * (g.bottom_right - g.bottom_left),
                           height = g.height_left +
                                    xi * (g.height_right - g.height_left);
              n += (*p)[1] >= bottom && (*p)[1] < bottom + height;
            }
          ++n_cells;
          empty += n == 0;
          few += n < 2;
        }
    }
  std::printf("cells swept: %s\n", n_cells > 1000 ? "many" : "few");
  verdict("cells that ran empty", empty, 0.);
  verdict("cells with less than two points", few, 0.);
}

/** Mass, its first moments, momentum, volume, and the integral of stress. */
std::array<double, 10>
resultants(const MaterialPoints &points)
{
  std::array<double, 10> sums = {};
  points.for_each([&](const MaterialPoint &p, const unsigned int) {
    sums[0] += p.mass;
    sums[1] += p.volume;
    for (unsigned int d = 0; d < 2; ++d)
      {
        sums[2 + d] += p.mass * p.position[d];
        sums[4 + d] += p.mass * p.velocity[d];
      }
    for (unsigned int c = 0; c < 4; ++c)
      sums[6 + c] += p.volume * p.stress[c];
  });
  return sums;
}

double
change(const std::array<double, 10> &a, const std::array<double, 10> &b)
{
  double worst = 0.;
  for (unsigned int i = 0; i < a.size(); ++i)
    worst = std::max(worst, std::abs(a[i] - b[i]) / (1. + std::abs(b[i])));
  return worst;
}

/** Points split for cells of half their size, and merge for larger ones. */
void
check_split_and_merge()
{
  Scene s(caisson +
          "subsection Soil\n set Initial velocity = r*z; z-2*r\nend\n");
  s.generator.generate(s.grid, s.body, s.soil, 1., s.points);
  const auto n          = s.points.n_points();
  const auto before     = resultants(s.points);
  double     largest[2] = {0., 0.};
  s.points.for_each([&](const MaterialPoint &p, const unsigned int) {
    for (unsigned int d = 0; d < 2; ++d)
      largest[d] = std::max(largest[d], p.size[d]);
  });
  // in steps: halves are halved again
  for (unsigned int k = 0; k < 6; ++k)
    s.points.adapt([&](const unsigned int) {
      return std::array<double, 2>{{.5 * largest[0], .5 * largest[1]}};
    });
  const auto   split     = s.points.n_points();
  unsigned int too_large = 0, outside = 0;
  s.points.for_each([&](const MaterialPoint &p, const unsigned int cell) {
    const auto x = to_reference(s.grid.geometry(cell), p.position);
    outside += !(x[0] >= 0. && x[0] <= 1. && x[1] >= 0. && x[1] <= 1.) ||
               s.grid.is_rigid(cell);
    for (unsigned int d = 0; d < 2; ++d)
      too_large += p.size[d] > .6 * largest[d];
  });
  std::printf("points split: %s\n", s.points.n_split > n / 10 ? "many" : "few");
  verdict("halves of the largest points left whole", too_large, 0.);
  verdict("halves outside their cell", outside, 0.);
  verdict("splitting changes mass, moments, momentum, volume, stress by",
          change(resultants(s.points), before),
          1e-12);
  for (unsigned int k = 0; k < 6; ++k)
    s.points.adapt([&](const unsigned int) {
      return std::array<double, 2>{{1e3 * largest[0], 1e3 * largest[1]}};
    });
  std::printf("points merged: %s\n",
              s.points.n_points() < split / 2 ? "most" : "few");
  verdict("merging changes mass, moments, momentum, volume, stress by",
          change(resultants(s.points), before),
          1e-12);
  double volume = 0.;
  for (unsigned int c = 0; c < s.grid.n_cells(); ++c)
    volume += s.points.view().filled_volume[c];
  verdict("volume kept by cell, error",
          std::abs(volume / before[1] - 1.),
          1e-12);
}

/** Refinement and distortion: sides, surface and layers stay where they are. */
void
check_distortion()
{
  const std::string mesh = R"(
    subsection Grid
      set Outer radius = 4
      set Bottom       = -4
      set Top          = 1
      set Refinement   = 2
    end
    subsection Soil
      set Number of layers = 2
      subsection Layer 2
        set Top depth = 2
      end
    end
    )";
  Scene             regular(mesh);
  Scene             s(mesh + "subsection Grid\nset Distortion = 0.3\nend\n");
  double            width = 0., straight = 0., shift_r = 0., shift_z = 0.;
  for (unsigned int c = 0; c < regular.grid.n_cells(); ++c)
    width = std::max(width,
                     std::abs(regular.grid.geometry(c).width - .5) +
                       std::abs(regular.grid.geometry(c).height_left - .5));
  std::set<double> heights;
  for (unsigned int n = 0; n < s.grid.n_nodes(); ++n)
    {
      const double r = regular.grid.r_of(n), z = regular.grid.z_of(n);
      const double dr = std::abs(s.grid.r_of(n) - r),
                   dz = std::abs(s.grid.z_of(n) - z);
      shift_r         = std::max(shift_r, dr);
      shift_z         = std::max(shift_z, dz);
      if (r == 0. || r == 4.)
        straight = std::max({straight, dr, dz});
      if (z == -4. || std::abs(z + 2.) < 1e-9 || std::abs(z) < 1e-9 || z == 1.)
        straight = std::max(straight, dz);
      if (std::abs(z + 3.) < 1e-9)
        heights.insert(dz);
    }
  std::printf("refined: %d x %d cells\n",
              int(s.grid.n_columns()),
              int(s.grid.n_rows()));
  verdict("refined cells: size error", width, 1e-12);
  verdict("distorted: shift of sides, surface and layers", straight, 0.);
  verdict("distorted: largest shift over its limit",
          std::max(shift_r, shift_z) / .15,
          1.);
  std::printf("distorted: rows bend: %s, shifts reach the limit: %s\n",
              heights.size() == 8 ? "yes" : "no",
              std::min(shift_r, shift_z) > .08 ? "yes" : "no");
  s.generator.generate(s.grid, s.body, s.soil, 1., s.points);
  double volume = 0.;
  s.points.for_each(
    [&](const MaterialPoint &p, const unsigned int) { volume += p.volume; });
  std::printf("distorted: %d points\n", int(s.points.n_points()));
  verdict("distorted: volume error", std::abs(volume / 32. - 1.), 1e-12);
}

/** A region, random positions, uniform stress, initial velocity. */
void
check_point_options()
{
  const std::string mesh = R"(
    subsection Grid
      set Geometry     = plane strain
      set Outer radius = 4
      set Bottom       = -4
      set Top          = 1
      set Cell width   = 0.25
      set Cell height  = 0.25
    end
    subsection Soil
      set Initial stress   = uniform
      set Uniform stress   = -1, -2, -3, 4
      set Initial velocity = r - 2*z ; 0.5*z*pi
    end
    )";
  double            sums[3];
  for (const unsigned int seed : {1, 1, 2})
    {
      static unsigned int run = 0;
      Scene               s(mesh + R"(subsection Material points
        set Region           = 1 - (r - 2)^2 - (z + 2)^2
        set Random positions = 0.5
        set Random seed      = )" +
              std::to_string(seed) + "\nend\n");
      s.generator.generate(s.grid, s.body, s.soil, 1., s.points);
      double outside = 0., volume = 0., state = 0., farthest = 0., sum = 0.;
      s.points.for_each([&](const MaterialPoint &p, const unsigned int) {
        const double r = p.position[0], z = p.position[1];
        outside += (r - 2.) * (r - 2.) + (z + 2.) * (z + 2.) >= 1.;
        volume += p.volume;
        state = std::max({state,
                          std::abs(p.stress[0] + 1.),
                          std::abs(p.stress[1] + 2.),
                          std::abs(p.stress[2] + 3.),
                          std::abs(p.stress[3] - 4.),
                          std::abs(p.velocity[0] - (r - 2. * z)),
                          std::abs(p.velocity[1] - .5 * z * pi)});
        for (const double x : {r, z}) // parts are 0.125 wide
          farthest =
            std::max(farthest, std::abs(x / .125 - std::floor(x / .125) - .5));
        sum += r * r + z;
      });
      sums[run++] = sum;
      verdict("points outside the region", outside, 0.);
      verdict("region: volume error", std::abs(volume / pi - 1.), 0.02);
      verdict("uniform stress and initial velocity: error", state, 1e-14);
      verdict("random positions: farthest from the lattice", farthest, .25);
      std::printf("random positions reach the limit: %s\n",
                  farthest > .24 ? "yes" : "no");
    }
  std::printf("equal seeds, equal points: %s; other seed: %s\n",
              sums[0] == sums[1] ? "yes" : "no",
              sums[0] == sums[2] ? "equal" : "others");
}

// ------------------------------------------------------------ boundaries

void
check_boundary_conditions()
{
  for (const std::string kind : {"roller", "fixed", "free"})
    {
      Scene s("subsection Grid\nset Inner radius = 1\nset Outer radius = 3\n"
              "set Bottom = -2\nset Top = 0\nend\n"
              "subsection Boundary conditions\nset Axis = " +
              kind + "\nset Side = " + kind + "\nset Bottom = " + kind +
              "\nset Top = " + kind + "\nend\n");
      s.boundary_conditions.initialize(s.grid);
      std::vector<Kernels::NodalVector> v(s.grid.n_nodes(), {{1., 1.}});
      s.boundary_conditions.constrain(v.data());
      // 3 x 3 nodes, from the lower left one
      std::printf("%s:", kind.c_str());
      for (const double z : {-2., -1., 0.})
        for (const double r : {1., 2., 3.})
          for (unsigned int n = 0; n < v.size(); ++n)
            if (std::abs(s.grid.r_of(n) - r) + std::abs(s.grid.z_of(n) - z) <
                1e-9)
              std::printf(" %g%g", v[n].value[0], v[n].value[1]);
      std::printf("\n");
    }
}

/** Prescribed velocities: which nodes, which components, impulse and work. */
void
check_prescribed_velocity()
{
  Scene s(R"(
    subsection Grid
      set Inner radius = 1
      set Outer radius = 3
      set Bottom       = -2
      set Top          = 0
    end
    subsection Boundary conditions
      set Prescribed region   = t - 0.5 - abs(z)
      set Prescribed velocity = free ; r*t
    end)");
  auto &b = s.boundary_conditions;
  b.check_parameters(s.grid);
  b.initialize(s.grid);
  // at t = 1 the rows z = 0; in the middle of the step t = 2
  b.prepare(s.grid, 1., 2.);
  const std::vector<double>         mass(s.grid.n_nodes(), 5.);
  std::vector<Kernels::NodalVector> v(s.grid.n_nodes(), {{1., 1.}}), held = v,
                                                                     zero = v;
  const double work = b.apply(mass, v.data());
  b.constrain(held.data());
  b.constrain_difference(zero.data());
  double error = 0.;
  for (unsigned int n = 0; n < v.size(); ++n)
    {
      const bool   is_top = s.grid.z_of(n) > -1e-9;
      const double r      = s.grid.r_of(n);
      // rollers on both sides
      const double v_r     = r < 1.5 || r > 2.5 ? 0. : 1.;
      const double v_z     = s.grid.z_of(n) < -1.5 ? 0. : is_top ? 2. * r : 1.;
      const double fixed_r = s.grid.z_of(n) < -1.5 ? 0. : v_r;
      error                = std::max({error,
                                       std::abs(v[n].value[0] - fixed_r),
                                       std::abs(v[n].value[1] - v_z),
                                       std::abs(held[n].value[0] - fixed_r),
                                       std::abs(held[n].value[1] - v_z),
                                       std::abs(zero[n].value[0] - fixed_r),
                                       std::abs(zero[n].value[1] - (is_top ? 0. : v_z))});
    }
  verdict("prescribed velocity: error", error, 1e-14);
  // three nodes at r = 1, 2, 3, from 1 to 2 r
  verdict("prescribed velocity: impulse error",
          std::abs(b.impulse()[1] / (2. * pi * 5. * (1. + 3. + 5.)) - 1.) +
            std::abs(b.impulse()[0]),
          1e-14);
  verdict("prescribed velocity: work error",
          std::abs(work / (2. * pi * 5. * (2. + 12. + 30.)) - 1.),
          1e-14);
  b.prepare(s.grid, .4, 0.);
  std::fill(v.begin(), v.end(), Kernels::NodalVector{{1., 1.}});
  const double no_work = b.apply(mass, v.data());
  verdict("nothing prescribed before its time", std::abs(no_work), 0.);
}

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_lines();
  check_motion();
  check_shape();
  check_mesh("free", false);
  check_mesh("extending", true);
  check_mesh_going_up("free");
  check_mesh_going_up("extending");
  check_cone();
  check_lid();
  check_cylinder();
  check_points();
  check_spacing();
  check_split_and_merge();
  check_distortion();
  check_point_options();
  check_boundary_conditions();
  check_prescribed_velocity();
}
