// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The mesh fits a cone, a caisson with a lid, and a cylinder that widens.
#include <caisson_mpm/base/text.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <vector>

#include "grid_volume.h"

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
              s.body.shape().contains(dealii::Point<2>(1.2, -.05), d),
              s.body.shape().contains(dealii::Point<2>(1.3, -.05), d));
}



int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  heading("cone");
  check_cone();
  heading("lid");
  check_lid();
  heading("cylinder");
  check_cylinder();
}
