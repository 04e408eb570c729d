// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/water/permeability_field.h>

#include <algorithm>

namespace CaissonMPM
{
  void
  PermeabilityField::compute(const BackgroundGrid &grid,
                             const MaterialPoints &points,
                             const Soil           &soil,
                             const double          faster)
  {
    permeability.assign(grid.n_cells(), {});
    properties.assign(grid.n_cells(), {});
    is_clay.assign(grid.n_cells(), false);
    std::vector<bool> undrained;
    for (unsigned int i = 0; i < soil.n_materials(); ++i)
      undrained.push_back(soil.material(i).has_undrained_strength());
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      {
        if (!grid.is_owned(cell) || grid.is_rigid(cell))
          continue;
        double volume = 0., mass = 0., along = 0., across = 0., clay = 0.;
        points.for_each_in(cell, [&](const MaterialPoint &p) {
          const SoilMaterial &material = soil.material(p.material);
          const double        k        = faster * material.permeability_at(
                                      p.void_ratio(material.void_ratio()));
          volume += p.volume;
          mass += p.mass;
          along += p.volume * k * material.anisotropy;
          across += p.volume / k;
          clay += undrained[p.material] ? p.volume : 0.;
        });
        is_clay[cell] = clay > .5 * volume;
        if (volume > 0.)
          permeability[cell] = {along / volume, volume / across};
        else // a gap
          {
            const auto        &g = grid.geometry(cell);
            const unsigned int i =
              soil.material_at(std::min(0., g.bottom_left));
            is_clay[cell]      = undrained[i];
            const double k     = faster * soil.material(i).permeability;
            permeability[cell] = {k * soil.material(i).anisotropy, k};
            volume             = 1.;
            mass               = soil.inertial_density(i);
          }
        const double gamma = soil.unit_weight_of_water();
        properties[cell]   = {{permeability[cell].horizontal / gamma,
                               permeability[cell].vertical / gamma},
                              volume / mass};
      }
  }

  std::vector<Conductance>
  PermeabilityField::of_flow() const
  {
    std::vector<Conductance> result = permeability;
    for (std::size_t cell = 0; cell < result.size(); ++cell)
      if (is_clay[cell])
        result[cell] = {};
    return result;
  }
} // namespace CaissonMPM
