// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/intervals.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/water/coupled_water.h>
#include <caisson_mpm/water/steady_seepage.h>

#include <cmath>
#include <utility>

namespace CaissonMPM
{
  namespace
  {
    // Above this, inertia changes the pressure of a transient by more than half
    // a per cent.
    constexpr double largest_inertia = .02;

    /** The force of the pressure in the cells, computed twice in a step. */
    class CoupledPressureForce : public NodalForce
    {
    public:
      explicit CoupledPressureForce(CoupledWater &water)
        : water(water)
      {}

      bool
      is_active() const override
      {
        return true;
      }

      bool
      is_implicit() const override
      {
        return true;
      }

      void
      solve(const Kernels::NodalVector             *velocity,
            const std::vector<Kernels::CornerView> &corners,
            const std::vector<double>              &mass) override
      {
        water.solve(velocity, corners, mass);
      }

      Vector2
      at_corner(const unsigned int cell,
                const unsigned int corner) const override
      {
        return water.pressure_projection().force_at(cell, corner);
      }

    private:
      void
      add(const ForceContext &, Kernels::NodalVector *force) override
      {
        water.pressure_projection().add_force(force);
      }

      CoupledWater &water;
    };
  } // namespace

  CoupledWater::CoupledWater(const WaterScene &scene)
    : FlowingWater(scene)
    , extremes(scene)
  {
    traits_.follows_soil = true;
    traits_.follows_clay = true;
    traits_.least_points = 4;
    projection.register_totals(scene.totals);
    scene.totals.keep("water_unbalanced", unbalanced);
    scene.totals.keep("water_through_surfaces", through_surfaces);
    scene.forces.push_back(std::make_unique<CoupledPressureForce>(*this));
  }

  // ------------------------------------------------------------ parameters

  void
  CoupledWater::check_parameters() const
  {
    bottom_expression().at_time(0.);
    FlowingWater::check_parameters();
    if (scene.body.shape().n_parts() > 1)
      throw BadInput(
        "Water/Level is coupled, and the wall has Rigid body/Wall steps or "
        "Rings: coupled water cannot leave the soil beside the gap above them. "
        "Set Level = seepage or undrained, or leave them out.");
    const OpenSides &open = scene.settings.sides;
    if (!lid && !open.surface && !open.outer && !open.bottom)
      throw BadInput(
        "the pore water has nowhere to drain to. Set Water/Drained "
        "surface, Drained outer side or Drained bottom = true.");
  }

  std::vector<const Section *>
  CoupledWater::used_groups() const
  {
    return {&scene.settings.coupled, &scene.settings.open_sides};
  }

  void
  CoupledWater::name_unused_entries(ParameterOrigins &origins) const
  {
    FlowingWater::name_unused_entries(origins);
    if (!scene.settings.sides.bottom)
      origins.add_unused({"Water/Bottom pressure"},
                         "Water/Drained bottom is false");
  }

  Expression
  CoupledWater::bottom_expression() const
  {
    const std::string &text = scene.settings.coupled.bottom_text;
    return Expression(text, "Water/Bottom pressure = " + text);
  }

  // ------------------------------------------------------------ the fields

  void
  CoupledWater::reinit()
  {
    FlowingWater::reinit();
    bottom_pressure = bottom_expression();
    projection.initialize(scene.grid);
    step = 0.;
  }

  std::vector<GridField>
  CoupledWater::fields()
  {
    const auto place = [this](const unsigned int cell) {
      return projection.solver().place(cell);
    };
    return {{"pore_pressure", &projection.pressure(), place},
            {"pore_water_left", &projection.remainder(), place},
            {"is_wet", &projection.wet_cells(), place}};
  }

  void
  CoupledWater::continue_after(const std::string &level,
                               const NamedFields &fields)
  {
    if (level == scene.settings.level_name())
      scatter(scene.grid, fields, this->fields());
    else if (const auto *const share =
               field_named(SteadySeepage::name_of_field, fields))
      begin_with_seepage(*share);
    FlowingWater::continue_after(level, fields);
    integrate_over_tip();
  }

  void
  CoupledWater::begin_with_seepage(const std::vector<double> &share_of_suction)
  {
    CellData &p = projection.pressure();
    p.zero_out_ghost_values();
    for (unsigned int cell = 0; cell < scene.grid.n_cells(); ++cell)
      if (scene.grid.is_owned(cell))
        {
          double mean = 0.;
          for (unsigned int k = 0; k < 4; ++k)
            mean +=
              .25 * share_of_suction[place_of_corner(scene.grid, cell, k)];
          p.local_element(projection.solver().place(cell)) = -suction() * mean;
        }
    p.update_ghost_values();
    projection.begin_with({-suction(), 0.});
    for (unsigned int i = 0; i < scene.soil.n_materials(); ++i)
      if (suction() != 0. && scene.soil.material(i).has_undrained_strength())
        begins_with_field = true;
  }

  // ------------------------------------------------------------ a step

  void
  CoupledWater::begin_step(const double              dt,
                           const BoundaryConditions &conditions,
                           Contact                  &contact)
  {
    if (!is_solved || ++steps_since_look == Intervals::soil_of_water)
      {
        soil_in_cells.compute(scene.grid,
                              scene.points,
                              scene.soil,
                              scene.settings.coupled.time_compression);
        steps_since_look = 0;
      }
    // steps that end at a record differ by rounding alone
    const bool is_new_step = std::abs(dt - step) > 1e-9 * step;
    if (is_new_step || steps_since_look % Intervals::equations_of_water == 0)
      {
        find_mudline();
        projection.set_up(scene.grid,
                          soil_columns,
                          soil_in_cells.properties,
                          scene.settings.sides,
                          conditions,
                          dt);
      }
    if (!is_solved && !projection.solver().has_known_value())
      throw RunFailure(
        "the pore water has nowhere to drain to: its pressure is known nowhere. "
        "Set Water/Drained surface, Drained outer side or Drained bottom.");
    is_solved = true;
    step      = dt;
    if (lid)
      lid->open(contact);
  }

