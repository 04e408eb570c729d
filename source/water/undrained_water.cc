// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/water/undrained_water.h>

#include <cmath>

namespace CaissonMPM
{
  namespace
  {
    // Below this share of a load, undrained soil changes its volume noticeably.
    constexpr double least_share = .9;

    /** What the water bears of a load on confined undrained soil. */
    double
    share_of_load(const Kernels::Material &material)
    {
      return material.water_modulus / material.p_wave_modulus;
    }
  } // namespace

  UndrainedWater::UndrainedWater(const WaterScene &scene)
    : PoreWater(scene)
    , connection(
        scene.grid.signals.after_change.connect([this]() { reinit(); }))
  {
    traits_.has_excess_pressure = true;
    traits_.resists_body        = true;
    traits_.bulk_modulus        = scene.settings.undrained.bulk_modulus;
    scene.totals.keep("water_time", time);
    extremes.register_totals(scene.totals);
  }

  void
  UndrainedWater::check_parameters() const
  {
    if (!scene.soil.is_submerged())
      throw BadInput("Water/Level is undrained, but the soil is dry: set "
                     "Soil/Submerged = true, or Level = drained.");
  }

  std::vector<const Section *>
  UndrainedWater::used_groups() const
  {
    return {&scene.settings.undrained, &scene.settings.sea};
  }

  void
  UndrainedWater::reinit()
  {
    Mudline columns; // its columns only: no height is asked for
    columns.initialize(scene.grid, scene.body.shape());
    tip.reinit(scene.grid, scene.body.shape(), columns);
    pressure.clear();
  }

  void
  UndrainedWater::compute_pressure()
  {
    scene.points.level_volume_ratio(pressure);
    for (double &value : pressure)
      value = -scene.settings.undrained.bulk_modulus * std::log(value);
    tip.integrate(scene.grid,
                  [this](const unsigned int cell, const unsigned int) {
                    return pressure[cell];
                  });
  }

  void
  UndrainedWater::begin_step(const double,
                             const BoundaryConditions &,
                             Contact &)
  {
    compute_pressure();
  }

  double
  UndrainedWater::end_step(const double time,
                           const double dt,
                           const double,
                           const double travel)
  {
    this->time = time + dt;
    return tip.value() * travel;
  }

  void
  UndrainedWater::write_pressure_to_points()
  {
    if (!pressure.empty())
      scene.points.set_pore_pressure(
        [this](const unsigned int cell, const dealii::Point<2> &) {
          return pressure[cell];
        });
  }

  NamedNumbers
  UndrainedWater::present_columns() const
  {
    NamedNumbers result = extremes.columns();
    result.emplace_back("tip_water_force_N", tip.value());
    return result;
  }

  NamedNumbers
  UndrainedWater::columns()
  {
    const double gamma = scene.soil.unit_weight_of_water();
    extremes.begin(gamma, scene.settings.sea.cavitation(gamma, 0.));
    for (const double p : pressure)
      extremes.include(p);
    if (!pressure.empty())
      for (const unsigned int cell : scene.points.cells_with_points())
        extremes.include_in(pressure[cell], scene.grid.geometry(cell));
    extremes.end(scene.grid.communicator());
    return present_columns();
  }

  std::vector<std::string>
  UndrainedWater::take_warnings()
  {
    std::vector<std::string> warnings;
    warn_of_open_lid(0.,
                     "Water/Level = undrained has no suction beneath it: take "
                     "Level = coupled with a Permeability of 1e-9 m/s, and "
                     "Suction control = sealed",
                     warnings);
    extremes.warn(time, place_in_words(), warnings);
    return warnings;
  }

  WaterReport
  UndrainedWater::report(const std::vector<Kernels::Material> &materials) const
  {
    WaterReport result;
    for (const unsigned int i : scene.soil.uppermost_materials())
      {
        const double      share = share_of_load(materials[i]);
        const std::string layer = to_text(scene.soil.material(i).layer + 1);
        result.lines.emplace_back("water in layer " + layer,
                                  "undrained, bears " + to_text(share, 3) +
                                    " of a load on confined soil");
        if (share < least_share)
          result.known_limits.push_back(
            "the water of layer " + layer +
            " is so soft that the soil is not undrained: it bears " +
            to_text(share, 2) + " of a load on confined soil, less than " +
            to_text(least_share) + ". Set Water/Bulk modulus = " +
            to_text(20. * (materials[i].p_wave_modulus - traits_.bulk_modulus),
                    2));
      }
    return result;
  }

  void
  UndrainedWater::continue_after(const std::string &, const NamedFields &)
  {
    compute_pressure();
  }
} // namespace CaissonMPM
