// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/water/undrained_suction.h>

namespace CaissonMPM
{
  UndrainedSuction::UndrainedSuction(const WaterScene &scene)
    : SteadySeepage(scene)
  {
    traits_.uses_permeability = false;
    traits_.resists_body      = true;
  }

  bool
  UndrainedSuction::is_wanted(const WaterScene &scene)
  {
    return scene.settings.suction.control !=
             SuctionSettings::Control::automatic &&
           scene.body.shape().name() == "caisson";
  }

  void
  UndrainedSuction::reinit()
  {
    SteadySeepage::reinit();
    // the plug would answer to the water beneath the lid with a delay
    if (lid->is_sealed())
      throw BadInput(
        "Water/Suction control is sealed, but Water/Level is " +
        scene.settings.level_name() +
        ": the water beneath a sealed lid follows the soil only in a coupled "
        "run. Set Water/Level = coupled, and the Permeability of clay to 1e-9 "
        "m/s.");
    if (scene.settings.level == WaterLevel::undrained)
      return;
    for (unsigned int i = 0; i < scene.soil.n_materials(); ++i)
      if (const SoilMaterial &material = scene.soil.material(i);
          !material.has_undrained_strength())
        throw BadInput(
          "Water/Suction control is set, and Water/Level is drained, but " +
          material.section() +
          " is no clay with an undrained strength (Friction angle = 0 and a "
          "Cohesion): water would flow through it. Set Water/Level = seepage "
          "or coupled, or, for no suction, Suction control = automatic.");
  }

  std::vector<const Section *>
  UndrainedSuction::used_groups() const
  {
    return {&scene.settings.seepage,
            &scene.settings.sea,
            &scene.settings.suction,
            &scene.settings.feasibility};
  }

  void
  UndrainedSuction::find_permeability()
  {
    soil_in_cells.permeability.assign(scene.grid.n_cells(), {1., 1.});
    soil_in_cells.is_clay.assign(scene.grid.n_cells(), true);
    spread_in_plug();
  }

  WaterFlow
  UndrainedSuction::flow() const
  {
    WaterFlow result = SteadySeepage::flow();
    result.flows     = false;
    result.out = result.in = result.response = 0.;
    return result;
  }
} // namespace CaissonMPM
