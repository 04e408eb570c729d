// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The stress turns with the soil: in rigid rotation, and in simple shear.
#include "kernel_scene.h"

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



int
main()
{
  heading("rigid rotation");
  check_rigid_rotation();
  heading("simple shear");
  check_simple_shear();
}
