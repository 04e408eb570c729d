// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Points are split where they are too large for their cell, and merged where
// they are too small; and their volumes are leveled.
#include <caisson_mpm/domain/cell_geometry.h>
#include <caisson_mpm/domain/material_points.h>
#include <caisson_mpm/domain/point_fields.h>
#include <caisson_mpm/kernels/layout.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  using namespace dealii;
  using namespace Kernels;

  namespace
  {
    /** Whether two points lie side by side in a direction. */
    bool
    are_neighbors(const MaterialPoint &a,
                  const MaterialPoint &b,
                  const unsigned int   direction)
    {
      const unsigned int across = 1 - direction;
      const auto         distance =
                   std::abs(a.position[direction] - b.position[direction]),
                 aside = std::abs(a.position[across] - b.position[across]);
      return a.material == b.material &&
             distance < .75 * (a.size[direction] + b.size[direction]) &&
             aside < .375 * (a.size[across] + b.size[across]);
    }
    /**
     * Order points so that which of them become one does not depend on how the
     * ranks brought them to the cell. Halves of a point have its number and
     * stand beside or above each other, up to round-off: a line at an angle to
     * both directions distinguishes their places.
     */
    template <typename PlacedPoint>
    void
    put_in_order(std::vector<PlacedPoint> &points)
    {
      constexpr double slope = .7319;
      const auto       along = [](const MaterialPoint &p) {
        return p.position[0] + slope * p.position[1];
      };
      std::sort(points.begin(),
                points.end(),
                [&](const PlacedPoint &a, const PlacedPoint &b) {
                  return a.second.id != b.second.id ?
                           a.second.id < b.second.id :
                           along(a.second) < along(b.second);
                });
    }

    /** A cell that strains by less, as most do, keeps the sizes of its points:
     * a thousand adaptations change them by a tenth. */
    constexpr double least_strain = 1e-4;

    /** The largest strain in r and z at the corners of a cell. */
    double
    largest_strain(const CellGeometry            &geometry,
                   const unsigned int             cell,
                   const MaterialPoints::Stretch &stretch_at)
    {
      double largest = 0.;
      for (unsigned int corner = 0; corner < 4; ++corner)
        for (const double strain :
             stretch_at(cell,
                        to_position(geometry,
                                    GeometryInfo<2>::unit_cell_vertex(corner))))
          largest = std::max(largest, std::abs(strain));
      return largest;
    }
  } // namespace

  std::vector<MaterialPoints::PlacedPoint>
  MaterialPoints::take_out_of_size(const unsigned int           cell,
                                   const std::array<double, 2> &wanted)
  {
    auto &range = sizes[cell];
    if (range[0].suits(wanted[0]) && range[1].suits(wanted[1]))
      return {};
    range = {}; // of the points that stay
    std::vector<LeavingPoint> places;
    for_each_lane(cell, [&](const int b, const int lane) {
      const double size[2] = {histories[b].size_r[lane],
                              histories[b].size_z[lane]};
      bool         is_out  = false;
      for (unsigned int d = 0; d < 2; ++d)
        is_out |=
          is_too_large(size[d], wanted[d]) || is_too_small(size[d], wanted[d]);
      if (is_out)
        places.push_back({cell, b, lane});
      else
        for (unsigned int d = 0; d < 2; ++d)
          range[d].include(size[d]);
    });
    auto points = take_out(places.data(), places.size());
    put_in_order(points);
    return points;
  }

  void
  MaterialPoints::split(const std::array<double, 2> &wanted,
                        std::vector<PlacedPoint>    &points)
  {
    for (unsigned int d = 0; d < 2; ++d)
      for (unsigned int i = 0; i < points.size(); ++i)
        {
          const unsigned int  cell  = points[i].first;
          const MaterialPoint whole = points[i].second;
          if (!is_too_large(whole.size[d], wanted[d]))
            continue;
          // One whose size says more than its volume has been stretched by
          // noise: splitting it would make points without end.
          const double area =
            whole.volume / (grid.axisymmetric() ? whole.position[radial] : 1.);
          if (area < .4 * whole.size[0] * whole.size[1])
            continue;
          const MaterialPoint lower = half_of(whole, d, -1.),
                              upper = half_of(whole, d, 1.);
          // beside the body or the end of the mesh it waits
          if (!is_in_soil(cell, lower.position) ||
              !is_in_soil(cell, upper.position))
            continue;
          points[i].second = lower;
          points.emplace_back(cell, upper);
          ++n_split;
        }
  }

  void
  MaterialPoints::merge(const std::array<double, 2> &wanted,
                        std::vector<PlacedPoint>    &points)
  {
    for (unsigned int d = 0; d < 2; ++d)
      for (unsigned int i = 0; i < points.size(); ++i)
        for (unsigned int j = i + 1; j < points.size(); ++j)
          {
            MaterialPoint &a = points[i].second, &b = points[j].second;
            if (!is_too_small(a.size[d], wanted[d]))
              break;
            if (!is_too_small(b.size[d], wanted[d]) || !are_neighbors(a, b, d))
              continue;
            a = one_of(a, b, d);
            points.erase(points.begin() + j);
            ++n_merged;
          }
  }

  void
  MaterialPoints::stretch(const Stretch &stretch_at, const WantedSize &wanted)
  {
    for (const unsigned int cell : active_cells)
      {
        if (largest_strain(grid.geometry(cell), cell, stretch_at) <
            least_strain)
          continue;
        const auto suitable = wanted(cell);
        auto      &range    = sizes[cell];
        range               = {};
        for_each_lane(cell, [&](const int b, const int lane) {
          const auto strain =
            stretch_at(cell, Point<2>(blocks[b].r[lane], blocks[b].z[lane]));
          double *const size[2] = {&histories[b].size_r[lane],
                                   &histories[b].size_z[lane]};
          for (unsigned int d = 0; d < 2; ++d)
            {
              const double old = *size[d];
              *size[d]         = std::clamp(old * std::exp(strain[d]),
                                    std::min(old, .3 * suitable[d]),
                                    std::max(old, 2. * suitable[d]));
              range[d].include(*size[d]);
            }
        });
      }
  }

  void
  MaterialPoints::adapt(const WantedSize &wanted)
  {
    std::vector<PlacedPoint> moving;
    for (const unsigned int cell : active_cells)
      {
        const auto size   = wanted(cell);
        auto       points = take_out_of_size(cell, size);
        merge(size, points);
        split(size, points);
        moving.insert(moving.end(), points.begin(), points.end());
      }
    bring_to_cells(moving);
  }

  double
  MaterialPoints::volume_ratio_in(const unsigned int cell) const
  {
    double now = 0., initial = 0.;
    for_each_lane(cell, [&](const int b, const int lane) {
      now += blocks[b].volume[lane];
      initial += histories[b].initial_volume[lane];
    });
    return now / initial;
  }

  void
  MaterialPoints::level_volume_ratio(std::vector<double> &ratio)
  {
    ratio.assign(grid.n_cells(), 1.);
    for (const unsigned int cell : active_cells)
      {
        ratio[cell] = volume_ratio_in(cell);
        for_each_lane(cell, [&](const int b, const int lane) {
          histories[b].initial_volume[lane] =
            blocks[b].volume[lane] / ratio[cell];
        });
      }
  }
} // namespace CaissonMPM
