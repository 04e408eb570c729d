// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The mesh: it fits the caisson, moves with it, and is distorted for tests.
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <set>
#include <vector>

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
check_mesh(const std::string &upper, const bool fixed_top)
{
  const double travel = 3., d = 1.7;
  Scene s(caisson + "subsection Grid\nset Upper zone = " + upper + "\nend\n",
          travel);
  std::vector<double> z0;
  for (unsigned int n = 0; n < s.grid.n_nodes(); ++n)
    z0.push_back(s.grid.z_of(n));
  check_volumes(s);

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
              int(s.lines.n_columns()),
              int(s.lines.n_rows()));
  verdict("refined cells: size error", width, 1e-12);
  verdict("distorted: shift of sides, surface and layers", straight, 0.);
  verdict("distorted: largest shift over its limit",
          std::max(shift_r, shift_z) / .15,
          1.);
  std::printf("distorted: rows bend: %s, shifts reach the limit: %s\n",
              heights.size() == 8 ? "yes" : "no",
              std::min(shift_r, shift_z) > .08 ? "yes" : "no");
  s.generator.generate(s.grid, s.body.shape(), s.soil, s.points);
  double volume = 0.;
  s.points.for_each(
    [&](const MaterialPoint &p, const unsigned int) { volume += p.volume; });
  std::printf("distorted: %d points\n", int(s.points.n_points()));
  verdict("distorted: volume error", std::abs(volume / 32. - 1.), 1e-12);
}



int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  heading("mesh that goes down with the body");
  check_mesh("free", false);
  check_mesh("extending", true);
  heading("mesh that goes up");
  check_mesh_going_up("free");
  check_mesh_going_up("extending");
  heading("refinement and distortion");
  check_distortion();
}
