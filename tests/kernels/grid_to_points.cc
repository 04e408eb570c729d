// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the kernel does to random points in distorted cells, against
//
// - closed forms: linear velocity fields, the limiter, the stress filter, the
// work
//   of the stress;
// - the sums over the points that the update leaves for the next step.
#include "kernel_scene.h"

/** The components of a stress that has turned by @p angle, from z to r. */
std::array<double, 4>
turned(const double *s, const double angle)
{
  const double c = std::cos(angle), d = std::sin(angle);
  return {{c * c * s[0] + d * d * s[1] + 2. * c * d * s[3],
           d * d * s[0] + c * c * s[1] - 2. * c * d * s[3],
           s[2],
           (c * c - d * d) * s[3] + c * d * (s[1] - s[0])}};
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
  const UpdateResult sums =
    update(s, *select_kernels("auto"), {dt, keep, true, 0., 0.}, v, moments);
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
    const std::array<double, 4> start      = turned(p.s, .5 * spin);
    std::array<double, 4>       end        = start;
    const double                elastic[4] = {2. * G * rr,
                                              2. * G * zz,
                                              2. * G * tt,
                                              2. * G * rz};
    for (int i = 0; i < 4; ++i)
      end[i] += elastic[i] + (i < 3 ? l * trace : 0.);
    const std::array<double, 4> exact = turned(end.data(), .5 * spin);
    for (int i = 0; i < 4; ++i)
      stress = std::max(stress, std::abs(block.stress[i][lane] - exact[i]));
    // the mean of both stresses in the middle of the turn
    work += p.volume * (1. + .5 * trace) * .5 *
            ((start[0] + end[0]) * rr + (start[1] + end[1]) * zz +
             (start[2] + end[2]) * tt + 2. * (start[3] + end[3]) * rz);
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
 * cells, though their points have twice the volume, that of the points' volume
 * in empty ones, and a mixture in between. */
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
    volume += moments[c].full * CellMap(s.geometry[c]).volume(axisymmetric);
  unsigned int i = 0;
  for (unsigned int c = 0; c < n_cells; ++c)
    for (int b = s.first[c]; b >= 0; b = s.next[b])
      for (int lane = 0; lane < s.headers[b].count; ++lane, ++i)
        volume += (1. - moments[c].full) * s.points[i].volume;
  // so slow that the stress hardly changes
  const double dt = 1e-12, a = .7, b = -1.1;
  const auto   sums = update(
    s,
    kernels,
    {dt, 0., true, 0., 0.},
    [&](const double r, const double z) {
      return std::array<double, 2>{{a * r, b * z}};
    },
    moments);
  const double power = -3. * a * (1. + axisymmetric) - 5. * b;
  verdict("work in full, mixed and empty cells",
          std::abs(sums.stress_work / (dt * volume * power) - 1.),
          1e-5);
}



/** The work of a full cell is the integral of the plane through the work of its
 * points, wherever these are: also near the axis, and where sides differ. */
