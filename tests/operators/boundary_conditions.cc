// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The boundary conditions: what they fix, and prescribed velocities.
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <vector>

#include "../shared/scene.h"

void
check_boundary_conditions()
{
  for (const std::string kind : {"roller", "fixed", "free"})
    {
      Scene s("subsection Grid\nset Inner radius = 1\nset Outer radius = 3\n"
              "set Bottom = -2\nset Top = 0\nend\n"
              "subsection Boundary conditions\nset Axis = " +
              kind + "\nset Side = " + kind + "\nset Bottom = " + kind +
              "\nset Top = " + kind + "\nend\n");
      s.boundary_conditions.initialize(s.grid);
      std::vector<Kernels::NodalVector> v(s.grid.n_nodes(), {{1., 1.}});
      s.boundary_conditions.constrain(v.data());
      // 3 x 3 nodes, from the lower left one
      std::printf("%s:", kind.c_str());
      for (const double z : {-2., -1., 0.})
        for (const double r : {1., 2., 3.})
          for (unsigned int n = 0; n < v.size(); ++n)
            if (std::abs(s.grid.r_of(n) - r) + std::abs(s.grid.z_of(n) - z) <
                1e-9)
              std::printf(" %g%g", v[n].value[0], v[n].value[1]);
      std::printf("\n");
    }
}

/** Prescribed velocities: which nodes, which components, impulse and work. */
void
check_prescribed_velocity()
{
  Scene s(R"(
    subsection Grid
      set Inner radius = 1
      set Outer radius = 3
      set Bottom       = -2
      set Top          = 0
    end
    subsection Boundary conditions
      set Prescribed region   = t - 0.5 - abs(z)
      set Prescribed velocity = free ; r*t
    end)");
  auto &b = s.boundary_conditions;
  b.check_parameters(s.lines);
  b.initialize(s.grid);
  // at t = 1 the rows z = 0; in the middle of the step t = 2
  b.prepare(s.grid, 1., 2.);
  const std::vector<double>         mass(s.grid.n_nodes(), 5.);
  std::vector<Kernels::NodalVector> v(s.grid.n_nodes(), {{1., 1.}}), held = v,
                                                                     zero = v;
  const PrescribedResult result = b.apply(mass, v.data());
  b.constrain(held.data());
  b.constrain_difference(zero.data());
  double error = 0.;
  for (unsigned int n = 0; n < v.size(); ++n)
    {
      const bool   is_top = s.grid.z_of(n) > -1e-9;
      const double r      = s.grid.r_of(n);
      // rollers on both sides
      const double v_r     = r < 1.5 || r > 2.5 ? 0. : 1.;
      const double v_z     = s.grid.z_of(n) < -1.5 ? 0. : is_top ? 2. * r : 1.;
      const double fixed_r = s.grid.z_of(n) < -1.5 ? 0. : v_r;
      error                = std::max({error,
                                       std::abs(v[n].value[0] - fixed_r),
                                       std::abs(v[n].value[1] - v_z),
                                       std::abs(held[n].value[0] - fixed_r),
                                       std::abs(held[n].value[1] - v_z),
                                       std::abs(zero[n].value[0] - fixed_r),
                                       std::abs(zero[n].value[1] - (is_top ? 0. : v_z))});
    }
  verdict("prescribed velocity: error", error, 1e-14);
  // three nodes at r = 1, 2, 3, from 1 to 2 r
  verdict("prescribed velocity: impulse error",
          std::abs(result.impulse[1] / (2. * pi * 5. * (1. + 3. + 5.)) - 1.) +
            std::abs(result.impulse[0]),
          1e-14);
  verdict("prescribed velocity: work error",
          std::abs(result.work / (2. * pi * 5. * (2. + 12. + 30.)) - 1.),
          1e-14);
  b.prepare(s.grid, .4, 0.);
  std::fill(v.begin(), v.end(), Kernels::NodalVector{{1., 1.}});
  const double no_work = b.apply(mass, v.data()).work;
  verdict("nothing prescribed before its time", std::abs(no_work), 0.);
}

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_boundary_conditions();
  check_prescribed_velocity();
  return 0;
}
