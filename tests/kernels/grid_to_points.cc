// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the kernel does to random points in distorted cells, against
//
// - closed forms: linear velocity fields, a rotation, the volume mean of the
//   divergence, the limiter, the stress filter, the work of the stress;
// - the sums over the points that the update leaves for the next step;
// - itself: the same kernels for all instruction sets of this CPU.
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

/** The velocities with which points at these places of the cell 4 move, in a
 * field that is not uniform. */
std::vector<std::array<double, 2>>
moves(Scene                                     s,
      const bool                                mean_volume_change,
      const std::vector<std::array<double, 2>> &places)
{
  std::vector<Point> others; // the other cells have to have points
  for (const Point &p : s.points)
    if (p.cell < 4 || p.cell == 5)
      others.push_back(p);
  s.points.clear();
  for (const Point &p : others)
    {
      if (p.cell == 5 && s.points.back().cell < 4)
        for (const auto &x : places)
          {
            s.points.push_back(p);
            s.points.back().cell = 4;
            s.points.back().r    = x[0];
            s.points.back().z    = x[1];
          }
      s.points.push_back(p);
    }
  fill_blocks(s);
  const double dt = 1e-6;
  update(
    s,
    *select_kernels("auto"),
    {dt, 0., mean_volume_change, 0., 0.},
    [](const double r, const double z) {
      return std::array<double, 2>{{r * z + std::sin(3. * r), z * z - r * z}};
    },
    std::vector<CellMoments>(n_cells, CellMoments()));
  std::vector<std::array<double, 2>> result;
  for_all(s, [&](PointBlock &block, int lane, const Point &p) {
    if (p.cell == 4)
      result.push_back(
        {{(block.r[lane] - p.r) / dt, (block.z[lane] - p.z) / dt}});
  });
  return result;
}

/** How far the divergence of these velocities is from the same in a cell. */
double
spread_of_divergence(const Scene &s, const bool mean_volume_change)
{
  const CellGeometry                &g = s.geometry[4];
  const double                       e = 1e-4;
  std::vector<std::array<double, 2>> places;
  for (const double xi : {.15, .5, .85})
    for (const double eta : {.15, .5, .85})
      {
        const double r = g.left + g.width * xi,
                     z =
                       g.bottom_left + (g.bottom_right - g.bottom_left) * xi +
                       (g.height_left + (g.height_right - g.height_left) * xi) *
                         eta;
        places.insert(places.end(),
                      {{{r - e, z}}, {{r + e, z}}, {{r, z - e}}, {{r, z + e}}});
      }
  const auto v     = moves(s, mean_volume_change, places);
  double     least = 1e300, largest = -1e300;
  for (unsigned int k = 0; k < v.size(); k += 4)
    {
      const double r = .5 * (places[k][0] + places[k + 1][0]);
      const double divergence =
        (v[k + 1][0] - v[k][0] + v[k + 3][1] - v[k + 2][1]) / (2. * e) +
        s.axisymmetric * .5 * (v[k][0] + v[k + 1][0]) / r;
      least   = std::min(least, divergence);
      largest = std::max(largest, divergence);
    }
  return largest - least;
}

/** With B-bar the points of a cell move with nearly the same divergence, and
 * through its sides as they would without. */
void
check_uniform_divergence(const double axisymmetric)
{
  Scene distorted = make_scene(axisymmetric, false), rectangular = distorted;
  for (CellGeometry &g : rectangular.geometry)
    {
      g.bottom_left = g.bottom_right = g.bottom_left > .3 ? .6 : 0.;
      g.height_left = g.height_right = .6;
    }
  for (const Scene &s : {rectangular, distorted})
    verdict("spread of the divergence over that without B-bar",
            spread_of_divergence(s, true) / spread_of_divergence(s, false),
            .25);
  const CellGeometry &g        = distorted.geometry[4];
  const double        top_left = g.bottom_left + g.height_left,
               top_right       = g.bottom_right + g.height_right;
  const std::vector<std::array<double, 2>> on_sides = {
    {{g.left, .4 * g.bottom_left + .6 * top_left}},
    {{g.left + .3 * g.width, .7 * top_left + .3 * top_right}}};
  const auto with    = moves(distorted, true, on_sides),
             without = moves(distorted, false, on_sides);
  const double slope = (top_right - top_left) / g.width;
  verdict("change of the flow through a vertical side",
          std::abs(with[0][0] - without[0][0]),
          1e-9);
  verdict("change of the flow through a row",
          std::abs(with[1][1] - without[1][1] -
                   slope * (with[1][0] - without[1][0])),
          1e-9);
}

