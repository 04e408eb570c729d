// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The material points as they are generated, also in a mesh that is distorted.
#include <caisson_mpm/base/text.h>

#include <deal.II/base/function.h>
#include <deal.II/base/mpi.h>

#include <deal.II/lac/vector.h>

#include <deal.II/numerics/vector_tools_interpolate.h>

#include <deal.II/particles/data_out.h>
#include <deal.II/particles/utilities.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <vector>

#include "../shared/scene.h"

void
check_points()
{
  Scene s(caisson + R"(
    subsection Soil
      set Number of layers = 2
      subsection Layer 2
        set Top depth     = 2
        set Solid density = 2700
        set Porosity      = 0.3
      end
    end
    subsection Time
      set Mass scaling = 4
    end)");
  s.generator.generate(s.grid, s.body.shape(), s.soil, s.points);
  double volume = 0., mass = 0., mr = 0., mz = 0., stress = 0., wrong = 0.;
  std::set<double> ids;
  s.points.for_each([&](const MaterialPoint &p, const unsigned int) {
    volume += p.volume;
    mass += p.mass;
    mr += p.mass * p.position[0];
    mz += p.mass * p.position[1];
    ids.insert(p.id);
    wrong += s.body.shape().contains(p.position, 0.) || p.position[1] > 0. ||
             p.material != (p.position[1] < -2. ? 1u : 0u);
    const double z = p.position[1];
    const double zz =
      8829. * std::max(z, -2.) + .7 * 1700. * 9.81 * std::min(z + 2., 0.);
    stress = std::max({stress,
                       std::abs(p.stress[1] / zz - 1.),
                       std::abs(p.stress[0] / zz - .5),
                       std::abs(p.stress[2] / zz - .5)});
  });
  // the soil: a cylinder without the wall, per radian and with inertia times 4
  const double h = s.body.shape().tip_height(), wall = .5 * (9. - 2.8 * 2.8),
               rho[2] = {.6 * 2500. + .4 * 1000., .7 * 2700. + .3 * 1000.};
  const double V      = 32. * 7. - wall * (.5 - .5 * h);
  const double M      = 4. * (rho[0] * (V - 32. * 5.) + rho[1] * 32. * 5.);
  const double r2     = (27. - 2.8 * 2.8 * 2.8) / 3.;
  const double Mr     = 4. * (rho[0] * (512. / 3. * 2. - r2 * (.5 - .5 * h)) +
                          rho[1] * 512. / 3. * 5.);
  const double wedge =
    -.5 + h + (h - 2. * h) / 3.; // of its volume, near enough
  const double Mz =
    4. *
    (rho[0] * (-32. * 2. + wall * ((.5 - h) * (.5 - h) / 2. - .5 * h * wedge)) -
     rho[1] * 32. * 5. * 4.5);
  verdict("points: volume error", std::abs(volume / V - 1.), 1e-12);
  verdict("points: mass error", std::abs(mass / M - 1.), 1e-12);
  verdict("points: first moment in r, error", std::abs(mr / Mr - 1.), 1e-5);
  verdict("points: first moment in z, error", std::abs(mz / Mz - 1.), 1e-4);
  verdict("points: initial stress error", stress, 1e-12);
  verdict("points in the body, above ground, or in the wrong layer", wrong, 0.);
  verdict("points: ids used twice",
          s.points.n_points() - double(ids.size()),
          0.);
}



/** The spacing rule: soil at rest, and the mesh swept through it. In a column
 * beside the body no cell that is full of soil may be without points. */
void
check_spacing()
{
  const double travel = 3.5;
  Scene        s(caisson, travel);
  s.generator.generate(s.grid, s.body.shape(), s.soil, s.points);
  std::vector<dealii::Point<2>> x;
  s.points.for_each([&](const MaterialPoint &p, const unsigned int) {
    x.push_back(p.position);
  });
  std::sort(x.begin(), x.end(), [](const auto &a, const auto &b) {
    return a[0] < b[0];
  });
  unsigned int empty = 0, few = 0, n_cells = 0;
  for (unsigned int k = 0; k <= 40; ++k)
    {
      s.grid.prepare_motion(travel * k / 40.);
      s.grid.advance();
      for (unsigned int c = 0; c < s.grid.n_cells(); ++c)
        {
          const auto &g = s.grid.geometry(c);
          // whole cells below the surface, outside the path of the wall
          if (s.grid.is_rigid(c) ||
              std::max(g.bottom_left + g.height_left,
                       g.bottom_right + g.height_right) > 0. ||
              (g.left > 2.7 && g.left < 2.99))
            continue;
          unsigned int n     = 0;
          const auto   first = std::lower_bound(
            x.begin(), x.end(), g.left, [](const auto &p, const double r) {
              return p[0] < r;
            });
          for (auto p = first; p != x.end() && (*p)[0] < g.left + g.width; ++p)
            {
              const double xi     = ((*p)[0] - g.left) / g.width,
                           bottom = g.bottom_left +
                                    xi * (g.bottom_right - g.bottom_left),
                           height = g.height_left +
                                    xi * (g.height_right - g.height_left);
              n += (*p)[1] >= bottom && (*p)[1] < bottom + height;
            }
          ++n_cells;
          empty += n == 0;
          few += n < 2;
        }
    }
  std::printf("cells swept: %s\n", n_cells > 1000 ? "many" : "few");
  verdict("cells that ran empty", empty, 0.);
  verdict("cells with less than two points", few, 0.);
}



