// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/water/pore_water.h>

#include <utility>

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
    const std::string why = "Water/Level is " + scene.settings.level_name();
    scene.settings.name_unused_groups(origins, used_groups(), why);
    if (traits_.uses_permeability)
      return;
    scene.soil.name_unused_permeability(origins, why);
    if (!scene.body.motion().follows_loads() && traits_.lid == nullptr)
      origins.add_unused({"Rigid body/Submerged weight"},
                         why + ", and Rigid body/Motion is " +
                           scene.body.motion().name());
  }

  void
  PoreWater::begin_step(const double              dt,
                        const BoundaryConditions &conditions,
                        Contact                  &contact)
  {
    (void)dt;
    (void)conditions;
    (void)contact;
  }

  const double *
  PoreWater::volume_rates(const Kernels::NodalVector             *velocity,
                          const std::vector<Kernels::CornerView> &corners)
  {
    (void)velocity;
    (void)corners;
    return nullptr;
  }

  double
  PoreWater::end_step(const double time,
                      const double dt,
                      const double force_on_body,
                      const double travel)
  {
    (void)time;
    (void)dt;
    (void)force_on_body;
    (void)travel;
    return 0.;
  }

  std::vector<std::string>
  PoreWater::column_names() const
  {
    std::vector<std::string> names;
    for (const auto &column : present_columns())
      names.push_back(column.first);
    return names;
  }

  WaterReport
  PoreWater::report(const std::vector<Kernels::Material> &materials) const
  {
    (void)materials;
    return {};
  }

  void
  PoreWater::continue_after(const std::string &level, const NamedFields &fields)
  {
    (void)level;
    (void)fields;
  }

  void
  PoreWater::warn_of_open_lid(const double              suction,
                              const std::string        &advice,
                              std::vector<std::string> &warnings)
  {
    const BodyMotion &motion  = scene.body.motion();
    const bool        is_open = is_caisson() && !motion.follows_loads() &&
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
