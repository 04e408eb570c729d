// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/water/plug_strength.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int n_slices = 100;
  }

  PlugStrength::PlugStrength(const BackgroundGrid &grid,
                             const MaterialPoints &points,
                             const Soil           &soil,
                             const RigidBody      &body)
    : grid(grid)
    , points(points)
    , soil(soil)
    , body(body)
  {}

  PlugStrength::Slices::Slices(const unsigned int n)
    : volume(n, 0.)
    , weight(n, 0.)
    , cohesion(n, 0.)
    , tension(n, std::numeric_limits<double>::max())
  {}

  PlugStrength::Slices
  PlugStrength::slices_below(const double top, const double embedment) const
  {
    const double wall = body.shape().left(), width = .5 * embedment;
    Slices       slices(n_slices);
    const auto   add = [&](const MaterialPoint &p) {
      const double to_wall = wall - p.position[radial],
                   depth   = (top - p.position[vertical]) / embedment;
      if (to_wall < 0. || to_wall > width || depth > 1.)
        return;
      const unsigned int  i = std::clamp(depth, 0., .999) * n_slices;
      const SoilMaterial &m = soil.material(p.material);
      const double        c = m.cohesion_after(p.plastic_deviatoric);
      slices.volume[i] += p.volume;
      slices.weight[i] += p.volume * soil.unit_weight(m);
      slices.cohesion[i] += p.volume * c;
      slices.tension[i] = std::min(slices.tension[i], m.tension_of(c));
    };
    for (const unsigned int cell : points.cells_with_points())
      if (grid.geometry(cell).left < wall)
        points.for_each_in(cell, add);
    for (auto *sums : {&slices.volume, &slices.weight, &slices.cohesion})
      Utilities::MPI::sum(*sums, grid.communicator(), *sums);
    Utilities::MPI::min(slices.tension, grid.communicator(), slices.tension);
    return slices;
  }

  WithstoodGradients
  PlugStrength::find(const Mudline &mudline) const
  {
    const double top       = mudline.height_at_wall(Mudline::Side::plug),
                 embedment = top + body.penetration();
    if (embedment <= 0.)
      return {};
    const Slices       slices  = slices_below(top, embedment);
    const double       gamma_w = soil.unit_weight_of_water();
    WithstoodGradients result;
    double             volume = 0., weight = 0., cohesion = 0.;
    for (unsigned int i = 0; i < n_slices; ++i)
      {
        if (slices.volume[i] == 0.)
          continue;
        volume += slices.volume[i];
        weight += slices.weight[i];
        cohesion += slices.cohesion[i];
        const double             depth    = embedment * (i + 1) / n_slices;
        const double             side     = 2. / embedment * cohesion / volume;
        const WithstoodGradients of_block = {
          0.,
          weight / volume / gamma_w,
          (slices.tension[i] / depth + side) / gamma_w};
        const bool is_first = result.surface == 0.;
        if (is_first)
          result.surface = of_block.weight;
        if (is_first || of_block.of_block() < result.of_block())
          {
            result.weight   = of_block.weight;
            result.strength = of_block.strength;
          }
      }
    return result;
  }
} // namespace CaissonMPM
