// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the travel of the body does to the lines: whether they can hold it, and
// the cells that soil will meet.
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/domain/grid_lines.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  using namespace dealii;

  void
  GridLines::check_travel() const
  {
    if (expanding_radius > 0.)
      return check_expansion();
    const bool   moves = travel_to_hold > 0. || uplift_to_hold > 0.;
    const double floor = moves ? zone_bottom : bottom;
    const double tip_depth =
      dip.empty() ? 0. : *std::max_element(dip.begin(), dip.end());
    if (tip_depth > 0. && shoulder - decay_below < floor - 1e-9)
      {
        const double needed = decay_below - tip_depth;
        throw BadInput(
          (moves ? "Grid/Moving zone below tip = " + meters(zone_below_tip) :
                   "The mesh below the tip, " +
                     meters(shoulder - tip_depth - bottom) + " deep,") +
          " must be at least " + meters(needed) +
          " for this tip: the rows need that depth to straighten.");
      }
    if (travel_to_hold > 0.)
      check_travel_down();
    if (uplift_to_hold > 0. && zone_bottom <= bottom)
      throw BadInput("The body moves up by " + meters(uplift_to_hold) +
                     ", and no rows can stretch below Grid/Moving zone below "
                     "tip = " +
                     meters(zone_below_tip) +
                     ". Reduce that, or lower Grid/Bottom.");
  }

  double
  GridLines::height_of_row(const unsigned int row) const
  {
    return height_at(rows[row + tree_.root_size()], travel_to_hold) -
           height_at(rows[row], travel_to_hold);
  }

  std::string
  GridLines::neighbors_of_row(const unsigned int row) const
  {
    std::string text;
    for (const double z : {rows[row + tree_.root_size()], rows[row]})
      {
        const auto line =
          std::find_if(fixed_rows.begin(),
                       fixed_rows.end(),
                       [z](const FixedLine &fixed) {
                         return std::abs(fixed.place - z) < 1e-9;
                       });
        if (line == fixed_rows.end())
          return "";
        text += (text.empty() ? "" : " and ") + line->reason +
                " (z = " + meters(z) + ")";
      }
    return text;
  }

  void
  GridLines::check_expansion() const
  {
    if (uplift_to_hold > 0.)
      throw BadInput("Rigid body/Velocity: the cylinder would become smaller "
                     "than at the start, by " +
                     meters(uplift_to_hold) + ". It can only grow.");
    const double factor =
      1. - travel_to_hold / (outer_radius - expanding_radius);
    double             smallest = 1e300;
    const unsigned int size     = tree_.root_size();
    for (unsigned int i = body_column_end; i + 1 < columns.size(); i += size)
      smallest = std::min(smallest, factor * (columns[i + size] - columns[i]));
    if (smallest < smallest_row_height())
      throw BadInput(
        "The radius grows by " + meters(travel_to_hold) +
        ", which compresses a column to " + meters(smallest) +
        ", below Grid/Smallest row height = " + meters(smallest_row_height()) +
        ". Increase Grid/Outer radius, or reduce Grid/Smallest "
        "row height or the velocity.");
  }

  void
  GridLines::check_travel_down() const
  {
    const double available = zone_bottom - bottom;
    if (travel_to_hold >= available)
      throw BadInput("The compressing zone, " + meters(available) +
                     " high, cannot accommodate a travel of " +
                     meters(travel_to_hold) + ". Lower Grid/Bottom below " +
                     meters(zone_bottom - travel_to_hold) +
                     ", reduce Grid/Moving zone below tip, or push less far.");
    // the flattest row below the moving zone
    unsigned int flattest = 0;
    for (unsigned int j = 0; j < n_rows(); j += tree_.root_size())
      if (rows[j] < zone_bottom - 1e-9 &&
          height_of_row(j) < height_of_row(flattest))
        flattest = j;
    if (height_of_row(flattest) < smallest_row_height())
      refuse_flat_row(flattest);
    if (height_at(top, travel_to_hold) <= 0.)
      throw BadInput("After a travel of " + meters(travel_to_hold) +
                     " the top of the mesh lies at z = " +
                     meters(height_at(top, travel_to_hold)) +
                     ", below the soil surface. Raise Grid/Top to more than " +
                     meters(travel_to_hold) + " plus the expected heave.");
  }

  void
  GridLines::refuse_flat_row(const unsigned int row) const
  {
    const double smallest       = height_of_row(row),
                 available      = zone_bottom - bottom;
    const std::string neighbors = neighbors_of_row(row);
    if (!neighbors.empty())
      throw BadInput(
        "The row between " + neighbors + ", " +
        meters(rows[row + tree_.root_size()] - rows[row]) +
        " high, is compressed to " + meters(smallest) + " by the travel of " +
        meters(travel_to_hold) +
        ", below Grid/Smallest row height = " + meters(smallest_row_height()) +
        ". Move one of these lines, or reduce Grid/Smallest row "
        "height; the row also limits the time step.");
    const double factor = 1. - travel_to_hold / available;
    const double needed =
      travel_to_hold / (1. - smallest_row_height() * factor / smallest);
    throw BadInput("The travel of " + meters(travel_to_hold) +
                   " compresses the lowest row to " + meters(smallest) +
                   ", below Grid/Smallest row height = " +
                   meters(smallest_row_height()) + ". " +
                   (smallest_row_height() * factor < smallest ?
                      "Lower Grid/Bottom to about " +
                        meters(zone_bottom - needed) + ", or reduce" :
                      "Reduce") +
                   " Grid/Smallest row height.");
  }

  double
  GridLines::line_height(const unsigned int column,
                         const unsigned int row,
                         const double       travel) const
  {
    // the side of the column with the deeper dip has the lower cells
    const unsigned int side =
      !dip.empty() && dip[column] > dip[column + 1] ? column : column + 1;
    return reference_height(side, row) + height_at(rows[row], travel) -
           rows[row];
  }

  unsigned int
  GridLines::first_row_above(const unsigned int column,
                             const unsigned int first,
                             const double       z,
                             const double       travel) const
  {
    unsigned int begin = first, end = n_rows();
    while (begin < end)
      {
        const unsigned int middle = (begin + end) / 2;
        if (line_height(column, middle + 1, travel) > z)
          end = middle;
        else
          begin = middle + 1;
      }
    return begin;
  }

  std::array<double, 2>
  GridLines::smallest_size_met(const GlobalCell cell) const
  {
    const CellBlock &own      = tree_.block(cell);
    const auto       width_of = [&](const CellBlock &b) {
      return columns[b.column + b.size] - columns[b.column];
    };
    std::array<double, 2> smallest = {
      {width_of(own),
       line_height(own.column, own.row + own.size, 0.) -
         line_height(own.column, own.row, 0.)}};
    // the cells of a column that soil of this cell meets, from a row on
    const auto meet =
      [&](const unsigned int i, const unsigned int first, const double travel) {
        const double low  = line_height(i, own.row, 0.),
                     high = line_height(i, own.row + own.size, 0.);
        for (unsigned int k = first_row_above(i, first, low, travel);
             k < n_rows();)
          {
            const CellBlock   &b   = tree_.block(tree_.cell_at(i, k));
            const unsigned int end = b.row + b.size;
            const double       z0  = line_height(i, b.row, travel),
                         z1        = line_height(i, end, travel);
            if (z0 > high)
              break;
            if (z1 > low && !inside_body(i, k))
              smallest = {{std::min(smallest[0], width_of(b)),
                           std::min(smallest[1], z1 - z0)}};
            k = end;
          }
      };
    const unsigned int n_samples = 100;
    for (unsigned int s = 1; s <= n_samples && expanding_radius == 0.; ++s)
      for (unsigned int i = own.column; i < own.column + own.size; ++i)
        {
          // rows sink: soil of this cell meets only cells that began above it
          if (travel_to_hold > 0.)
            meet(i, own.row, travel_to_hold * s / n_samples);
          if (uplift_to_hold > 0.)
            meet(i, 0, -uplift_to_hold * s / n_samples);
        }
    return smallest;
  }

  double
  GridLines::smallest_height_met(const GlobalCell cell) const
  {
    if (node_shift.empty())
      return smallest_size_met(cell)[vertical];
    const auto g = initial_geometry(cell); // nothing moves
    return std::max(g.height_left, g.height_right);
  }

  double
  GridLines::smallest_width_met(const GlobalCell cell) const
  {
    if (expanding_radius == 0.)
      return node_shift.empty() ? smallest_size_met(cell)[radial] :
                                  initial_geometry(cell).width;
    const CellBlock   &own       = tree_.block(cell);
    const double       r0        = columns[own.column];
    double             smallest  = columns[own.column + own.size] - r0;
    const unsigned int n_samples = 100;
    for (unsigned int s = 1; s <= n_samples; ++s)
      {
        const double travel = travel_to_hold * s / n_samples;
        const double a = expanding_radius, b = a + travel;
        const double r =
          axisymmetric() ? std::sqrt(r0 * r0 + b * b - a * a) : r0 + travel;
        // soil that was dr wide is now r0 / r times that
        const double shortened = axisymmetric() ? r0 / r : 1.;
        const double rate      = 1. / (outer_radius - a);
        const double start =
          (r - travel * rate * outer_radius) / (1. - travel * rate);
        const auto next =
          std::upper_bound(columns.begin() + body_column_end + 1,
                           columns.end() - 1,
                           start + 1e-9);
        const double width = (*next - *(next - 1)) * (1. - travel * rate);
        smallest           = std::min(smallest, width / shortened);
      }
    return smallest;
  }
} // namespace CaissonMPM
