// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Which cells of the coarse lines are halved, and whether that leads to the
// cells that the body asks for.
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/domain/grid_lines.h>

#include <deal.II/base/patterns.h>

#include <algorithm>

namespace CaissonMPM
{
  using namespace dealii;

  void
  GridLines::declare_refinement()
  {
    const Patterns::Integer times(0, 6);
    const Patterns::Double  positive(1e-9);
    add_parameter(
      "Refinement levels",
      levels,
      "",
      "Cells at the tip are halved in both directions this many times; the "
      "lines of the mesh at the body are coarser by as many, so that the "
      "smallest cells have the size that Fine cell size says. With 0 the mesh "
      "has lines only.",
      times);
    add_word_or_number(
      *this,
      "Refined distance",
      refined_distance,
      "auto",
      0.,
      "m",
      "Cells up to this distance from the tip are halved Refinement levels "
      "times, those up to twice this distance once less, and so on; auto takes "
      "three thicknesses of the wall, or three radii of a cone or pile. Within "
      "less, rows bend sharply, and the tip force is too large.",
      positive);
    add_parameter(
      "Refinement levels along wall",
      levels_at_wall,
      "",
      "Cells along the wall above the tip, up to its thickness away, are "
      "halved in both directions this many times, those up to twice this "
      "distance once less, and so on.",
      times);
    add_parameter(
      "Refined region",
      refined_region,
      "",
      "Cells are also halved Refinement levels times where this expression in "
      "r, z at the start and pi is positive at a corner, in the middle of a "
      "side or in the middle of the cell; an empty one adds none.");
  }

  Expression
  GridLines::parse_region() const
  {
    return refined_region.empty() ?
             Expression() :
             Expression(refined_region, "Grid/Refined region");
  }

  void
  GridLines::name_unused_entries(ParameterOrigins &origins) const
  {
    if (levels == 0)
      origins.add_unused({"Grid/Refined distance", "Grid/Refined region"},
                         "Grid/Refinement levels is 0");
  }

  // ------------------------------------------------------------ the body

  double
  GridLines::distance_of_tip(const BodyShape &body) const
  {
    constexpr double widths = 3.;
    return refined_distance.value_or(
      std::max(widths * (body.right() - body.left()), least_distance(body)));
  }

  bool
  GridLines::is_wedge(const BodyShape &body)
  {
    const double left = body.left(), right = body.right();
    return body.tip_height() > 0. &&
           (left > 0. ||
            body.lower_surface(.5 * (left + right)) <
              .5 * (body.lower_surface(left) + body.lower_surface(right)) -
                1e-9 * body.tip_height());
  }

  double
  GridLines::least_distance(const BodyShape &body) const
  {
    return is_wedge(body) ? std::ldexp(body.tip_height(), 2 - int(levels)) : 0.;
  }

  void
  GridLines::check_refinement(const BodyShape &body) const
  {
    if (levels == 0 || !body.exists())
      return;
    const unsigned int size = 1u << levels, n = body.cells_across_wall();
    if (!fine_size && n % size != 0)
      throw BadInput("Rigid body/Cells across the wall, times "
                     "Grid/Refinement, = " +
                     to_text(n) + " must be a multiple of " + to_text(size) +
                     ", because Grid/Refinement levels = " + to_text(levels) +
                     " halves cells that many times.");
    const double given = distance_of_tip(body), least = least_distance(body);
    if (given < (1. - 1e-5) * least) // which the message has in a few digits
      throw BadInput("Grid/Refined distance = " + meters(given) +
                     " must be at least " + meters(least) +
                     " for this tip: the rows that follow it must be level "
                     "again where cells are no longer halved.");
  }

  // ------------------------------------------------------------ the cells

  namespace
  {
    /** The distance between two intervals; 0 where they touch. */
    double
    distance(const double a0, const double a1, const double b0, const double b1)
    {
      return std::max({b0 - a1, a0 - b1, 0.});
    }

    /** The level of a cell at this distance, if @p n is that of those nearer
     * than @p reach, and one less that of those nearer than twice that. */
    unsigned int
    level_at(const double distance, double reach, const unsigned int n)
    {
      for (unsigned int level = n; level > 0; --level, reach *= 2.)
        if (distance < reach * (1. - 1e-9))
          return level;
      return 0;
    }
  } // namespace

  unsigned int
  GridLines::wanted_level(const CellBlock  &b,
                          const BodyShape  &body,
                          const Expression &region) const
  {
    if (is_in_region(b, region))
      return levels;
    if (!body.exists())
      return 0;
    const double low = rows[b.row], high = rows[b.row + b.size],
                 thickness = body.right() - body.left();
    const double aside     = distance(columns[b.column],
                                  columns[b.column + b.size],
                                  body.left(),
                                  body.right());
    if (body.expands())
      return level_at(aside, thickness, levels_at_wall);
    const double from_tip  = distance(low, high, body.bottom(), shoulder),
                 from_wall = distance(low, high, shoulder, zone_top);
    unsigned int level     = std::max(
      level_at(std::max(aside, from_tip), distance_of_tip(body), levels),
      level_at(std::max(aside, from_wall), thickness, levels_at_wall));
    for (unsigned int i = 1; i < body.n_parts(); ++i)
      {
        const BodyPart part = body.part(i);
        const double   from_part =
          std::max(distance(low, high, part.bottom, part.top),
                   distance(columns[b.column],
                            columns[b.column + b.size],
                            part.left,
                            part.right));
        // a ring like the tip, a piece of the wall like the wall
        level = std::max(level,
                         level_at(from_part,
                                  thickness,
                                  body.is_ring(i) ? levels : levels_at_wall));
      }
    return level;
  }

  bool
  GridLines::is_in_region(const CellBlock &b, const Expression &region) const
  {
    if (region.empty())
      return false;
    const double left = columns[b.column], right = columns[b.column + b.size],
                 low = rows[b.row], high = rows[b.row + b.size];
    for (const double r : {left, .5 * (left + right), right})
      for (const double z : {low, .5 * (low + high), high})
        if (region(Point<2>(r, z), 0.) > 0.)
          return true;
    return false;
  }

  void
  GridLines::make_cells(const BodyShape &body)
  {
    const unsigned int size = 1u << levels;
    tree_ = CellTree(n_columns() / size, n_rows() / size, levels);
    if (levels == 0)
      return;
    const Expression region = parse_region();
    tree_.refine(
      [&](const CellBlock &b) { return wanted_level(b, body, region); },
      [&](const CellBlock &b) { return inside_body(b.column, b.row); },
      largest_number);
    if (tree_.n_cells() > largest_number)
      throw BadInput("Halving the cells near the body " + to_text(levels) +
                     " times gives more than Grid/Largest number of cells = " +
                     to_text(largest_number) +
                     ". Reduce Grid/Refined distance or Grid/Refinement "
                     "levels.");
    check_heights(body);
  }

  void
  GridLines::check_heights(const BodyShape &body) const
  {
    for (unsigned int c = 0; c < n_cells(); ++c)
      {
        const CellBlock &b     = tree_.block(GlobalCell(c));
        const auto       g     = initial_geometry(GlobalCell(c));
        const double     level = rows[b.row + b.size] - rows[b.row],
                     smallest  = std::min(g.height_left, g.height_right);
        if (body.exists() && smallest < .2 * level)
          throw BadInput("The cell at r = " + meters(g.left) +
                         ", z = " + meters(g.bottom_left) + " is only " +
                         meters(smallest) +
                         " high on one side, where cells are no longer "
                         "halved. Increase Grid/Refined distance.");
      }
  }
} // namespace CaissonMPM
