// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The same transfer and the same update by the kernels of this CPU and by those
// without intrinsics, which serve on all processors but x86-64.
#include "kernel_scene.h"

#ifdef CAISSON_X86_64
namespace CaissonMPM::Kernels
{
  /** Compiled with CAISSON_GENERIC_LANES, for this test only. */
  const KernelTable &
  kernels_generic();
} // namespace CaissonMPM::Kernels
#endif

/** The largest difference of the points of two scenes, relative to 1 plus its
 * size. */
double
difference_of_points(const Scene &a, const Scene &b)
{
  double worst = 0.;
  for (unsigned int i = 0; i < a.blocks.size(); ++i)
    {
      const auto *x = reinterpret_cast<const double *>(&a.blocks[i]),
                 *y = reinterpret_cast<const double *>(&b.blocks[i]);
      for (unsigned int j = 0; j < sizeof(PointBlock) / sizeof(double); ++j)
        if (j % block_size < a.headers[i].count)
          worst =
            std::max(worst, std::abs(x[j] - y[j]) / (1. + std::abs(x[j])));
    }
  return worst;
}



double
difference_of_kernels(const double axisymmetric, const Material &material)
{
  Scene native = make_scene(axisymmetric, false);
  fill_blocks(native);
  native.material    = material;
  Scene      generic = native;
  const auto v       = [](const double r, const double z) {
    return std::array<double, 2>{{.3 * r * z, -.5 * z + r}};
  };
  const UpdateSettings settings = {1e-3, .5, true, .7, .1};
  const Sums           a = collect(native, *select_kernels("auto"), gauss),
             b           = collect(generic, kernels_generic(), gauss);
  update(native, *select_kernels("auto"), settings, v, a.moments);
  update(generic, kernels_generic(), settings, v, b.moments);
  return std::max(difference(a, b), difference_of_points(native, generic));
}



int
main()
{
  const auto worst = [](const Material &material) {
    return std::max(difference_of_kernels(0., material),
                    difference_of_kernels(1., material));
  };
  Material material = make_scene(0., false).material; // linear elastic
  verdict("generic lanes: difference", worst(material), 1e-12);
  const double values[] = {E, nu, 29., 6., 1e2, 1e2, no_limit};
  set_law<MohrCoulomb>(material, read_parameters<MohrCoulomb>(values));
  verdict("the same with soil that yields", worst(material), 1e-12);
  std::printf("two lanes: %s\n", kernels_generic().width == 2 ? "yes" : "NO");
}
