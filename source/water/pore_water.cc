// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/kernels/cell_map.h>
#include <caisson_mpm/water/pore_water.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
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

  // ------------------------------------------------------------ extremes

  using namespace dealii;

  PressureExtremes::PressureExtremes(const WaterScene &scene)
    : scene(scene)
  {
    scene.totals.keep("has_warned_of_cavitation", has_warned);
  }

  void
  PressureExtremes::begin()
  {
    unit_weight = scene.soil.unit_weight_of_water();
    at_rest     = scene.settings.sea.cavitation(unit_weight, 0.);
    smallest = largest = 0.;
    lowest             = {{at_rest, 0., 0.}};
  }

  void
  PressureExtremes::include(const double pressure)
  {
    smallest = std::min(smallest, pressure);
    largest  = std::max(largest, pressure);
  }

  void
  PressureExtremes::include_at(const double pressure,
                               const double r,
                               const double z)
  {
    lowest = std::min(lowest, {{at_rest - unit_weight * z + pressure, r, z}});
  }

  void
  PressureExtremes::include_in(const double                 pressure,
                               const Kernels::CellGeometry &cell)
  {
    const Kernels::CellMap<> map(cell);
    include_at(pressure, map.left + .5 * map.width, map.center_z());
  }

  void
  PressureExtremes::end()
  {
    const MPI_Comm communicator = scene.grid.communicator();
    smallest                    = Utilities::MPI::min(smallest, communicator);
    largest                     = Utilities::MPI::max(largest, communicator);
    for (const auto &of_rank : Utilities::MPI::all_gather(communicator, lowest))
      lowest = std::min(lowest, of_rank);
  }

  NamedNumbers
  PressureExtremes::columns() const
  {
    return {{"pore_pressure_smallest_Pa", smallest},
            {"pore_pressure_largest_Pa", largest},
            {"cavitation_margin_Pa", lowest[0]}};
  }

  void
  PressureExtremes::warn(const double              time,
                         const std::string        &place,
                         std::vector<std::string> &warnings)
  {
    if (lowest[0] >= 0. || std::exchange(has_warned, true))
      return;
    warnings.push_back(
      "the pore water falls below its vapor pressure at t = " +
      to_text(time, 5) + " s" + place + ", first at r = " +
      to_text(lowest[1], 4) + " m, z = " + to_text(lowest[2], 4) +
      " m. It would boil there (cavitation), which the program does not "
      "compute: from here on, soil that is drawn apart or dilates carries "
      "more suction than water can, and its resistance is too large. "
      "Check Water/Water depth; see cavitation_margin_Pa in history.csv");
  }
} // namespace CaissonMPM
