// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The grid lines, which need neither a mesh nor MPI: how they are spaced, how
// they move, and what the mesh refuses.
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/domain/graded_lines.h>
#include <caisson_mpm/domain/grid_lines.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "../shared/scene.h"

/** Grid lines without a mesh. */
struct Lines : EmptyParameters
{
  explicit Lines(const std::string &parameters,
                 const double       travel = 0.,
                 const double       uplift = 0.)
  {
    auto &prm = dealii::ParameterAcceptor::prm;
    soil.declare_layers(3);
    prm.parse_input_from_string(parameters);
    dealii::ParameterAcceptor::parse_all_parameters(prm);
    lines.check_parameters();
    body.shape().refine(lines.number_to_divide_by());
    body.check_parameters();
    lines.place(body.shape(), soil, travel, uplift);
  }

  GridLines lines;
  Soil      soil;
  RigidBody body;
};

void
check_lines()
{
  const auto uniform = graded_lines({0., 1., 2.5}, [](double) { return .3; });
  bool       through = std::count(uniform.begin(), uniform.end(), 1.) == 1;
  double     largest = 0.;
  for (unsigned int i = 1; i < uniform.size(); ++i)
    largest = std::max(largest, uniform[i] - uniform[i - 1]);
  std::printf("lines: %d through 1: %d, largest %.4f\n",
              int(uniform.size()),
              through,
              largest);
  const auto graded =
    graded_lines({0., 10.}, [](const double x) { return .1 + .2 * x; });
  double smallest_ratio = 1e9, largest_ratio = 0.;
  for (unsigned int i = 2; i < graded.size(); ++i)
    {
      const double ratio =
        (graded[i] - graded[i - 1]) / (graded[i - 1] - graded[i - 2]);
      smallest_ratio = std::min(smallest_ratio, ratio);
      largest_ratio  = std::max(largest_ratio, ratio);
    }
  verdict("graded lines: spread of the ratio",
          largest_ratio - smallest_ratio,
          1e-2);
  std::printf("ratio %.2f\n", largest_ratio);
}

/** The numbers of cells, the cells of the body, zones and sides. */
void
check_cells()
{
  const Lines s(caisson + "subsection Rigid body\nset Lid thickness = 0.25\n"
                          "end\n",
                3.);
  const GridLines &lines = s.lines;
  unsigned int     wrong = 0, n_body = 0, n_lid = 0, n_zone[2] = {0, 0};
  for (unsigned int c = 0; c < lines.n_cells(); ++c)
    {
      const GlobalCell       cell{c};
      const auto             g      = lines.initial_geometry(cell);
      const dealii::Point<2> middle = to_position(g, dealii::Point<2>(.5, .5));
      wrong += lines.is_body_cell(cell) != s.body.shape().contains(middle, 0.);
      wrong += lines.row_of(cell) * lines.n_columns() + lines.column_of(cell) !=
               index_of(cell);
      n_body += lines.is_body_cell(cell);
      n_lid += lines.is_lid_cell(cell);
      ++n_zone[static_cast<unsigned int>(lines.zone_of(cell))];
      const double left = lines.node_start(lines.column_of(cell), 0)[radial];
      wrong += left != g.left;
    }
  verdict("cells: wrong numbers, places or body cells", wrong, 0.);
  std::printf("cells %u x %u, body %u, of the lid %u, moving %u, "
              "compressing %u\n",
              lines.n_columns(),
              lines.n_rows(),
              n_body,
              n_lid,
              n_zone[0],
              n_zone[1]);
  std::printf("sides of corners: %u %u %u %u, inside %u\n",
              lines.sides_of(0, 0),
              lines.sides_of(lines.n_columns(), 0),
              lines.sides_of(0, lines.n_rows()),
              lines.sides_of(lines.n_columns(), lines.n_rows()),
              lines.sides_of(1, 1));
}

/** Entries of the section Rigid body, as a text of parameters. */
std::string
wall_with(const std::string &entries)
{
  return "subsection Rigid body\nset Tip angle = 45\n" + entries +
         "\nend\nsubsection Grid\nset Moving zone below tip = 2\nend\n";
}

/** The cells of a wall with steps and rings are the body's, and have its
 * volume; rows are level at all faces above the tip. */