/** Let the soil have the velocity v(r, z) for @p n_steps, and put all points
 * back to where they were after each: the field is uniform. */
void
repeat(Scene                                                      &s,
       const double                                                dt,
       const unsigned int                                          n_steps,
       const std::function<std::array<double, 2>(double, double)> &v)
{
  const std::vector<CellMoments> moments(n_cells, CellMoments());
  for (unsigned int k = 0; k < n_steps; ++k)
    {
      update(s, *select_kernels("auto"), {dt, 0., false, 0., 0.}, v, moments);
      for_all(s, [](PointBlock &block, int lane, const Point &p) {
        block.r[lane] = p.r;
        block.z[lane] = p.z;
      });
    }
}

/** Ten rigid turns leave the stress as it was, whatever the step: the matrix is
 * orthogonal, and the angle of a step is right to the fifth order. */
void
check_rigid_rotation()
{
  const double pi = std::acos(-1.);
  for (const unsigned int n_steps : {200u, 20000u})
    {
      Scene s = make_scene(0., false);
      fill_blocks(s);
      repeat(s,
             20. * pi / n_steps,
             n_steps,
             [](const double r, const double z) {
               return std::array<double, 2>{{z, -r}};
             });
      double size = 0., place = 0.;
      for_all(s, [&](PointBlock &block, int lane, const Point &p) {
        const double rr = block.stress[0][lane], zz = block.stress[1][lane],
                     rz    = block.stress[3][lane];
        const double start = std::hypot(.5 * (p.s[0] - p.s[1]), p.s[3]);
        size =
          std::max(size, std::abs(std::hypot(.5 * (rr - zz), rz) / start - 1.));
        place = std::max(place, std::abs(rz - p.s[3]) / start);
      });
      verdict("ten turns: change of the deviator", size, 1e-10);
      verdict("ten turns: error of the angle",
              place,
              n_steps < 1000 ? .1 : 1e-8);
    }
}

/** Simple shear v_r = z to 3 without initial stress: sigma_rz = G sin(3),
 * sigma_rr = -sigma_zz = G (1 - cos(3)). Returns the error over G. */
double
error_of_simple_shear(const unsigned int n_steps)
{
  Scene s = make_scene(0., false);
  for (Point &p : s.points)
    std::fill_n(p.s, 4, 0.);
  fill_blocks(s);
  const double shear = 3., G = E / (2. * (1. + nu));
  repeat(s, shear / n_steps, n_steps, [](double, const double z) {
    return std::array<double, 2>{{z, 0.}};
  });
  double error = 0.;
  for_all(s, [&](PointBlock &block, int lane, const Point &) {
    error =
      std::max({error,
                std::abs(block.stress[3][lane] / G - std::sin(shear)),
                std::abs(block.stress[0][lane] / G - 1. + std::cos(shear)),
                std::abs(block.stress[1][lane] / G + 1. - std::cos(shear))});
  });
  return error;
}

void
check_simple_shear()
{
  const double coarse = error_of_simple_shear(50),
               fine   = error_of_simple_shear(100);
  verdict("simple shear, 100 steps: error over G", fine, 1e-4);
  verdict("simple shear: order of the error, less 2",
          std::abs(std::log2(coarse / fine) - 2.),
          .01);
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
    for (int b = s.first[c]; b >= 0; b = s.headers[b].next)
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
  std::printf("cells that no point left: %s\n", n > 0 ? "some" : "none");
}

/** The mean over a cell of the divergence of the nodal field v(r, z), by Gauss
 * points. */
