// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the soil in the cells is to water that flows through it.
#ifndef caisson_mpm_water_permeability_field_h
#define caisson_mpm_water_permeability_field_h

#include <caisson_mpm/domain/material_points.h>
#include <caisson_mpm/materials/soil.h>
#include <caisson_mpm/water/pressure_projection.h>

#include <vector>

namespace CaissonMPM
{
  /** Means over the points of each cell; a gap has the soil of its depth at the
   * start. Flow along layers adds up, flow across them shares its gradient. */
  struct PermeabilityField
  {
    /** Compute the means, with all permeabilities @p faster than the soil's.
     * Not collective. */
    void
    compute(const BackgroundGrid &grid,
            const MaterialPoints &points,
            const Soil           &soil,
            const double          faster);

    /** Return the permeability of the cells, 0 where water does not flow in a
     * time that counts. [n_cells], m/s */
    std::vector<Conductance>
    of_flow() const;

    std::vector<Conductance>     permeability; // [n_cells], m/s
    std::vector<unsigned char>   is_clay;    // [n_cells], undrained by strength
    std::vector<WaterProperties> properties; // [n_cells]
  };
} // namespace CaissonMPM

#endif
