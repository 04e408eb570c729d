// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Cells that are halved around the tip and along the wall: which they are,
// their neighbors, and the nodes that hang at their edges.
#include <caisson_mpm/base/text.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>
#include <set>

#include "../shared/messages.h"
#include "../shared/scene.h"
#include "grid_volume.h"

const std::string halved = R"(
  subsection Rigid body
    set Cells across the wall = 4
    set Tip angle             = 45
  end
  subsection Grid
    set Refinement levels            = 2
    set Refinement levels along wall = 1
  end
  )";

/** Neighbors: they name each other, differ by a level at most, and not at all
 * at the body. */
void
check_neighbors(const BackgroundGrid &grid)
{
  const CellTree        &tree    = grid.lines().tree();
  unsigned int           one_way = 0, too_different = 0, at_body = 0, twice = 0;
  std::set<unsigned int> levels;
  for (unsigned int c = 0; c < grid.n_cells(); ++c)
    {
      const CellBlock &own = tree.block(grid.global_number(c));
      levels.insert(tree.level_of(own));
      for (unsigned int face = 0; face < 4; ++face)
        for (const bool second : {false, true})
          {
            const int beyond = grid.neighbor(c, face, second);
            if (beyond < 0)
              {
                one_way += !grid.at_side(c, face);
                continue;
              }
            bool back = false;
            for (const bool other : {false, true})
              back |=
                grid.neighbor(beyond, face ^ 1u, other) == static_cast<int>(c);
            one_way += !back;
            const CellBlock &b = tree.block(grid.global_number(beyond));
            too_different += b.size > 2 * own.size || own.size > 2 * b.size;
            at_body +=
              grid.is_rigid(c) != grid.is_rigid(beyond) && b.size != own.size;
            twice += second && beyond != grid.neighbor(c, face);
          }
    }
  std::printf("levels %d, faces with two neighbors: %s\n",
              int(levels.size()),
              twice > 20 ? "many" : "few");
  verdict("neighbors that do not name each other", one_way, 0.);
  verdict("neighbors that differ by more than a level", too_different, 0.);
  verdict("neighbors of the body of another level", at_body, 0.);
}

/** Hanging nodes: deal.II's constraints are those of the tree, and they stay in
 * the middle of their edges. */
void
check_hanging_nodes(const BackgroundGrid &grid)
{
  const CellTree                                 &tree = grid.lines().tree();
  std::set<std::pair<unsigned int, unsigned int>> nodes;
  for (unsigned int c = 0; c < tree.n_cells(); ++c)
    for (unsigned int k = 0; k < 4; ++k)
      {
        const CellBlock &b = tree.block(GlobalCell(c));
        nodes.emplace(b.column + b.size * (k % 2), b.row + b.size * (k / 2));
      }
  const auto  n = std::count_if(nodes.begin(), nodes.end(), [&](const auto &x) {
    return tree.masters_of({x.first, x.second}).has_value();
  });
  const auto &list  = grid.hanging_nodes().list();
  double      error = 0., weight = 0.;
  for (const auto &h : list)
    {
      const unsigned int a = h.masters[0], b = h.masters[1];
      error = std::max(
        {error,
         std::abs(grid.r_of(h.node) - .5 * (grid.r_of(a) + grid.r_of(b))),
         std::abs(grid.z_of(h.node) - .5 * (grid.z_of(a) + grid.z_of(b)))});
      weight =
        std::max(weight,
                 std::abs(h.weights[0] - .5) + std::abs(h.weights[1] - .5));
    }
  verdict("hanging nodes: those of the tree missing",
          double(n) - list.size(),
          0.);
  verdict("hanging nodes: distance from the middle", error, 1e-13);
  verdict("hanging nodes: error of weights", weight, 0.);
}