/** A region, random positions, uniform stress, initial velocity. */
void
check_point_options()
{
  const std::string mesh = R"(
    subsection Grid
      set Geometry     = plane strain
      set Outer radius = 4
      set Bottom       = -4
      set Top          = 1
      set Cell width   = 0.25
      set Cell height  = 0.25
    end
    subsection Soil
      set Initial stress   = uniform
      set Uniform stress   = -1, -2, -3, 4
      set Initial velocity = r - 2*z ; 0.5*z*pi
      subsection Layer 1
        set Law = linear elastic
      end
    end
    )";
  double            sums[3];
  for (const unsigned int seed : {1, 1, 2})
    {
      static unsigned int run = 0;
      Scene               s(mesh + R"(subsection Material points
        set Region           = 1 - (r - 2)^2 - (z + 2)^2
        set Random positions = 0.5
        set Random seed      = )" +
              to_text(seed) + "\nend\n");
      s.generator.generate(s.grid, s.body.shape(), s.soil, s.points);
      double outside = 0., volume = 0., state = 0., farthest = 0., sum = 0.;
      s.points.for_each([&](const MaterialPoint &p, const unsigned int) {
        const double r = p.position[0], z = p.position[1];
        outside += (r - 2.) * (r - 2.) + (z + 2.) * (z + 2.) >= 1.;
        volume += p.volume;
        state = std::max({state,
                          std::abs(p.stress[0] + 1.),
                          std::abs(p.stress[1] + 2.),
                          std::abs(p.stress[2] + 3.),
                          std::abs(p.stress[3] - 4.),
                          std::abs(p.velocity[0] - (r - 2. * z)),
                          std::abs(p.velocity[1] - .5 * z * pi)});
        for (const double x : {r, z}) // parts are 0.125 wide
          farthest =
            std::max(farthest, std::abs(x / .125 - std::floor(x / .125) - .5));
        sum += r * r + z;
      });
      sums[run++] = sum;
      verdict("points outside the region", outside, 0.);
      verdict("region: volume error", std::abs(volume / pi - 1.), 0.02);
      verdict("uniform stress and initial velocity: error", state, 1e-14);
      verdict("random positions: farthest from the lattice", farthest, .25);
      std::printf("random positions reach the limit: %s\n",
                  farthest > .24 ? "yes" : "no");
    }
  std::printf("equal seeds, equal points: %s; other seed: %s\n",
              sums[0] == sums[1] ? "yes" : "no",
              sums[0] == sums[2] ? "equal" : "others");
}



/** Soil ends at the surface, where a body also begins there or just below, and
 * no row between the surface and the tip is flat. */
void
check_start_at_surface()
{
  for (const double depth : {0., .02, .1})
    for (const char *tip : {"flat", "triangular"})
      {
        Scene s(caisson + "subsection Rigid body\nset Initial penetration = " +
                  std::to_string(depth) + "\nset Tip = " + tip + "\nend\n",
                1.);
        s.generator.generate(s.grid, s.body.shape(), s.soil, s.points);
        double volume = 0., highest = -1.;
        s.points.for_each([&](const MaterialPoint &p, const unsigned int) {
          volume += p.volume;
          highest = std::max(highest, p.position[vertical]);
        });
        double lowest_row = 1e9;
        for (unsigned int c = 0; c < s.grid.n_cells(); ++c)
          lowest_row = std::min(lowest_row, height_of(s.grid.geometry(c)));
        const bool   is_flat = std::string(tip) == "flat";
        const double area =
                       is_flat ? .2 * depth : depth * depth / std::tan(pi / 3.),
                     missing = 8. * 8. / 2. * 7. - 2.9 * area - volume,
                     cell    = 2.9 * .1 * .1;
        std::printf("%s tip at %.2f m: ", tip, depth);
        // a quarter of each cell that both the surface and the tip cross
        verdict("volume error in cells", std::abs(missing) / cell, 1.);
        verdict("soil above the surface", std::max(0., highest), 0.);
        verdict("flattest row, cells too flat",
                std::max(0., .5 - lowest_row / .1),
                0.);
      }
}


