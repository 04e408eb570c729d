// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/domain/cell_geometry.h>
#include <caisson_mpm/kernels/cell_map.h>
#include <caisson_mpm/water/soil_columns.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    constexpr double nowhere = -std::numeric_limits<double>::max();

    // A cell with less soil than this holds points that were thrown off.
    constexpr double least_share_of_soil = .05;

    constexpr double round_off = 1e-9; // of the height of the domain

    double
    bottom_of(const Kernels::CellGeometry &g)
    {
      return .5 * (g.bottom_left + g.bottom_right);
    }
  } // namespace

  void
  SoilColumns::initialize(const BackgroundGrid &grid, const BodyShape &body)
  {
    const GridLines &lines = grid.lines();
    axisymmetric           = grid.axisymmetric();
    left.resize(lines.n_columns());
    width.resize(lines.n_columns());
    sides.resize(lines.n_columns());
    tolerance = round_off * (lines.node_start(0, lines.n_rows())[1] -
                             lines.node_start(0, 0)[1]);
    for (unsigned int c = 0; c < lines.n_columns(); ++c)
      {
        left[c]             = lines.node_start(c, 0)[0];
        width[c]            = lines.node_start(c + 1, 0)[0] - left[c];
        const double middle = left[c] + .5 * width[c];
        sides[c] = !body.exists() || middle > body.right() ? Side::beyond :
                   middle > body.left()                    ? Side::body :
                                                             Side::plug;
      }
    at_inner_wall =
      std::find(sides.begin(), sides.end(), Side::body) - sides.begin() - 1;
    std::vector<unsigned int> lowest_of_body(lines.n_columns(), lines.n_rows());
    for (unsigned int i = 0; i < grid.n_global_cells(); ++i)
      {
        const auto       cell  = static_cast<GlobalCell>(i);
        const CellBlock &block = lines.tree().block(cell);
        if (lines.is_body_cell(cell))
          for (unsigned int c = 0; c < block.size; ++c)
            {
              unsigned int &row = lowest_of_body[block.column + c];
              row               = std::min(row, block.row);
              if (sides[block.column] == Side::plug && !lines.is_lid_cell(cell))
                at_inner_wall = std::min(at_inner_wall, block.column - 1);
            }
      }
    // the column of an edge that is inset has soil only
    for (unsigned int c = 0; c < lines.n_columns(); ++c)
      if (sides[c] == Side::body && lowest_of_body[c] == lines.n_rows())
        sides[c] = left[c] > .5 * (body.left() + body.right()) ? Side::beyond :
                                                                 Side::plug;
    first_column.resize(grid.n_cells());
    n_columns.resize(grid.n_cells());
    is_below_body.resize(grid.n_cells());
    sides_of_cells.resize(grid.n_cells());
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      {
        const CellBlock &block = lines.tree().block(grid.global_number(cell));
        first_column[cell]     = block.column;
        n_columns[cell]        = block.size;
        is_below_body[cell]    = sides[block.column] == Side::body &&
                              block.row < lowest_of_body[block.column];
        sides_of_cells[cell] = sides[block.column];
        if (sides[block.column] == Side::body && !is_below_body[cell])
          sides_of_cells[cell] =
            side_above_step(lines, body, grid.global_number(cell));
      }
  }

  SoilColumns::Side
  SoilColumns::side_above_step(const GridLines &lines,
                               const BodyShape &body,
                               const GlobalCell cell)
  {
    const auto g = lines.initial_geometry(cell);
    if (lines.is_body_cell(cell) || body.n_parts() == 1 ||
        bottom_of(g) > body.top() - round_off)
      return Side::body;
    const CellBlock &block = lines.tree().block(cell);
    for (unsigned int c = block.column; c < lines.n_columns(); ++c)
      if (lines.is_body_cell(lines.tree().cell_at(c, block.row)))
        return Side::plug;
    return Side::beyond;
  }

  std::vector<SoilColumns::Top>
  SoilColumns::find_tops(const BackgroundGrid &grid,
                         const MaterialPoints &points) const
  {
    // the highest cell of each column that this rank has, and the one below:
    // points at the top may be in either
    std::vector<int> highest(heights.size(), -1);
    for (const unsigned int cell : points.cells_with_points())
      {
        const auto &g = grid.geometry(cell);
        if (points.filled_volume_in(cell) <
            least_share_of_soil *
              Kernels::CellMap<>(g).volume(axisymmetric ? 1. : 0.))
          continue;
        for (unsigned int i = 0; i < n_columns[cell]; ++i)
          {
            int &other = highest[first_column[cell] + i];
            if (other < 0 || bottom_of(g) > bottom_of(grid.geometry(other)))
              other = cell;
          }
      }
    std::vector<unsigned int> cells;
    for (const int cell : highest)
      if (cell >= 0)
        {
          cells.push_back(cell);
          const int below = grid.neighbor(cell, 2);
          if (below >= 0 && grid.is_owned(below) && !grid.is_rigid(below))
            cells.push_back(below);
        }
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());

    std::vector<Top> tops;
    for (const unsigned int cell : cells)
      points.for_each_in(cell, [&](const MaterialPoint &p) {
        tops.push_back({first_column[cell],
                        n_columns[cell],
                        p.position[vertical] + .5 * p.size[vertical],
                        p.size[vertical],
                        p.volume});
      });
    return tops;
  }

  void
  SoilColumns::find(const BackgroundGrid &grid, const MaterialPoints &points)
  {
    heights.assign(sides.size(), nowhere);
    const auto tops            = find_tops(grid, points);
    const auto for_each_column = [](const Top &top, const auto &action) {
      for (unsigned int i = 0; i < top.n_columns; ++i)
        action(top.column + i);
    };
    for (const Top &top : tops)
      for_each_column(top, [&](const unsigned int c) {
        heights[c] = std::max(heights[c], top.height);
      });
    std::vector<double> highest(heights.size());
    Utilities::MPI::max(heights, grid.communicator(), highest);

    // the mean of those within half a point of the highest one
    std::vector<double> sums(2 * heights.size(), 0.);
    for (const Top &top : tops)
      for_each_column(top, [&](const unsigned int c) {
        if (top.height > highest[c] - .5 * top.size)
          {
            sums[2 * c] += top.volume * top.height;
            sums[2 * c + 1] += top.volume;
          }
      });
    Utilities::MPI::sum(sums, grid.communicator(), sums);
    for (unsigned int c = 0; c < heights.size(); ++c)
      if (sums[2 * c + 1] > 0.)
        heights[c] = sums[2 * c] / sums[2 * c + 1];
    fill_cells(grid);
  }

  void
  SoilColumns::fill_cells(const BackgroundGrid &grid)
  {
    filled_.assign(grid.n_cells(), 0.);
    top.assign(grid.n_cells(), 0);
    cell_height.assign(heights.size(), std::numeric_limits<double>::max());
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      {
        if (grid.is_rigid(cell))
          continue;
        const auto &g = grid.geometry(cell);
        if (side_of(cell) == Side::body)
          {
            filled_[cell] = is_below_body[cell] ? 1. : 0.;
            continue;
          }
        double mean = 0.;
        for (unsigned int i = 0; i < n_columns[cell]; ++i)
          mean += heights[first_column[cell] + i] / n_columns[cell];
        const double above_bottom = mean - bottom_of(g);
        if (above_bottom > tolerance)
          filled_[cell] =
            std::clamp(above_bottom / height_of(g), least_filled, 1.);
        top[cell] =
          above_bottom > tolerance && above_bottom <= height_of(g) + tolerance;
      }
    find_tops_of_water(grid);
  }

  void
  SoilColumns::find_tops_of_water(const BackgroundGrid &grid)
  {
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      {
        if (filled_[cell] == 0. || side_of(cell) == Side::body)
          continue;
        // The mean over a larger cell may be dry above a smaller one that is
        // full: not heights decide, but what is above.
        bool is_known = true, is_wet = false;
        for (const bool second : {false, true})
          {
            const int above = grid.neighbor(cell, 3, second);
            if (above < 0)
              is_known = grid.at_side(cell, 3);
            else
              // soil that touches a ring has no open water above
              is_wet = is_wet || filled_[above] > 0. ||
                       (grid.is_rigid(above) && !grid.is_lid(above) &&
                        filled_[cell] >= touching);
          }
        if (is_known) // where another rank knows better, the height is left
          top[cell] = !is_wet;
        if (top[cell])
          for (unsigned int i = 0; i < n_columns[cell]; ++i)
            cell_height[first_column[cell] + i] =
              height_of(grid.geometry(cell));
      }
  }

  std::vector<Beyond>
  SoilColumns::find_beyond(const BackgroundGrid &grid,
                           const OpenSides      &open) const
  {
    std::vector<Beyond> result(grid.n_nodes(), Beyond::cell);
    const auto set = [&](const unsigned int node, const Beyond beyond) {
      if (result[node] == Beyond::cell || beyond == Beyond::plug)
        result[node] = beyond;
    };
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      {
        if (filled_[cell] == 0.)
          continue;
        const auto &node    = grid.cell_nodes(cell).node;
        const bool  in_plug = side_of(cell) == Side::plug;
        if (is_top(cell) && (in_plug || open.surface))
          for (unsigned int k = 2; k < 4; ++k)
            set(node[k], in_plug ? Beyond::plug : Beyond::outside);
        for (const unsigned int n : node)
          if (open.outer && grid.is_at(n, GridLines::Side::outer))
            set(n, Beyond::outside);
          else if (open.bottom && grid.is_at(n, GridLines::Side::bottom))
            set(n, Beyond::bottom);
      }
    return result;
  }

  double
  SoilColumns::touched_share_of_lid(const BackgroundGrid &grid) const
  {
    std::vector<double> areas = {0., 0.}; // touched, all
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      {
        const int above = grid.neighbor(cell, 3);
        if (!grid.is_owned(cell) || grid.is_rigid(cell) || above < 0 ||
            !grid.is_rigid(above) || !grid.is_lid(above))
          continue;
        const auto of_nodes = areas_of_side(grid.geometry(cell), axisymmetric);
        const double area   = of_nodes[0] + of_nodes[1];
        areas[1] += area;
        if (filled_[cell] >= touching)
          areas[0] += area;
      }
    Utilities::MPI::sum(areas, grid.communicator(), areas);
    return areas[1] > 0. ? areas[0] / areas[1] : 0.;
  }

  double
  SoilColumns::mean_height(const Side side) const
  {
    double sum = 0., area = 0.;
    for (unsigned int c = 0; c < sides.size(); ++c)
      if (sides[c] == side)
        {
          const double own =
            width[c] * (axisymmetric ? left[c] + .5 * width[c] : 1.);
          sum += own * heights[c];
          area += own;
        }
    return sum / area;
  }

  double
  SoilColumns::height_at_wall(const Side side) const
  {
    return side == Side::plug ?
             heights[at_inner_wall] :
             heights[std::find(sides.begin(), sides.end(), Side::beyond) -
                     sides.begin()];
  }

  double
  SoilColumns::largest_change(const SoilColumns &other) const
  {
    double change = 0.;
    for (unsigned int c = 0; c < heights.size(); ++c)
      if (sides[c] != Side::body)
        change =
          std::max(change,
                   std::abs(heights[c] - other.heights[c]) / cell_height[c]);
    return change;
  }
} // namespace CaissonMPM
