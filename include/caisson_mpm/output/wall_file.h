// SPDX-License-Identifier: LGPL-2.1-or-later
//
// wall.csv: the stresses along the walls of the body at the frames, or at each
// record.
#ifndef caisson_mpm_output_wall_file_h
#define caisson_mpm_output_wall_file_h

#include <caisson_mpm/materials/soil.h>
#include <caisson_mpm/operators/wall_forces.h>
#include <caisson_mpm/output/row_file.h>

#include <string>
#include <vector>

namespace CaissonMPM
{
  /** The rows of the walls at one record. */
  struct WallRecord
  {
    double               time, penetration, travel; // s, m, m
    double               interval;                  // of the means, s
    double               tip_stress;                // Pa
    std::vector<WallRow> rows;
  };

  /**
   * Writes a row for each row of nodes on the walls that is below the surface
   * of the ground at the start or bears a force. Normal stress and shear stress
   * are the radial and the vertical traction: their integrals are the forces on
   * the walls. Owned by one rank; not collective.
   */
  class WallFile : public RowFile
  {
  public:
    /** What the columns depend on. */
    struct Scene
    {
      const Soil &soil;
      double      radius;            // at which the stress at rest is taken, m
      bool        has_inner, is_wet; // an inner wall, excess pore pressure
    };

    WallFile(const std::string &directory, const Scene &scene);

    void
    append(const WallRecord &record);

  private:
    const Scene scene;
  };
} // namespace CaissonMPM

#endif
