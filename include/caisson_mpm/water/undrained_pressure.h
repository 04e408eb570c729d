// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The pore pressure of soil that no water leaves or enters: with the volume V
// of the points of a cell, V_0 at the start, and the bulk modulus K_w of the
// water over the porosity,
//   p = -K_w ln(V / V_0).
// The points change their volume with the mean divergence of their cell, and
// carry V / V_0 through the mesh. One value in each cell does not lock. What
// the points of a cell differ in, because they came from different cells, would
// be answered by no strain: they share the mean.
#ifndef caisson_mpm_water_undrained_pressure_h
#define caisson_mpm_water_undrained_pressure_h

#include <caisson_mpm/domain/material_points.h>

#include <vector>

namespace CaissonMPM
{
  /** Not collective. */
  class UndrainedPressure
  {
  public:
    /** Find the pressure from the volumes of the points. @p bulk_modulus: K_w.
     * Units: Pa. */
    void
    find(const double bulk_modulus, MaterialPoints &points);

    /** Return whether it has been found since forget(). */
    bool
    is_found() const
    {
      return !pressure_.empty();
    }

    /** Forget it, when the cells of this rank change. */
    void
    forget()
    {
      pressure_.clear();
    }

    /** Return the excess pressure of each cell, 0 where there is no point.
     * [n_cells], Pa */
    const std::vector<double> &
    pressure() const
    {
      return pressure_;
    }

  private:
    std::vector<double> pressure_;
  };
} // namespace CaissonMPM

#endif
