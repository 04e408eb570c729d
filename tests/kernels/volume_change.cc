// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The mean volume change of cells (B-bar): the points of a cell have the mean
// of their divergence and keep their deviatoric strain, and they move with
// nearly the same divergence.
#include "kernel_scene.h"

/** The mean over a cell of the divergence of the nodal field v(r, z), by Gauss
 * points. */
double
mean_divergence_of(
  const CellGeometry                                         &g,
  const double                                                axisymmetric,
  const std::function<std::array<double, 2>(double, double)> &v)
{
  double change = 0., volume = 0.;
  for (const QuadraturePoint &q : gauss_points(g, axisymmetric))
    {
      const Shape N(g, q.r, q.z);
      volume += q.volume;
      for (int i = 0; i < 4; ++i)
        {
          const double x = g.left + (i % 2) * g.width;
          const double y = (i % 2 ? g.bottom_right : g.bottom_left) +
                           (i / 2) * (i % 2 ? g.height_right : g.height_left);
          const auto w = v(x, y);
          change +=
            q.volume * (w[0] * (N.d_dr[i] + axisymmetric * N.value[i] / q.r) +
                        w[1] * N.d_dz[i]);
        }
    }
  return change / volume;
}



/** B-bar: all points of a cell have its mean volume change, and keep their own
 * deviatoric strain. */
void
check_mean_volume(const double axisymmetric)
{
  const std::vector<CellMoments> moments(n_cells, CellMoments());
  const auto                     v = [](const double r, const double z) {
    return std::array<double, 2>{{r * z * z, z * r + z * z * z}};
  };
  Scene with = make_scene(axisymmetric, false);
  fill_blocks(with);
  Scene without = with;
  update(with, *select_kernels("auto"), {1e-3, 0., true, 0., 0.}, v, moments);
  update(
    without, *select_kernels("auto"), {1e-3, 0., false, 0., 0.}, v, moments);
  double                             spread = 0., largest = 0., deviator = 0.;
  std::vector<std::array<double, 4>> stress;
  std::vector<double>                ratio(n_cells, -1.);
  for_all(with, [&](PointBlock &b, int lane, const Point &p) {
    const double change = b.volume[lane] / p.volume;
    if (ratio[p.cell] < 0.)
      ratio[p.cell] = change;
    spread = std::max(spread, std::abs(change - ratio[p.cell]));
    stress.push_back({{b.stress[0][lane],
                       b.stress[1][lane],
                       b.stress[2][lane],
                       b.stress[3][lane]}});
  });
  unsigned int k = 0;
  for_all(without, [&](PointBlock &b, int lane, const Point &p) {
    largest =
      std::max(largest, std::abs(b.volume[lane] / p.volume - ratio[p.cell]));
    const auto &w = stress[k++];
    deviator =
      std::max({deviator,
                std::abs(w[3] - b.stress[3][lane]),
                std::abs(w[0] - w[1] - b.stress[0][lane] + b.stress[1][lane])});
  });
  double mean = 0.;
  for (unsigned int c = 0; c < n_cells; ++c)
    mean =
      std::max(mean,
               std::abs(
                 ratio[c] - 1. -
                 1e-3 * mean_divergence_of(with.geometry[c], axisymmetric, v)));
  verdict("B-bar: spread of the volume change", spread, 1e-14);
  verdict("B-bar: mean volume change error", mean, 1e-14);
  verdict("B-bar: change of the deviator", deviator / 1e4, 1e-13);
  verdict("B-bar: effect below", largest, 1e-2);
  verdict("B-bar: no effect", 1e-6 / largest, 1.);
}



/** The velocities with which points at these places of the cell 4 move, in a
 * field that is not uniform. */
