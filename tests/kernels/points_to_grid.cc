// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the kernels bring from random points in distorted cells to the nodes,
// against
//
// - deal.II: shape functions of FE_Q<2>(1) under MappingQ1, and 2 x 2 Gauss
//   integration of an affine stress in full cells;
// - sums over the points written out: mass, momentum, force, the consistent
//   mass matrix, the bound of the stiffness, the force of a nodal pressure.
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>

#include <deal.II/grid/tria.h>

#include "kernel_scene.h"

/** deal.II's cell of this geometry. */
void
make_cell(const CellGeometry &g, dealii::Triangulation<2> &triangulation)
{
  std::vector<dealii::Point<2>> v;
  v.emplace_back(g.left, g.bottom_left);
  v.emplace_back(g.left + g.width, g.bottom_right);
  v.emplace_back(g.left, g.bottom_left + g.height_left);
  v.emplace_back(g.left + g.width, g.bottom_right + g.height_right);
  dealii::CellData<2> cell;
  cell.vertices = {0, 1, 2, 3};
  triangulation.create_triangulation(v, {cell}, dealii::SubCellData());
}

void
check_shape_functions()
{
  double map = 0., value = 0., grad = 0., volume = 0.;
  for (unsigned int k = 0; k < 50; ++k)
    {
      const CellGeometry       g = {uniform(0., 3.),
                                    uniform(.1, 2.),
                                    uniform(-1., 1.),
                                    uniform(-1., 1.),
                                    uniform(.2, 2.),
                                    uniform(.2, 2.)};
      dealii::Triangulation<2> triangulation;
      make_cell(g, triangulation);
      const dealii::FE_Q<2> fe(1);
      dealii::DoFHandler<2> dofs(triangulation);
      dofs.distribute_dofs(fe);
      const dealii::MappingQ1<2> mapping;
      const dealii::Point<2>     unit(uniform(0., 1.), uniform(0., 1.));
      dealii::FEValues<2>        at_point(mapping,
                                   fe,
                                   dealii::Quadrature<2>(unit),
                                   dealii::update_values |
                                     dealii::update_gradients |
                                     dealii::update_quadrature_points);
      dealii::FEValues<2>        integral(mapping,
                                   fe,
                                   dealii::QGauss<2>(3),
                                   dealii::update_JxW_values |
                                     dealii::update_quadrature_points);
      at_point.reinit(dofs.begin_active());
      integral.reinit(dofs.begin_active());
      const dealii::Point<2>   x = at_point.quadrature_point(0);
      const LocalPoint<Scalar> p =
        CellMap<>(g).at_position(Scalar(x[0]), Scalar(x[1]));
      map = std::max(
        {map, std::abs(p.xi[0] - unit[0]), std::abs(p.eta[0] - unit[1])});
      const Shape shape(g, x[0], x[1]);
      for (unsigned int i = 0; i < 4; ++i)
        {
          value =
            std::max(value,
                     std::abs(shape.value[i] - at_point.shape_value(i, 0)));
          const auto exact = at_point.shape_grad(i, 0);
          grad             = std::max({grad,
                                       std::abs(shape.d_dr[i] - exact[0]),
                                       std::abs(shape.d_dz[i] - exact[1])});
        }
      double exact = 0.;
      for (unsigned int q = 0; q < 9; ++q)
        exact += integral.JxW(q) * integral.quadrature_point(q)[0];
      volume = std::max(volume, std::abs(CellMap<>(g).volume(1.) - exact));
    }
  verdict("inverse map error", map, 1e-12);
  verdict("shape value error", value, 1e-12);
  verdict("shape gradient error", grad, 1e-10);
  verdict("volume error", volume, 1e-12);
}



// ------------------------------------------------------------ points to grid

void
add_force(NodalSums                  &n,
          const Shape                &N,
          const int                   i,
          const double                volume,
          const std::array<double, 4> s, // rr zz tt rz
          const double                kappa_over_r)
{
  n.force[0] -= volume * (N.d_dr[i] * s[0] + N.d_dz[i] * s[3] +
                          kappa_over_r * N.value[i] * s[2]);
  n.force[1] -= volume * (N.d_dr[i] * s[3] + N.d_dz[i] * s[1]);
}

