// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The transfer kernels on random points in distorted cells, against
//
// - deal.II: shape functions of FE_Q<2>(1) under MappingQ1, and 2 x 2 Gauss
//   integration of an affine stress in full cells;
// - sums over the points written out: mass, momentum, force, the consistent
//   mass matrix, the bound of the stiffness;
// - closed forms of the point update: linear velocity fields, a rotation, the
//   volume mean of the divergence, the limiter;
// - each other: the same kernels for all instruction sets of this CPU.
#include <caisson_mpm/kernels/dispatch.h>
#include <caisson_mpm/kernels/grid_to_points.h>
#include <caisson_mpm/kernels/points_to_grid.h>

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>

#include <deal.II/grid/tria.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <vector>

using namespace CaissonMPM::Kernels;
using Scalar = Lanes<1>;

std::mt19937 generator(42);

double
uniform(const double a, const double b)
{
  return a + (b - a) * (generator() / 4294967296.);
}

void
verdict(const char *what, const double error, const double tolerance)
{
  std::printf("%s <= %g: %s\n",
              what,
              tolerance,
              error <= tolerance ? "yes" : "no");
  if (!(error <= tolerance))
    std::printf("  found %.3e\n", error);
}

/** N_I and grad N_I at a place of a cell. */
struct Shape
{
  double value[4], d_dr[4], d_dz[4];

  Shape(const CellGeometry &g, const double r, const double z)
  {
    const CellMap<>          map(g);
    const LocalPoint<Scalar> p = map.at_position(Scalar(r), Scalar(z));
    for (int i = 0; i < 4; ++i)
      {
        double corner[4] = {0., 0., 0., 0.}, c[4];
        corner[i]        = 1.;
        coefficients(corner, c);
        Scalar dr, dz;
        gradient(c, p, map.inverse_width, dr, dz);
        value[i] = evaluate(c, p)[0];
        d_dr[i]  = dr[0];
        d_dz[i]  = dz[0];
      }
  }
};



// ------------------------------------------------------------ the scene

constexpr unsigned int n_cells = 6, n_nodes = 12; // 3 x 2 cells

struct Point
{
  unsigned int cell;
  double       r, z, v[2], s[4], mass, volume;
};

struct Scene
{
  double                     axisymmetric;
  std::vector<int>           neighbors = std::vector<int>(4 * n_cells, -1);
  std::vector<CellGeometry>  geometry;
  std::vector<CellNodes>     nodes;
  std::vector<unsigned char> flags;
  std::vector<Point>         points;
  std::vector<PointBlock>    blocks;
  std::vector<PointHistory>  histories;
  std::vector<BlockHeader>   headers;
  std::vector<int>           first;
  std::vector<unsigned int>  active;
  std::vector<double>        filled;
  std::vector<unsigned char> changed;
  Material                   material;

  GridView
  grid() const
  {
    return {geometry.data(),
            nodes.data(),
            flags.data(),
            neighbors.data(),
            axisymmetric};
  }
  PointsView
  view()
  {
    histories.resize(blocks.size());
    return {blocks.data(),
            histories.data(),
            headers.data(),
            first.data(),
            active.data(),
            n_cells,
            filled.data(),
            changed.data()};
  }
};

constexpr double E = 1e6, nu = .3;

constexpr double surrounding = -1.7; // added to the normal stresses

// full from 0.9 of the volume on, here the cells 0, 2 and 4
const IntegrationSettings gauss      = {.9, .9, true, false, surrounding},
                          gauss_mean = {.9, .9, true, true, surrounding},
                          at_points  = {1e300, 1e300, true, false, surrounding};

/** Cells 0, 2, 4 are filled, the others by a third. The stress of the points
 * is random, or affine. */
