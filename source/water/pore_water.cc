// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/water/pore_water.h>

#include <algorithm>

namespace CaissonMPM
{
  PoreWater::PoreWater(const WaterScene &scene)
    : scene(scene)
  {
    scene.totals.keep("has_warned_of_open_lid", has_warned_of_open_lid);
  }

  void
  PoreWater::name_unused_entries(ParameterOrigins &origins) const
  {
    const WaterSettings &settings = scene.settings;
    const std::string    why      = "Water/Level is " + settings.level_name();
    auto                 used     = used_groups();
    if (traits_.has_excess_pressure)
      used.push_back(&settings.sea);
    const std::vector<const Section *> groups = {&settings.undrained,
                                                 &settings.seepage,
                                                 &settings.coupled,
                                                 &settings.open_sides,
                                                 &settings.sea},
                                       of_lid = {&settings.suction,
                                                 &settings.feasibility,
                                                 &settings.design};
    for (const Section *const group : groups)
      if (std::find(used.begin(), used.end(), group) == used.end())
        origins.add_unused(group->entries(), why);
    if (traits_.lid == nullptr)
      for (const Section *const group : of_lid)
        origins.add_unused(group->entries(),
                           traits_.uses_permeability ? "there is no caisson" :
                                                       why);
    else
      settings.suction.name_unused_entries(origins);
    if (traits_.uses_permeability)
      return;
    scene.soil.name_unused_permeability(origins, why);
    if (!scene.body.motion().traits.follows_loads && traits_.lid == nullptr)
      origins.add_unused({"Rigid body/Submerged weight"},
                         why + ", and Rigid body/Motion is " +
                           scene.body.motion().name);
  }

  std::vector<bool>
  PoreWater::pressure_in_stress() const
  {
    std::vector<bool> result;
    for (unsigned int i = 0; i < scene.soil.n_materials(); ++i)
      result.push_back(traits_.has_excess_pressure &&
                       shows_total_stress(scene.soil.material(i)));
    return result;
  }

  bool
  PoreWater::shows_pressure() const
  {
    const auto in_stress = pressure_in_stress();
    return traits_.has_excess_pressure &&
           std::count(in_stress.begin(), in_stress.end(), false) > 0;
  }

  std::vector<std::string>
  PoreWater::column_names() const
  {
    std::vector<std::string> names;
    for (const auto &column : present_columns())
      names.push_back(column.first);
    return names;
  }

  void
  PoreWater::warn_of_open_lid(const double              suction,
                              const std::string        &advice,
                              std::vector<std::string> &warnings)
  {
    const BodyMotion &motion = scene.body.motion();
    const bool is_open = scene.has_caisson() && !motion.traits.follows_loads &&
                         motion.mean_velocity() < 0. && suction == 0.;
    if (holds_first(has_warned_of_open_lid, is_open))
      warnings.push_back(
        "the caisson is pulled up, and water flows freely beneath its lid: "
        "the force is that of an open lid, and not what a sealed one "
        "bears. " +
        advice);
  }

  std::string
  PoreWater::place_in_words() const
  {
    return scene.body.shape().exists() ?
             " at a penetration of " + to_text(scene.body.penetration(), 5) +
               " m" :
             "";
  }

  bool
  holds_first(bool &has_held, const bool holds)
  {
    return holds && !std::exchange(has_held, true);
  }
} // namespace CaissonMPM
