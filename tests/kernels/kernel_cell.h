// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the tests of the transfer kernels share: random numbers, a point, and
// the shape functions and Gauss points of a cell.
#ifndef caisson_mpm_tests_kernel_cell_h
#define caisson_mpm_tests_kernel_cell_h

#include <caisson_mpm/kernels/grid_to_points.h>
#include <caisson_mpm/kernels/points_to_grid.h>

#include <cmath>
#include <random>
#include <vector>

using namespace CaissonMPM::Kernels;
using Scalar = Lanes<1>;

constexpr double       E = 1e6, nu = .3;
constexpr unsigned int n_cells = 6, n_nodes = 12; // 3 x 2 cells

struct Point
{
  unsigned int cell;
  double       r, z, v[2], s[4], mass, volume;
};

inline std::mt19937 generator(42);

inline double
uniform(const double a, const double b)
{
  return a + (b - a) * (generator() / 4294967296.);
}

/** N_I and grad N_I at a place of a cell. */
struct Shape
{
  double value[4], d_dr[4], d_dz[4];

  Shape(const CellGeometry &g, const double r, const double z)
  {
    const CellMap<>          map(g);
    const LocalPoint<Scalar> p = map.at_position(Scalar(r), Scalar(z));
    for (int i = 0; i < 4; ++i)
      {
        double corner[4] = {0., 0., 0., 0.}, c[4];
        corner[i]        = 1.;
        coefficients(corner, c);
        Scalar dr, dz;
        gradient(c, p, map.inverse_width, dr, dz);
        value[i] = evaluate(c, p)[0];
        d_dr[i]  = dr[0];
        d_dz[i]  = dz[0];
      }
  }
};



/** A place of a cell and the volume that it stands for. */
struct QuadraturePoint
{
  double r, z, volume;
};

/** The 2 x 2 Gauss points of a cell. */
inline std::vector<QuadraturePoint>
gauss_points(const CellGeometry &g, const double axisymmetric)
{
  const double place[2] = {.5 - std::sqrt(1. / 12.), .5 + std::sqrt(1. / 12.)};
  std::vector<QuadraturePoint> points;
  for (unsigned int q = 0; q < 4; ++q)
    {
      const double xi = place[q % 2], r = g.left + g.width * xi;
      const double height =
        g.height_left + (g.height_right - g.height_left) * xi;
      const double z = g.bottom_left + (g.bottom_right - g.bottom_left) * xi +
                       height * place[q / 2];
      points.push_back(
        {r,
         z,
         .25 * g.width * height * (axisymmetric * r + 1. - axisymmetric)});
    }
  return points;
}

#endif