Scene
make_scene(const double axisymmetric, const bool affine)
{
  Scene s;
  s.axisymmetric    = axisymmetric;
  const double r[4] = {.5, .9, 1.5, 1.8};
  double       z[3][4];
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 4; ++i)
      z[j][i] = .6 * j + uniform(-.15, .15);
  for (unsigned int j = 0; j < 2; ++j)
    for (unsigned int i = 0; i < 3; ++i)
      {
        s.geometry.push_back({r[i],
                              r[i + 1] - r[i],
                              z[j][i],
                              z[j][i + 1],
                              z[j + 1][i] - z[j][i],
                              z[j + 1][i + 1] - z[j][i + 1]});
        const unsigned int n = 4 * j + i;
        s.nodes.push_back({{n, n + 1, n + 4, n + 5}});
      }
  s.flags              = {0, 0, next_to_body, 0, 0, next_to_body};
  const double a[4][3] = {{-3e3, 4e2, 2e3},
                          {-5e3, 1e2, 3e3},
                          {-2e3, 3e2, 1e3},
                          {5e2, -2e2, 7e2}};
  for (unsigned int c = 0; c < n_cells; ++c)
    {
      const CellGeometry &g = s.geometry[c];
      const unsigned int  n = 9 + 4 * c;
      for (unsigned int k = 0; k < n; ++k)
        {
          Point        p;
          const double xi = uniform(0., 1.), eta = uniform(0., 1.);
          p.cell = c;
          p.r    = g.left + g.width * xi;
          p.z    = g.bottom_left + (g.bottom_right - g.bottom_left) * xi +
                (g.height_left + (g.height_right - g.height_left) * xi) * eta;
          p.volume =
            CellMap<>(g).volume(axisymmetric) / n * (c % 2 == 0 ? 1. : .33);
          p.mass = 1900. * p.volume * uniform(.9, 1.1);
          for (double &v : p.v)
            v = uniform(-1., 1.);
          for (int i = 0; i < 4; ++i)
            p.s[i] = affine ? a[i][0] + a[i][1] * p.r + a[i][2] * p.z :
                              uniform(-1e4, 1e4);
          s.points.push_back(p);
        }
    }
  s.material.body_force[0]  = .3;
  s.material.body_force[1]  = -9.;
  s.material.p_wave_modulus = E * (1. - nu) / ((1. + nu) * (1. - 2. * nu));
  set_law<LinearElastic>(s.material, LinearElastic::Parameters::make(E, nu));
  return s;
}

/** Bring the points into blocks, padded as the class MaterialPoints does. */
void
fill_blocks(Scene &s)
{
  s.blocks.clear();
  s.headers.clear();
  s.first.assign(n_cells, -1);
  s.filled.assign(n_cells, 0.);
  s.changed.assign(n_cells, true);
  s.active.clear();
  for (unsigned int c = 0; c < n_cells; ++c)
    {
      s.active.push_back(c);
      std::vector<Point> mine;
      for (const Point &p : s.points)
        if (p.cell == c)
          {
            mine.push_back(p);
            s.filled[c] += p.volume;
          }
      for (unsigned int k = 0; k < mine.size(); k += 8)
        {
          const int b     = s.blocks.size();
          const int count = std::min<int>(8, mine.size() - k);
          (k == 0 ? s.first[c] : s.headers.back().next) = b;
          s.headers.push_back({-1, static_cast<short>(count), 0});
          s.blocks.push_back(PointBlock());
          PointBlock &block = s.blocks.back();
          for (int lane = 0; lane < 8; ++lane)
            {
              const Point &p         = mine[lane < count ? k + lane : k];
              block.r[lane]          = p.r;
              block.z[lane]          = p.z;
              block.velocity_r[lane] = p.v[0];
              block.velocity_z[lane] = p.v[1];
              for (int i = 0; i < 4; ++i)
                block.stress[i][lane] = p.s[i];
              block.mass[lane]   = lane < count ? p.mass : 0.;
              block.volume[lane] = lane < count ? p.volume : 0.;
            }
        }
    }
}

