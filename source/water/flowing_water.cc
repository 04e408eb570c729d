// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/kernels/cell_map.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/water/flowing_water.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>

namespace CaissonMPM
{
  void
  PermeabilityField::compute(const BackgroundGrid &grid,
                             const MaterialPoints &points,
                             const Soil           &soil,
                             const double          faster)
  {
    permeability.assign(grid.n_cells(), {});
    properties.assign(grid.n_cells(), {});
    is_clay.assign(grid.n_cells(), false);
    std::vector<bool> undrained;
    for (unsigned int i = 0; i < soil.n_materials(); ++i)
      undrained.push_back(soil.material(i).has_undrained_strength());
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      {
        if (!grid.is_owned(cell) || grid.is_rigid(cell))
          continue;
        double volume = 0., mass = 0., along = 0., across = 0., clay = 0.;
        points.for_each_in(cell, [&](const MaterialPoint &p) {
          const SoilMaterial &material = soil.material(p.material);
          const double        k        = faster * material.permeability_at(
                                      p.void_ratio(material.void_ratio()));
          volume += p.volume;
          mass += p.mass;
          along += p.volume * k * material.anisotropy;
          across += p.volume / k;
          clay += undrained[p.material] ? p.volume : 0.;
        });
        is_clay[cell] = clay > .5 * volume;
        if (volume > 0.)
          permeability[cell] = {along / volume, volume / across};
        else // a gap
          {
            const auto        &g = grid.geometry(cell);
            const unsigned int i =
              soil.material_at(std::min(0., g.bottom_left));
            is_clay[cell]      = undrained[i];
            const double k     = faster * soil.material(i).permeability;
            permeability[cell] = {k * soil.material(i).anisotropy, k};
            volume             = 1.;
            mass               = soil.inertial_density(i);
          }
        const double gamma = soil.unit_weight_of_water();
        properties[cell]   = {{permeability[cell].horizontal / gamma,
                               permeability[cell].vertical / gamma},
                              volume / mass};
      }
  }

  std::vector<Conductance>
  PermeabilityField::of_flow() const
  {
    std::vector<Conductance> result = permeability;
    for (std::size_t cell = 0; cell < result.size(); ++cell)
      if (is_clay[cell])
        result[cell] = {};
    return result;
  }

  FlowingWater::FlowingWater(const WaterScene &scene)
    : PoreWater(scene)
  {
    if (scene.has_caisson())
      lid = std::make_unique<LidCompartment>(scene);
    traits_.has_excess_pressure = true;
    traits_.uses_permeability   = true;
    traits_.resists_body        = true;
    traits_.lid                 = lid.get();
    before_change = scene.grid.signals.before_change.connect([this]() {
      if (has_started)
        kept = gather(this->scene.grid, fields());
    });
    after_change  = scene.grid.signals.after_change.connect([this]() {
      reinit();
      scatter(this->scene.grid, kept, fields());
      kept.clear();
    });
    scene.totals.carry("water_has_started", has_started);
    scene.totals.keep("water_time", time);
  }

  void
  FlowingWater::check_parameters() const
  {
    if (lid)
      scene.settings.suction.check_parameters();
    if (!scene.soil.is_submerged() || scene.soil.unit_weight_of_water() <= 0.)
      throw BadInput("There is pore water or suction, but the soil is dry: set "
                     "Soil/Submerged = true, Soil/Fluid density and a Soil/"
                     "Gravity that points downward, or Level = drained with "
                     "Suction control = automatic.");
    if (lid)
      lid->check_parameters();
  }

  void
  FlowingWater::reinit()
  {
    if (lid)
      lid->initialize();
    soil_columns.initialize(scene.grid, scene.body.shape());
    tip.reinit(scene.grid, scene.body.shape(), soil_columns);
    is_solved        = false;
    steps_since_look = 0;
  }

  void
  FlowingWater::find_mudline()
  {
    soil_columns.find(scene.grid, scene.points);
    if (lid)
      lid->update_touching(soil_columns);
  }