void
check_wall_as_built()
{
  const std::string step = "set Wall steps = 1:0.1, 2:0.3\n",
                    ring = "set Rings = 0.5:0.3:0.1, 1.4:0.2:0.2\n";
  // rings are at the inner face of the piece behind them
  const auto tube = [](const double from, const double to, const double h) {
    return pi * h * (to * to - from * from);
  };
  const double h = .2, outside = h * (3. - .2 / 3.),
               inside = h * (2.8 + .2 / 3.);
  // of a tip as high as the wall is thick, half of its rectangle
  const auto tip = [&](const double edge) {
    return tube(2.8, 3., 1.) -
           2. * pi * .5 * h * (edge == 0. ? outside : inside);
  };
  const double rings = tube(2.5, 2.8, .1) + tube(2.7, 2.9, .2);
  for (const double edge : {0., 1.})
    for (const char *levels : {"0", "1"})
      {
        const Lines  s(caisson +
                        wall_with("set Edge of the tip = " +
                                  std::to_string(edge) + "\n" + step + ring) +
                        "subsection Grid\nset Refinement levels = " + levels +
                        "\nend\n",
                      1.);
        double       volume = 0.;
        unsigned int wrong = 0, n_lowest = 0;
        for (unsigned int c = 0; c < s.lines.n_cells(); ++c)
          {
            const GlobalCell cell{c};
            const auto       g       = s.lines.initial_geometry(cell);
            const bool       is_body = s.lines.is_body_cell(cell);
            for (const double x : {.01, .5, .99})
              for (const double y : {.01, .5, .99})
                wrong +=
                  is_body != s.body.shape().contains(
                               to_position(g, dealii::Point<2>(x, y)), 0.);
            n_lowest += s.lines.is_lowest_cell(cell);
            if (is_body)
              volume += 2. * pi * g.width *
                        ((g.left / 2. + g.width / 6.) * g.height_left +
                         (g.left / 2. + g.width / 3.) * g.height_right);
          }
        std::printf("edge %.0f, levels %s: lowest cells %u\n",
                    edge,
                    levels,
                    n_lowest);
        verdict("wall as built: places in the wrong cell", wrong, 0.);
        verdict("wall as built: error of the volume",
                std::abs(volume / (tip(edge) + tube(2.9, 3., 1.) +
                                   tube(2.7, 3., 1.) + rings) -
                         1.),
                1e-12);
      }
}

/** A step that does not change the thickness leaves the mesh as it is. */
void
check_equal_thickness()
{
  const Lines plain(caisson + wall_with("")),
    stepped(caisson + wall_with("set Wall steps = 1:0.2, 2:0.2"));
  bool same = plain.lines.n_cells() == stepped.lines.n_cells();
  for (unsigned int c = 0; same && c < plain.lines.n_cells(); ++c)
    {
      const auto a = plain.lines.initial_geometry(GlobalCell{c}),
                 b = stepped.lines.initial_geometry(GlobalCell{c});
      same         = a.left == b.left && a.bottom_left == b.bottom_left &&
             a.height_left == b.height_left;
    }
  std::printf("equal thicknesses: %s mesh\n", same ? "the same" : "another");
}

/** The mesh has the free edges of a footing half a cell inside those of the
 * box, but not those of a box that goes deeper, or that begins below the
 * surface. */
void
check_edges_of_footing()
{
  for (const char *bottom : {"0", "-0.5"})
    for (const double travel : {0.05, 0.5})
      for (const char *left : {"0", "1"})
        for (const char *side : {"4", "2"})
          {
            const Lines s(std::string("subsection Rigid body\nset Kind = box\n"
                                      "set Box right = 2\nset Box top = 1\n"
                                      "set Box bottom = ") +
                            bottom + "\nset Box left = " + left +
                            "\nend\nsubsection Grid\nset Outer radius = " +
                            side +
                            "\nset Bottom = -4\nset Top = 2\n"
                            "set Cell width = 0.5\nset Fine cell size = 0.25\n"
                            "set Refinement = 2\nend\n",
                          travel);
            double      from = 1e9, to = 0.;
            for (unsigned int c = 0; c < s.lines.n_cells(); ++c)
              if (s.lines.is_body_cell(GlobalCell{c}))
                {
                  const auto g = s.lines.initial_geometry(GlobalCell{c});
                  from         = std::min(from, g.left);
                  to           = std::max(to, g.left + g.width);
                }
            std::printf(
              "box from %s to 2 of %s, bottom %s, sinks by %.2f: cells "
              "from %.4f to %.4f\n",
              left,
              side,
              bottom,
              travel,
              from,
              to);
          }
}

