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

  NodalData &
  GroundWater::field()
  {
    return is_coupled() ? projection.pressure() : seepage.field();
  }

  const NodalData &
  GroundWater::field() const
  {
    return is_coupled() ? projection.pressure() : seepage.field();
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
        for (unsigned int k = 0; k < 4; ++k)
          action(grid.cell_nodes(cell).node[k],
                 std::size_t(block.row + k / 2 * block.size) *
                     (grid.lines().n_columns() + 1) +
                   block.column + k % 2 * block.size);
      }
  }

  std::vector<double>
  GroundWater::gather_field() const
  {
    constexpr double    none = std::numeric_limits<double>::lowest();
    std::vector<double> values(n_places(), none);
    for_each_place([&](const unsigned int node, const std::size_t place) {
      if (node < grid.n_owned_nodes())
        values[place] = field().local_element(node);
    });
    Utilities::MPI::max(values, grid.communicator(), values);
    for (double &value : values)
      if (value == none)
        value = std::numeric_limits<double>::quiet_NaN();
    return values;
  }

  void
  GroundWater::scatter_field(const std::vector<double> &values)
  {
    field().zero_out_ghost_values();
    for_each_place([&](const unsigned int node, const std::size_t place) {
      if (node < grid.n_owned_nodes())
        field().local_element(node) = values[place];
    });
    field().update_ghost_values();
  }

  void
  GroundWater::keep_field()
  {
    if (acts() && has_started)
      kept_field = gather_field();
  }

  namespace
  {
    const std::string name_of_place = "water_at_";
  }

  NamedNumbers
  GroundWater::field_state() const
  {
    NamedNumbers state;
    if (!acts())
      return state;
    const std::vector<double> values = gather_field();
    for (std::size_t place = 0; place < values.size(); ++place)
      if (!std::isnan(values[place]))
        state.emplace_back(name_of_place + to_text(place), values[place]);
    return state;
  }

  void
  GroundWater::resume_field(const NamedNumbers &state)
  {
    if (!acts())
      return;
    std::vector<double> values(n_places(), 0.);
    for (const auto &[name, value] : state)
      if (name.compare(0, name_of_place.size(), name_of_place) == 0)
        values[std::stoul(name.substr(name_of_place.size()))] = value;
    scatter_field(values);
  }

  void
  GroundWater::write_pressure_to(MaterialPoints &of_points)
  {
    if (!acts() || !is_solved)
      return;
    const std::vector<double> &p = pressure();
    of_points.set_pore_pressure([&](const unsigned int cell,
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