/** The sums as the equations say; the stress of full cells is affine. */
Sums
collect_written_out(const Scene &s, const bool gauss_in_full_cells)
{
  Sums sums = {std::vector<NodalSums>(n_nodes, NodalSums()), {}};
  for (const Point &p : s.points)
    for (int i = 0; i < 4; ++i)
      {
        NodalSums  &n = sums.node[s.nodes[p.cell].node[i]];
        const Shape N(s.geometry[p.cell], p.r, p.z);
        n.mass += p.mass * N.value[i];
        for (int d = 0; d < 2; ++d)
          {
            n.momentum[d] += p.mass * N.value[i] * p.v[d];
            n.force[d] += p.mass * N.value[i] * s.material.body_force[d];
          }
        if (!gauss_in_full_cells || p.cell % 2 == 1)
          add_force(n,
                    N,
                    i,
                    p.volume,
                    {{p.s[0], p.s[1], p.s[2], p.s[3]}},
                    s.axisymmetric / p.r);
      }
  for (unsigned int c = 0; gauss_in_full_cells && c < n_cells; c += 2)
    {
      const Point *p[3] = {nullptr, nullptr, nullptr}; // they fix the function
      for (const Point &q : s.points)
        for (const Point *&slot : p)
          if (q.cell == c && slot == nullptr)
            {
              slot = &q;
              break;
            }
      const double r1 = p[1]->r - p[0]->r, r2 = p[2]->r - p[0]->r,
                   z1 = p[1]->z - p[0]->z, z2 = p[2]->z - p[0]->z,
                   det = r1 * z2 - r2 * z1;
      for (const QuadraturePoint &q :
           gauss_points(s.geometry[c], s.axisymmetric))
        {
          const double a = ((q.r - p[0]->r) * z2 - (q.z - p[0]->z) * r2) / det,
                       b = ((q.z - p[0]->z) * r1 - (q.r - p[0]->r) * z1) / det;
          std::array<double, 4> stress;
          for (int i = 0; i < 4; ++i)
            stress[i] = p[0]->s[i] + a * (p[1]->s[i] - p[0]->s[i]) +
                        b * (p[2]->s[i] - p[0]->s[i]);
          for (int i = 0; i < 4; ++i)
            add_force(sums.node[s.nodes[c].node[i]],
                      Shape(s.geometry[c], q.r, q.z),
                      i,
                      q.volume,
                      stress,
                      s.axisymmetric / q.r);
        }
    }
  return sums;
}

void
check_sums(const double axisymmetric)
{
  const KernelTable &kernels = *select_kernels("auto");
  Scene              s       = make_scene(axisymmetric, true);
  fill_blocks(s);
  verdict("sums, Gauss in full cells, error",
          difference(collect(s, kernels, gauss), collect_written_out(s, true)),
          1e-12);
  s = make_scene(axisymmetric, false);
  fill_blocks(s);
  verdict("sums, material points, error",
          difference(collect(s, kernels, at_points),
                     collect_written_out(s, false)),
          1e-12);
}

/** The mean pressure option: the fit keeps the mean, loses the slopes. */
void
check_mean_pressure()
{
  Scene s = make_scene(1., true);
  fill_blocks(s);
  const Sums affine = collect(s, *select_kernels("auto"), gauss),
             mean   = collect(s, *select_kernels("auto"), gauss_mean);
  double slope = 0., deviator = 0., full = 0.;
  for (unsigned int c = 0; c < n_cells; ++c)
    {
      full += affine.moments[c].full != (c % 2 == 0);
      if (c % 2 == 1)
        continue;
      const double *a = affine.moments[c].fit, *m = mean.moments[c].fit;
      for (int d = 1; d < 3; ++d)
        {
          slope    = std::max(slope, std::abs(m[d] + m[3 + d] + m[6 + d]));
          deviator = std::max(deviator,
                              std::abs(m[d] - m[3 + d] - (a[d] - a[3 + d])) +
                                std::abs(m[9 + d] - a[9 + d]));
        }
    }
  verdict("cells that are full, miscounted", full, 0.);
  verdict("mean pressure: slope of the mean stress", slope / 1e3, 1e-12);
  verdict("mean pressure: change of the deviator", deviator / 1e3, 1e-12);
}