void
check_work_of_plane(const double axisymmetric)
{
  const double xi[] = {.2, .7, .9, .4}, eta[] = {.1, .9, .3, .7},
               m[] = {1., 2., 1.5, .5};
  // by Gauss integration, exact for the cubic r (dz/deta) q
  const double gauss[] = {.11270166537925831, .5, .88729833462074169},
               share[] = {5. / 18., 8. / 18., 5. / 18.};
  const auto q         = [](const double x, const double y) {
    return 2. + 3. * x - 5. * y;
  };
  double error = 0.;
  for (const double left : {0., .1, 5.})
    for (const double right_height : {.2, .3})
      {
        CellMap<> map;
        map.left         = left;
        map.width        = .25;
        map.height       = .2;
        map.height_slope = right_height - map.height;
        double sums[3] = {0., 0., 0.}, mass[9] = {}, exact = 0.;
        for (int i = 0; i < 4; ++i)
          {
            const double x = xi[i], y = eta[i], w = m[i] * q(x, y),
                         of_mass[] = {1., x, y, x * y, x * x, y * y};
            sums[0] += w;
            sums[1] += w * x;
            sums[2] += w * y;
            for (int k = 0; k < 6; ++k)
              mass[k] += m[i] * of_mass[k];
          }
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            exact += share[i] * share[j] * map.width *
                     (map.height + map.height_slope * gauss[i]) *
                     (axisymmetric * (left + map.width * gauss[i]) + 1. -
                      axisymmetric) *
                     q(gauss[i], gauss[j]);
        const Lanes<1> s[]       = {sums[0], sums[1], sums[2]},
                       moments[] = {
                         mass[0], mass[1], mass[2], mass[3], mass[4], mass[5]};
        const double found =
          work_in_full_cells(s,
                             moments,
                             Lanes<1>(map.center_of_volume(axisymmetric)),
                             Lanes<1>(map.volume(axisymmetric)),
                             Lanes<1>(0.))[0];
        error = std::max(error, std::abs(found / exact - 1.));
      }
  verdict("work in a full cell, where it is a plane", error, 1e-12);
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
  const UpdateResult       result = update(
    s,
    kernels,
    {1e-3, 0., true, 0., .1},
    [](const double r, const double z) {
      return std::array<double, 2>{{r * z, -3. * z}};
    },
    collect(s, kernels, gauss).moments,
    &kept);
  std::vector<CellMoments> fresh(n_cells);
  for (unsigned int c = 0; c < n_cells; ++c)
    {
      fresh[c].full = kept[c].full;
      sum_points<Scalar>(s.step(gauss, fresh), s.geometry[c], c);
    }
  double       worst = 0.;
  unsigned int n     = 0;
  for (unsigned int c = 0; c < n_cells; ++c)
    {
      bool left = false;
      for (unsigned int i = 0; i < result.n_leaving; ++i)
        left = left || result.leaving[i].cell == c;
      if (left)
        continue;
      ++n;
      const double *a = kept[c].mass, *b = fresh[c].mass;
      for (unsigned int i = 0; i < 33; ++i)
        worst = std::max(worst, std::abs(a[i] - b[i]) / (1. + std::abs(b[i])));
    }
  verdict("moments kept for the next step, error", worst, 1e-12);
  std::printf("some cells no point left: %s\n", n > 0 ? "yes" : "no");
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
  const UpdateResult result =
    update(s, *select_kernels("auto"), {dt, 0., false, k, 0.}, v, moments);
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
          std::abs(double(n_limited) - result.n_limited),
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
  update(
    s, *select_kernels("auto"), {1e-3, 0., true, 0., 1.}, rest, sums.moments);
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

/** Where some points of a full cell are so many times as stiff as the others,
 * the filter has changed the stress by this, over 1e4. */
double
filtered_beside(const double times_as_stiff)
{
  Scene s = make_scene(1., false);
  fill_blocks(s);
  s.stiffer.p_wave_modulus *= times_as_stiff;
  s.headers[s.next[s.first[0]]].material = 1;
  const Sums sums = collect(s, *select_kernels("auto"), gauss);
  const auto rest = [](double, double) {
    return std::array<double, 2>{{0., 0.}};
  };
  update(
    s, *select_kernels("auto"), {1e-3, 0., true, 0., 1.}, rest, sums.moments);
  double change = 0.;
  for_all(s, [&](PointBlock &b, int lane, const Point &p) {
    if (p.cell == 0)
      change = std::max(change, std::abs(b.stress[1][lane] - p.s[1]));
  });
  return change / 1e4;
}

void
check_filter_of_mixed_cells()
{
  verdict("filter: acts on soils of like stiffness",
          .1 / filtered_beside(1.9),
          1.);
  verdict("filter: moves no stress from stiff to soft soil",
          filtered_beside(2.1),
          1e-14);
}



int
main()
{
  heading("linear velocity field");
  for (const double axisymmetric : {0., 1.})
    {
      std::printf("%s\n", axisymmetric > 0. ? "axisymmetric" : "plane strain");
      check_linear_field(axisymmetric);
    }
  heading("velocity limiter");
  check_limiter();
  heading("stress filter");
  check_stress_filter();
  check_filter_of_mixed_cells();
  heading("work of the stress, and sums for the next step");
  for (const double axisymmetric : {0., 1.})
    {
      check_work(axisymmetric);
      check_work_of_plane(axisymmetric);
      check_kept_moments(axisymmetric);
    }
}
