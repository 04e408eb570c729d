// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the pore water says of itself: columns, warnings, reasons.
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/kernels/cell_map.h>
#include <caisson_mpm/water/ground_water.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    // Above this, inertia changes the pressure of a transient by more than half
    // a per cent.
    constexpr double largest_inertia = .02;

    // From this share of the area on, the soil bears on the whole lid.
    constexpr double full_lid = .9;

    // Nearer to the critical gradient than this, no margin is left: the suction
    // is not known better.
    constexpr double near_critical = .9;

    // A flow that lifts less than this share of the plug is not looked at.
    constexpr double least_lifted_share = .1;

    // Below this, undrained soil changes its volume noticeably.
    constexpr double least_share = .9;

    /** Whether something is so for the first time; it is remembered. */
    bool
    is_first(bool &was_so, const bool is_so)
    {
      return is_so && !std::exchange(was_so, true);
    }

    /** What the water bears of a load on confined undrained soil. */
    double
    share_of_load(const Kernels::Material &material)
    {
      return material.water_modulus / material.p_wave_modulus;
    }
  } // namespace

  std::vector<std::string>
  GroundWater::column_names() const
  {
    std::vector<std::string> names;
    for (const auto &value : values(mudline))
      names.push_back(value.first);
    return names;
  }

  double
  GroundWater::heave(const Mudline &mudline) const
  {
    return has_started && mudline.is_found() ?
             mudline.mean_height(Mudline::Side::plug) - plug_height :
             0.;
  }

  double
  GroundWater::heave_by_wall() const
  {
    const double outer = body.shape().right(), area = pi * outer * outer;
    return body.motion().travel() * (area - lid_area()) / lid_area();
  }

  NamedNumbers
  GroundWater::values(const Mudline &mudline) const
  {
    if (!acts())
      return {};
    const double total_with_water = -last_force_on_body + tip_force();
    NamedNumbers result;
    if (level != Level::seepage)
      {
        const auto [smallest, largest] = extremes();
        result = {{"pore_pressure_smallest_Pa", smallest},
                  {"pore_pressure_largest_Pa", largest},
                  {"cavitation_margin_Pa", boiling_margin.value}};
      }
    if (is_undrained())
      {
        result.insert(result.end(),
                      {{"tip_water_force_N", tip_force()},
                       {"total_force_with_water_N", total_with_water}});
        return result;
      }
    const double scale = flow_scale();
    if (is_coupled())
      result.emplace_back("water_balance",
                          through_surfaces > 0. ?
                            unbalanced / through_surfaces :
                            0.);
    if (!has_lid())
      {
        result.insert(result.end(),
                      {{"tip_water_force_N", tip_force()},
                       {"total_force_with_water_N", total_with_water},
                       {"net_outflow_m3_s", -scale * flow_in},
                       {"flow_iterations", 1. * n_iterations()}});
        return result;
      }
    const NamedNumbers of_lid = values_of_lid(mudline);
    result.insert(result.end(), of_lid.begin(), of_lid.end());
    if (is_coupled())
      result.emplace_back("total_force_with_water_N", total_with_water);
    return result;
  }

  NamedNumbers
  GroundWater::values_of_lid(const Mudline &mudline) const
  {
    // only the names are wanted before the flow is known
    const auto at_wall = [&](const Mudline::Side side) {
      return mudline.is_found() ? mudline.height_at_wall(side) : 0.;
    };
    const double s = suction.value(), rise = heave(mudline),
                 scale = flow_scale(), gas = suction.gas_expansion();
    NamedNumbers result = {
      {"suction_Pa", s},
      {"required_suction_Pa", suction.required()},
      {"cavitation_suction_Pa", suction.cavitation(height_of_lid())},
      {"suction_force_N", s * lid_area()},
      {"tip_water_force_N", tip_force()},
      {"pore_pressure_factor",
       is_coupled() ?
         (s > 0. && tip_area > 0. ? -tip_integral / tip_area / s : 0.) :
         tip_integral / tip_area},
      {"exit_gradient_wall", scale * exit.wall},
      {"exit_gradient_axis", scale * exit.axis},
      {"critical_gradient", withstood.surface},
      {"seepage_flow_m3_s", scale * flow_out},
      {"seepage_inflow_m3_s", scale * flow_in},
      {"seepage_volume_m3", seepage_volume},
      {"pumped_volume_m3",
       seepage_volume + lid_area() * (body.motion().travel() + rise) + gas -
         volume_at_start},
      {"gas_expansion_m3", gas},
      {"plug_heave_m", rise},
      {"mudline_at_inner_wall_m", at_wall(Mudline::Side::plug)},
      {"mudline_at_outer_wall_m", at_wall(Mudline::Side::beyond)},
      {"flow_iterations", 1. * n_iterations()}};
    const auto of_plug = plug_balance.columns(lid_area() * rise);
    result.insert(result.end(), of_plug.begin(), of_plug.end());
    return result;
  }

  std::pair<double, double>
  GroundWater::extremes() const
  {
    std::pair<double, double> result  = {0., 0.};
    const auto                include = [&](const double p) {
      result.first  = std::min(result.first, p);
      result.second = std::max(result.second, p);
    };
    for (const double p : undrained.pressure())
      include(p);
    if (is_coupled() && has_started)
      for (const unsigned int cell : projection.solver().cells())
        include(projection.pressure_in(cell));
    return {Utilities::MPI::min(result.first, grid.communicator()),
            Utilities::MPI::max(result.second, grid.communicator())};
  }

  GroundWater::BoilingMargin
  GroundWater::find_boiling_margin() const
  {
    const double gamma           = soil.unit_weight_of_water(),
                 rest            = suction.cavitation(0.);
    std::array<double, 3> lowest = {{rest, 0., 0.}};
    const auto include = [&](const double p, const double r, const double z) {
      lowest = std::min(lowest, {{rest - gamma * z + p, r, z}});
    };
    const auto include_cell = [&](const double p, const unsigned int cell) {
      const Kernels::CellMap<> map(grid.geometry(cell));
      include(p, map.left + .5 * map.width, map.center_z());
    };
    if (undrained.is_found())
      for (const unsigned int cell : points.cells_with_points())
        include_cell(undrained.pressure()[cell], cell);
    if (is_coupled() && is_solved)
      {
        for (const unsigned int cell : projection.solver().cells())
          include_cell(projection.pressure_in(cell), cell);
        for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
          if (const auto p = projection.known_at(node))
            include(*p, grid.r_of(node), grid.z_of(node));
      }
    for (const auto &of_rank :
         Utilities::MPI::all_gather(grid.communicator(), lowest))
      lowest = std::min(lowest, of_rank);
    return {lowest[0], lowest[1], lowest[2]};
  }

  void
  GroundWater::find_exit_gradient()
  {
    const double wall = body.shape().left(), width = body.penetration();
    exit = exit_gradient(grid, mudline, permeability, outflow(), wall, width);
  }

  NamedNumbers
  GroundWater::columns()
  {
    if (is_coupled() || is_undrained())
      boiling_margin = find_boiling_margin();
    if (!flows())
      return values(mudline);
    if (!is_solved && !is_coupled())
      solve();
    if (is_solved && has_lid())
      find_exit_gradient();
    Mudline now = mudline;
    now.find(grid, points);
    if (has_lid())
      withstood = plug_strength.find(now);
    return values(now);
  }

  bool
  GroundWater::pulls_with_open_lid() const
  {
    // Drained soil leaves a sealed lid no more than an open one.
    return (is_undrained() || is_coupled()) && has_lid() &&
           !body.motion().follows_loads() &&
           body.motion().mean_velocity() < 0. && suction.value() == 0.;
  }

  std::vector<std::string>
  GroundWater::take_warnings()
  {
    std::vector<std::string> warnings;
    if (is_first(has_warned_of_open_lid, pulls_with_open_lid()))
      warnings.push_back(
        "the caisson is pulled up, and water flows freely beneath its lid: "
        "the force is that of an open lid, and not what a sealed one bears. " +
        std::string(is_undrained() ?
                      "Water/Level = undrained has no suction beneath it" :
                      "Give the suction beneath a sealed one with Water/"
                      "Suction control = table"));
    const std::string where =
      body.shape().exists() ?
        " at a penetration of " + to_text(body.penetration(), 5) + " m" :
        "";
    if (is_first(has_warned_of_boiling, boiling_margin.value < 0.))
      warnings.push_back(
        "the pore water falls below its vapor pressure at t = " +
        to_text(time, 5) + " s" + where +
        ", first at r = " + to_text(boiling_margin.r, 4) +
        " m, z = " + to_text(boiling_margin.z, 4) +
        " m. It would boil there (cavitation), which the program does not "
        "compute: from here on, soil that is drawn apart or dilates is held "
        "by more suction than water bears, and its resistance is too large. "
        "Check Water/Water depth; see cavitation_margin_Pa in history.csv");
    if (has_suction())
      warn_of_plug(where, warnings);
    return warnings;
  }

  bool
  GroundWater::carries_soil() const
  {
    // The gradient of soil that gives off hardly any water is noise, and less
    // suction than this lifts no soil by its flow.
    const double least = least_lifted_share * body.penetration() *
                         withstood.of_block() * soil.unit_weight_of_water();
    return suction.value() > least &&
           flow_scale() * std::max(exit.wall, exit.axis) >
             near_critical * withstood.of_block();
  }

  void
  GroundWater::warn_of_plug(const std::string        &where,
                            std::vector<std::string> &warnings)
  {
    const std::string bound =
      withstood.strength == 0. ?
        "the critical one" :
        "what weight and cohesion of the plug withstand, gradients of " +
          to_text(withstood.weight, 3) + " and " +
          to_text(withstood.strength, 3) + ",";
    if (is_first(has_warned_of_piping, carries_soil()))
      warnings.push_back(
        "the exit gradient exceeds " + percent(near_critical, 2) + " of " +
        bound + where +
        ": the flow carries nearly all of the soil. Piping may begin, which "
        "the program does not follow");
    if (is_first(has_warned_of_lift,
                 heave(mudline) > heave_by_wall() + .02 * body.shape().right()))
      warnings.push_back("the suction lifts the plug" + where +
                         ": it rises by more than the wall displaces");
  }

  std::vector<GroundWater::Drainage>
  GroundWater::drainage(const std::vector<Kernels::Material> &materials) const
  {
    std::vector<Drainage> result;
    if (!is_coupled() || !body.shape().exists())
      return result;
    const double diameter = 2. * body.shape().right(),
                 speed    = body.motion().usual_velocity();
    for (const unsigned int i : soil.uppermost_materials())
      {
        const double modulus = materials[i].p_wave_modulus;
        Drainage     d;
        d.c_v = time_compression * soil.material(i).permeability * modulus /
                soil.unit_weight_of_water();
        d.group = speed * diameter / d.c_v;
        d.inertia =
          d.c_v / (std::sqrt(modulus / soil.inertial_density(i)) * diameter);
        result.push_back(d);
      }
    return result;
  }

  std::vector<std::pair<std::string, std::string>>
  GroundWater::description(
    const std::vector<Kernels::Material> &materials) const
  {
    std::vector<std::pair<std::string, std::string>> lines;
    if (has_suction())
      lines.emplace_back(
        "suction",
        "on a lid of " + to_text(lid_area(), 4) + " m2; the weight is " +
          to_text(1e-3 * body.submerged_weight(), 4) + " kN, like " +
          to_text(1e-3 * body.submerged_weight() / lid_area(), 3) +
          " kPa on it; water boils there at " +
          to_text(1e-3 * suction.cavitation(height_of_lid()), 3) + " kPa");
    if (is_undrained())
      for (const unsigned int i : soil.uppermost_materials())
        lines.emplace_back("water in layer " +
                             to_text(soil.material(i).layer + 1),
                           "undrained, bears " +
                             to_text(share_of_load(materials[i]), 3) +
                             " of a load on confined soil");
    const auto of_layers = drainage(materials);
    const auto group     = [this](const Drainage &layer) {
      if (!body.motion().needs_response())
        return to_text(layer.group, 3);
      return to_text(2. * body.shape().right() / layer.c_v, 3) +
             " for each m/s of the velocity, which is a result";
    };
    for (unsigned int i = 0; i < of_layers.size(); ++i)
      lines.emplace_back("drainage of layer " + to_text(i + 1),
                         "c_v = " + to_text(of_layers[i].c_v, 3) +
                           " m2/s, v D / c_v = " + group(of_layers[i]) +
                           (time_compression != 1. ?
                              ", permeability times " +
                                to_text(time_compression) +
                                " (Water/Time compression)" :
                              ""));
    return lines;
  }

  std::vector<std::string>
  GroundWater::known_limits(
    const std::vector<Kernels::Material> &materials) const
  {
    std::vector<std::string> limits;
    for (const unsigned int i : soil.uppermost_materials())
      if (is_undrained() && share_of_load(materials[i]) < least_share)
        limits.push_back(
          "the water of layer " + to_text(soil.material(i).layer + 1) +
          " is so soft that the soil is not undrained: it bears " +
          to_text(share_of_load(materials[i]), 2) +
          " of a load on confined soil, less than " + to_text(least_share) +
          ". Set Water/Bulk modulus = " +
          to_text(20. * (materials[i].p_wave_modulus - bulk_modulus), 2));
    const auto of_layers = drainage(materials);
    for (unsigned int i = 0; i < of_layers.size(); ++i)
      if (of_layers[i].inertia > largest_inertia)
        limits.push_back(
          "inertia delays the drainage of layer " + to_text(i + 1) +
          ": c_v over wave speed and diameter is " +
          to_text(of_layers[i].inertia, 2) + ", more than " +
          to_text(largest_inertia) +
          ". Reduce Time/Mass scaling if pressures that change fast matter");
    return limits;
  }

  double
  GroundWater::height_of_lid() const
  {
    return body.shape().lower_face_of_lid() - body.motion().travel();
  }

  NamedNumbers
  GroundWater::limits() const
  {
    return {{"submerged_weight_N", body.submerged_weight()}};
  }

  std::string
  GroundWater::reason_to_end() const
  {
    if (!has_suction())
      return "";
    if (body.penetration() <= 0.)
      return "the caisson has left the soil, and water flows in below its skirt";
    if (touched_lid >= full_lid)
      return "the plug fills the caisson: soil bears on " +
             percent(full_lid, 2) + " of the lid (refusal)";
    if (is_solved &&
        mudline.mean_height(Mudline::Side::plug) >= height_of_lid())
      return "the plug fills the caisson: it has reached the lid, or the top of "
             "the skirt where the mesh has no lid (refusal)";
    return suction.limit_reached(height_of_lid());
  }
} // namespace CaissonMPM
