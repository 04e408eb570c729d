// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/domain/grid_fields.h>

#include <deal.II/base/mpi.h>

#include <limits>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    std::size_t
    n_places(const GridLines &lines)
    {
      return std::size_t(lines.n_columns() + 1) * (lines.n_rows() + 1);
    }

    /** Call action(index in the values, place) for what this rank owns. */
    template <typename Action>
    void
    for_each_owned(const BackgroundGrid &grid,
                   const GridField      &field,
                   const Action         &action)
    {
      const auto visit = [&](const unsigned int index,
                             const std::size_t  place) {
        if (index < field.values->locally_owned_size())
          action(index, place);
      };
      for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
        if (field.place_of_cell)
          visit(field.place_of_cell(cell), place_of_corner(grid, cell, 0));
        else
          for (unsigned int k = 0; k < 4; ++k)
            visit(grid.cell_nodes(cell).node[k],
                  place_of_corner(grid, cell, k));
    }
  } // namespace

  std::size_t
  place_of_corner(const BackgroundGrid &grid,
                  const unsigned int    cell,
                  const unsigned int    k)
  {
    const CellBlock &block =
      grid.lines().tree().block(grid.global_number(cell));
    return std::size_t(block.row + k / 2 * block.size) *
             (grid.lines().n_columns() + 1) +
           block.column + k % 2 * block.size;
  }

  NamedFields
  gather(const BackgroundGrid &grid, const std::vector<GridField> &fields)
  {
    constexpr double none = std::numeric_limits<double>::lowest();
    NamedFields      result;
    for (const GridField &field : fields)
      {
        std::vector<double> values(n_places(grid.lines()), none);
        for_each_owned(grid, field, [&](const auto index, const auto place) {
          values[place] = field.values->local_element(index);
        });
        Utilities::MPI::max(values, grid.communicator(), values);
        for (double &value : values)
          if (value == none)
            value = std::numeric_limits<double>::quiet_NaN();
        result.emplace_back(field.name, std::move(values));
      }
    return result;
  }

  void
  scatter(const BackgroundGrid         &grid,
          const NamedFields            &values,
          const std::vector<GridField> &fields)
  {
    for (const GridField &field : fields)
      if (const auto *const stored = field_named(field.name, values))
        {
          field.values->zero_out_ghost_values();
          for_each_owned(grid, field, [&](const auto index, const auto place) {
            field.values->local_element(index) = (*stored)[place];
          });
          field.values->update_ghost_values();
        }
  }

  const std::vector<double> *
  field_named(const std::string &name, const NamedFields &fields)
  {
    for (const auto &[other, values] : fields)
      if (other == name)
        return &values;
    return nullptr;
  }
} // namespace CaissonMPM
