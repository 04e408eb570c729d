// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/domain/grid_lines.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cstdint>

namespace CaissonMPM
{
  using namespace dealii;

  GridLines::GridLines()
    : Section("/Grid")
  {
    declare_domain();
    declare_cells();
    declare_refinement();
    declare_motion();
    add_parameter(
      "Distortion",
      distortion,
      "",
      "Columns and the heights of nodes are displaced irregularly by up to "
      "this share of the cell size, except at the sides of the domain, the "
      "soil surface and the boundaries of layers; this tests the method in "
      "scenes without a body.",
      Patterns::Double(0., 0.4));
    add_parameter(
      "Largest number of cells",
      largest_number,
      "",
      "A mesh with more cells is refused before it is created; a cell takes "
      "about 2 kB of memory.",
      Patterns::Integer(1))
      .influence = Influence::motion;
    add_parameter(
      "Refinement",
      refinement,
      "",
      "All cell sizes are divided by this number, at every place, for studies "
      "of convergence; distances in the mesh stay. Numbers below 1 make the "
      "mesh coarser.",
      Patterns::Double(1. / 64., 256.));
  }

  namespace
  {
    const Patterns::Double positive(1e-9), not_negative(0.);
  }

  void
  GridLines::declare_domain()
  {
    add_choice<Geometry>(*this,
                         "Geometry",
                         geometry,
                         {{"axisymmetric", Geometry::axisymmetric},
                          {"plane strain", Geometry::plane_strain}},
                         "",
                         "The scene is axisymmetric about r = 0, or in plane "
                         "strain.");
    add_parameter("Inner radius",
                  inner_radius,
                  "m",
                  "The domain begins at this r.",
                  not_negative);
    add_parameter("Outer radius",
                  outer_radius,
                  "m",
                  "The domain ends at this r.",
                  positive);
    add_parameter(
      "Bottom",
      bottom,
      "m",
      "The domain begins at this z, below the soil surface at z = 0.");
    add_parameter(
      "Top",
      top,
      "m",
      "The domain ends at this z at the start, on or above the soil surface at "
      "z = 0.");
  }

  void
  GridLines::declare_cells()
  {
    add_parameter(
      "Cell width",
      cell_width,
      "m",
      "Cells far from the body, and all cells of a scene without a body, have "
      "this width.",
      positive);
    add_parameter(
      "Cell height",
      cell_height,
      "m",
      "Cells far above and below the tip of the body, and all cells of a scene "
      "without a body, have this height.",
      positive);
    add_word_or_number(
      *this,
      "Growth ratio",
      growth,
      "auto",
      {},
      "",
      "Away from the fine cells the sizes of neighboring cells have this "
      "ratio; auto is 1.15, and 1.45 beyond ten thicknesses of a wall.",
      Patterns::Double(1.001, 2.));
    add_parameter(
      "Fine width",
      fine_width,
      "m",
      "Cells up to this distance from the wall, on both sides, are as wide as "
      "those of the wall (or of the cone, the pile, the cylinder).",
      not_negative);
    add_parameter(
      "Fine height",
      fine_height,
      "m",
      "Cells up to this distance above and below the tip are as high as those "
      "of the wall are wide.",
      not_negative);
    add_word_or_number(
      *this,
      "Fine cell size",
      fine_size,
      "auto",
      0.,
      "m",
      "The finest cells have this width and height; those of a body are "
      "narrower if its width is not a multiple of it; auto takes what Rigid "
      "body/Cells across the wall gives for a caisson, cone, pile or cylinder, "
      "and Cell width and Cell height for a box.",
      positive);
  }

  void
  GridLines::declare_motion()
  {
    add_parameter(
      "Moving zone below tip",
      zone_below_tip,
      "m",
      "The zone that moves with the body reaches this far below its tip.",
      not_negative);
    add_parameter(
      "Smallest row height",
      smallest_row,
      "m",
      "Rows of the compressing zone must stay at least this high, and columns "
      "around a cylinder this wide.",
      positive)
      .influence = Influence::motion;
  }

  void
  GridLines::check_parameters() const
  {
    if (inner_radius >= outer_radius)
      throw BadInput("Grid/Inner radius = " + meters(inner_radius) +
                     " must be smaller than Grid/Outer radius = " +
                     meters(outer_radius) + ".");
    if (bottom >= 0. || top < 0.)
      throw BadInput("Grid/Bottom = " + meters(bottom) +
                     " and Grid/Top = " + meters(top) +
                     " must lie below and above the soil surface, z = 0.");
    if (levels_at_wall > levels)
      throw BadInput(
        "Grid/Refinement levels along wall = " + to_text(levels_at_wall) +
        " must not exceed Grid/Refinement levels = " + to_text(levels) + ".");
    parse_region();
  }