  void
  FlowingWater::find_plug_rate(const Kernels::NodalVector *velocity)
  {
    if (!lid || !lid->is_sealed() || !soil_columns.is_found())
      return;
    double sum = 0.;
    for (unsigned int cell = 0; cell < scene.grid.n_cells(); ++cell)
      {
        const double filled = soil_columns.filled()[cell];
        if (!scene.grid.is_owned(cell) || filled <= 0. ||
            !soil_columns.is_top(cell) ||
            soil_columns.side_of(cell) != SoilColumns::Side::plug)
          continue;
        // the vertical velocity at the surface of the soil, linear in r
        const auto           &g    = scene.grid.geometry(cell);
        const unsigned int   *node = scene.grid.cell_nodes(cell).node;
        std::array<double, 2> v;
        for (unsigned int i = 0; i < 2; ++i)
          v[i] = (1. - filled) * velocity[node[i]].value[vertical] +
                 filled * velocity[node[2 + i]].value[vertical];
        sum += g.width * ((g.left / 2. + g.width / 6.) * v[0] +
                          (g.left / 2. + g.width / 3.) * v[1]);
      }
    plug_rate = scene.grid.circumference() *
                dealii::Utilities::MPI::sum(sum, scene.grid.communicator());
  }

  void
  FlowingWater::finish_flow()
  {
    if (lid)
      lid->plug().start(soil_columns);
    has_started = true;
  }

  double
  FlowingWater::end_step(const double time,
                         const double dt,
                         const double force_on_body,
                         const double)
  {
    this->time = time + dt;
    if (lid)
      lid->end_step(this->time, dt, force_on_body, soil_columns, flow());
    return 0.;
  }

  std::string
  FlowingWater::reason_to_end() const
  {
    return lid ? lid->reason_to_end(is_solved ? &soil_columns : nullptr) : "";
  }

  const std::vector<double> &
  FlowingWater::nodal_pressure()
  {
    pressure.resize(scene.grid.n_nodes());
    const auto [field, factor] = field_at_nodes();
    for (unsigned int node = 0; node < scene.grid.n_nodes(); ++node)
      pressure[node] = factor * field->local_element(node);
    return pressure;
  }

  void
  FlowingWater::write_pressure_to_points()
  {
    if (!is_solved)
      return;
    nodal_pressure();
    scene.points.set_pore_pressure(
      [this](const unsigned int cell, const dealii::Point<2> &place) {
        return pressure_at(cell, place);
      });
  }

  double
  FlowingWater::pressure_at(const unsigned int      cell,
                            const dealii::Point<2> &place) const
  {
    const Kernels::CellMap<> map(scene.grid.geometry(cell));
    double                   at_corner[4], field[4];
    for (unsigned int k = 0; k < 4; ++k)
      at_corner[k] = pressure[scene.grid.cell_nodes(cell).node[k]];
    Kernels::coefficients(at_corner, field);
    return Kernels::evaluate(field,
                             map.at_position(place[radial], place[vertical]));
  }

  NamedNumbers
  FlowingWater::columns()
  {
    prepare_columns();
    if (is_solved && lid && flow().flows)
      lid->plug().find_exit_gradient(soil_columns,
                                     soil_in_cells.of_flow(),
                                     outflow());
    SoilColumns now = soil_columns;
    now.find(scene.grid, scene.points);
    if (lid)
      lid->update_limits(now, flow());
    return columns_with(now);
  }

  NamedNumbers
  FlowingWater::columns_with(const SoilColumns &soil_columns) const
  {
    const WaterFlow now = flow();
    if (lid)
      return lid->columns(soil_columns, now);
    return {{"tip_water_force_N", now.tip_force},
            {"net_outflow_m3_s", -now.scale * now.in},
            {"flow_iterations", 1. * now.n_iterations}};
  }

  std::vector<std::string>
  FlowingWater::take_warnings()
  {
    std::vector<std::string> warnings;
    if (lid)
      lid->warn(place_in_words(), soil_columns, flow(), warnings);
    return warnings;
  }

  WaterReport
  FlowingWater::report(const std::vector<Kernels::Material> &) const
  {
    WaterReport result;
    if (lid)
      result.lines.emplace_back("suction", lid->description());
    return result;
  }

  void
  FlowingWater::continue_after(const std::string &, const NamedFields &)
  {
    soil_columns.find(scene.grid, scene.points);
    if (lid)
      lid->continue_after(soil_columns);
  }
} // namespace CaissonMPM
