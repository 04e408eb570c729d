// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The force of a pressure that is given at the nodes, against its integral
// written out, and in equilibrium with a uniform stress.
#include "kernel_scene.h"

// ------------------------------------------------------------ pressure

/** The nodal forces of a pressure with the nodal values @p value, each cell
 * integrated as the equation says, over the points or over Gauss points. */
std::vector<NodalVector>
pressure_written_out(const Scene &s, const std::vector<double> &value)
{
  std::vector<NodalVector> force(n_nodes, {{0., 0.}});
  const auto               add = [&](const unsigned int c,
                       const double       r,
                       const double       z,
                       const double       volume) {
    const Shape N(s.geometry[c], r, z);
    double      p = 0.;
    for (int j = 0; j < 4; ++j)
      p += N.value[j] * value[s.nodes[c].node[j]];
    for (int i = 0; i < 4; ++i)
      {
        double *const f = force[s.nodes[c].node[i]].value;
        f[0] += volume * p * (N.d_dr[i] + s.axisymmetric * N.value[i] / r);
        f[1] += volume * p * N.d_dz[i];
      }
  };
  for (const Point &p : s.points)
    if (p.cell % 2 == 1)
      add(p.cell, p.r, p.z, p.volume);
  for (unsigned int c = 0; c < n_cells; c += 2)
    for (const QuadraturePoint &q : gauss_points(s.geometry[c], s.axisymmetric))
      add(c, q.r, q.z, q.volume);
  return force;
}



/** A pressure that differs from node to node, and a uniform one that a stress
 * holds in equilibrium. */
void
check_pressure(const double axisymmetric)
{
  const KernelTable &kernels = *select_kernels("auto");
  Scene              s       = make_scene(axisymmetric, false);
  for (Point &p : s.points)
    {
      p.s[0] = p.s[1] = p.s[2] = 1e4;
      p.s[3]                   = 0.;
    }
  s.material.body_force[0] = s.material.body_force[1] = 0.;
  fill_blocks(s);
  Sums                     sums = collect(s, kernels, gauss);
  const StepContext        step = s.step(gauss, sums.moments);
  std::vector<double>      uneven(n_nodes);
  std::vector<NodalVector> force(n_nodes, {{0., 0.}});
  for (double &p : uneven)
    p = uniform(-1e4, 1e4);
  kernels.pressure_force(step, uneven.data(), force.data());
  const auto exact = pressure_written_out(s, uneven);
  double     error = 0., rest = 0., largest = 0.;
  for (unsigned int n = 0; n < n_nodes; ++n)
    for (int d = 0; d < 2; ++d)
      error = std::max(error, std::abs(force[n].value[d] - exact[n].value[d]));
  verdict("pressure of the nodes, error", error / 1e4, 1e-13);

  const std::vector<double> even(n_nodes, 1e4);
  std::fill(force.begin(), force.end(), NodalVector{{0., 0.}});
  kernels.pressure_force(step, even.data(), force.data());
  for (unsigned int n = 0; n < n_nodes; ++n)
    for (int d = 0; d < 2; ++d)
      {
        rest =
          std::max(rest, std::abs(force[n].value[d] + sums.node[n].force[d]));
        largest = std::max(largest, std::abs(force[n].value[d]));
      }
  verdict("uniform pressure and the same stress, force left",
          rest / largest,
          1e-14);
}



int
main()
{
  heading("force of a nodal pressure");
  for (const double axisymmetric : {0., 1.})
    {
      std::printf("%s\n", axisymmetric > 0. ? "axisymmetric" : "plane strain");
      check_pressure(axisymmetric);
    }
}