  double
  GridLines::height_at(const double z0, const double travel) const
  {
    if (expanding_radius > 0.)
      return z0;
    const double rate =
      z0 < zone_bottom ? -(z0 - bottom) / (zone_bottom - bottom) : -1.;
    return z0 + rate * travel;
  }

  double
  GridLines::reference_height(const unsigned int i, const unsigned int j) const
  {
    if (!node_shift.empty())
      return rows[j] + node_shift[j][i];
    if (dip.empty() || dip[i] == 0.)
      return rows[j];
    const double distance = rows[j] > shoulder ?
                              (rows[j] - shoulder) / decay_above :
                              (shoulder - rows[j]) / decay_below;
    return rows[j] - dip[i] * std::max(0., 1. - distance);
  }

  double
  GridLines::radial_rate(const double r0) const
  {
    if (expanding_radius == 0.)
      return 0.;
    return r0 < expanding_radius ?
             r0 / expanding_radius :
             (outer_radius - r0) / (outer_radius - expanding_radius);
  }

  bool
  GridLines::inside_body(const unsigned int column,
                         const unsigned int row) const
  {
    for (const Range &range : body_ranges)
      if (range.contains(column, row))
        return true;
    return lid.contains(column, row);
  }

  std::vector<double>
  GridLines::row_lines() const
  {
    std::vector<double> result;
    for (std::size_t i = 0; i < rows.size(); i += std::size_t(1) << levels)
      result.push_back(rows[i]);
    return result;
  }

  Point<2>
  GridLines::free_node_start(const LatticeNode &node) const
  {
    return Point<2>(columns[node.column],
                    reference_height(node.column, node.row));
  }

  Tensor<1, 2>
  GridLines::free_node_rate(const LatticeNode &node) const
  {
    return Tensor<1, 2>({radial_rate(columns[node.column]),
                         height_at(rows[node.row], 1.) - rows[node.row]});
  }

  Point<2>
  GridLines::node_start(const unsigned int i, const unsigned int j) const
  {
    const auto masters = tree_.masters_of({i, j});
    if (!masters)
      return free_node_start({i, j});
    return free_node_start(masters->front()) +
           .5 * (free_node_start(masters->back()) -
                 free_node_start(masters->front()));
  }

  Tensor<1, 2>
  GridLines::node_rate(const unsigned int i, const unsigned int j) const
  {
    const auto masters = tree_.masters_of({i, j});
    if (!masters)
      return free_node_rate({i, j});
    return .5 *
           (free_node_rate(masters->front()) + free_node_rate(masters->back()));
  }

  unsigned int
  GridLines::sides_of(const unsigned int i, const unsigned int j) const
  {
    const bool   lies_on[4] = {i == 0, i == n_columns(), j == 0, j == n_rows()};
    unsigned int result     = 0;
    for (unsigned int side = 0; side < 4; ++side)
      result |= lies_on[side] << side;
    return result;
  }

  Kernels::CellGeometry
  GridLines::initial_geometry(const GlobalCell cell) const
  {
    const CellBlock &b          = tree_.block(cell);
    const auto       lower_left = node_start(b.column, b.row),
               lower_right      = node_start(b.column + b.size, b.row),
               upper_left       = node_start(b.column, b.row + b.size),
               upper_right      = node_start(b.column + b.size, b.row + b.size);
    return {lower_left[radial],
            lower_right[radial] - lower_left[radial],
            lower_left[vertical],
            lower_right[vertical],
            upper_left[vertical] - lower_left[vertical],
            upper_right[vertical] - lower_right[vertical]};
  }

  GridLines::Zone
  GridLines::zone_of(const GlobalCell cell) const
  {
    return rows[row_of(cell)] < zone_bottom - 1e-9 ? Zone::compressing :
                                                     Zone::moving;
  }

  std::string
  GridLines::description() const
  {
    const std::string lines = to_text(n_columns() / tree_.root_size()) + " x " +
                              to_text(n_rows() / tree_.root_size()) + " cells",
                      kind = axisymmetric() ? "axisymmetric" : "plane strain";
    if (levels == 0)
      return lines + ", " + kind;
    return to_text(n_cells()) + " cells, from " + lines + " halved up to " +
           to_text(levels) + (levels == 1 ? " time, " : " times, ") + kind;
  }
} // namespace CaissonMPM
