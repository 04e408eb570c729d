// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Where the lines are at the start, and whether there are too many of them.
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/domain/graded_lines.h>
#include <caisson_mpm/domain/grid_lines.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    /** Lines with the middles between them, and the middles between these, ...
     */
    std::vector<double>
    halved(const std::vector<double> &lines, const unsigned int n_times)
    {
      if (n_times == 0)
        return lines;
      std::vector<double> result;
      for (const double x : lines)
        {
          if (!result.empty())
            result.push_back(.5 * (result.back() + x));
          result.push_back(x);
        }
      return halved(result, n_times - 1);
    }
  } // namespace

  void
  GridLines::place(const BodyShape &body,
                   const Soil      &soil,
                   const double     travel,
                   const double     uplift)
  {
    if (distortion > 0. && body.exists())
      throw BadInput("Grid/Distortion is for scenes without a rigid body: the "
                     "mesh must fit the body. Set Distortion = 0.");
    travel_to_hold = travel;
    uplift_to_hold = uplift;
    check_refinement(body);
    follow(body);
    const Spacing in_r = spacing_in_r(body), in_z = spacing_in_z(body, soil);
    check_number_of_cells(in_r, in_z);
    columns = lines_of(in_r);
    rows    = lines_of(in_z);
    if (columns.size() < 2 || rows.size() < 2)
      throw BadInput(
        "the mesh, as wide as Grid/Outer radius = " + meters(outer_radius) +
        " allows and from Grid/Bottom = " + meters(bottom) + " to Grid/Top = " +
        meters(top) + ", is too small to have a cell. Lengths are in m.");
    fixed_rows = in_z.fixed;
    if (distortion > 0.)
      distort_columns();
    columns = halved(columns, levels);
    rows    = halved(rows, levels);
    if (distortion > 0.)
      distort_rows(fixed_rows);
    find_body(body);
    make_cells(body);
    check_travel();
  }

  void
  GridLines::follow(const BodyShape &body)
  {
    zone_bottom = bottom;
    zone_top    = top;
    if (!body.exists())
      return;
    if (body.expands())
      {
        expanding_radius = body.right();
        return;
      }
    shoulder    = body.bottom() + body.tip_height();
    zone_bottom = std::max(bottom, body.bottom() - zone_below_tip);
    zone_top    = body.top();
    decay_below = body.height_of_bent_rows();
    // the rows are level again where cells are no longer halved
    if (levels > 0 && is_wedge(body))
      decay_below =
        std::min(decay_below, distance_of_tip(body) * (1u << (levels - 1)));
    decay_above = std::min(
      {decay_below, zone_top - shoulder, lowest_ledge(body) - shoulder});
  }

  // ------------------------------------------------------------ spacing

  std::vector<double>
  GridLines::lines_of(const Spacing &spacing)
  {
    std::vector<double> fixed;
    for (const FixedLine &line : spacing.fixed)
      fixed.push_back(line.place);
    return graded_lines(fixed, spacing.size);
  }

  double
  GridLines::reach_of_yielding(const BodyShape &body)
  {
    // Around a wall, soil yields within some of its widths, and the cells there
    // decide about the force; around a cone or a pile it may be anywhere.
    constexpr double widths  = 10.;
    const bool       is_wall = body.left() > 0.;
    return is_wall ? widths * body.width_of_tip() :
                     std::numeric_limits<double>::infinity();
  }

  double
  GridLines::size_at(const double distance,
                     const double reach,
                     const double fine,
                     const double coarse) const
  {
    constexpr double near = .15, beyond = .45; // larger by, per size
    const double     from = std::clamp(distance, 0., reach);
    const double     growing =
      growth ? (*growth - 1.) * std::max(distance, 0.) :
                   near * from + beyond * std::max(distance - reach, 0.);
    return std::min(std::max(coarse / refinement, fine),
                    fine + growing / refinement);
  }

  GridLines::Spacing
  GridLines::even_spacing(const std::vector<FixedLine> &fixed,
                          const double                  size) const
  {
    return {fixed, [=](double) { return size; }, size, ""};
  }

  std::pair<double, std::string>
  GridLines::finest_cell(const BodyShape  &body,
                         const double      otherwise,
                         const std::string entry) const
  {
    if (fine_size)
      return {*fine_size / refinement,
              "Grid/Fine cell size = " + meters(*fine_size)};
    if (body.cell_width() > 0.)
      return {body.cell_width(), body.entry_of_cell_width()};
    return {otherwise / refinement, entry + " = " + meters(otherwise)};
  }

  double
  GridLines::inset_of_footing(const BodyShape &body) const
  {
    if (!body.has_flat_base() || body.bottom() < 0.)
      return 0.;
    const double half =
      .5 * finest_cell(body, cell_width, "Grid/Cell width").first;
    return travel_to_hold <= half ? half : 0.;
  }

  std::pair<double, double>
  GridLines::sides_of_body(const BodyShape &body) const
  {
    if (body.expands())
      return {inner_radius, body.right()};
    const double inset   = inset_of_footing(body);
    const bool   at_axis = body.left() <= inner_radius,
               at_side   = body.right() >= outer_radius;
    return {body.left() + (at_axis ? 0. : inset),
            body.right() - (at_side ? 0. : inset)};
  }

  double
  GridLines::lowest_ledge(const BodyShape &body)
  {
    double lowest = std::numeric_limits<double>::infinity();
    for (unsigned int i = 1; i < body.n_parts(); ++i)
      lowest = std::min(lowest, body.part(i).bottom);
    // an edge that is not in the middle bends the rows beside the wall
    const double shoulder = body.bottom() + body.tip_height();
    if (shoulder < 0. &&
        std::min(body.lower_surface(body.left()),
                 body.lower_surface(body.right())) < shoulder - 1e-9)
      lowest = std::min(lowest, 0.);
    return lowest;
  }

  void
  GridLines::check_parts(const BodyShape   &body,
                         const double       cell,
                         const double       line_spacing,
                         const std::string &entry)
  {
    constexpr double smallest = .5, least = 2.; // cells in a gap, at a ring
    const auto refuse = [&](const std::string &what, const double needed) {
      throw BadInput(what + " of " + meters(cell) + " (" + entry +
                     "). Cells of " + meters(needed) +
                     " or less are needed: increase Rigid body/Cells across "
                     "the wall, or set Grid/Fine cell size.");
    };
    const auto check = [&](std::vector<double> lines, const char *direction) {
      std::sort(lines.begin(), lines.end());
      for (std::size_t i = 0; i + 1 < lines.size(); ++i)
        if (const double gap = lines[i + 1] - lines[i];
            gap > 1e-9 && gap < smallest * line_spacing * (1. - 1e-6))
          refuse("Two faces of the body are " + meters(gap) + " apart in " +
                   direction + ", less than half of a cell",
                 gap / smallest * cell / line_spacing);
    };
    std::vector<double> radii   = body.radii_of_tip(),
                        heights = {body.bottom() + body.tip_height(),
                                   body.lower_face_of_lid()};
    for (unsigned int i = 0; i < body.n_parts(); ++i)
      {
        const BodyPart part  = body.part(i);
        const double   width = part.right - part.left;
        if (body.is_ring(i) && width < least * cell * (1. - 1e-6))
          refuse("Rigid body/Rings: a ring " + meters(width) +
                   " wide is less than two cells",
                 width / least);
        radii.insert(radii.end(), {part.left, part.right});
        heights.push_back(part.top);
        if (i > 0)
          heights.push_back(part.bottom);
      }
    check(radii, "r");
    check(heights, "z");
  }

  GridLines::Spacing
  GridLines::spacing_in_r(const BodyShape &body) const
  {
    const FixedLine inner = {inner_radius, "Grid/Inner radius"},
                    outer = {outer_radius, "Grid/Outer radius"};
    if (!body.exists())
      return even_spacing({inner, outer}, cell_width / refinement);
    const bool expands = body.expands();
    // one column of the cylinder is enough
    const auto [left, right] = sides_of_body(body);
    if (expands && right <= inner_radius)
      throw BadInput("Rigid body/Outer diameter: the radius of the cylinder, " +
                     meters(right) + ", must exceed Grid/Inner radius = " +
                     meters(inner_radius) +
                     ". Reduce Grid/Inner radius, for instance to 0.");
    double from = left, to = right; // with rings and steps
    for (unsigned int i = 1; i < body.n_parts(); ++i)
      {
        from = std::min(from, body.part(i).left);
        to   = std::max(to, body.part(i).right);
      }
    if (from < inner_radius || to > outer_radius)
      throw BadInput("The body, from r = " + meters(from) + " to " +
                     meters(to) + ", does not fit in the mesh, from r = " +
                     meters(inner_radius) + " to " + meters(outer_radius) +
                     ". Change Grid/Outer radius or the body.");
    const auto   finest = finest_cell(body, cell_width, "Grid/Cell width");
    const double fine   = finest.first * (1u << levels);
    std::vector<FixedLine> fixed = {inner,
                                    {left, "the body"},
                                    {right, "the body"},
                                    outer};
    for (const double r : body.radii_of_tip())
      fixed.push_back({r, "the edge of the tip"});
    for (unsigned int i = 1; i < body.n_parts(); ++i)
      for (const double r : {body.part(i).left, body.part(i).right})
        fixed.push_back({r, "a step or ring of the wall"});
    if (fixed.size() > 4)
      check_parts(body, finest.first, fine, finest.second);
    const double reach = reach_of_yielding(body);
    const auto   size  = [=, right = right](const double r) {
      if (expands && r < right)
        return right - inner_radius;
      const double distance = std::max({from - r, r - to, 0.}) - fine_width;
      return size_at(distance, reach, fine, cell_width);
    };
    return {fixed,
            size,
            fine,
            finest.second + " or Grid/Fine width = " + meters(fine_width)};
  }

  GridLines::Spacing
  GridLines::spacing_in_z(const BodyShape &body, const Soil &soil) const
  {
    std::vector<FixedLine> fixed = {{bottom, "Grid/Bottom"},
                                    {0., "the soil surface"},
                                    {top, "Grid/Top"}};
    for (const double z : soil.interfaces())
      {
        const std::string entry =
          "Soil/Layer " + to_text(fixed.size() - 1) + "/Top depth";
        if (z <= bottom)
          throw BadInput(
            entry + " = " + meters(-z) +
            " is not above the end of the mesh, Grid/Bottom = " +
            meters(bottom) +
            ". Reduce Soil/Number of layers, or lower the bottom.");
        fixed.push_back({z, entry});
      }
    if (!body.exists() || body.expands())
      return even_spacing(fixed, cell_height / refinement);
    if (body.bottom() < bottom || body.top() > top)
      throw BadInput("The body, from z = " + meters(body.bottom()) + " to " +
                     meters(body.top()) +
                     ", does not fit in the mesh, from z = " + meters(bottom) +
                     " to " + meters(top) +
                     ". Change Grid/Bottom, Grid/Top or the body.");
    if (travel_to_hold > 0. || uplift_to_hold > 0.)
      fixed.push_back({zone_bottom, "Grid/Moving zone below tip"});
    fixed.push_back({shoulder, "the tip of the body"});
    fixed.push_back({zone_top, "the top of the body"});
    if (body.has_lid())
      fixed.push_back({body.lower_face_of_lid(), "the lid of the body"});
    std::vector<double> faces = {shoulder};
    for (unsigned int i = 1; i < body.n_parts(); ++i)
      for (const double z : {body.part(i).bottom, body.part(i).top})
        if (std::abs(z - zone_top) > 1e-9)
          {
            faces.push_back(z);
            fixed.push_back({z, "a step or ring of the wall"});
          }
    const auto   finest = finest_cell(body, cell_height, "Grid/Cell height");
    const double fine   = finest.first * (1u << levels);
    // a flat row between both lines would only make the time step small
    constexpr double flat = .75; // of a cell
    if (std::any_of(faces.begin(), faces.end(), [fine](const double z) {
          return z != 0. && std::abs(z) < flat * fine;
        }))
      fixed.erase(fixed.begin() + 1);
    const double reach = reach_of_yielding(body);
    const auto   size  = [=](const double z) {
      double to_face = std::numeric_limits<double>::infinity();
      for (const double face : faces)
        to_face = std::min(to_face, std::abs(z - face));
      return size_at(to_face - fine_height, reach, fine, cell_height);
    };
    return {fixed,
            size,
            fine,
            finest.second + " or Grid/Fine height = " + meters(fine_height)};
  }

  // ------------------------------------------------------------ number

  std::vector<double>
  GridLines::cells_between(std::vector<FixedLine>              &fixed,
                           const std::function<double(double)> &size)
  {
    std::sort(fixed.begin(),
              fixed.end(),
              [](const FixedLine &a, const FixedLine &b) {
                return a.place < b.place;
              });
    std::vector<double> numbers;
    for (std::size_t i = 0; i + 1 < fixed.size(); ++i)
      numbers.push_back(
        number_of_cells(fixed[i].place, fixed[i + 1].place, size));
    return numbers;
  }

  void
  GridLines::check_number_of_cells(const Spacing &in_r,
                                   const Spacing &in_z) const
  {
    auto       fixed_in_r = in_r.fixed, fixed_in_z = in_z.fixed;
    const auto sum = [](const std::vector<double> &numbers) {
      return std::accumulate(numbers.begin(), numbers.end(), 0.);
    };
    const double n_columns = sum(cells_between(fixed_in_r, in_r.size)),
                 n_rows    = sum(cells_between(fixed_in_z, in_z.size)),
                 n         = n_columns * n_rows;
    if (n <= largest_number)
      return;
    constexpr double bytes_per_cell = 2000.;
    throw BadInput(
      "The mesh would have " + to_text(n_columns, 6) + " x " +
      to_text(n_rows, 6) + " = " + to_text(n, 6) + " cells and take about " +
      to_text(n * bytes_per_cell * 1e-9, 3) +
      " GB of memory, more than Grid/Largest number of cells = " +
      to_text(largest_number) + ". " +
      (n_columns > n_rows ?
         reason_for_number(
           "columns", "r", "Grid/Cell width", cell_width, in_r) :
         reason_for_number(
           "rows", "z", "Grid/Cell height", cell_height, in_z)) +
      (refinement > 1. ? " Grid/Refinement = " + to_text(refinement) + "." :
                         ""));
  }

  std::string
  GridLines::reason_for_number(const std::string &what,
                               const std::string &coordinate,
                               const std::string &entry,
                               const double       size,
                               Spacing            spacing)
  {
    const auto  numbers = cells_between(spacing.fixed, spacing.size);
    const auto  largest = std::max_element(numbers.begin(), numbers.end());
    const auto &from    = spacing.fixed[largest - numbers.begin()],
               &to      = spacing.fixed[largest - numbers.begin() + 1];
    const double n_finest =
      number_of_cells(from.place, to.place, [&](const double x) {
        const double here = spacing.size(x);
        return here < 1.001 * spacing.finest ?
                 here :
                 std::numeric_limits<double>::infinity();
      });
    const std::string most = to_text(*largest, 6) + " of the " + what;
    if (!spacing.finest_entry.empty() && n_finest > .5 * *largest)
      return most + " are " + meters(spacing.finest) + " fine: change " +
             spacing.finest_entry + ".";
    const auto place = [&](const FixedLine &line) {
      return line.reason + " (" + coordinate + " = " + meters(line.place) + ")";
    };
    return most + " lie between " + place(from) + " and " + place(to) +
           ": check these lengths, which are in meters, and " + entry + " = " +
           meters(size) + ".";
  }

  // ------------------------------------------------------------ the body

  namespace
  {
    unsigned int
    line_at(const std::vector<double> &lines, const double x)
    {
      const auto it =
        std::min_element(lines.begin(),
                         lines.end(),
                         [x](const double a, const double b) {
                           return std::abs(a - x) < std::abs(b - x);
                         });
      return it - lines.begin();
    }
  } // namespace

  void
  GridLines::find_body(const BodyShape &body)
  {
    if (!body.exists())
      return;
    const auto [left, right] = sides_of_body(body);
    body_column_begin        = line_at(columns, left);
    body_column_end          = line_at(columns, right);
    dip.assign(columns.size(), 0.);
    if (body.expands())
      {
        body_ranges = {{body_column_begin, body_column_end, 0, n_rows()}};
        return;
      }
    find_dips(body);
    body_row_begin = line_at(rows, shoulder);
    for (unsigned int i = 0; i < body.n_parts(); ++i)
      {
        const BodyPart part = body.part(i);
        body_ranges.push_back(
          {i == 0 ? body_column_begin : line_at(columns, part.left),
           i == 0 ? body_column_end : line_at(columns, part.right),
           i == 0 ? body_row_begin : line_at(rows, part.bottom),
           line_at(rows, part.top)});
      }
    if (body.has_lid())
      lid = {0,
             line_at(columns, body.left_at_top()),
             line_at(rows, body.lower_face_of_lid()),
             line_at(rows, zone_top)};
  }

  void
  GridLines::find_dips(const BodyShape &body)
  {
    for (unsigned int i = body_column_begin; i <= body_column_end; ++i)
      dip[i] = shoulder - body.lower_surface(columns[i]);
    // beside an edge that is not in the middle, rows become level again
    const double left      = columns[body_column_begin],
                 right     = columns[body_column_end];
    const auto at_distance = [&](const double of_side, const double distance) {
      return of_side < 1e-9 ?
               0. :
               of_side * std::max(0., 1. - distance / (right - left));
    };
    for (unsigned int i = 0; i < body_column_begin; ++i)
      dip[i] = at_distance(dip[body_column_begin], left - columns[i]);
    for (unsigned int i = body_column_end + 1; i < columns.size(); ++i)
      dip[i] = at_distance(dip[body_column_end], columns[i] - right);
  }

  std::string
  GridLines::known_limit(const BodyShape &body) const
  {
    constexpr double   tolerance = .01; // of the size
    const unsigned int n         = body_column_end - body_column_begin;
    if (!fine_size || n == 0 || body.expands() || inset_of_footing(body) > 0.)
      return "";
    const double width  = columns[body_column_end] - columns[body_column_begin],
                 actual = width / n, wanted = *fine_size / refinement;
    if (std::abs(actual - wanted) <= tolerance * wanted)
      return "";
    return "Grid/Fine cell size = " + meters(*fine_size) +
           " does not divide the width of the body, " + meters(width) +
           ": the cells there are " + meters(actual) + " wide" + ". Set " +
           meters(actual * refinement) +
           ", or the width over another whole number.";
  }

  // ------------------------------------------------------------ distortion

  namespace
  {
    /** A number from -1 to 1 that looks random, the same on all machines. */
    double
    scatter(const unsigned int i, const unsigned int j)
    {
      // the finalizer of MurmurHash3 on both numbers
      std::uint64_t h = 0x9e3779b97f4a7c15u * (i + 1) + j;
      h               = (h ^ (h >> 33)) * 0xff51afd7ed558ccdu;
      h               = (h ^ (h >> 33)) * 0xc4ceb9fe1a85ec53u;
      return ((h ^ (h >> 33)) >> 11) * 0x1p-52 - 1.;
    }

    /** The shorter distance of an inner line to its neighbors. */
    double
    distance_to_next(const std::vector<double> &lines, const unsigned int i)
    {
      return std::min(lines[i + 1] - lines[i], lines[i] - lines[i - 1]);
    }
  } // namespace

  void
  GridLines::distort_columns()
  {
    const std::vector<double> regular = columns;
    for (unsigned int i = 1; i + 1 < columns.size(); ++i)
      columns[i] += distortion * scatter(i, 0) * distance_to_next(regular, i);
  }

  void
  GridLines::distort_rows(const std::vector<FixedLine> &straight_rows)
  {
    node_shift.assign(rows.size(), std::vector<double>(columns.size(), 0.));
    for (unsigned int j = 1; j + 1 < rows.size(); ++j)
      {
        const bool is_straight =
          std::any_of(straight_rows.begin(),
                      straight_rows.end(),
                      [&](const FixedLine &line) {
                        return std::abs(line.place - rows[j]) < 1e-9;
                      });
        for (unsigned int i = 1; i + 1 < columns.size() && !is_straight; ++i)
          node_shift[j][i] =
            distortion * scatter(i, j) * distance_to_next(rows, j);
      }
  }
} // namespace CaissonMPM
