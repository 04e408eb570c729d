// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The force of flowing pore water at the points: against the sum written out,
// the weight that it carries at the critical gradient, and cut cells.
#include "kernel_scene.h"

using Forces = std::vector<NodalVector>;

/** The largest component of a difference of forces. */
double
largest(const Forces &a, const Forces &b)
{
  double result = 0.;
  for (unsigned int n = 0; n < n_nodes; ++n)
    for (int d = 0; d < 2; ++d)
      result = std::max(result, std::abs(a[n].value[d] - b[n].value[d]));
  return result;
}

Forces
force_of(Scene                     &s,
         const std::vector<double> &pressure,
         const std::vector<double> &filled)
{
  const KernelTable &kernels = *select_kernels("auto");
  Sums               sums    = collect(s, kernels, gauss);
  const StepContext  step    = s.step(gauss, sums.moments);
  Forces             force(n_nodes, {{0., 0.}});
  kernels.pressure_gradient_force(step,
                                  pressure.data(),
                                  filled.data(),
                                  force.data());
  return force;
}

/** - sum_p V_p N_I grad p, with the field of a cell that has the lower share
 * @p filled of the height. */
Forces
written_out(const Scene               &s,
            const std::vector<double> &pressure,
            const std::vector<double> &filled)
{
  Forces force(n_nodes, {{0., 0.}});
  for (const Point &p : s.points)
    {
      const double x = filled[p.cell];
      if (x == 0.)
        continue;
      CellGeometry lower = s.geometry[p.cell];
      lower.height_left *= x;
      lower.height_right *= x;
      // above the surface the field is that at the surface
      const double share  = (p.r - lower.left) / lower.width,
                   bottom = lower.bottom_left +
                            share * (lower.bottom_right - lower.bottom_left),
                   height = lower.height_left +
                            share * (lower.height_right - lower.height_left);
      const Shape weight(s.geometry[p.cell], p.r, p.z),
        field(lower, p.r, std::min(p.z, bottom + height));
      double gradient[2] = {0., 0.};
      for (int k = 0; k < 4; ++k)
        {
          const double value = pressure[s.nodes[p.cell].node[k]];
          gradient[0] += value * field.d_dr[k];
          gradient[1] += value * field.d_dz[k];
        }
      for (int k = 0; k < 4; ++k)
        for (int d = 0; d < 2; ++d)
          force[s.nodes[p.cell].node[k]].value[d] -=
            p.volume * weight.value[k] * gradient[d];
    }
  return force;
}

int
main()
{
  for (const double axisymmetric : {0., 1.})
    {
      std::printf("%s\n", axisymmetric > 0. ? "axisymmetric" : "plane strain");
      Scene s = make_scene(axisymmetric, false);
      fill_blocks(s);
      const std::vector<double> full(n_cells, 1.);

      std::vector<double> uneven(n_nodes);
      for (double &p : uneven)
        p = uniform(-1e4, 1e4);
      verdict("pressure of the nodes, error",
              largest(force_of(s, uneven, full), written_out(s, uneven, full)) /
                1e4,
              1e-13);
      std::vector<double> cut(n_cells);
      for (unsigned int c = 0; c < n_cells; ++c)
        cut[c] = c % 3 == 0 ? 0. : uniform(.02, 1.);
      verdict("cut cells, error",
              largest(force_of(s, uneven, cut), written_out(s, uneven, cut)) /
                1e4,
              1e-11);
      const std::vector<double> even(n_nodes, 1e4);
      verdict("uniform pressure, force left",
              largest(force_of(s, even, full), Forces(n_nodes, {{0., 0.}})) /
                1e4,
              1e-13);

      // p = -gamma z carries the weight gamma of each volume, wherever it is
      const double        gamma = 9e3;
      std::vector<double> upward(n_nodes);
      Forces              weight(n_nodes, {{0., 0.}});
      for (unsigned int c = 0; c < n_cells; ++c)
        {
          const CellGeometry &g    = s.geometry[c];
          const double        z[4] = {g.bottom_left,
                                      g.bottom_right,
                                      g.bottom_left + g.height_left,
                                      g.bottom_right + g.height_right};
          for (int k = 0; k < 4; ++k)
            upward[s.nodes[c].node[k]] = -gamma * z[k];
        }
      for (const Point &p : s.points)
        {
          const Shape shape(s.geometry[p.cell], p.r, p.z);
          for (int k = 0; k < 4; ++k)
            weight[s.nodes[p.cell].node[k]].value[1] +=
              gamma * p.volume * shape.value[k];
        }
      verdict("critical gradient, weight left",
              largest(force_of(s, upward, full), weight) / gamma,
              1e-13);
    }
}
