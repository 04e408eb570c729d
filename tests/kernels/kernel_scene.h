// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the tests of the transfer kernels share: random points in six distorted
// cells, in the memory layout of the kernels, and one call of each kernel.
#ifndef caisson_mpm_tests_kernel_scene_h
#define caisson_mpm_tests_kernel_scene_h

#include <caisson_mpm/kernels/dispatch.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "../shared/verdict.h"
#include "kernel_cell.h"

struct Scene
{
  double           axisymmetric;
  std::vector<int> neighbors =
    std::vector<int>(neighbors_per_cell * n_cells, -1);
  std::vector<CellGeometry>   geometry;
  std::vector<CellNodes>      nodes;
  std::vector<unsigned char>  flags;
  std::vector<Point>          points;
  std::vector<PointBlock>     blocks;
  std::vector<PointHistory>   histories;
  std::vector<BlockHeader>    headers;
  std::vector<int>            next, first;
  std::vector<unsigned int>   active;
  std::vector<double>         filled;
  std::vector<double>         filled_at_node = std::vector<double>(n_nodes, 1.);
  std::vector<unsigned char>  changed;
  std::vector<unsigned short> n_yielding;
  Material                    material, stiffer; // of no block by itself
  std::vector<Material>       materials;

  GridView
  grid() const
  {
    return {geometry.data(),
            nodes.data(),
            flags.data(),
            neighbors.data(),
            axisymmetric};
  }
  PointsView
  view()
  {
    return {blocks.data(),
            histories.data(),
            headers.data(),
            next.data(),
            first.data(),
            active.data(),
            n_cells,
            filled.data(),
            changed.data(),
            n_yielding.data()};
  }
  StepContext
  step(const IntegrationSettings &settings, std::vector<CellMoments> &moments)
  {
    materials = {material, stiffer};
    return {view(),
            grid(),
            materials.data(),
            settings,
            moments.data(),
            filled_at_node.data()};
  }
};

// full from 0.9 of the volume on, here the cells 0, 2 and 4
const IntegrationSettings gauss      = {.9, .9, true, PressureSlope::acts},
                          gauss_mean = {.9, .9, true, PressureSlope::ignored},
                          at_points = {1e300, 1e300, true, PressureSlope::acts};

/** Move point @p k of the @p n in a cell so that their center is that of the
 * volume: the first of a pair toward it, the second opposite to the first, and
 * the last one, which is alone, to the center. */
inline void
center(const CellGeometry       &g,
       const double              axisymmetric,
       const unsigned int        k,
       const unsigned int        n,
       const std::vector<Point> &points,
       Point                    &p)
{
  const CellMap<> map(g);
  const double    x_c = map.center_of_volume(axisymmetric);
  double          x = x_c, y = 0.; // along the rows, and across
  if (k + 1 < n)
    {
      const bool   is_second = k % 2 == 1;
      const Point &other     = is_second ? points.back() : p;
      const double sign      = is_second ? -1. : .8;
      const double other_x   = (other.r - g.left) / g.width - .5;
      x                      = x_c + sign * (other_x - x_c);
      y      = sign * ((other.z - map.center_z()) / map.mean_height() -
                  map.rise() * other_x);
      p.mass = other.mass;
    }
  p.r = g.left + g.width * (x + .5);
  p.z = map.center_z() + map.mean_height() * (y + map.rise() * x);
}

/** Cells 0, 2, 4 are filled, the others by a third. The stress of the points
 * is random, or affine; in the latter case their center is that of the cell. */
inline Scene
make_scene(const double axisymmetric, const bool affine)
{
  Scene s;
  s.axisymmetric    = axisymmetric;
  const double r[4] = {.5, .9, 1.5, 1.8};
  double       z[3][4];
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 4; ++i)
      z[j][i] = .6 * j + uniform(-.15, .15);
  for (unsigned int j = 0; j < 2; ++j)
    for (unsigned int i = 0; i < 3; ++i)
      {
        s.geometry.push_back({r[i],
                              r[i + 1] - r[i],
                              z[j][i],
                              z[j][i + 1],
                              z[j + 1][i] - z[j][i],
                              z[j + 1][i + 1] - z[j][i + 1]});
        const unsigned int n = 4 * j + i;
        s.nodes.push_back({{n, n + 1, n + 4, n + 5}});
      }
  s.flags              = {0, 0, next_to_body, 0, 0, next_to_body};
  const double a[4][3] = {{-3e3, 4e2, 2e3},
                          {-5e3, 1e2, 3e3},
                          {-2e3, 3e2, 1e3},
                          {5e2, -2e2, 7e2}};
  for (unsigned int c = 0; c < n_cells; ++c)
    {
      const CellGeometry &g = s.geometry[c];
      const unsigned int  n = 9 + 4 * c;
      for (unsigned int k = 0; k < n; ++k)
        {
          Point        p;
          const double xi = uniform(0., 1.), eta = uniform(0., 1.);
          p.cell = c;
          p.r    = g.left + g.width * xi;
          p.z    = g.bottom_left + (g.bottom_right - g.bottom_left) * xi +
                (g.height_left + (g.height_right - g.height_left) * xi) * eta;
          p.volume =
            CellMap<>(g).volume(axisymmetric) / n * (c % 2 == 0 ? 1. : .33);
          p.mass = 1900. * p.volume * uniform(.9, 1.1);
          if (affine && c % 2 == 0)
            center(g, axisymmetric, k, n, s.points, p);
          for (double &v : p.v)
            v = uniform(-1., 1.);
          for (int i = 0; i < 4; ++i)
            p.s[i] = affine ? a[i][0] + a[i][1] * p.r + a[i][2] * p.z :
                              uniform(-1e4, 1e4);
          s.points.push_back(p);
        }
    }
  s.material.initial_void_ratio = .6;
  s.material.body_force[0] = .3, s.material.body_force[1] = -9.;
  s.material.p_wave_modulus = E * (1. - nu) / ((1. + nu) * (1. - 2. * nu));
  const double values[]     = {E, nu};
  set_law<LinearElastic>(s.material, read_parameters<LinearElastic>(values));
  s.stiffer = s.material;
  return s;
}

