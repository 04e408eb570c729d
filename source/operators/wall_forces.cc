// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/operators/wall_forces.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    constexpr double same_height = 1e-9; // m

    /** The sums over the nodes of one wall in one row. */
    enum SumOfWall : unsigned int
    {
      area,
      friction,  // times area
      adhesion,  // times area
      wet_area,  // of cells with points
      pressure,  // times wet area
      in_stress, // the same, of soil whose total stress is shown
      n_sums_of_wall
    };

    /** The mean pore pressure of the points in a cell, in the soil with and
     * without the materials of @p total, or nan. */
    std::array<double, 2>
    mean_pore_pressures(const MaterialPoints    &points,
                        const std::vector<bool> &total,
                        const unsigned int       cell)
    {
      double                volume = 0.;
      std::array<double, 2> sums   = {};
      points.for_each_in(cell, [&](const MaterialPoint &p) {
        volume += p.volume;
        sums[total[p.material]] += p.volume * p.pore_pressure;
      });
      return {{sums[0] / volume, sums[1] / volume}};
    }
  } // namespace

  void
  WallForces::initialize(const BackgroundGrid &grid, const Contact &contact)
  {
    std::vector<double> own;
    contact.for_each_end([&](const ContactFace &face,
                             const unsigned int end,
                             const FaceStrength &) {
      if (is_wall(face.surface))
        own.push_back(grid.z_of(face.nodes[end]));
    });
    heights.clear();
    for (const auto &part :
         Utilities::MPI::all_gather(grid.communicator(), own))
      heights.insert(heights.end(), part.begin(), part.end());
    std::sort(heights.begin(), heights.end());
    heights.erase(std::unique(heights.begin(),
                              heights.end(),
                              [](const double a, const double b) {
                                return b - a < same_height;
                              }),
                  heights.end());
    impulses.resize(heights.size());
    row_of_node.assign(grid.n_nodes(), -1);
    // Also of nodes that count to the wall only at times, as those of a lid
    // that soil does not touch: they belong to the row below.
    for (const ContactFace &face : collect_contact_faces(grid))
      for (const unsigned int node : face.nodes)
        if (is_wall(face.surface))
          {
            const auto above  = std::upper_bound(heights.begin(),
                                                heights.end(),
                                                grid.z_of(node) + same_height);
            row_of_node[node] = std::max<int>(above - heights.begin(), 1) - 1;
          }
  }

  void
  WallForces::register_totals(RunTotals &totals)
  {
    for (unsigned int row = 0; row < impulses.size(); ++row)
      for (const Surface wall : {inner_wall, outer_wall})
        for (const unsigned int d : {radial, vertical})
          totals.sum("impulse_on_" +
                       std::string(wall == inner_wall ? "inner" : "outer") +
                       "_row_" + to_text(row) + (d == radial ? "_r" : "_z"),
                     impulses[row][number_of(wall)][d]);
  }

  void
  WallForces::add_step(const Contact &contact)
  {
    contact.for_each_impulse([this](const unsigned int node,
                                    const Surface      surface,
                                    const Vector2     &impulse) {
      if (is_wall(surface))
        impulses[row_of_node[node]][number_of(surface)] += impulse;
    });
  }

  void
  WallForces::clear()
  {
    std::fill(impulses.begin(), impulses.end(), std::array<Vector2, 2>());
  }

  std::vector<WallRow>
  WallForces::rows(const BackgroundGrid    &grid,
                   const Contact           &contact,
                   const MaterialPoints    &points,
                   const std::vector<bool> &total) const
  {
    // 1. sums over the ends of the faces, of all ranks
    std::vector<double> sums(heights.size() * 2 * n_sums_of_wall, 0.);
    contact.for_each_end([&](const ContactFace  &face,
                             const unsigned int  end,
                             const FaceStrength &strength) {
      if (!is_wall(face.surface))
        return;
      const unsigned int node  = face.nodes[end];
      const double       share = grid.circumference() * face.areas[end];
      double *const      sum =
        &sums[(2 * row_of_node[node] + number_of(face.surface)) *
              n_sums_of_wall];
      if (node < grid.n_owned_nodes())
        {
          sum[area] += share;
          sum[friction] += share * strength.friction;
          sum[adhesion] += share * strength.adhesion;
        }
      if (!grid.is_owned(face.soil_cell))
        return;
      const auto p = mean_pore_pressures(points, total, face.soil_cell);
      if (std::isnan(p[0]))
        return;
      sum[wet_area] += share;
      sum[pressure] += share * p[0];
      sum[in_stress] += share * p[1];
    });
    Utilities::MPI::sum(sums, grid.communicator(), sums);
    // 2. means
    std::vector<WallRow> result(heights.size());
    for (unsigned int row = 0; row < heights.size(); ++row)
      {
        result[row].height = heights[row];
        for (unsigned int wall = 0; wall < 2; ++wall)
          {
            const double *const sum = &sums[(2 * row + wall) * n_sums_of_wall];
            result[row].walls[wall] = {sum[area],
                                       impulses[row][wall],
                                       sum[friction] / sum[area],
                                       sum[adhesion] / sum[area],
                                       sum[pressure] / sum[wet_area],
                                       sum[wet_area] > 0. ?
                                         sum[in_stress] / sum[wet_area] :
                                         0.};
          }
      }
    return result;
  }

  double
  WallForces::area_of_tip(const BackgroundGrid &grid, const Contact &contact)
  {
    double own = 0.;
    contact.for_each_end([&](const ContactFace &face,
                             const unsigned int end,
                             const FaceStrength &) {
      if (face.surface == tip && face.nodes[end] < grid.n_owned_nodes())
        own += face.areas[end] * std::abs(face.normal[vertical]);
    });
    return grid.circumference() * Utilities::MPI::sum(own, grid.communicator());
  }
} // namespace CaissonMPM