  void
  CoupledWater::solve(const Kernels::NodalVector             *velocity,
                      const std::vector<Kernels::CornerView> &corners,
                      const std::vector<double>              &mass)
  {
    projection.solve(velocity,
                     corners,
                     mass,
                     {-suction(), bottom_pressure.at_time(time + .5 * step)});
    integrate_over_tip();
    finish_flow();
    const PressureProjection::Flow &flow = projection.flow();
    unbalanced += step * std::abs(flow.left);
    through_surfaces += step * (std::abs(flow.out) + std::abs(flow.in));
  }

  void
  CoupledWater::integrate_over_tip()
  {
    tip.integrate(
      scene.grid,
      [this](const unsigned int cell, const unsigned int) {
        return projection.pressure_in(cell);
      },
      0.,
      [](const unsigned int) { return 0.; }); // neither steps nor rings
  }

  WaterFlow
  CoupledWater::flow() const
  {
    WaterFlow result;
    result.out            = projection.flow().out;
    result.in             = projection.flow().in;
    result.tip_force      = tip.value();
    result.tip_resistance = tip.value();
    result.plug_rate      = plug_rate;
    result.response       = projection.conductance_of_plug();
    if (suction() != 0. && tip.area() > 0.)
      result.pressure_factor = -tip.at_tip() / tip.area() / suction();
    result.n_iterations = projection.solver().n_iterations();
    return result;
  }

  // ------------------------------------------------------------ records

  void
  CoupledWater::prepare_columns()
  {
    extremes.begin();
    for (const unsigned int cell : projection.solver().cells())
      {
        const double p = projection.pressure_in(cell);
        if (has_started)
          extremes.include(p);
        if (is_solved)
          extremes.include_in(p, scene.grid.geometry(cell));
      }
    if (is_solved)
      for (unsigned int node = 0; node < scene.grid.n_owned_nodes(); ++node)
        if (const auto p = projection.known_at(node))
          extremes.include_at(*p, scene.grid.r_of(node), scene.grid.z_of(node));
    extremes.end();
  }

  NamedNumbers
  CoupledWater::columns_with(const SoilColumns &soil_columns) const
  {
    NamedNumbers result = extremes.columns();
    result.emplace_back("water_balance",
                        through_surfaces > 0. ? unbalanced / through_surfaces :
                                                0.);
    const NamedNumbers of_flow = FlowingWater::columns_with(soil_columns);
    result.insert(result.end(), of_flow.begin(), of_flow.end());
    return result;
  }

  std::vector<std::string>
  CoupledWater::take_warnings()
  {
    std::vector<std::string> warnings;
    if (!lid || !lid->is_sealed())
      warn_of_open_lid(suction(),
                       "Set Water/Suction control = sealed for a sealed one",
                       warnings);
    if (std::exchange(begins_with_field, false))
      warnings.push_back(
        "the excess pressure in clay begins with the field that carried the "
        "suction of the installation, which is no pore pressure: forces are "
        "right while the clay is undrained. Where it drains, run the "
        "installation with Water/Level = coupled, too");
    extremes.warn(time, place_in_words(), warnings);
    const auto of_plug = FlowingWater::take_warnings();
    warnings.insert(warnings.end(), of_plug.begin(), of_plug.end());
    return warnings;
  }

  WaterReport
  CoupledWater::report(const std::vector<Kernels::Material> &materials) const
  {
    WaterReport result = FlowingWater::report(materials);
    if (!scene.body.shape().exists())
      return result;
    const double compression = scene.settings.coupled.time_compression,
                 diameter    = 2. * scene.body.shape().right();
    unsigned int number      = 0;
    for (const unsigned int i : scene.soil.uppermost_materials())
      {
        const std::string layer   = to_text(++number);
        const double      modulus = materials[i].p_wave_modulus;
        // k (lambda + 2 mu) / gamma_w, m2/s, with mass scaling over the speed
        // of waves and the diameter
        const double c_v = compression * scene.soil.material(i).permeability *
                           modulus / scene.soil.unit_weight_of_water();
        const double inertia =
          c_v /
          (std::sqrt(modulus / scene.soil.inertial_density(i)) * diameter);
        const std::string group =
          scene.body.motion().traits.needs_response ?
            to_text(diameter / c_v, 3) +
              " for each m/s of the velocity, which is a result" :
            to_text(scene.body.motion().usual_velocity() * diameter / c_v, 3);
        result.lines.emplace_back("drainage of layer " + layer,
                                  "c_v = " + to_text(c_v, 3) +
                                    " m2/s, v D / c_v = " + group +
                                    (compression != 1. ?
                                       ", permeability times " +
                                         to_text(compression) +
                                         " (Water/Time compression)" :
                                       ""));
        if (inertia > largest_inertia)
          result.known_limits.push_back(
            "inertia delays the drainage of layer " + layer +
            ": c_v over wave speed and diameter is " + to_text(inertia, 2) +
            ", more than " + to_text(largest_inertia) +
            ". Reduce Time/Mass scaling if pressures that change fast matter");
      }
    return result;
  }
} // namespace CaissonMPM
