// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The field of the pore water at the nodes: over a change of parts, in a
// checkpoint, and at the points.
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/kernels/cell_map.h>
#include <caisson_mpm/water/ground_water.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <limits>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    const std::string of_nodes = "water_at_";
  }

  std::size_t
  GroundWater::n_places() const
  {
    return std::size_t(grid.lines().n_columns() + 1) *
           (grid.lines().n_rows() + 1);
  }

  template <typename Action>
  void
  GroundWater::for_each_place(const Action &action) const
  {
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      {
        const CellBlock &block =
          grid.lines().tree().block(grid.global_number(cell));
        if (is_coupled())
          {
            action(projection.solver().place(cell),
                   std::size_t(block.row) * (grid.lines().n_columns() + 1) +
                     block.column);
            continue;
          }
        for (unsigned int k = 0; k < 4; ++k)
          action(grid.cell_nodes(cell).node[k],
                 std::size_t(block.row + k / 2 * block.size) *
                     (grid.lines().n_columns() + 1) +
                   block.column + k % 2 * block.size);
      }
  }

  std::vector<GroundWater::KeptField>
  GroundWater::kept_fields()
  {
    if (is_coupled())
      return {{"water_in_", &projection.pressure()},
              {"water_left_in_", &projection.remainder()},
              {"water_wet_in_", &projection.wet_cells()}};
    return {{of_nodes, &seepage.field()}};
  }

  std::vector<double>
  GroundWater::gather(const NodalData &field) const
  {
    constexpr double    none = std::numeric_limits<double>::lowest();
    std::vector<double> values(n_places(), none);
    for_each_place([&](const unsigned int node, const std::size_t place) {
      if (node < field.locally_owned_size())
        values[place] = field.local_element(node);
    });
    Utilities::MPI::max(values, grid.communicator(), values);
    for (double &value : values)
      if (value == none)
        value = std::numeric_limits<double>::quiet_NaN();
    return values;
  }

  void
  GroundWater::scatter(const std::vector<double> &values,
                       NodalData                 &field) const
  {
    field.zero_out_ghost_values();
    for_each_place([&](const unsigned int node, const std::size_t place) {
      if (node < field.locally_owned_size())
        field.local_element(node) = values[place];
    });
    field.update_ghost_values();
  }

  void
  GroundWater::keep_field()
  {
    if (flows() && has_started)
      for (const KeptField &kept : kept_fields())
        kept_values.push_back(gather(*kept.field));
  }

  NamedNumbers
  GroundWater::field_state()
  {
    NamedNumbers state;
    if (!flows())
      return state;
    for (const KeptField &kept : kept_fields())
      {
        const std::vector<double> values = gather(*kept.field);
        for (std::size_t place = 0; place < values.size(); ++place)
          if (!std::isnan(values[place]))
            state.emplace_back(kept.name + to_text(place), values[place]);
      }
    return state;
  }

  std::vector<double>
  GroundWater::values_at_places(const NamedNumbers &state,
                                const std::string  &field) const
  {
    std::vector<double> values(n_places(), 0.);
    for (const auto &[name, value] : state)
      if (name.compare(0, field.size(), field) == 0)
        values[std::stoul(name.substr(field.size()))] = value;
    return values;
  }

  void
  GroundWater::resume_field(const NamedNumbers &state)
  {
    if (flows())
      for (const KeptField &kept : kept_fields())
        scatter(values_at_places(state, kept.name), *kept.field);
    if (is_coupled())
      projection.know_wet_cells();
  }

  void
  GroundWater::begin_with_seepage(const NamedNumbers &state)
  {
    const std::vector<double> at_nodes = values_at_places(state, of_nodes);
    const std::size_t         per_row  = grid.lines().n_columns() + 1;
    CellData                 &p        = projection.pressure();
    p.zero_out_ghost_values();
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      if (grid.is_owned(cell))
        {
          const CellBlock &block =
            grid.lines().tree().block(grid.global_number(cell));
          double mean = 0.;
          for (unsigned int k = 0; k < 4; ++k)
            mean += .25 * at_nodes[(block.row + k / 2 * block.size) * per_row +
                                   block.column + k % 2 * block.size];
          p.local_element(projection.solver().place(cell)) =
            -suction.value() * mean;
        }
    p.update_ghost_values();
    projection.begin_with({-suction.value(), 0.});
  }

  void
  GroundWater::go_on_after(const std::string &level, const NamedNumbers &state)
  {
    if (is_undrained())
      find_undrained_pressure();
    if (!flows())
      return suction.release();
    // Seepage has the pressure over the suction as its field.
    const bool was_coupled = level == "coupled";
    if (was_coupled == is_coupled())
      resume_field(state);
    else if (is_coupled() && level == "seepage")
      begin_with_seepage(state);
    mudline.find(grid, points);
    if (is_coupled())
      find_tip_integral();
    if (!has_lid())
      return;
    volume_at_start = lid_area() * (body.motion().travel() + heave(mudline)) +
                      suction.gas_expansion();
    suction.go_on_at(lid_area() *
                     (body.motion().travel() + recent_heave.value()));
  }

  void
  GroundWater::write_pressure_to_points()
  {
    if (undrained.is_found())
      points.set_pore_pressure(
        [this](const unsigned int cell, const Point<2> &) {
          return undrained.pressure()[cell];
        });
    if (!flows() || !is_solved)
      return;
    const std::vector<double> &p = pressure();
    points.set_pore_pressure([&](const unsigned int cell,
                                 const Point<2>    &place) {
      const Kernels::CellMap<> map(grid.geometry(cell));
      double                   at_corner[4], field[4];
      for (unsigned int k = 0; k < 4; ++k)
        at_corner[k] = p[grid.cell_nodes(cell).node[k]];
      Kernels::coefficients(at_corner, field);
      return Kernels::evaluate(field,
                               map.at_position(place[radial], place[vertical]));
    });
  }
} // namespace CaissonMPM
