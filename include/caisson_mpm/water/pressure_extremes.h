// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The smallest and the largest excess pore pressure, and how far the water is
// from boiling where it is nearest to it.
#ifndef caisson_mpm_water_pressure_extremes_h
#define caisson_mpm_water_pressure_extremes_h

#include <caisson_mpm/water/pore_water.h>

#include <array>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /** Of one record. The margin is the absolute pressure over that of vapor, at
   * most that of the water on the mudline at rest. */
  class PressureExtremes
  {
  public:
    explicit PressureExtremes(const WaterScene &scene);

    /** Begin a record. */
    void
    begin();

    /** Include a pressure in the extremes. Units: Pa. */
    void
    include(const double pressure);

    /** Include a pressure at a place in the margin. Units: Pa, m. */
    void
    include_at(const double pressure, const double r, const double z);

    /** The same in the middle of a cell. */
    void
    include_in(const double pressure, const Kernels::CellGeometry &cell);

    /** Take the extremes of all ranks. Collective. */
    void
    end();

    NamedNumbers
    columns() const;

    /** Append a warning when the water would boil for the first time. @p place:
     * of the body, in words. Units: s. */
    void
    warn(const double              time,
         const std::string        &place,
         std::vector<std::string> &warnings);

  private:
    const WaterScene      scene;
    double                unit_weight = 0.; // of the water, N/m3
    double                at_rest     = 0.; // margin on the mudline, Pa
    double                smallest = 0., largest = 0.; // Pa
    std::array<double, 3> lowest     = {{0., 0., 0.}}; // margin, r, z; Pa, m
    bool                  has_warned = false;
  };
} // namespace CaissonMPM

#endif
