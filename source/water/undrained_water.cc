// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/kernels/cell_map.h>
#include <caisson_mpm/water/undrained_water.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  namespace
  {
    // Below this share of a load, undrained soil changes its volume noticeably.
    constexpr double least_share = .9;
  } // namespace

  UndrainedWater::UndrainedWater(const WaterScene &scene)
    : PoreWater(scene)
    , connection(
        scene.grid.signals.after_change.connect([this]() { reinit(); }))
    , extremes(scene)
  {
    traits_.has_excess_pressure = true;
    traits_.follows_clay        = true;
    traits_.resists_body        = true;
    traits_.bulk_modulus        = scene.settings.undrained.bulk_modulus;
    if (scene.asks_for_suction())
      {
        suction     = std::make_unique<SteadySeepage>(scene);
        traits_.lid = suction->traits().lid;
        of_suction  = suction->present_columns();
      }
    else
      of_suction = {{"tip_water_force_N", 0.}};
    scene.totals.keep("undrained_water_time", time);
  }

  void
  UndrainedWater::check_parameters() const
  {
    if (!scene.soil.is_submerged())
      throw BadInput("Water/Level is undrained, but the soil is dry: set "
                     "Soil/Submerged = true, or Level = drained.");
    if (suction)
      suction->check_parameters();
  }

  std::vector<const Section *>
  UndrainedWater::used_groups() const
  {
    std::vector<const Section *> used = {&scene.settings.undrained};
    if (suction)
      used.push_back(&scene.settings.seepage);
    return used;
  }

  void
  UndrainedWater::reinit()
  {
    SoilColumns columns; // its columns only: no height is asked for
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
    // the pressure acts in the share of a cell that is filled
    tip.integrate(
      scene.grid,
      [this](const unsigned int cell, const unsigned int) {
        return pressure[cell];
      },
      0.,
      [this](const unsigned int cell) {
        const double whole = Kernels::CellMap<>(scene.grid.geometry(cell))
                               .volume(scene.grid.axisymmetric() ? 1. : 0.);
        return std::min(1., scene.points.filled_volume_in(cell) / whole);
      });
  }

  void
  UndrainedWater::begin_step(const double              dt,
                             const BoundaryConditions &conditions,
                             Contact                  &contact)
  {
    compute_pressure();
    if (suction)
      suction->begin_step(dt, conditions, contact);
  }

  double
  UndrainedWater::end_step(const double time,
                           const double dt,
                           const double force_on_body,
                           const double travel)
  {
    this->time = time + dt;
    if (suction)
      suction->end_step(time, dt, force_on_body - tip.value(), travel);
    return tip.value() * travel;
  }

  void
  UndrainedWater::write_pressure_to_points()
  {
    if (pressure.empty())
      return;
    if (suction)
      suction->nodal_pressure();
    scene.points.set_pore_pressure(
      [this](const unsigned int cell, const dealii::Point<2> &place) {
        return pressure[cell] +
               (suction ? suction->pressure_at(cell, place) : 0.);
      });
  }

  NamedNumbers
  UndrainedWater::present_columns() const
  {
    NamedNumbers result = extremes.columns();
    for (const auto &[name, value] : of_suction)
      result.emplace_back(name,
                          value +
                            (name == "tip_water_force_N" ? tip.value() : 0.));
    return result;
  }

  NamedNumbers
  UndrainedWater::columns()
  {
    if (suction)
      of_suction = suction->columns();
    extremes.begin();
    for (const double p : pressure)
      extremes.include(p);
    if (!pressure.empty())
      for (const unsigned int cell : scene.points.cells_with_points())
        extremes.include_in(pressure[cell], scene.grid.geometry(cell));
    extremes.end();
    return present_columns();
  }

  std::vector<std::string>
  UndrainedWater::take_warnings()
  {
    std::vector<std::string> warnings;
    if (suction)
      warnings = suction->take_warnings();
    else
      warn_of_open_lid(0.,
                       "Set Water/Level = coupled with a Permeability of 1e-9 "
                       "m/s, and Suction control = sealed",
                       warnings);
    extremes.warn(time, place_in_words(), warnings);
    return warnings;
  }

  WaterReport
  UndrainedWater::report(const std::vector<Kernels::Material> &materials) const
  {
    WaterReport result = suction ? suction->report(materials) : WaterReport();
    for (const unsigned int i : scene.soil.uppermost_materials())
      {
        const double share =
          materials[i].water_modulus / materials[i].p_wave_modulus;
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
  UndrainedWater::continue_after(const std::string &level,
                                 const NamedFields &fields)
  {
    compute_pressure();
    if (suction)
      suction->continue_after(level, fields);
  }
} // namespace CaissonMPM
