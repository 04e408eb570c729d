// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Selective mass scaling: the factors of cells, the operator L, its bound D,
// what its polynomial makes of a body that moves as one, how nodes answer to an
// impulse of contact, and a bar whose factors vary.
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/time_step.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "stepper.h"

/** A disc in a mesh with halved cells, its points at random places. */
const std::string disc = R"(
  subsection Soil
    set Submerged        = false
    set Gravity          = 0, 0
    set Initial stress   = none
    set Initial velocity = 1 ; 2
  end
  subsection Grid
    set Geometry          = plane strain
    set Outer radius      = 3
    set Bottom            = -3
    set Top               = 0
    set Cell width        = 0.25
    set Cell height       = 0.25
    set Distortion        = 0.3
    set Refinement levels = 1
    set Refined region    = 0.5 - r
  end
  subsection Material points
    set Region           = 1 - (r - 1.5)^2 - (z + 1.5)^2
    set Random positions = 1
  end
  )" + free_sides;

/** A bar between two rollers, whose points swing. */
const std::string bar = R"(
  subsection Soil
    set Submerged        = false
    set Gravity          = 0, 0
    set Initial stress   = none
    set Initial velocity = 0 ; sin(2*pi*z/1.2)
    subsection Layer 1
      set Law            = linear elastic
      set Youngs modulus = 8e7
      set Poisson ratio  = 0
      set Porosity       = 0
      set Solid density  = 1000
    end
  end
  subsection Grid
    set Geometry     = plane strain
    set Outer radius = 0.05
    set Bottom       = -1.2
    set Top          = 0
    set Cell width   = 0.05
    set Cell height  = 0.05
  end
  subsection Boundary conditions
    set Axis = roller
    set Side = roller
    set Top  = roller
  end
  )";



double
sum_of_products(const NodalData &x, const NodalData &y)
{
  double sum = 0.;
  for (unsigned int i = 0; i < x.locally_owned_size(); ++i)
    sum += x.local_element(i) * y.local_element(i);
  return sum;
}



/** Halved cells have twice the inertia of their parents, whose size is that of
 * all others. */
void
check_factors()
{
  Stepper  s(R"(
  subsection Grid
    set Geometry          = plane strain
    set Outer radius      = 4
    set Bottom            = -4
    set Top               = 0
    set Cell width        = 0.5
    set Cell height       = 0.5
    set Refinement levels = 1
    set Refined region    = 1 - r
  end
  )",
            "");
  TimeStep time_step;
  auto    &prm = dealii::ParameterAcceptor::prm;
  prm.parse_input_from_string(
    "subsection Time\nset Inertia tolerance = 0.5\nend\n");
  dealii::ParameterAcceptor::parse_all_parameters(prm);
  time_step.follow_tip([]() { return 240.; });
  const BackgroundGrid &grid = s.scene.grid;
  time_step.initialize(*Kernels::select_kernels("auto"),
                       grid,
                       s.scene.points,
                       s.scene.soil,
                       s.materials);
  double       error[2] = {0., 0.};
  unsigned int n[2]     = {0, 0};
  for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
    {
      const int    level = grid.cell_iterator(cell)->level();
      const double found = time_step.inertia_of_deformation()[cell];
      error[level] =
        std::max(error[level], std::abs(found - (level == 0 ? 120. : 240.)));
      ++n[level];
    }
  verdict("0.5 x 240 in cells", n[0] > 0 ? error[0] : 1., 1e-9);
  verdict("twice that in halved ones", n[1] > 0 ? error[1] : 1., 1e-9);
}



/** A node at rest answers to an impulse of contact with its lumped mass. */
void
check_impulse(const BackgroundGrid       &grid,
              const NodalMomentum        &momentum,
              const Kernels::StepContext &step,
              const std::vector<double>  &factors)
{
  const unsigned int              n = grid.n_nodes();
  std::vector<Kernels::NodalSums> nodes(momentum.sums(), momentum.sums() + n);
  for (auto &node : nodes)
    node.deformation_mass = 0.;
  SelectiveMass mass;
  mass.initialize(grid);
  mass.collect(step, factors.data(), nodes.data());
  std::vector<Kernels::NodalVector> v(n, {{0., 0.}}), u = v;
  mass.accelerate(nodes.data(), v.data(), u.data());
  const double impulse[2] = {3., -7.};
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int d = 0; d < 2 && nodes[i].mass > 0.; ++d)
      u[i].value[d] += impulse[d] / nodes[i].mass;
  mass.correct(nodes.data(), v.data(), u.data());
  double       error    = 0.;
  unsigned int n_scaled = 0;
  for (unsigned int i = 0; i < n; ++i)
    if (nodes[i].mass > 0. && nodes[i].deformation_mass > 0.)
      {
        ++n_scaled;
        for (unsigned int d = 0; d < 2; ++d)
          error = std::max(error,
                           std::abs(u[i].value[d] * lumped_mass(nodes[i]) -
                                    impulse[d]));
      }
  verdict("impulse: error", n_scaled > 0 ? error : 1., 1e-12);
}



/** Return the largest eigenvalue of D^-1 (M + L), by the power method from
 * @p x. */
