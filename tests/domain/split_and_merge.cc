// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Material points that are split, merged and stretched.
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <vector>

#include "../shared/scene.h"

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
  s.generator.generate(s.grid, s.body.shape(), s.soil, s.points);
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
  RunTotals totals;
  s.points.register_totals(totals);
  const auto counts = totals.counts();
  const auto n_split =
    std::find_if(counts.begin(), counts.end(), [](const auto &count) {
      return count.first == "points_split";
    })->second;
  std::printf("many points split: %s\n", n_split > n / 10 ? "yes" : "no");
  verdict("halves of the largest points left whole", too_large, 0.);
  verdict("halves outside their cell", outside, 0.);
  verdict("splitting changes mass, moments, momentum, volume, stress by",
          change(resultants(s.points), before),
          1e-12);
  for (unsigned int k = 0; k < 6; ++k)
    s.points.adapt([&](const unsigned int) {
      return std::array<double, 2>{{1e3 * largest[0], 1e3 * largest[1]}};
    });
  std::printf("most points merged: %s\n",
              s.points.n_points() < split / 2 ? "yes" : "no");
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



/** The largest size of all points in r and z. */
std::array<double, 2>
largest_size(const MaterialPoints &points)
{
  std::array<double, 2> largest = {{0., 0.}};
  points.for_each([&](const MaterialPoint &p, const unsigned int) {
    for (unsigned int d = 0; d < 2; ++d)
      largest[d] = std::max(largest[d], p.size[d]);
  });
  return largest;
}



/** The sizes of points follow their stretch, and points that it has made too
 * long are split that way only. */
void
check_stretch()
{
  Scene s(caisson);
  s.generator.generate(s.grid, s.body.shape(), s.soil, s.points);
  const auto largest = largest_size(s.points);
  const auto stretch = [&](const double strain, const unsigned int n) {
    for (unsigned int k = 0; k < n; ++k)
      s.points.stretch(
        [&](const unsigned int, const dealii::Point<2> &) {
          return std::array<double, 2>{{strain, -strain}};
        },
        [&](const unsigned int) { return largest; });
  };
  stretch(.12, 5);
  const auto now = largest_size(s.points);
  verdict("five strains of 0.12 and -0.12: error of the size in r and z",
          std::max(std::abs(now[0] / largest[0] - std::exp(.6)),
                   std::abs(now[1] / largest[1] - std::exp(-.6))),
          1e-12);
  const auto before = resultants(s.points);
  s.points.adapt([&](const unsigned int) {
    return std::array<double, 2>{{largest[0], now[1]}};
  });
  double after[2] = {0., 0.};
  s.points.for_each([&](const MaterialPoint &p, const unsigned int cell) {
    const auto &g    = s.grid.geometry(cell);
    const bool  side = p.position[0] < g.left + .3 * g.width ||
                      p.position[0] > g.left + .7 * g.width;
    for (unsigned int d = 0; d < 2 && !side; ++d)
      after[d] = std::max(after[d], p.size[d]);
  });
  verdict("size after splitting over the wanted one, in r",
          after[0] / largest[0],
          1.05);
  verdict("size after splitting over the wanted one, in z",
          after[1] / now[1],
          1.05);
  verdict("splitting changes mass, moments, momentum, volume, stress by",
          change(resultants(s.points), before),
          1e-12);
  stretch(1., 20);
  stretch(-1., 20);
  double bounded[2] = {1e300, 0.};
  s.points.for_each([&](const MaterialPoint &p, const unsigned int) {
    bounded[0] = std::min(bounded[0], p.size[0] / largest[0]);
    bounded[1] = std::max(bounded[1], p.size[1] / largest[1]);
  });
  verdict("forth and back by 20: error of the bounds of the size",
          std::max(std::abs(bounded[0] - .3), std::abs(bounded[1] - 2.)),
          1e-12);
}



/** The sum over the points of what depends on which of them were merged, if a
 * cell is given its points from the first or from the last one on. */
double
merged_sum(const bool reversed)
{
  Scene s("subsection Grid\nset Geometry = plane strain\nend\n"
          "subsection Material points\nset Per direction far = 5\n"
          "set Random positions = 0.3\nend\n");
  s.generator.generate(s.grid, s.body.shape(), s.soil, s.points);
  std::vector<std::pair<unsigned int, MaterialPoint>> all;
  s.points.for_each([&](const MaterialPoint &p, const unsigned int cell) {
    all.emplace_back(cell, p);
  });
  if (reversed)
    std::reverse(all.begin(), all.end());
  s.points.reset(std::vector<unsigned int>(s.grid.n_global_cells(), 25));
  for (const auto &[cell, p] : all)
    s.points.add(cell, p);
  s.points.settle();
  s.points.adapt([&](const unsigned int) {
    return std::array<double, 2>{{1., 1.}};
  });
  double sum = 0.;
  s.points.for_each([&](const MaterialPoint &p, const unsigned int) {
    sum += p.volume * p.volume * p.position[0] * p.position[1];
  });
  return sum;
}



int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  heading("splitting and merging");
  check_split_and_merge();
  heading("stretch");
  check_stretch();
  heading("order of the points");
  verdict("merged points depend on the order in which they came by",
          std::abs(merged_sum(true) / merged_sum(false) - 1.),
          1e-13);
  return 0;
}