/** Call action(block, lane, point) for all points, in their order. */
void
for_all(Scene                                                       &s,
        const std::function<void(PointBlock &, int, const Point &)> &action)
{
  unsigned int i = 0;
  for (unsigned int c = 0; c < n_cells; ++c)
    for (int b = s.first[c]; b >= 0; b = s.headers[b].next)
      for (int lane = 0; lane < s.headers[b].count; ++lane)
        action(s.blocks[b], lane, s.points[i++]);
}



// ------------------------------------------------------------ shape functions

void
check_shape_functions()
{
  double map = 0., value = 0., grad = 0., volume = 0.;
  for (unsigned int k = 0; k < 50; ++k)
    {
      const CellGeometry            g = {uniform(0., 3.),
                                         uniform(.1, 2.),
                                         uniform(-1., 1.),
                                         uniform(-1., 1.),
                                         uniform(.2, 2.),
                                         uniform(.2, 2.)};
      std::vector<dealii::Point<2>> v;
      v.emplace_back(g.left, g.bottom_left);
      v.emplace_back(g.left + g.width, g.bottom_right);
      v.emplace_back(g.left, g.bottom_left + g.height_left);
      v.emplace_back(g.left + g.width, g.bottom_right + g.height_right);
      dealii::CellData<2> cell;
      cell.vertices = {0, 1, 2, 3};
      dealii::Triangulation<2> triangulation;
      triangulation.create_triangulation(v, {cell}, dealii::SubCellData());
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

struct Sums
{
  std::vector<NodalSums>   node;
  std::vector<CellMoments> moments;
};

Sums
collect(Scene                     &s,
        const KernelTable         &kernels,
        const IntegrationSettings &settings)
{
  Sums sums = {std::vector<NodalSums>(n_nodes, NodalSums()),
               std::vector<CellMoments>(n_cells)};
  kernels.points_to_grid(s.view(),
                         s.grid(),
                         &s.material,
                         settings,
                         sums.node.data(),
                         sums.moments.data());
  return sums;
}

void
add_force(NodalSums                  &n,
          const Shape                &N,
          const int                   i,
          const double                volume,
          const std::array<double, 4> s, // rr zz tt rz
          const double                kappa_over_r)
{
  n.force[0] -= volume * (N.d_dr[i] * (s[0] + surrounding) + N.d_dz[i] * s[3] +
                          kappa_over_r * N.value[i] * (s[2] + surrounding));
  n.force[1] -= volume * (N.d_dr[i] * s[3] + N.d_dz[i] * (s[1] + surrounding));
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
                   det          = r1 * z2 - r2 * z1;
      const CellGeometry     &g = s.geometry[c];
      const dealii::QGauss<2> gauss(2);
      for (unsigned int q = 0; q < 4; ++q)
        {
          const double xi = gauss.point(q)[0], eta = gauss.point(q)[1];
          const double r = g.left + g.width * xi;
          const double height =
            g.height_left + (g.height_right - g.height_left) * xi;
          const double z = g.bottom_left +
                           (g.bottom_right - g.bottom_left) * xi + height * eta;
          const double a = ((r - p[0]->r) * z2 - (z - p[0]->z) * r2) / det,
                       b = ((z - p[0]->z) * r1 - (r - p[0]->r) * z1) / det;
          std::array<double, 4> stress;
          for (int i = 0; i < 4; ++i)
            stress[i] = p[0]->s[i] + a * (p[1]->s[i] - p[0]->s[i]) +
                        b * (p[2]->s[i] - p[0]->s[i]);
          for (int i = 0; i < 4; ++i)
            add_force(sums.node[s.nodes[c].node[i]],
                      Shape(g, r, z),
                      i,
                      gauss.weight(q) * g.width * height *
                        (s.axisymmetric * r + 1. - s.axisymmetric),
                      stress,
                      s.axisymmetric / r);
        }
    }
  return sums;
}

double
difference(const Sums &a, const Sums &b)
{
  double mass = 0., momentum = 0., force = 0.;
  for (unsigned int n = 0; n < n_nodes; ++n)
    {
      mass = std::max(mass, std::abs(a.node[n].mass - b.node[n].mass));
      for (int d = 0; d < 2; ++d)
        {
          momentum =
            std::max(momentum,
                     std::abs(a.node[n].momentum[d] - b.node[n].momentum[d]));
          force =
            std::max(force, std::abs(a.node[n].force[d] - b.node[n].force[d]));
        }
    }
  return std::max({mass / 1e3, momentum / 1e3, force / 1e4});
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
      fit_stress(map, points.sum, sums.sum, false, fit);
      const double share = std::min(1., half_width * half_width / .02);
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

/** A cell filled by a third is full inside the soil, not at a free surface. */
void
check_full_cells()
{
  Scene s = make_scene(1., true);
  fill_blocks(s);
  s.first.push_back(-1);            // a cell without points
  s.neighbors[4 * 1 + 3] = n_cells; // above cell 1
  const Sums sums =
    collect(s, *select_kernels("auto"), {.9, .3, true, false, 0.});
  std::printf("full cells:");
  for (unsigned int c = 0; c < n_cells; ++c)
    std::printf(" %d", sums.moments[c].full);
  std::printf("\n");
}

/** M x, and the null space of XPIC that follows from it. */
void
check_mass_matrix()
{
  Scene s = make_scene(1., false);
  fill_blocks(s);
  const KernelTable       &kernels = *select_kernels("auto");
  const Sums               sums    = collect(s, kernels, gauss);
  std::vector<NodalVector> x(n_nodes), y(n_nodes), exact(n_nodes), one(n_nodes),
    lumped(n_nodes);
  for (unsigned int n = 0; n < n_nodes; ++n)
    for (int d = 0; d < 2; ++d)
      {
        x[n].value[d]   = uniform(-1., 1.);
        one[n].value[d] = 1.;
        y[n].value[d] = exact[n].value[d] = lumped[n].value[d] = 0.;
      }
  kernels.apply_mass(
    s.view(), s.grid(), sums.moments.data(), x.data(), y.data());
  kernels.apply_mass(
    s.view(), s.grid(), sums.moments.data(), one.data(), lumped.data());
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



// ------------------------------------------------------------ grid to points

/** One update with a nodal velocity field v(r, z) for all purposes. */
LeavingPoints
update(Scene                                                      &s,
       const KernelTable                                          &kernels,
       const UpdateSettings                                       &settings,
       const std::function<std::array<double, 2>(double, double)> &v,
       std::vector<CellMoments>                                    moments,
       std::vector<CellMoments> *kept = nullptr)
{
  static std::vector<LeavingPoint> leaving(1000);
  std::vector<NodalVector>         field(n_nodes);
  for (unsigned int c = 0; c < n_cells; ++c)
    for (int i = 0; i < 4; ++i)
      {
        const CellGeometry &g = s.geometry[c];
        const double        r = g.left + (i % 2) * g.width;
        const double        z = (i % 2 ? g.bottom_right : g.bottom_left) +
                         (i / 2) * (i % 2 ? g.height_right : g.height_left);
        const auto w              = v(r, z);
        field[s.nodes[c].node[i]] = {{w[0], w[1]}};
      }
  LeavingPoints result = {leaving.data(), 1000, 0, 0, 0.};
  kernels.grid_to_points(s.view(),
                         s.grid(),
                         s.grid(),
                         &s.material,
                         settings,
                         gauss,
                         {field.data(), field.data(), field.data()},
                         moments.data(),
                         result);
  if (kept != nullptr)
    *kept = moments;
  return result;
}

void
check_linear_field(const double axisymmetric)
{
  Scene s = make_scene(axisymmetric, false);
  fill_blocks(s);
  const std::vector<CellMoments> moments(n_cells, CellMoments());
  const double                   dt = 1e-3, a = .7, b = -1.1, c = .4, keep = .3;
  const auto                     v = [&](const double r, const double z) {
    return std::array<double, 2>{{a * r, b * z + c * r}};
  };
  const LeavingPoints sums = update(
    s, *select_kernels("auto"), {dt, keep, true, 0., 0., 0.}, v, moments);
  double       work = 0.;
  const double M    = E * (1. - nu) / ((1. + nu) * (1. - 2. * nu)),
               l = M * nu / (1. - nu), G = E / (2. * (1. + nu));
  double position = 0., velocity = 0., stress = 0., volume = 0.;
  for_all(s, [&](PointBlock &block, int lane, const Point &p) {
    const auto w = v(p.r, p.z);
    position     = std::max({position,
                             std::abs(block.r[lane] - p.r - dt * w[0]),
                             std::abs(block.z[lane] - p.z - dt * w[1])});
    velocity =
      std::max({velocity,
                std::abs(block.velocity_r[lane] - keep * p.v[0] - w[0]),
                std::abs(block.velocity_z[lane] - keep * p.v[1] - w[1])});
    const double rr = dt * a, zz = dt * b, tt = axisymmetric * dt * a,
                 rz = .5 * dt * c, spin = -.5 * dt * c, trace = rr + zz + tt;
    const double exact[4] = {p.s[0] + 2. * spin * p.s[3] + l * trace +
                               2. * G * rr,
                             p.s[1] - 2. * spin * p.s[3] + l * trace +
                               2. * G * zz,
                             p.s[2] + l * trace + 2. * G * tt,
                             p.s[3] + spin * (p.s[1] - p.s[0]) + 2. * G * rz};
    for (int i = 0; i < 4; ++i)
      stress = std::max(stress, std::abs(block.stress[i][lane] - exact[i]));
    // the mean of the old stress, rotated, and the new one
    const double turn    = 2. * spin * p.s[3];
    const double mean_rr = .5 * (p.s[0] + turn + exact[0]),
                 mean_zz = .5 * (p.s[1] - turn + exact[1]),
                 mean_tt = .5 * (p.s[2] + exact[2]),
                 mean_rz = .5 * (p.s[3] + spin * (p.s[1] - p.s[0]) + exact[3]);
    work += p.volume * (1. + .5 * trace) *
            (mean_rr * rr + mean_zz * zz + mean_tt * tt + 2. * mean_rz * rz);
    volume =
      std::max(volume, std::abs(block.volume[lane] / p.volume - 1. - trace));
  });
  verdict("linear field: position error", position, 1e-13);
  verdict("linear field: velocity error", velocity, 1e-13);
  verdict("linear field: stress error", stress / 1e4, 1e-13);
  verdict("linear field: volume error", volume, 1e-13);
  verdict("linear field: error of the stress work",
          std::abs(sums.stress_work / work - 1.),
          1e-12);
}

/** The work of a uniform stress and strain is that of the cell's volume in full
 * cells, though their points have twice the volume, and of that of the points
 * in the others; the surrounding pressure counts to it. */
void
check_work(const double axisymmetric)
{
  Scene s = make_scene(axisymmetric, false);
  for (Point &p : s.points)
    {
      p.s[0] = p.s[2] = -3.;
      p.s[1]          = -5.;
      p.s[3]          = 0.;
      p.volume *= 2.;
    }
  fill_blocks(s);
  const KernelTable &kernels = *select_kernels("auto");
  const auto         moments = collect(s, kernels, gauss).moments;
  double             volume  = 0.;
  for (unsigned int c = 0; c < n_cells; ++c)
    if (moments[c].full)
      volume += CellMap(s.geometry[c]).volume(axisymmetric);
  unsigned int i = 0;
  for (unsigned int c = 0; c < n_cells; ++c)
    for (int b = s.first[c]; b >= 0; b = s.headers[b].next)
      for (int lane = 0; lane < s.headers[b].count; ++lane, ++i)
        if (!moments[c].full)
          volume += s.points[i].volume;
  // so slow that the stress hardly changes
  const double dt = 1e-12, a = .7, b = -1.1;
  const auto   sums = update(
    s,
    kernels,
    {dt, 0., true, 0., 0., surrounding},
    [&](const double r, const double z) {
      return std::array<double, 2>{{a * r, b * z}};
    },
    moments);
  const double power =
    (-3. + surrounding) * a * (1. + axisymmetric) + (-5. + surrounding) * b;
  verdict("work in full and other cells",
          std::abs(sums.stress_work / (dt * volume * power) - 1.),
          1e-5);
}

/** The moments that an update leaves of the cells that no point left are those
 * of their points. */
void
check_kept_moments(const double axisymmetric)
{
  Scene s = make_scene(axisymmetric, false);
  fill_blocks(s);
  const KernelTable       &kernels = *select_kernels("auto");
  std::vector<CellMoments> kept;
  const LeavingPoints      leaving = update(
    s,
    kernels,
    {1e-3, 0., true, 0., .1, surrounding},
    [](const double r, const double z) {
      return std::array<double, 2>{{r * z, -3. * z}};
    },
    collect(s, kernels, gauss).moments,
    &kept);
  std::vector<CellMoments> fresh(n_cells);
  for (unsigned int c = 0; c < n_cells; ++c)
    {
      fresh[c].full = kept[c].full;
      sum_points<Scalar>(s.view(), s.grid(), &s.material, gauss, c, fresh[c]);
    }
  double       worst = 0.;
  unsigned int n     = 0;
  for (unsigned int c = 0; c < n_cells; ++c)
    {
      bool left = false;
      for (unsigned int i = 0; i < leaving.n; ++i)
        left = left || leaving.points[i].cell == c;
      if (left)
        continue;
      ++n;
      const double *a = kept[c].mass, *b = fresh[c].mass;
      for (unsigned int i = 0; i < 33; ++i)
        worst = std::max(worst, std::abs(a[i] - b[i]) / (1. + std::abs(b[i])));
    }
  verdict("moments kept for the next step, error", worst, 1e-12);
  std::printf("cells that no point left: %s\n", n > 0 ? "some" : "none");
}

/** B-bar: all points of a cell have its mean volume change, and keep their own
 * deviatoric strain. */
void
check_mean_volume(const double axisymmetric)
{
  const std::vector<CellMoments> moments(n_cells, CellMoments());
  const auto                     v = [](const double r, const double z) {
    return std::array<double, 2>{{r * z * z, z * r + z * z * z}};
  };
  Scene with = make_scene(axisymmetric, false);
  fill_blocks(with);
  Scene without = with;
  update(
    with, *select_kernels("auto"), {1e-3, 0., true, 0., 0., 0.}, v, moments);
  update(without,
         *select_kernels("auto"),
         {1e-3, 0., false, 0., 0., 0.},
         v,
         moments);
  double                             spread = 0., largest = 0., deviator = 0.;
  std::vector<std::array<double, 4>> stress;
  std::vector<double>                ratio(n_cells, -1.);
  for_all(with, [&](PointBlock &b, int lane, const Point &p) {
    const double change = b.volume[lane] / p.volume;
    if (ratio[p.cell] < 0.)
      ratio[p.cell] = change;
    spread = std::max(spread, std::abs(change - ratio[p.cell]));
    stress.push_back({{b.stress[0][lane],
                       b.stress[1][lane],
                       b.stress[2][lane],
                       b.stress[3][lane]}});
  });
  unsigned int k = 0;
  for_all(without, [&](PointBlock &b, int lane, const Point &p) {
    largest =
      std::max(largest, std::abs(b.volume[lane] / p.volume - ratio[p.cell]));
    const auto &w = stress[k++];
    deviator =
      std::max({deviator,
                std::abs(w[3] - b.stress[3][lane]),
                std::abs(w[0] - w[1] - b.stress[0][lane] + b.stress[1][lane])});
  });
  // the mean itself, by the divergence theorem on rectangular Gauss points
  double mean = 0.;
  for (unsigned int c = 0; c < n_cells; ++c)
    {
      const CellGeometry     &g = with.geometry[c];
      const dealii::QGauss<2> gauss(2);
      double                  change = 0., volume = 0.;
      for (unsigned int q = 0; q < 4; ++q)
        {
          const double xi = gauss.point(q)[0], r = g.left + g.width * xi;
          const double height =
            g.height_left + (g.height_right - g.height_left) * xi;
          const double z = g.bottom_left +
                           (g.bottom_right - g.bottom_left) * xi +
                           height * gauss.point(q)[1];
          const Shape  N(g, r, z);
          const double dV = height * (axisymmetric * r + 1. - axisymmetric);
          volume += dV;
          for (int i = 0; i < 4; ++i)
            {
              const double x = g.left + (i % 2) * g.width;
              const double y =
                (i % 2 ? g.bottom_right : g.bottom_left) +
                (i / 2) * (i % 2 ? g.height_right : g.height_left);
              const auto w = v(x, y);
              change +=
                dV * (w[0] * (N.d_dr[i] + axisymmetric * N.value[i] / r) +
                      w[1] * N.d_dz[i]);
            }
        }
      mean = std::max(mean, std::abs(ratio[c] - 1. - 1e-3 * change / volume));
    }
  verdict("B-bar: spread of the volume change", spread, 1e-14);
  verdict("B-bar: mean volume change error", mean, 1e-14);
  verdict("B-bar: change of the deviator", deviator / 1e4, 1e-13);
  verdict("B-bar: effect below", largest, 1e-2);
  verdict("B-bar: no effect", 1e-6 / largest, 1.);
}

void
check_limiter()
{
  Scene s = make_scene(1., false);
  fill_blocks(s);
  const std::vector<CellMoments> moments(n_cells, CellMoments());
  const double                   dt = 1e-2, k = .1;
  const auto                     v = [](double, double) {
    return std::array<double, 2>{{6., -8.}};
  };
  const LeavingPoints leaving =
    update(s, *select_kernels("auto"), {dt, 0., false, k, 0., 0.}, v, moments);
  double       error = 0., direction = 0.;
  unsigned int n_limited = 0;
  for_all(s, [&](PointBlock &b, int lane, const Point &p) {
    const CellGeometry &g       = s.geometry[p.cell];
    const bool          at_body = s.flags[p.cell] & next_to_body;
    const double        limit =
      k * std::min({g.width, g.height_left, g.height_right}) / dt;
    const double expected = at_body ? std::min(10., limit) : 10.;
    n_limited += at_body && limit < 10.;
    const double speed = std::hypot(b.velocity_r[lane], b.velocity_z[lane]);
    const double path  = std::hypot(b.r[lane] - p.r, b.z[lane] - p.z) / dt;
    error =
      std::max({error, std::abs(speed - expected), std::abs(path - expected)});
    direction =
      std::max(direction,
               std::abs(8. * b.velocity_r[lane] + 6. * b.velocity_z[lane]));
  });
  verdict("limiter: speed error", error, 1e-10);
  verdict("limiter: change of direction", direction, 1e-12);
  verdict("limiter: firings, miscounted",
          std::abs(double(n_limited) - leaving.n_limited),
          0.);
  verdict("limiter: no firing", 1. / n_limited, 1.);
}

/** The filter moves the stress of full cells to the fit, and no further. */
void
check_stress_filter()
{
  Scene s = make_scene(1., false);
  fill_blocks(s);
  const Sums sums = collect(s, *select_kernels("auto"), gauss);
  const auto rest = [](double, double) {
    return std::array<double, 2>{{0., 0.}};
  };
  update(s,
         *select_kernels("auto"),
         {1e-3, 0., true, 0., 1., 0.},
         rest,
         sums.moments);
  // all of the misfit removed: the stress of a full cell is affine
  double affine = 0., partly = 0.;
  for (unsigned int c = 0; c < n_cells; ++c)
    {
      std::vector<std::array<double, 3>> x; // r, z, sigma_zz
      for_all(s, [&](PointBlock &b, int lane, const Point &p) {
        if (p.cell == c && c % 2 == 0)
          x.push_back({{b.r[lane], b.z[lane], b.stress[1][lane]}});
        if (p.cell == c && c % 2 == 1)
          partly = std::max(partly, std::abs(b.stress[1][lane] - p.s[1]));
      });
      for (unsigned int i = 3; i < x.size(); ++i)
        {
          const double r1 = x[1][0] - x[0][0], z1 = x[1][1] - x[0][1],
                       r2 = x[2][0] - x[0][0], z2 = x[2][1] - x[0][1],
                       det = r1 * z2 - r2 * z1, r = x[i][0] - x[0][0],
                       z     = x[i][1] - x[0][1];
          const double value = x[0][2] +
                               (r * z2 - z * r2) / det * (x[1][2] - x[0][2]) +
                               (z * r1 - r * z1) / det * (x[2][2] - x[0][2]);
          affine = std::max(affine, std::abs(value - x[i][2]));
        }
    }
  verdict("filter: misfit left in full cells", affine / 1e4, 1e-9);
  verdict("filter: change in other cells", partly / 1e4, 1e-14);
}



// ------------------------------------------------------- instruction sets

void
check_instruction_sets()
{
  double       worst = 0.;
  unsigned int n     = 0;
  for (const double axisymmetric : {0., 1.})
    {
      Scene s = make_scene(axisymmetric, false);
      fill_blocks(s);
      const auto v = [](const double r, const double z) {
        return std::array<double, 2>{{.3 * r * z, -.5 * z + r}};
      };
      Scene      base = s;
      const Sums a    = collect(base, *select_kernels("SSE2"), gauss);
      update(base,
             *select_kernels("SSE2"),
             {1e-3, .5, true, .7, .1, 0.},
             v,
             a.moments);
      for (const char *name : {"AVX2", "AVX-512"})
        if (const KernelTable *kernels = select_kernels(name))
          {
            Scene      other = s;
            const Sums b     = collect(other, *kernels, gauss);
            worst            = std::max(worst, difference(a, b));
            update(other, *kernels, {1e-3, .5, true, .7, .1, 0.}, v, b.moments);
            for (unsigned int i = 0; i < base.blocks.size(); ++i)
              {
                const double *x = reinterpret_cast<double *>(&base.blocks[i]),
                             *y = reinterpret_cast<double *>(&other.blocks[i]);
                for (unsigned int j = 0; j < sizeof(PointBlock) / 8; ++j)
                  if (j % 8 < static_cast<unsigned int>(base.headers[i].count))
                    worst =
                      std::max(worst,
                               std::abs(x[j] - y[j]) / (1. + std::abs(x[j])));
              }
            ++n;
          }
    }
  verdict("all instruction sets of this CPU: difference", worst, 1e-12);
  std::printf("unknown instruction set: %s\n",
              select_kernels("NEON") == nullptr ? "refused" : "accepted");
}

int
main()
{
  check_shape_functions();
  for (const double axisymmetric : {0., 1.})
    {
      std::printf("%s\n", axisymmetric > 0. ? "axisymmetric" : "plane strain");
      check_sums(axisymmetric);
      check_linear_field(axisymmetric);
      check_mean_volume(axisymmetric);
    }
  std::printf("both\n");
  check_mean_pressure();
  check_narrow_band();
  check_full_cells();
  check_full_stiffness();
  check_mass_matrix();
  check_stiffness_bound();
  check_limiter();
  check_stress_filter();
  for (const double axisymmetric : {0., 1.})
    {
      check_work(axisymmetric);
      check_kept_moments(axisymmetric);
    }
  check_instruction_sets();
}