/** Refinement and distortion: sides, surface and layers stay where they are. */
void
check_distortion()
{
  const std::string mesh = R"(
    subsection Grid
      set Outer radius = 4
      set Bottom       = -4
      set Top          = 1
      set Refinement   = 2
    end
    subsection Soil
      set Number of layers = 2
      subsection Layer 2
        set Top depth = 2
      end
    end
    )";
  Scene             regular(mesh);
  Scene             s(mesh + "subsection Grid\nset Distortion = 0.3\nend\n");
  double            width = 0., straight = 0., shift_r = 0., shift_z = 0.;
  for (unsigned int c = 0; c < regular.grid.n_cells(); ++c)
    width = std::max(width,
                     std::abs(regular.grid.geometry(c).width - .5) +
                       std::abs(regular.grid.geometry(c).height_left - .5));
  std::set<double> heights;
  for (unsigned int n = 0; n < s.grid.n_nodes(); ++n)
    {
      const double r = regular.grid.r_of(n), z = regular.grid.z_of(n);
      const double dr = std::abs(s.grid.r_of(n) - r),
                   dz = std::abs(s.grid.z_of(n) - z);
      shift_r         = std::max(shift_r, dr);
      shift_z         = std::max(shift_z, dz);
      if (r == 0. || r == 4.)
        straight = std::max({straight, dr, dz});
      if (z == -4. || std::abs(z + 2.) < 1e-9 || std::abs(z) < 1e-9 || z == 1.)
        straight = std::max(straight, dz);
      if (std::abs(z + 3.) < 1e-9)
        heights.insert(dz);
    }
  std::printf("refined: %d x %d cells\n",
              int(s.lines.n_columns()),
              int(s.lines.n_rows()));
  verdict("refined cells: size error", width, 1e-12);
  verdict("distorted: shift of sides, surface and layers", straight, 0.);
  verdict("distorted: largest shift over its limit",
          std::max(shift_r, shift_z) / .15,
          1.);
  std::printf("distorted: rows bend: %s, shifts reach the limit: %s\n",
              heights.size() == 8 ? "yes" : "no",
              std::min(shift_r, shift_z) > .08 ? "yes" : "no");
  s.generator.generate(s.grid, s.body.shape(), s.soil, s.points);
  double volume = 0.;
  s.points.for_each(
    [&](const MaterialPoint &p, const unsigned int) { volume += p.volume; });
  std::printf("distorted: %d points\n", int(s.points.n_points()));
  verdict("distorted: volume error", std::abs(volume / 32. - 1.), 1e-12);
}



/** Kernels leave out registers with nothing but padding. A point that begins
 * such a register finds a padding that is up to date again. */
void
check_padding()
{
  Scene s(caisson);
  s.generator.generate(s.grid, s.body.shape(), s.soil, s.points);
  MaterialPoint point;
  s.points.for_each(
    [&](const MaterialPoint &p, const unsigned int) { point = p; });
  unsigned int air = 0;
  while (s.points.view().first_block[air] >= 0 || s.grid.is_rigid(air))
    ++air;
  double wrong = 0.;
  for (int n = 1; n <= Kernels::block_size; ++n)
    {
      s.points.add(air, point);
      s.points.settle();
      const Kernels::PointsView points = s.points.view();
      Kernels::PointBlock      &block  = points.blocks[points.first_block[air]];
      for (const int width : {2, 4}) // of a register
        for (int lane = n; n % width == 1 && lane % width != 0; ++lane)
          wrong += block.r[lane] != block.r[0] || block.mass[lane] != 0. ||
                   block.volume[lane] != 0.;
      for (int lane = n; lane < Kernels::block_size; ++lane)
        block.r[lane] = 0.; // what a kernel leaves behind may be anything
    }
  verdict("padding: lanes that do not repeat the first", wrong, 0.);
}



/** The blocks of a cell that are not where they belong: those of a material
 * come together, and all but the last of them are full. */
unsigned int
n_out_of_order(const MaterialPoints::ParticleHandler &particles,
               const BackgroundGrid                  &grid,
               const unsigned int                     cell)
{
  unsigned int         result = 0;
  std::set<double>     materials;
  Kernels::BlockHeader before = {-1., 0.};
  for (const auto &particle :
       particles.particles_in_cell(grid.cell_iterator(cell)))
    {
      const auto numbers = particle.get_properties();
      if (numbers[0] == before.material)
        result += before.count != Kernels::block_size;
      else
        result += !materials.insert(numbers[0]).second;
      before = {numbers[0], numbers[1]};
    }
  return result;
}

/** The largest error of r as deal.II interpolates it to the particles, by their
 * numbers. */
