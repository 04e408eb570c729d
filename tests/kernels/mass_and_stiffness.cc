// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The consistent mass matrix, and the bounds of the stiffness that the mass
// floor rests on, against sums over the points written out.
#include "kernel_scene.h"

/** For lumped mass on a regular grid the floor is the mass at Courant one. */
void
check_full_stiffness()
{
  double worst = 0.;
  for (const double width : {.1, .3, 40.})
    {
      const double    height = .1, M = 1e6;
      CellMap<Scalar> map;
      map.left          = Scalar(7.);
      map.width         = Scalar(width);
      map.inverse_width = Scalar(1. / width);
      map.bottom        = Scalar(-1.);
      map.height        = Scalar(height);
      map.bottom_slope = map.height_slope = Scalar(0.);
      Scalar stiffness[4];
      find_full_stiffness(map, 0., Scalar(M), stiffness);
      const double bound =
        M * width * height * (1. / (width * width) + 1. / (height * height));
      for (const Scalar &k : stiffness)
        worst = std::max(worst, std::abs(k[0] / bound - 1.));
    }
  verdict("full cells: bound of the stiffness, error", worst, 1e-12);
}



/** M x, and the null space of XPIC that follows from it. */
void
check_mass_matrix()
{
  Scene s = make_scene(1., false);
  fill_blocks(s);
  const KernelTable       &kernels = *select_kernels("auto");
  Sums                     sums    = collect(s, kernels, gauss);
  std::vector<NodalVector> x(n_nodes), y(n_nodes), exact(n_nodes), one(n_nodes),
    lumped(n_nodes);
  for (unsigned int n = 0; n < n_nodes; ++n)
    for (int d = 0; d < 2; ++d)
      {
        x[n].value[d]   = uniform(-1., 1.);
        one[n].value[d] = 1.;
        y[n].value[d] = exact[n].value[d] = lumped[n].value[d] = 0.;
      }
  const StepContext step = s.step(gauss, sums.moments);
  kernels.apply_mass(step, x.data(), y.data());
  kernels.apply_mass(step, one.data(), lumped.data());
  for (const Point &p : s.points)
    {
      const Shape N(s.geometry[p.cell], p.r, p.z);
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
          for (int d = 0; d < 2; ++d)
            exact[s.nodes[p.cell].node[i]].value[d] +=
              p.mass * N.value[i] * N.value[j] *
              x[s.nodes[p.cell].node[j]].value[d];
    }
  double error = 0., lump = 0.;
  for (unsigned int n = 0; n < n_nodes; ++n)
    for (int d = 0; d < 2; ++d)
      {
        error = std::max(error, std::abs(y[n].value[d] - exact[n].value[d]));
        lump = std::max(lump, std::abs(lumped[n].value[d] - sums.node[n].mass));
      }
  verdict("consistent mass matrix error", error / 1e3, 1e-13);
  verdict("row sums are the nodal masses, error", lump / 1e3, 1e-13);
}



/** The bound of sum_J |K_IJ| that the mass floor rests on. */
void
check_stiffness_bound()
{
  double smallest = 1e300, largest = 0.;
  Scene  s = make_scene(1., false);
  fill_blocks(s);
  const Sums   sums = collect(s, *select_kernels("auto"), at_points);
  const double M = s.material.p_wave_modulus, l = M * nu / (1. - nu),
               G = E / (2. * (1. + nu));
  std::vector<double> row(2 * n_nodes, 0.);
  // per point: the assembled rows are at most the sum of these
  for (const Point &p : s.points)
    {
      const Shape N(s.geometry[p.cell], p.r, p.z);
      double      B[8][4]; // strain rr, zz, tt, engineering rz
      for (int i = 0; i < 4; ++i)
        {
          const double b[2][4] = {{N.d_dr[i], 0., N.value[i] / p.r, N.d_dz[i]},
                                  {0., N.d_dz[i], 0., N.d_dr[i]}};
          for (int d = 0; d < 2; ++d)
            std::copy(b[d], b[d] + 4, B[2 * i + d]);
        }
      for (int a = 0; a < 8; ++a)
        for (int b = 0; b < 8; ++b)
          {
            double k = G * B[a][3] * B[b][3];
            for (int i = 0; i < 3; ++i)
              for (int j = 0; j < 3; ++j)
                k += (i == j ? M : l) * B[a][i] * B[b][j];
            row[2 * s.nodes[p.cell].node[a / 2] + a % 2] +=
              p.volume * std::abs(k);
          }
    }
  for (unsigned int n = 0; n < n_nodes; ++n)
    for (int d = 0; d < 2; ++d)
      {
        const double ratio = sums.node[n].stiffness / row[2 * n + d];
        smallest           = std::min(smallest, ratio);
        largest            = std::max(largest, ratio);
      }
  verdict("stiffness above its bound", 1. / smallest, 1.);
  verdict("bound above the stiffness", largest, 10.);
}



int
main()
{
  heading("stiffness of full cells");
  check_full_stiffness();
  heading("consistent mass matrix");
  check_mass_matrix();
  heading("bound of the stiffness");
  check_stiffness_bound();
}
