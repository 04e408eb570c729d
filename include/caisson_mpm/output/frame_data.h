// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the files of a frame contain: material points, cells, and the body.
//
// The quantities of points are those of output/point_quantities.h that are
// drawn: SI units, stresses effective and positive in tension,
//   mean_stress = (rr + zz + tt) / 3,
//   deviator    = sqrt(3 J2),  J2 = s:s / 2.
// Where PoreWater::shows_total_stress(), a stress is the total one less the
// hydrostatic pressure, and the pore pressure is 0: stress less pore pressure
// is the same everywhere.
// The void ratio follows from the initial porosity n of the point's layer and
// its change of volume J: e = (1 + e0) J - 1 with e0 = n / (1 - n).
// statev_1 and so on are STATEV of user materials, where the soil has such
// laws. whole_volume (m3) is the volume of a point for the whole circumference,
// in plane strain per meter.
//
// A vector has the components r, z and 0. A symmetric tensor has six: rr, zz,
// tt (around the axis), rz, 0 and 0, in the order of VTK. The vertical
// effective stress is once more positive in compression and in kPa, beside its
// ratio to that at rest at the same place; a layer has its number in the
// entries.
//
// An array is called as the quantity and its unit, as the columns of
// history.csv are: stress_zz_Pa. The files have no other place for units that
// ParaView shows.
#ifndef caisson_mpm_output_frame_data_h
#define caisson_mpm_output_frame_data_h

#include <caisson_mpm/bodies/rigid_body.h>
#include <caisson_mpm/domain/background_grid.h>
#include <caisson_mpm/domain/material_points.h>
#include <caisson_mpm/materials/soil.h>
#include <caisson_mpm/output/vtu_file.h>
#include <caisson_mpm/water/pore_water.h>

#include <vector>

namespace CaissonMPM
{
  /** Makes the pieces of the files of what this rank owns. It only refers to
   * the parts. Not collective. */
  class FrameData
  {
  public:
    FrameData(const BackgroundGrid &grid,
              const MaterialPoints &points,
              const Soil           &soil,
              const PoreWater      &water)
      : grid(grid)
      , points(points)
      , soil(soil)
      , total(water.pressure_in_stress())
      , with_pore_pressure(water.shows_pressure())
    {}

    /** Return the material points of this rank from number begin to end. */
    VtuPiece
    of_points(const unsigned long long begin,
              const unsigned long long end) const;

    /**
     * Return the cells of this rank: what they are, how many points they have,
     * and the means of stress, void ratio and pore pressure over the points,
     * by volume. A mean is not a number where no point has it: in the body
     * and above the soil. The layer is that of most points.
     */
    VtuPiece
    of_cells() const;

    /** Return the section of the body where it is now, as the cells of the mesh
     * in it, which follow its surface exactly; on any rank all of it, nothing
     * where there is no body. */
    VtuPiece
    of_body(const RigidBody &body) const;

  private:
    const BackgroundGrid &grid;
    const MaterialPoints &points;
    const Soil           &soil;
    // of which materials the total stress is shown [n_materials]
    const std::vector<bool> total;
    const bool              with_pore_pressure;
  };
} // namespace CaissonMPM

#endif