/** Bring the points into blocks, padded as the class MaterialPoints does. Every
 * third has grown by a ninth: from the void ratio 0.6 to 0.78. */
inline void
fill_blocks(Scene &s)
{
  s.blocks.clear();
  s.histories.clear();
  s.headers.clear();
  s.next.clear();
  s.first.assign(n_cells, -1);
  s.filled.assign(n_cells, 0.);
  s.changed.assign(n_cells, true);
  s.n_yielding.assign(n_cells, 0);
  s.active.clear();
  for (unsigned int c = 0; c < n_cells; ++c)
    {
      s.active.push_back(c);
      std::vector<Point> mine;
      for (const Point &p : s.points)
        if (p.cell == c)
          {
            mine.push_back(p);
            s.filled[c] += p.volume;
          }
      for (unsigned int k = 0; k < mine.size(); k += 8)
        {
          const int b     = s.blocks.size();
          const int count = std::min<int>(8, mine.size() - k);
          (k == 0 ? s.first[c] : s.next.back()) = b;
          s.headers.push_back({0., double(count)});
          s.next.push_back(-1);
          s.blocks.push_back(PointBlock());
          s.histories.push_back(PointHistory());
          PointBlock &block = s.blocks.back();
          for (int lane = 0; lane < 8; ++lane)
            {
              const Point &p         = mine[lane < count ? k + lane : k];
              block.r[lane]          = p.r;
              block.z[lane]          = p.z;
              block.velocity_r[lane] = p.v[0];
              block.velocity_z[lane] = p.v[1];
              for (int i = 0; i < 4; ++i)
                block.stress[i][lane] = p.s[i];
              block.mass[lane]   = lane < count ? p.mass : 0.;
              block.volume[lane] = lane < count ? p.volume : 0.;
              s.histories.back().initial_volume[lane] =
                (k + lane) % 3 == 0 ? .9 * p.volume : p.volume;
            }
        }
    }
}

/** Call action(block, lane, point) for all points, in their order. */
inline void
for_all(Scene                                                       &s,
        const std::function<void(PointBlock &, int, const Point &)> &action)
{
  unsigned int i = 0;
  for (unsigned int c = 0; c < n_cells; ++c)
    for (int b = s.first[c]; b >= 0; b = s.next[b])
      for (int lane = 0; lane < s.headers[b].count; ++lane)
        action(s.blocks[b], lane, s.points[i++]);
}

struct Sums
{
  std::vector<NodalSums>   node;
  std::vector<CellMoments> moments;
};

inline Sums
collect(Scene                     &s,
        const KernelTable         &kernels,
        const IntegrationSettings &settings)
{
  Sums sums = {std::vector<NodalSums>(n_nodes, NodalSums()),
               std::vector<CellMoments>(n_cells)};
  kernels.points_to_grid(s.step(settings, sums.moments), sums.node.data());
  return sums;
}

inline double
difference(const Sums &a, const Sums &b)
{
  double mass = 0., momentum = 0., force = 0.;
  for (unsigned int n = 0; n < n_nodes; ++n)
    {
      mass = std::max(mass, std::abs(a.node[n].mass - b.node[n].mass));
      for (int d = 0; d < 2; ++d)
        {
          momentum =
            std::max(momentum,
                     std::abs(a.node[n].momentum[d] - b.node[n].momentum[d]));
          force =
            std::max(force, std::abs(a.node[n].force[d] - b.node[n].force[d]));
        }
    }
  return std::max({mass / 1e3, momentum / 1e3, force / 1e4});
}

/** One update with a nodal velocity field v(r, z) for all purposes. */
inline UpdateResult
update(Scene                                                      &s,
       const KernelTable                                          &kernels,
       const UpdateSettings                                       &settings,
       const std::function<std::array<double, 2>(double, double)> &v,
       std::vector<CellMoments>                                    moments,
       std::vector<CellMoments> *kept = nullptr)
{
  static std::vector<LeavingPoint> leaving(1000);
  std::vector<NodalVector>         field(n_nodes);
  for (unsigned int c = 0; c < n_cells; ++c)
    for (int i = 0; i < 4; ++i)
      {
        const CellGeometry &g = s.geometry[c];
        const double        r = g.left + (i % 2) * g.width;
        const double        z = (i % 2 ? g.bottom_right : g.bottom_left) +
                         (i / 2) * (i % 2 ? g.height_right : g.height_left);
        const auto w              = v(r, z);
        field[s.nodes[c].node[i]] = {{w[0], w[1]}};
      }
  UpdateResult result = {leaving.data(), 1000, 0, 0, 0.};
  kernels.grid_to_points(s.step(gauss, moments),
                         {s.grid(),
                          settings,
                          {field.data(), field.data(), field.data()}},
                         result);
  if (kept != nullptr)
    *kept = moments;
  return result;
}

#endif
