// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/intervals.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/water/steady_seepage.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace CaissonMPM
{
  namespace
  {
    // So much more easily a suction passes clay in the plug than below it, and
    // so much less easily an overpressure, which would tear the plug off its
    // base if it took its stress away.
    constexpr double faster_in_plug = 1e3;

    /** Minus the gradient of the excess pressure, per volume. */
    class SeepageForce : public NodalForce
    {
    public:
      explicit SeepageForce(SteadySeepage &water)
        : water(water)
      {}

      bool
      is_active() const override
      {
        return water.suction() != 0.;
      }

    private:
      void
      add(const ForceContext &context, Kernels::NodalVector *force) override
      {
        context.kernels.pressure_gradient_force(context.step,
                                                water.nodal_pressure().data(),
                                                water.filled().data(),
                                                force);
      }

      SteadySeepage &water;
    };
  } // namespace

  const std::string SteadySeepage::name_of_field = "share_of_suction";

  SteadySeepage::SteadySeepage(const WaterScene &scene)
    : FlowingWater(scene)
    , flows(scene.settings.level == WaterLevel::seepage)
  {
    traits_.uses_permeability = flows;
    traits_.resists_body      = !flows || (lid && lid->is_sealed());
    scene.forces.push_back(std::make_unique<SeepageForce>(*this));
  }

  void
  SteadySeepage::check_parameters() const
  {
    FlowingWater::check_parameters();
    if (!lid)
      throw BadInput(
        "Water/Level is seepage, but Rigid body/Kind is " +
        scene.body.shape().name +
        ": only a caisson has a lid with suction beneath it. Set Kind = "
        "caisson, or Level = drained, undrained or coupled.");
  }

  std::vector<const Section *>
  SteadySeepage::used_groups() const
  {
    if (flows)
      return {&scene.settings.seepage, &scene.settings.open_sides};
    return {&scene.settings.seepage};
  }

  void
  SteadySeepage::reinit()
  {
    FlowingWater::reinit();
    seepage.initialize(scene.grid);
    if (flows)
      return;
    // the plug would answer to the water beneath the lid with a delay
    if (lid->is_sealed())
      throw BadInput(
        "Water/Suction control is sealed, but Water/Level is " +
        scene.settings.level_name() +
        ": the water beneath a sealed lid follows the soil only in a coupled "
        "run. Set Water/Level = coupled, and the Permeability of clay to 1e-9 "
        "m/s.");
    for (unsigned int i = 0; i < scene.soil.n_materials(); ++i)
      if (const SoilMaterial &material = scene.soil.material(i);
          scene.settings.level == WaterLevel::drained &&
          !material.has_undrained_strength())
        throw BadInput(
          "Water/Suction control is set, and Water/Level is drained, but " +
          material.section() +
          " is no clay with an undrained strength (Friction angle = 0 and a "
          "Cohesion): water would flow through it. Set Water/Level = seepage "
          "or coupled, or, for no suction, Suction control = automatic.");
  }

  std::vector<GridField>
  SteadySeepage::fields()
  {
    return {{name_of_field, &seepage.field(), {}}};
  }

  void
  SteadySeepage::begin_step(const double,
                            const BoundaryConditions &,
                            Contact &contact)
  {
    if (!still_serves())
      solve();
    lid->open(contact);
  }

  bool
  SteadySeepage::still_serves()
  {
    const double renewal = scene.settings.seepage.renewal,
                 moved =
                   std::abs(scene.body.motion().travel() - travel_at_solve);
    if (!is_solved || is_of_overpressure != (suction() < 0.) ||
        moved >= renewal * scene.body.shape().cell_width())
      return false;
    if (++steps_since_look < Intervals::mudline)
      return true;
    SoilColumns now = soil_columns;
    now.find(scene.grid, scene.points);
    lid->update_touching(now);
    steps_since_look = 0;
    return dealii::Utilities::MPI::max(now.largest_change(soil_columns),
                                       scene.grid.communicator()) < renewal;
  }

  void
  SteadySeepage::solve()
  {
    find_mudline();
    is_of_overpressure = suction() < 0.;
    find_permeability();
    seepage.solve(soil_columns,
                  soil_in_cells.permeability,
                  scene.settings.sides);
    if (!is_of_overpressure && !tip_is_in_clay())
      fill_clay_of_plug();
    tip.integrate(
      scene.grid,
      [this](const unsigned int cell, const unsigned int corner) {
        return seepage.field().local_element(
          scene.grid.cell_nodes(cell).node[corner]);
      },
      1.,
      [this](const unsigned int cell) {
        return soil_columns.filled()[cell] >= SoilColumns::touching ? 1. : 0.;
      });
    const auto sums  = seepage.sums_of_plug_and_open();
    flow_out         = sums[0];
    flow_in          = -sums[1];
    is_solved        = true;
    travel_at_solve  = scene.body.motion().travel();
    steps_since_look = 0;
    finish_flow();
  }

  void
  SteadySeepage::find_permeability()
  {
    if (flows)
      soil_in_cells.compute(scene.grid, scene.points, scene.soil, 1.);
    else
      {
        soil_in_cells.permeability.assign(scene.grid.n_cells(), {1., 1.});
        soil_in_cells.is_clay.assign(scene.grid.n_cells(), true);
      }
    if (flows && !tip_is_in_clay())
      return;
    // let a suction reach all clay in the plug, down to the tip
    for (unsigned int cell = 0; cell < scene.grid.n_cells(); ++cell)
      if (soil_in_cells.is_clay[cell] && is_in_plug(cell))
        for (double *const k : {&soil_in_cells.permeability[cell].horizontal,
                                &soil_in_cells.permeability[cell].vertical})
          *k *= is_of_overpressure ? 1. / faster_in_plug : faster_in_plug;
  }

  bool
  SteadySeepage::tip_is_in_clay() const
  {
    const unsigned int i = scene.soil.material_at(-scene.body.penetration());
    return scene.soil.material(i).has_undrained_strength();
  }

  bool
  SteadySeepage::is_in_plug(const unsigned int cell) const
  {
    const auto &g = scene.grid.geometry(cell);
    return soil_columns.side_of(cell) == SoilColumns::Side::plug &&
           g.bottom_left + .5 * g.height_left > -scene.body.penetration();
  }

  void
  SteadySeepage::fill_clay_of_plug()
  {
    // whether a node belongs to clay of the plug, and to other soil
    NodalData of_clay, of_rest;
    for (NodalData *const v : {&of_clay, &of_rest})
      scene.grid.reinit(*v, 1);
    for (unsigned int cell = 0; cell < scene.grid.n_cells(); ++cell)
      if (scene.grid.is_owned(cell) && soil_columns.filled()[cell] > 0.)
        for (const unsigned int node : scene.grid.cell_nodes(cell).node)
          (soil_in_cells.is_clay[cell] && is_in_plug(cell) ? of_clay : of_rest)
            .local_element(node) = 1.;
    for (NodalData *const v : {&of_clay, &of_rest})
      {
        v->compress(dealii::VectorOperation::add);
        v->update_ghost_values();
      }
    for (unsigned int node = 0; node < scene.grid.n_nodes(); ++node)
      if (of_clay.local_element(node) > 0. && of_rest.local_element(node) == 0.)
        seepage.field().local_element(node) = 1.;
  }

  WaterFlow
  SteadySeepage::flow() const
  {
    WaterFlow result;
    result.scale           = suction() / scene.soil.unit_weight_of_water();
    result.flows           = flows;
    result.tip_force       = -suction() * tip.value();
    result.tip_area        = tip.value();
    result.pressure_factor = tip.at_tip() / tip.area();
    result.plug_rate       = plug_rate;
    result.n_iterations    = seepage.n_iterations();
    if (flows)
      {
        result.out      = flow_out;
        result.in       = flow_in;
        result.response = flow_out / scene.soil.unit_weight_of_water();
      }
    return result;
  }

  void
  SteadySeepage::prepare_columns()
  {
    if (!is_solved)
      solve();
  }

  void
  SteadySeepage::continue_after(const std::string &level,
                                const NamedFields &fields)
  {
    scatter(scene.grid, fields, this->fields());
    FlowingWater::continue_after(level, fields);
  }
} // namespace CaissonMPM