double
mean_divergence_of(
  const CellGeometry                                         &g,
  const double                                                axisymmetric,
  const std::function<std::array<double, 2>(double, double)> &v)
{
  double change = 0., volume = 0.;
  for (const QuadraturePoint &q : gauss_points(g, axisymmetric))
    {
      const Shape N(g, q.r, q.z);
      volume += q.volume;
      for (int i = 0; i < 4; ++i)
        {
          const double x = g.left + (i % 2) * g.width;
          const double y = (i % 2 ? g.bottom_right : g.bottom_left) +
                           (i / 2) * (i % 2 ? g.height_right : g.height_left);
          const auto w = v(x, y);
          change +=
            q.volume * (w[0] * (N.d_dr[i] + axisymmetric * N.value[i] / q.r) +
                        w[1] * N.d_dz[i]);
        }
    }
  return change / volume;
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
  update(with, *select_kernels("auto"), {1e-3, 0., true, 0., 0.}, v, moments);
  update(
    without, *select_kernels("auto"), {1e-3, 0., false, 0., 0.}, v, moments);
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
  double mean = 0.;
  for (unsigned int c = 0; c < n_cells; ++c)
    mean =
      std::max(mean,
               std::abs(
                 ratio[c] - 1. -
                 1e-3 * mean_divergence_of(with.geometry[c], axisymmetric, v)));
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



// ------------------------------------------------------- instruction sets

/** The largest difference of what the instruction sets of this CPU make of the
 * same soil, relative to 1 plus its size. */
double
difference_of_instruction_sets(const double    axisymmetric,
                               const Material &material)
{
  double worst = 0.;
  Scene  s     = make_scene(axisymmetric, false);
  fill_blocks(s);
  s.material   = material;
  const auto v = [](const double r, const double z) {
    return std::array<double, 2>{{.3 * r * z, -.5 * z + r}};
  };
  Scene      base = s;
  const Sums a    = collect(base, *select_kernels("SSE2"), gauss);
  update(base, *select_kernels("SSE2"), {1e-3, .5, true, .7, .1}, v, a.moments);
  for (const char *name : {"AVX2", "AVX-512"})
    if (const KernelTable *kernels = select_kernels(name))
      {
        Scene      other = s;
        const Sums b     = collect(other, *kernels, gauss);
        worst            = std::max(worst, difference(a, b));
        update(other, *kernels, {1e-3, .5, true, .7, .1}, v, b.moments);
        for (unsigned int i = 0; i < base.blocks.size(); ++i)
          {
            const double *x = reinterpret_cast<double *>(&base.blocks[i]),
                         *y = reinterpret_cast<double *>(&other.blocks[i]);
            for (unsigned int j = 0; j < sizeof(PointBlock) / 8; ++j)
              if (j % 8 < static_cast<unsigned int>(base.headers[i].count))
                worst = std::max(worst,
                                 std::abs(x[j] - y[j]) / (1. + std::abs(x[j])));
          }
      }
  return worst;
}

void
check_instruction_sets()
{
  const auto worst = [](const Material &material) {
    return std::max(difference_of_instruction_sets(0., material),
                    difference_of_instruction_sets(1., material));
  };
  Material material = make_scene(0., false).material; // linear elastic
  verdict("all instruction sets of this CPU: difference",
          worst(material),
          1e-12);
  // blocks that yield may wait for others: some of them, and all
  for (const double cohesion : {9e3, 1e2})
    {
      set_law<MohrCoulomb>(
        material,
        MohrCoulomb::Parameters::make(E, nu, .5, .1, cohesion, cohesion));
      const std::string name =
        "the same with the cohesion " + std::to_string(int(cohesion));
      verdict(name.c_str(), worst(material), 1e-12);
    }
  auto sand = MohrCoulomb::Parameters::make(E, nu, .5, .1, 1e2, 1e2);
  sand.largest_void_ratio = .7;
  set_law<MohrCoulomb>(material, sand);
  verdict("the same with some soil in its loosest state",
          worst(material),
          1e-12);
  std::printf("unknown instruction set: %s\n",
              select_kernels("NEON") == nullptr ? "refused" : "accepted");
}

int
main()
{
  for (const double axisymmetric : {0., 1.})
    {
      std::printf("%s\n", axisymmetric > 0. ? "axisymmetric" : "plane strain");
      check_linear_field(axisymmetric);
      check_mean_volume(axisymmetric);
      check_uniform_divergence(axisymmetric);
    }
  std::printf("both\n");
  check_rigid_rotation();
  check_simple_shear();
  check_limiter();
  check_stress_filter();
  for (const double axisymmetric : {0., 1.})
    {
      check_work(axisymmetric);
      check_kept_moments(axisymmetric);
    }
  check_instruction_sets();
}