double
largest_eigenvalue(const NodalMomentum &momentum, NodalData &x, NodalData &Lx)
{
  const Kernels::NodalSums *const sums    = momentum.sums();
  double                          largest = 0.;
  for (unsigned int i = 0; i < 300; ++i)
    {
      momentum.selective_mass().apply(x, Lx);
      double energy = 0., bound = 0.;
      for (unsigned int k = 0; k < x.locally_owned_size(); ++k)
        {
          const Kernels::NodalSums &node = sums[k / 2];
          const double D = lumped_mass(node), v = x.local_element(k);
          double      &next = Lx.local_element(k);
          next += node.mass * v;
          energy += v * next;
          bound += D * v * v;
          x.local_element(k) = D > 0. ? next / D : 0.;
        }
      largest = std::max(largest, energy / bound);
      x *= 1. / x.linfty_norm();
    }
  return largest;
}



/** L keeps momentum and lets a body move as one; it is symmetric and
 * semidefinite; D bounds M + L. */
void
check_operator()
{
  Stepper               s(disc, "");
  std::mt19937          random(1);
  const BackgroundGrid &grid = s.scene.grid;
  std::vector<double>   factors(grid.n_cells());
  for (double &factor : factors)
    factor = 1. + random() % 1000;
  NodalMomentum                     momentum;
  std::vector<Kernels::CellMoments> moments(grid.n_cells());
  momentum.initialize(grid);
  const Kernels::KernelTable &kernels = *Kernels::select_kernels("auto");
  const Kernels::StepContext  step    = {s.scene.points.view(),
                                         grid.view(),
                                         s.materials.data(),
                                         s.motion.settings().integration(),
                                         moments.data(),
                                         momentum.filled()};
  momentum.collect({kernels, step, s.scene.points, grid, 0.},
                   factors.data(),
                   s.forces);
  const auto field = [&]() {
    NodalData x;
    grid.reinit(x, 2);
    return x;
  };
  const auto fill = [&](NodalData &x) {
    for (unsigned int i = 0; i < x.locally_owned_size(); ++i)
      x.local_element(i) = random() / std::pow(2., 32) - .5;
  };
  NodalData one = field(), x = field(), y = field(), Lx = field(), Ly = field();
  one = 1.;
  fill(x);
  fill(y);
  const SelectiveMass &mass = momentum.selective_mass();
  mass.apply(one, Ly);
  mass.apply(x, Lx);
  const double size = Lx.l1_norm();
  verdict("translation: inertia", Ly.l1_norm() / size, 1e-14);
  verdict("momentum: error", std::abs(sum_of_products(one, Lx)) / size, 1e-14);
  mass.apply(y, Ly);
  const double xLy = sum_of_products(x, Ly), yLx = sum_of_products(y, Lx);
  verdict("symmetry: error", std::abs(xLy - yLx) / std::abs(xLy), 1e-12);
  const double largest = largest_eigenvalue(momentum, x, Lx);
  verdict("D^-1 (M + L): largest eigenvalue, less 1", largest - 1., 1e-12);
  verdict("  and it is reached", .98 - largest, 0.);
  check_impulse(grid, momentum, step, factors);
}



/** A force on a body that moves as one meets the inertia that the polynomial
 * leaves, a twentieth of what a factor of 1500 has otherwise. */
void
check_translation()
{
  for (const double factor : {1.2, 20., 1500.})
    {
      Stepper s(disc,
                "subsection Method\nset Stress update = USL\n"
                "set Mass floor = false\nend\n"
                "subsection Loads\nset Body force = 3 ; -7\nend\n");
      s.deformation.assign(s.scene.grid.n_cells(), factor);
      const auto before = s.sums();
      s.step();
      const auto    after = s.sums();
      const Vector2 given =
        (1. / (dt * before.mass)) * (after.momentum - before.momentum);
      // T_5 on [1/20, 1]
      const auto T = [](const double x) {
        const double t = (1.05 - 2. * x) / .95;
        return 16. * std::pow(t, 5) - 20. * std::pow(t, 3) + 5. * t;
      };
      const double expected = (1. - T(1. / factor) / T(0.)) / (1. + 1. / T(0.));
      verdict(("factor " + std::to_string(factor).substr(0, 4) +
               ": acceleration, error")
                .c_str(),
              (given - expected * Vector2({3., -7.})).norm(),
              1e-9);
    }
}



/** Return the largest speed over that of the start in a bar that swings at a
 * Courant number of 0.8, with factors of 100 to 400, and two cells at its end
 * whose inertia is lumped. */
double
growth_in_bar(const std::string &update)
{
  Stepper      s(bar,
            "subsection Method\nset FLIP fraction = 1\n"
                 "set Stress update = " +
              update + "\nend\n");
  std::mt19937 random(2);
  const auto   n = s.scene.grid.n_cells();
  for (unsigned int cell = 0; cell < n; ++cell)
    s.deformation.push_back(100. + random() % 300);
  s.translation.assign(n, 1.);
  for (unsigned int cell = 0; cell < n; ++cell)
    if (s.scene.grid.geometry(cell).bottom_left < -1.101)
      s.translation[cell] = s.deformation[cell];
  const double start   = s.sums().max_speed;
  double       largest = 0.;
  for (unsigned int step = 0; step < 20000 && largest < 10. * start; ++step)
    {
      s.step();
      largest = std::max(largest, s.sums().max_speed);
    }
  return largest / start;
}



int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  heading("factors of cells");
  check_factors();
  heading("the operator");
  check_operator();
  heading("a body that moves as one");
  check_translation();
  heading("a bar");
  verdict("USL: largest speed over that of the start",
          growth_in_bar("USL"),
          2.);
  verdict("MUSL, whose speed grows", 10. / growth_in_bar("MUSL"), 1.);
  return 0;
}
