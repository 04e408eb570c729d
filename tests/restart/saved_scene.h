// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the tests of checkpoints share: a box of soil whose points have numbers
// with many digits, and a directory.
#ifndef caisson_mpm_tests_saved_scene_h
#define caisson_mpm_tests_saved_scene_h

#include <caisson_mpm/domain/point_exchange.h>

#include <cmath>
#include <string>

#include "../shared/scene.h"

/** A square box with this size of cells, with 25 points each. */
inline std::string
box(const std::string &size)
{
  return R"(
  subsection Rigid body
    set Kind = none
  end
  subsection Grid
    set Outer radius = 3
    set Bottom       = -3
    set Top          = 0.5
    set Cell width   = )" +
         size + R"(
    set Cell height  = )" +
         size + R"(
  end
  subsection Soil
    set Number of layers = 2
    subsection Layer 2
      set Top depth = 1.25
    end
  end
  subsection Material points
    set Per direction far = 5
  end)";
}



inline const std::string directory = "checkpoint_files";



inline std::string
path(const std::string &name)
{
  return directory + "/" + name;
}



/** Numbers with digits that no two members share. */
inline void
fill(MaterialPoint &p)
{
  double     number = p.id;
  const auto next   = [&number]() { return std::sin(++number) / 3.; };
  for (unsigned int d = 0; d < 2; ++d)
    {
      p.velocity[d] = next();
      p.size[d]     = next();
    }
  for (double &s : p.stress)
    s = 1e5 * next();
  for (double &s : p.state)
    s = next();
  p.plastic_deviatoric = next();
  p.plastic_volumetric = -0.;
  p.mass               = next();
  p.initial_volume     = next();
  p.initial_position   = dealii::Point<2>(next(), 1e-310);
}



inline void
generate(Scene &s)
{
  s.generator.generate(s.grid, s.body.shape(), s.soil, s.points);
  std::vector<TravelingPoint> all;
  std::vector<unsigned int>   n_in_cell(s.grid.n_global_cells(), 0);
  s.points.for_each([&](const MaterialPoint &p, const unsigned int cell) {
    all.push_back({s.grid.global_number(cell), p});
    ++n_in_cell[index_of(all.back().cell)];
  });
  s.points.reset(n_in_cell);
  for (TravelingPoint &p : all)
    {
      fill(p.point);
      s.points.add(s.grid.local_number(p.cell), p.point);
    }
  s.points.settle();
}

#endif
