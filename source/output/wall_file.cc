// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/output/wall_file.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace CaissonMPM
{
  namespace
  {
    /** The columns of one wall. */
    std::vector<std::string>
    names_of_wall(const std::string &wall, const bool is_wet)
    {
      std::vector<std::string> names = {wall + "_area_m2",
                                        wall + "_normal_stress_Pa",
                                        wall + "_shear_stress_Pa",
                                        wall + "_K",
                                        wall + "_friction_ratio",
                                        wall + "_mobilized_friction"};
      if (is_wet)
        names.push_back(wall + "_pore_pressure_Pa");
      return names;
    }

    std::vector<std::string>
    names_of_columns(const WallFile::Scene &scene)
    {
      std::vector<std::string> names = {"time_s",
                                        "penetration_m",
                                        "depth_m",
                                        "vertical_stress_at_rest_Pa",
                                        "horizontal_stress_at_rest_Pa",
                                        "tip_stress_Pa"};
      for (const char *const wall : {"inner", "outer"})
        if (scene.has_inner || wall == std::string("outer"))
          for (const std::string &name : names_of_wall(wall, scene.is_wet))
            names.push_back(name);
      return names;
    }

    /** The values of one wall, of which the normal of the soil points to the
     * axis (-1) or away from it (1). */
    std::vector<double>
    values_of_wall(const WallPart &wall,
                   const double    sign,
                   const double    interval,
                   const double    vertical_at_rest)
    {
      constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
      const double     scale   = 1. / (wall.area * interval),
                   contact     = sign * wall.impulse[radial] * scale,
                   normal      = contact + wall.pressure_in_stress,
                   shear       = wall.impulse[vertical] * scale,
                   limit =
                     wall.friction * std::max(contact, 0.) + wall.adhesion;
      return {wall.area,
              normal,
              shear,
              vertical_at_rest > 0. ? normal / vertical_at_rest : unknown,
              normal > 0. ? std::abs(shear) / normal : unknown,
              limit > 0. ? std::abs(shear) / limit : unknown};
    }

    bool
    bears(const WallPart &wall)
    {
      return wall.impulse.norm_square() > 0.;
    }
  } // namespace

  WallFile::WallFile(const std::string &directory, const Scene &scene)
    : RowFile(directory + "/wall.csv", names_of_columns(scene), 10)
    , scene(scene)
  {}

  void
  WallFile::append(const WallRecord &record)
  {
    // from above
    for (auto row = record.rows.rbegin(); row != record.rows.rend(); ++row)
      {
        const double depth = record.travel - row->height;
        if (depth <= 0. && !bears(row->walls[0]) && !bears(row->walls[1]))
          continue;
        const Stress at_rest = scene.soil.initial_stress(
          dealii::Point<2>(scene.radius, std::min(-depth, 0.)));
        std::vector<double> values = {record.time,
                                      record.penetration,
                                      depth,
                                      -at_rest[zz],
                                      -at_rest[rr],
                                      record.tip_stress};
        for (unsigned int i = scene.has_inner ? 0 : 1; i < 2; ++i)
          {
            const WallPart &wall = row->walls[i];
            const double    sign = i == 0 ? 1. : -1.;
            for (const double value :
                 values_of_wall(wall, sign, record.interval, -at_rest[zz]))
              values.push_back(value);
            if (scene.is_wet)
              values.push_back(wall.pore_pressure);
          }
        // -0 and -nan are nothing to read
        for (double &value : values)
          value = std::isnan(value) ? std::abs(value) : value + 0.;
        RowFile::append(values);
      }
  }
} // namespace CaissonMPM