/** The number of cells of a row of lines from the first of them to @p x, with a
 * part of the cell in which it lies. */
double
cells_to(const std::vector<double> &lines, const double x)
{
  const auto above = std::upper_bound(lines.begin() + 1, lines.end() - 1, x);
  return (above - lines.begin()) - (*above - x) / (*above - *(above - 1));
}

/** The lines of one direction, taken from the cells. */
std::vector<double>
lines_of(const GridLines &lines, const unsigned int direction)
{
  std::vector<double> result;
  const unsigned int  n =
    direction == radial ? lines.n_columns() : lines.n_rows();
  for (unsigned int i = 0; i <= n; ++i)
    result.push_back(direction == radial ? lines.node_start(i, 0)[radial] :
                                           lines.node_start(0, i)[vertical]);
  return result;
}

/** Meshes of one family: between any two distances from the body, their numbers
 * of cells have the ratio of Grid/Refinement. */
void
check_similar_meshes()
{
  const std::vector<double> distances = {0., .1, .2, .4, .8, 1.6};
  const std::pair<const char *, const char *> kinds[] = {{"0", "1.2"},
                                                         {"1", "1.2"},
                                                         {"0", "auto"}};
  for (const auto &[levels, growth] : kinds)
    {
      std::vector<double> of_base;
      double              worst = 0., tip = 0.;
      for (const double number : {1., .5, 1.5, 2., 3.})
        {
          const Lines s(
            "subsection Rigid body\nset Kind = caisson\n"
            "set Cells across the wall = 4\nset Tip angle = 30\nend\n"
            "subsection Grid\nset Outer radius = 15\nset Bottom = -18\n"
            "set Top = 8\nset Cell width = 1.2\nset Cell height = 0.4\n"
            "set Fine width = 0.15\nset Fine height = 0.15\n"
            "set Refined distance = 0.3\nset Growth ratio = " +
            std::string(growth) + "\nset Refinement levels = " + levels +
            "\nset Refinement = " + std::to_string(number) + "\nend\n");
          const auto columns = lines_of(s.lines, radial),
                     rows    = lines_of(s.lines, vertical);
          const double shoulder =
            s.body.shape().bottom() + s.body.shape().tip_height();
          std::vector<double> cells;
          for (unsigned int i = 0; i + 1 < distances.size(); ++i)
            {
              const double a = distances[i], b = distances[i + 1];
              cells.push_back(cells_to(columns, 3. + b) -
                              cells_to(columns, 3. + a));
              cells.push_back(cells_to(rows, shoulder - a) -
                              cells_to(rows, shoulder - b));
            }
          if (number == 1.)
            of_base = cells;
          for (unsigned int i = 0; i < cells.size(); ++i)
            worst =
              std::max(worst, std::abs(cells[i] / (number * of_base[i]) - 1.));
          // the bevel of the shoulder is a cell high
          tip =
            std::max(tip,
                     std::abs(s.body.shape().tip_height() -
                              .05 * std::tan(radians(30.)) - .1 / 4. / number));
        }
      verdict("similar meshes: error of the ratio of cells", worst, .05);
      verdict("similar meshes: error of the height of the tip", tip, 1e-12);
    }
}

/** The outer nodes of a tip are a cell higher in soil with friction, and half a
 * cell without; the tip of this body is 0.1 m high, its cells are 0.1 m wide.
 */
void
check_bevel()
{
  Lines s("subsection Rigid body\nset Kind = caisson\n"
          "set Wall thickness = 0.2\nend\n");
  for (const bool has_friction : {true, false})
    {
      s.body.shape().enter_soil(has_friction);
      const double height = has_friction ? .2 : .15;
      verdict(has_friction ? "bevel with friction" : "bevel without friction",
              std::abs(s.body.shape().tip_height() - height),
              1e-12);
    }
}