/** Points in a narrow band: the slope across it is reduced, along it exact. */
void
check_narrow_band()
{
  const double slope[2] = {3e3, -2e3};
  double       along = 0., across = 0.;
  for (const double half_width : {0., .05, .3})
    {
      // in a cell of size one at the axis of plane strain
      PointSums<Scalar> points;
      FitSums<Scalar>   sums;
      points.clear();
      sums.clear();
      const CellMap<> cell({0., 1., 0., 0., 1., 1.});
      for (int k = 0; k < 20; ++k)
        {
          const double x    = .1 + (k % 2 ? half_width : -half_width),
                       y    = (k / 2 - 4.5) / 10.;
          const Scalar s[4] = {Scalar(slope[0] * x + slope[1] * y),
                               Scalar(0.),
                               Scalar(0.),
                               Scalar(0.)};
          points.add(cell.at_position(Scalar(x + .5), Scalar(y + .5)),
                     Scalar(2.),
                     Scalar(0.),
                     Scalar(0.));
          sums.add(Scalar(x), Scalar(y), Scalar(2.), s);
        }
      CellMap<Scalar> map;
      map.left = map.bottom = map.bottom_slope = map.height_slope = Scalar(0.);
      map.width = map.inverse_width = map.height = Scalar(1.);
      Scalar fit[12];
      fit_stress(map, 0., points.sum, sums.sum, {Scalar(1.)}, Scalar(1.), fit);
      // the center of the points is 0.1 off that of the cell
      const double variance = half_width * half_width,
                   raised   = variance +
                            192. *
                              std::max(0., 2. / 27. - .5 * (variance + .0825)) *
                              .01,
                   share = variance / std::max(raised, .02);
      along              = std::max(along, std::abs(fit[2][0] / slope[1] - 1.));
      across = std::max(across, std::abs(fit[1][0] / slope[0] - share));
    }
  verdict("narrow band: slope along it, error", along, 1e-12);
  verdict("narrow band: share of the slope across it, error", across, 1e-12);
}

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

/**
 * Cells filled by a third: at their points at a free surface, at Gauss points
 * inside the soil where a tenth is enough, and a mixture of both in between,
 * which changes with the filling of the cell and of those around it.
 */
void
check_mixture()
{
  Scene s = make_scene(1., true);
  fill_blocks(s);
  const auto with = [&](const double full_at_surface,
                        const double full_inside,
                        const double around) {
    s.filled_at_node.assign(n_nodes, around);
    return collect(s,
                   *select_kernels("auto"),
                   {full_at_surface, full_inside, true, PressureSlope::acts});
  };
  double worst = 0.;
  for (const double around : {.5, .55, .6, .7, .75, 1.})
    {
      const Sums mixed = with(.9, .45, around),
                 gauss = with(.05, .05, around), // in all cells
        points         = with(.9, .9, around);   // in those filled by a third
      std::printf("share of the Gauss points, around %.2f:", around);
      for (unsigned int c = 0; c < n_cells; ++c)
        std::printf(" %.3f", mixed.moments[c].full);
      std::printf("\n");
      const double w = mixed.moments[1].full;
      for (unsigned int n = 0; n < n_nodes; ++n)
        for (unsigned int d = 0; d < 2; ++d)
          worst = std::max(worst,
                           std::abs(mixed.node[n].force[d] -
                                    w * gauss.node[n].force[d] -
                                    (1. - w) * points.node[n].force[d]) /
                             std::abs(gauss.node[n].force[d]));
    }
  verdict("force of the mixture, error", worst, 1e-10);
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
  check_shape_functions();
  for (const double axisymmetric : {0., 1.})
    {
      std::printf("%s\n", axisymmetric > 0. ? "axisymmetric" : "plane strain");
      check_sums(axisymmetric);
      check_pressure(axisymmetric);
    }
  std::printf("both\n");
  check_mean_pressure();
  check_narrow_band();
  check_mixture();
  check_full_stiffness();
  check_mass_matrix();
  check_stiffness_bound();
}