double
error_of_interpolation(const MaterialPoints::ParticleHandler &particles,
                       const BackgroundGrid                  &grid)
{
  dealii::Vector<double> at_nodes(grid.dof_handler().n_dofs()),
    at_particles(particles.get_next_free_particle_index());
  dealii::VectorTools::interpolate(grid.mapping(),
                                   grid.dof_handler(),
                                   dealii::ScalarFunctionFromFunctionObject<2>(
                                     [](const dealii::Point<2> &x) {
                                       return x[0];
                                     }),
                                   at_nodes);
  dealii::Particles::Utilities::interpolate_field_on_particles(
    grid.dof_handler(), particles, at_nodes, at_particles);
  double worst = 0.;
  for (const auto &particle : particles)
    worst = std::max(worst,
                     std::abs(at_particles[particle.get_id()] -
                              particle.get_location()[0]));
  return worst;
}

/** The number of particles that deal.II draws. */
unsigned int
n_drawn(const MaterialPoints::ParticleHandler &particles)
{
  dealii::Particles::DataOut<2> drawing;
  drawing.build_patches(particles);
  std::stringstream text;
  drawing.write_gnuplot(text);
  unsigned int result = 0;
  for (std::string line; std::getline(text, line);)
    result += !line.empty() && line[0] != '#';
  return result;
}

/** Tools of deal.II see the points, as blocks that lie in their cells. */
void
check_particles()
{
  Scene s(caisson);
  s.generator.generate(s.grid, s.body.shape(), s.soil, s.points);
  std::vector<std::pair<unsigned int, MaterialPoint>> others;
  s.points.for_each([&](MaterialPoint p, const unsigned int cell) {
    p.material = 1 + others.size() % 2;
    others.emplace_back(cell, p);
  });
  for (const auto &[cell, p] : others)
    s.points.add(cell, p);
  s.points.settle();
  for (const double size : {.03, .03, .2, .06}) // split and merge
    s.points.adapt([&](const unsigned int) {
      return std::array<double, 2>{{size, size}};
    });
  const auto          &particles = s.points.particles();
  unsigned int         wrong = 0, n_points = 0;
  double               outside = 0.;
  dealii::Tensor<1, 2> moments;
  for (unsigned int cell = 0; cell < s.grid.n_cells(); ++cell)
    wrong += n_out_of_order(particles, s.grid, cell);
  for (const auto &particle : particles)
    {
      const double count = particle.get_properties()[1];
      const auto   x     = s.grid.mapping().transform_real_to_unit_cell(
        particle.get_surrounding_cell(), particle.get_location());
      outside =
        std::max(outside, dealii::GeometryInfo<2>::distance_to_unit_cell(x));
      n_points += static_cast<unsigned int>(count);
      moments += count * particle.get_location();
    }
  s.points.for_each(
    [&](const MaterialPoint &p, const unsigned int) { moments -= p.position; });
  const auto n = particles.n_global_particles();
  std::printf(
    "all points lie in particles: %s, and deal.II draws %s of these\n",
    n_points == s.points.n_points() ? "yes" : "no",
    n_drawn(particles) == n ? "all" : "not all");
  verdict("particles without a number of their own",
          double(n) - particles.locally_owned_particle_ids().n_elements(),
          0.);
  verdict("particles outside their cell, by cells", outside, 1e-12);
  verdict("mean place of the points: error of the sum",
          moments.norm() / n_points,
          1e-12);
  verdict("blocks out of order in their cells", wrong, 0.);
  verdict("interpolation to particles: error",
          error_of_interpolation(particles, s.grid),
          1e-12);
}



/** A law of the user costs more, by its points: ranks share the work by that.
 */
void
check_costs()
{
  const std::string layers   = R"(
    subsection Soil
      set Number of layers = 2
      subsection Layer 2
        set Top depth = 2
      end
    end)";
  double            n_points = 0., cost[2] = {};
  for (const bool by_user : {false, true})
    {
      Scene s(caisson + layers);
      s.points.keep_user_state(0, {false, by_user});
      s.generator.generate(s.grid, s.body.shape(), s.soil, s.points);
      for (const unsigned int of_cell : s.points.cell_costs())
        cost[by_user] += of_cell;
      n_points = 0.;
      s.points.for_each([&](const MaterialPoint &p, const unsigned int) {
        n_points += p.material == 1;
      });
    }
  const double of_point = (cost[1] - cost[0]) / n_points;
  std::printf("a point of a user's law costs some 100 ns more: %s\n",
              of_point > 50. && of_point < 200. ? "yes" : "no");
}



int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  heading("mass, moments and initial stress");
  check_points();
  heading("spacing");
  check_spacing();
  heading("regions and random positions");
  check_point_options();
  heading("points in a refined and distorted mesh");
  check_distortion();
  heading("a body that starts on the surface");
  check_start_at_surface();
  heading("padding of blocks");
  check_padding();
  heading("particles of deal.II");
  check_particles();
  heading("costs of cells");
  check_costs();
  return 0;
}