/** A linear field stays linear, and sums stay what they are. */
void
check_fields(const BackgroundGrid &grid)
{
  NodalData field, sums;
  grid.reinit(field, 2);
  grid.reinit(sums, 2);
  double total = 0., moment = 0.;
  for (unsigned int n = 0; n < grid.n_nodes(); ++n)
    {
      field.begin()[2 * n]     = 1. + 2. * grid.r_of(n) - 3. * grid.z_of(n);
      field.begin()[2 * n + 1] = grid.z_of(n);
      sums.begin()[2 * n + 1]  = 1. + n % 7;
      total += sums.begin()[2 * n + 1];
      moment += sums.begin()[2 * n + 1] * grid.z_of(n);
    }
  for (const auto &h : grid.hanging_nodes().list())
    field.begin()[2 * h.node] = 1e9;
  grid.hanging_nodes().interpolate(field, 2);
  grid.hanging_nodes().distribute(sums, 2);
  double error = 0., left = 0.;
  for (unsigned int n = 0; n < grid.n_nodes(); ++n)
    {
      error = std::max(error,
                       std::abs(field.begin()[2 * n] - 1. - 2. * grid.r_of(n) +
                                3. * grid.z_of(n)));
      total -= sums.begin()[2 * n + 1];
      moment -= sums.begin()[2 * n + 1] * grid.z_of(n);
    }
  for (const auto &h : grid.hanging_nodes().list())
    left = std::max(left, std::abs(sums.begin()[2 * h.node + 1]));
  verdict("linear field: error", error, 1e-12);
  verdict("sums: lost, and of the first moment",
          std::abs(total) + std::abs(moment),
          1e-8);
  verdict("sums: left at hanging nodes", left, 0.);
}

void
check_caisson()
{
  Scene        s(caisson + halved, 3.);
  const double h = s.body.shape().tip_height();
  std::printf("caisson: %s\n", s.lines.description().c_str());
  verdict("rigid cells: volume error",
          std::abs(volume_of(s.grid, true) /
                     (pi * (9. - 2.8 * 2.8) * (3. - .5 * h)) -
                   1.),
          1e-12);
  // the smallest cells are as wide as the entry of the wall says
  double smallest = 1e9;
  for (unsigned int c = 0; c < s.grid.n_cells(); ++c)
    if (s.grid.is_rigid(c))
      smallest = std::min(smallest, s.grid.geometry(c).width);
  verdict("smallest width in the wall: error", std::abs(smallest - .05), 1e-12);
  check_neighbors(s.grid);
  for (const double travel : {0., 1.7})
    {
      s.grid.move_to(travel);
      verdict("all cells: volume error",
              std::abs(volume_of(s.grid, false) / (pi * 64. * (11. - travel)) -
                       1.),
              1e-12);
      check_hanging_nodes(s.grid);
    }
  check_fields(s.grid);
}

/** The points of cells of any level fill the soil. */
void
check_points()
{
  Scene s(caisson + halved +
            "subsection Material points\nset Split and merge "
            "= true\nend\n",
          3.);
  s.generator.generate(s.grid, s.body.shape(), s.soil, s.points);
  double volume = 0.;
  s.points.for_each(
    [&](const MaterialPoint &p, const unsigned int) { volume += p.volume; });
  const double h    = s.body.shape().tip_height();
  const double soil = 32. * 7. - .5 * (9. - 2.8 * 2.8) * (.5 - .5 * h);
  verdict("points: volume error", std::abs(volume / soil - 1.), 1e-12);
}

/** Other bodies, and a region without a body. */
void
check_others()
{
  Scene        cone(R"(
    subsection Rigid body
      set Kind                  = cone
      set Outer diameter        = 0.4
      set Skirt length          = 2
      set Cells across the wall = 4
      set Initial penetration   = 1
      set Shoulder bevel        = 0
    end
    subsection Grid
      set Outer radius = 3
      set Bottom       = -5
      set Top          = 1.5
      set Cell width   = 0.3
      set Cell height  = 0.3
      set Moving zone below tip = 2.5
      set Refinement levels     = 1
    end)",
             1.);
  const double h = cone.body.shape().tip_height();
  verdict("cone: volume error",
          std::abs(volume_of(cone.grid, true) / (pi * .04 * (2. - h + h / 3.)) -
                   1.),
          1e-12);
  check_neighbors(cone.grid);
  Scene region(R"(
    subsection Grid
      set Outer radius      = 4
      set Bottom            = -4
      set Top               = 1
      set Distortion        = 0.3
      set Refinement levels = 3
      set Refined region    = 1 - (r - 2)^2 - (z + 2)^2
    end)");
  std::printf("region: %s\n", region.lines.description().c_str());
  verdict("region: volume error",
          std::abs(volume_of(region.grid, false) / (pi * 16. * 5.) - 1.),
          1e-12);
  check_neighbors(region.grid);
  check_hanging_nodes(region.grid);
}

void
check_refusals()
{
  for (const std::string entries :
       {"subsection Rigid body\nset Cells across the wall = 6\nend\n",
        "subsection Grid\nset Refined distance = 0.01\nend\n",
        "subsection Grid\nset Refinement levels along wall = 3\nend\n",
        "subsection Grid\nset Largest number of cells = 1000\nend\n"})
    print_error(entries,
                [&]() { const Scene s(caisson + halved + entries, 3.); });
}

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_caisson();
  check_points();
  check_others();
  check_refusals();
  return 0;
}
