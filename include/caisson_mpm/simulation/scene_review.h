// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What an engineer would ask about a scene before it is run.
#ifndef caisson_mpm_simulation_scene_review_h
#define caisson_mpm_simulation_scene_review_h

#include <caisson_mpm/base/declared_entries.h>
#include <caisson_mpm/base/parameter_origins.h>
#include <caisson_mpm/simulation/simulation_parts.h>
#include <caisson_mpm/water/lid_compartment.h>

#include <optional>
#include <string>

namespace CaissonMPM
{
  /**
   * Warns of values that the program can compute with, but that are hardly
   * meant: units that are off by a thousand, boundaries that are too near, a
   * wall that is rougher than the soil. What cannot be meant at all is refused
   * where the entry belongs. After the lines are placed; not collective.
   */
  class SceneReview
  {
  public:
    /** The warnings go to @p origins. The speed of waves is the least one of all
     * layers (m/s), and the number of steps infinite where the end is not
     * known. */
    SceneReview(const SimulationParts &parts,
                const double           wave_speed,
                const double           n_steps,
                ParameterOrigins      &origins)
      : parts(parts)
      , wave_speed(wave_speed)
      , n_steps(n_steps)
      , origins(origins)
    {}

    void
    all();

  private:
    /** Warn of entries in Pa that are no stress, strength or stiffness of soil.
     */
    void
    stresses();
    /** The material of a layer in which an entry of its law is largest. */
    std::optional<unsigned int>
    strongest(const EntryRecord &entry) const;
    void
    stress(const EntryRecord           &entry,
           const double                 value,
           const std::optional<double> &friction_angle);
    void
    stress_at_start();
    /** The depth to which the body is long or goes, within the mesh. Units: m.
     */
    double
    depth_of_skirt() const;
    /** The effective weight of the soil above that depth. Units: Pa. */
    double
    weight_above() const;
    void
    layers();
    void
    contrast_of_stiffness();
    void
    stiffness_and_strength(const SoilMaterial &soil);
    void
    undrained_volume(const SoilMaterial &soil);
    void
    solid_density(const SoilMaterial &soil);
    /** Warn of a law by density where no entry says how dense the soil is. */
    void
    density_of_state(const SoilMaterial &soil);
    void
    gravity();
    void
    fluid();
    void
    thin_layers();
    void
    size_of_body();
    void
    motion_of_body();
    /** Warn of soil without cohesion whose inertia exceeds its stress at rest:
     * beyond an inertia tolerance of 1 the forces were found to be too large.
     */
    void
    confinement();
    void
    cells_at_tip();
    void
    points_at_tip();
    void
    transfer();
    void
    friction();
    /** Warn of walls that are rougher than a soil beside them. Outer and inner
     * friction angle of the body, in degrees; 0 where there is no wall. */
    void
    friction_of_walls(const SoilMaterial &soil,
                      const double        outer,
                      const double        inner);
    /** Warn of a surface of the body that is rougher than a soil.
     * @p exceeds: a sentence without its subject and stop. */
    void
    too_rough(const Surface surface, const std::string &exceeds);
    void
    boundaries();
    /** Whether the body is a box: a plate, a block or a piston. */
    bool
    is_block() const;
    /** Whether soil must give way to a caisson or cone that goes deeper. */
    bool
    is_pushed_in() const;
    void
    suction();
    /** Warn of undrained strength in soil through which water flows. */
    void
    seepage();
    void
    length_of_run();

    /** Warn of an entry with its value: "Section/Entry = 5 Pa text". */
    void
    doubt(const std::string &entry,
          const double       value,
          const std::string &unit,
          const std::string &text);

    const SimulationParts &parts;
    const double           wave_speed, n_steps;
    ParameterOrigins      &origins;
  };
} // namespace CaissonMPM

#endif