/** The heights of lines follow the travel, and what soil meets on the way. */
void
check_motion()
{
  const Lines  s(caisson, 3.);
  const auto  &lines = s.lines;
  const double d     = 1.5;
  verdict("lines: motion error",
          std::abs(lines.height_at(-7., d) + 7.) +
            std::abs(lines.height_at(-2.5, d) + 4.) +
            std::abs(lines.height_at(-4.75, d) + 5.5) +
            std::abs(lines.height_at(1., d) + .5),
          1e-14);
  double       rate = 0., smallest = 1e9;
  unsigned int taller = 0;
  for (unsigned int j = 0; j <= lines.n_rows(); ++j)
    {
      const double z = lines.node_start(0, j)[vertical];
      rate           = std::max(rate,
                      std::abs(z + d * lines.node_rate(0, j)[vertical] -
                               lines.height_at(z, d)));
    }
  for (unsigned int c = 0; c < lines.n_cells(); ++c)
    {
      const GlobalCell cell{c};
      const auto       g   = lines.initial_geometry(cell);
      const double     met = lines.smallest_height_met(cell);
      taller += met > std::max(g.height_left, g.height_right) + 1e-12;
      smallest = std::min(smallest, met);
    }
  verdict("lines: rate error", rate, 1e-12);
  verdict("cells that meet only taller ones", taller, 0.);
  // the lowest rows keep a third of their height
  std::printf("smallest height met: %.3f\n", smallest);
}

/** What the mesh refuses, with the entry to change. */
void
check_refusals()
{
  const auto refuse = [](const std::string &parameters,
                         const double       travel = 0.,
                         const double       uplift = 0.) {
    try
      {
        const Lines s(caisson + parameters, travel, uplift);
        std::printf("accepted\n");
      }
    catch (const BadInput &error)
      {
        std::printf("%s\n", error.what());
      }
  };
  refuse("subsection Grid\nset Inner radius = 8\nend\n");
  refuse("subsection Grid\nset Bottom = 1\nend\n");
  refuse("subsection Grid\nset Outer radius = 2.5\nend\n");
  // cells across the wall: a whole number, and even
  refuse("subsection Grid\nset Refinement = 1.3\nend\n");
  refuse("subsection Grid\nset Refinement = 0.5\nend\n");
  refuse("subsection Grid\nset Bottom = -0.4\nend\n");
  refuse("subsection Grid\nset Distortion = 0.1\nend\n");
  refuse("", 5.);
  refuse("", 4.49);
  refuse("subsection Grid\nset Moving zone below tip = 0.1\nend\n", 1.);
  // a thin layer is named
  refuse("subsection Soil\nset Number of layers = 3\n"
         "subsection Layer 2\nset Top depth = 4\nend\n"
         "subsection Layer 3\nset Top depth = 4.001\nend\nend\n",
         1.);
  // more cells than memory holds, by each of the entries that may be wrong
  refuse("subsection Rigid body\nset Wall thickness = 1e-9\nset Tip = flat\n"
         "end\n");
  refuse("subsection Grid\nset Top = 1e9\nend\n");
  refuse("subsection Grid\nset Bottom = -1e9\nend\n");
  refuse("subsection Grid\nset Fine cell size = 1e-6\nend\n");
  refuse("subsection Grid\nset Cell width = 1e-7\nend\n"
         "subsection Rigid body\nset Kind = none\nend\n");
  refuse("subsection Grid\nset Largest number of cells = 100\nend\n");
  // steps and rings that contradict each other, or need smaller cells
  for (const char *entries :
       {"set Wall steps = 1:0.1, 1:0.3",
        "set Wall steps = 0.05:0.1",
        "set Wall steps = 2.5:0.1\nset Lid thickness = 0.6",
        "set Wall steps = 1:3",
        "set Wall steps = 1:0.19",
        "set Rings = 1:0.1:0.1",
        "set Rings = 1:0.2:0.04",
        "set Rings = 1:0.2:0.1, 1.1:0.2:0.1",
        "set Rings = 0.1:0.2:0.1",
        "set Rings = 2.95:0.2:0.1",
        "set Rings = 1:2.8:0.1",
        "set Rings = 1:0.2:0.2\nset Wall steps = 1.1:0.1",
        "set Edge of the tip = 0.1"})
    refuse(wall_with(entries));
}

int
main(int, char **)
{
  check_lines();
  check_cells();
  check_wall_as_built();
  check_equal_thickness();
  check_edges_of_footing();
  check_similar_meshes();
  check_bevel();
  check_motion();
  check_refusals();
  return 0;
}
