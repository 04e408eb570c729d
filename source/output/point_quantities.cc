// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/conventions.h>
#include <caisson_mpm/output/point_quantities.h>

#include <cmath>

namespace CaissonMPM
{
  namespace
  {
    double
    speed(const MaterialPoint &p)
    {
      return std::hypot(p.velocity[0], p.velocity[1]);
    }

    double
    mean_stress(const MaterialPoint &p)
    {
      return (p.stress[rr] + p.stress[zz] + p.stress[tt]) / 3.;
    }

    /** sqrt(3 J2). */
    double
    deviator(const MaterialPoint &p)
    {
      const double mean = mean_stress(p);
      double       j2   = p.stress[rz] * p.stress[rz];
      for (const unsigned int component : {rr, zz, tt})
        j2 += .5 * std::pow(p.stress[component] - mean, 2);
      return std::sqrt(3. * j2);
    }
  } // namespace



  const std::map<std::string, PointQuantity> &
  point_quantities()
  {
    using P = const MaterialPoint &;
    static const std::map<std::string, PointQuantity> quantities = {
      {"position_r", [](P p) { return p.position[0]; }},
      {"position_z", [](P p) { return p.position[1]; }},
      {"displacement_r",
       [](P p) { return p.position[0] - p.initial_position[0]; }},
      {"displacement_z",
       [](P p) { return p.position[1] - p.initial_position[1]; }},
      {"velocity_r", [](P p) { return p.velocity[0]; }},
      {"velocity_z", [](P p) { return p.velocity[1]; }},
      {"speed", speed},
      {"stress_rr", [](P p) { return p.stress[rr]; }},
      {"stress_zz", [](P p) { return p.stress[zz]; }},
      {"stress_tt", [](P p) { return p.stress[tt]; }},
      {"stress_rz", [](P p) { return p.stress[rz]; }},
      {"stress_ratio", [](P p) { return p.stress[rr] / p.stress[zz]; }},
      {"mean_stress", mean_stress},
      {"deviator", deviator},
      {"plastic_strain", [](P p) { return p.plastic_deviatoric; }},
      {"plastic_volume_strain", [](P p) { return p.plastic_volumetric; }},
      {"volume_ratio", [](P p) { return p.volume / p.initial_volume; }},
      {"density", [](P p) { return p.mass / p.volume; }},
      {"kinetic_energy",
       [](P p) { return .5 * p.mass / p.volume * speed(p) * speed(p); }}};
    return quantities;
  }



  std::string
  point_quantities_text()
  {
    return "Quantities: position_r, position_z, displacement_r, "
           "displacement_z, velocity_r, velocity_z, speed, stress_rr, "
           "stress_zz, stress_tt, stress_rz, stress_ratio (rr over zz), "
           "mean_stress (tension positive), deviator (sqrt(3 J2)), "
           "plastic_strain, plastic_volume_strain, volume_ratio, density "
           "(scaled), kinetic_energy (J/m3).";
  }
} // namespace CaissonMPM
