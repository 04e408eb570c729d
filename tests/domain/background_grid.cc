// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The mesh: it fits a caisson, a cone, a lid and a cylinder, and moves with
// them.
#include <caisson_mpm/base/text.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <set>
#include <vector>

#include "../shared/scene.h"
#include "grid_volume.h"

/** The volumes of a caisson and of its mesh, at the start. */
void
check_volumes(const Scene &s)
{
  const double h = s.body.shape().tip_height();
  verdict("rigid cells: volume error",
          std::abs(volume_of(s.grid, true) /
                     (pi * (9. - 2.8 * 2.8) * (3. - .5 * h)) -
                   1.),
          1e-12);
  verdict("all cells: volume error",
          std::abs(volume_of(s.grid, false) / (pi * 64. * 11.) - 1.),
          1e-12);
}

void
check_mesh()
{
  const double        travel = 3., d = 1.7;
  Scene               s(caisson, travel);
  std::vector<double> z0;
  for (unsigned int n = 0; n < s.grid.n_nodes(); ++n)
    z0.push_back(s.grid.z_of(n));
  check_volumes(s);

  s.grid.prepare_motion(d);
  s.grid.advance();
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
          motion = std::max(motion, std::abs(z[k] - exact));
        }
    }
  std::printf("%d zones\n", int(zones.size()));
  verdict("motion error", motion, 1e-12);
  verdict("vertices of deal.II: error", vertices, 1e-12);
  std::printf("all cells have height: %s\n", smallest > 0. ? "yes" : "no");
}

/** The smallest height of a cell over that of its row. */
double
smallest_height_ratio(const BackgroundGrid &grid)
{
  std::vector<double> height(grid.lines().n_rows(), 0.);
  double              smallest = 1e9;
  for (unsigned int pass = 0; pass < 2; ++pass)
    for (unsigned int c = 0; c < grid.n_cells(); ++c)
      {
        const auto &g   = grid.geometry(c);
        double     &row = height[grid.lines().row_of(grid.global_number(c))];
        if (pass == 0 && grid.lines().column_of(grid.global_number(c)) + 1 ==
                           grid.lines().n_columns())
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
                to_text(angle) + R"(
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
              std::abs(s.body.shape().lower_surface(0.) + 1.) +
                std::abs(s.body.shape().lower_surface(.05) + 1. - .25 * h) +
                std::abs(s.body.shape().lower_surface(R) + 1. - h),
              1e-12);
      std::printf("smallest height of a cell over that of its row: %.3f\n",
                  smallest_height_ratio(s.grid));
      const auto inside = [&s](const double r, const double z) {
        return s.body.shape().contains(dealii::Point<2>(r, z), 0.);
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
  const double h = s.body.shape().tip_height();
  verdict("lid: volume error",
          std::abs(
            volume_of(s.grid, true) /
              (pi * (9. - 2.8 * 2.8) * (3. - .5 * h) + pi * 2.8 * 2.8 * .25) -
            1.),
          1e-12);
  const auto inside = [&s](const double r, const double z) {
    return s.body.shape().contains(dealii::Point<2>(r, z), 0.);
  };
  std::printf("inside: %d%d%d%d\n",
              inside(1., 2.4),
              inside(1., 2.2),
              inside(2.8, 2.3),
              inside(1., 2.6));
}

/** The mesh moves up: rows stretch below the zone. */
void
check_mesh_going_up()
{
  const double        uplift = .7;
  Scene               s(caisson, 0., uplift);
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
      motion = std::max(motion, std::abs(s.grid.z_of(n) - exact));
    }
  verdict("up: motion error", motion, 1e-12);
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
              s.body.shape().contains(dealii::Point<2>(1.2, -.05), d),
              s.body.shape().contains(dealii::Point<2>(1.3, -.05), d));
}

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  heading("mesh that goes down with the body");
  check_mesh();
  heading("mesh that goes up");
  check_mesh_going_up();
  heading("cone");
  check_cone();
  heading("lid");
  check_lid();
  heading("cylinder");
  check_cylinder();
  return 0;
}