std::vector<std::array<double, 2>>
moves(Scene                                     s,
      const bool                                mean_volume_change,
      const std::vector<std::array<double, 2>> &places)
{
  std::vector<Point> others; // the other cells have to have points
  for (const Point &p : s.points)
    if (p.cell < 4 || p.cell == 5)
      others.push_back(p);
  s.points.clear();
  for (const Point &p : others)
    {
      if (p.cell == 5 && s.points.back().cell < 4)
        for (const auto &x : places)
          {
            s.points.push_back(p);
            s.points.back().cell = 4;
            s.points.back().r    = x[0];
            s.points.back().z    = x[1];
          }
      s.points.push_back(p);
    }
  fill_blocks(s);
  const double dt = 1e-6;
  update(
    s,
    *select_kernels("auto"),
    {dt, 0., mean_volume_change, 0., 0.},
    [](const double r, const double z) {
      return std::array<double, 2>{{r * z + std::sin(3. * r), z * z - r * z}};
    },
    std::vector<CellMoments>(n_cells, CellMoments()));
  std::vector<std::array<double, 2>> result;
  for_all(s, [&](PointBlock &block, int lane, const Point &p) {
    if (p.cell == 4)
      result.push_back(
        {{(block.r[lane] - p.r) / dt, (block.z[lane] - p.z) / dt}});
  });
  return result;
}



/** How far the divergence of these velocities is from the same in a cell. */
double
spread_of_divergence(const Scene &s, const bool mean_volume_change)
{
  const CellGeometry                &g = s.geometry[4];
  const double                       e = 1e-4;
  std::vector<std::array<double, 2>> places;
  for (const double xi : {.15, .5, .85})
    for (const double eta : {.15, .5, .85})
      {
        const double r = g.left + g.width * xi,
                     z =
                       g.bottom_left + (g.bottom_right - g.bottom_left) * xi +
                       (g.height_left + (g.height_right - g.height_left) * xi) *
                         eta;
        places.insert(places.end(),
                      {{{r - e, z}}, {{r + e, z}}, {{r, z - e}}, {{r, z + e}}});
      }
  const auto v     = moves(s, mean_volume_change, places);
  double     least = 1e300, largest = -1e300;
  for (unsigned int k = 0; k < v.size(); k += 4)
    {
      const double r = .5 * (places[k][0] + places[k + 1][0]);
      const double divergence =
        (v[k + 1][0] - v[k][0] + v[k + 3][1] - v[k + 2][1]) / (2. * e) +
        s.axisymmetric * .5 * (v[k][0] + v[k + 1][0]) / r;
      least   = std::min(least, divergence);
      largest = std::max(largest, divergence);
    }
  return largest - least;
}



/** With B-bar the points of a cell move with nearly the same divergence, and
 * through its sides as they would without. */
void
check_uniform_divergence(const double axisymmetric)
{
  Scene distorted = make_scene(axisymmetric, false), rectangular = distorted;
  for (CellGeometry &g : rectangular.geometry)
    {
      g.bottom_left = g.bottom_right = g.bottom_left > .3 ? .6 : 0.;
      g.height_left = g.height_right = .6;
    }
  for (const Scene &s : {rectangular, distorted})
    verdict("spread of the divergence over that without B-bar",
            spread_of_divergence(s, true) / spread_of_divergence(s, false),
            .25);
  const CellGeometry &g        = distorted.geometry[4];
  const double        top_left = g.bottom_left + g.height_left,
               top_right       = g.bottom_right + g.height_right;
  const std::vector<std::array<double, 2>> on_sides = {
    {{g.left, .4 * g.bottom_left + .6 * top_left}},
    {{g.left + .3 * g.width, .7 * top_left + .3 * top_right}}};
  const auto with    = moves(distorted, true, on_sides),
             without = moves(distorted, false, on_sides);
  const double slope = (top_right - top_left) / g.width;
  verdict("change of the flow through a vertical side",
          std::abs(with[0][0] - without[0][0]),
          1e-9);
  verdict("change of the flow through a row",
          std::abs(with[1][1] - without[1][1] -
                   slope * (with[1][0] - without[1][0])),
          1e-9);
}



int
main()
{
  heading("mean volume change");
  for (const double axisymmetric : {0., 1.})
    {
      std::printf("%s\n", axisymmetric > 0. ? "axisymmetric" : "plane strain");
      check_mean_volume(axisymmetric);
    }
  heading("motion of the points");
  for (const double axisymmetric : {0., 1.})
    {
      std::printf("%s\n", axisymmetric > 0. ? "axisymmetric" : "plane strain");
      check_uniform_divergence(axisymmetric);
    }
}
