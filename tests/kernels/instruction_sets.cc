// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The same transfer and the same update with all instruction sets of this CPU.
#include "kernel_scene.h"

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
  Scene        base = s;
  const Sums   a    = collect(base, *select_kernels("SSE2"), gauss);
  const double work = update(base,
                             *select_kernels("SSE2"),
                             {1e-3, .5, true, .7, .1},
                             v,
                             a.moments)
                        .stress_work;
  for (const char *name : {"AVX2", "AVX-512"})
    if (const KernelTable *kernels = select_kernels(name))
      {
        Scene      other = s;
        const Sums b     = collect(other, *kernels, gauss);
        worst            = std::max(worst, difference(a, b));
        const UpdateResult result =
          update(other, *kernels, {1e-3, .5, true, .7, .1}, v, b.moments);
        worst =
          std::max(worst,
                   std::abs(result.stress_work - work) / (1. + std::abs(work)));
        for (unsigned int c = 0; c < n_cells; ++c)
          worst = std::max(worst, std::abs(other.filled[c] - base.filled[c]));
        for (unsigned int i = 0; i < base.blocks.size(); ++i)
          {
            const double *x = reinterpret_cast<double *>(&base.blocks[i]),
                         *y = reinterpret_cast<double *>(&other.blocks[i]);
            for (unsigned int j = 0; j < sizeof(PointBlock) / 8; ++j)
              if (j % 8 < base.headers[i].count)
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
      const double values[] = {E, nu, 29., 6., cohesion, cohesion, no_limit};
      set_law<MohrCoulomb>(material, read_parameters<MohrCoulomb>(values));
      const std::string name =
        "the same with the cohesion " + std::to_string(int(cohesion));
      verdict(name.c_str(), worst(material), 1e-12);
    }
  const double loosest[] = {E, nu, 29., 6., 1e2, 1e2, .7};
  set_law<MohrCoulomb>(material, read_parameters<MohrCoulomb>(loosest));
  verdict("the same with some soil in its loosest state",
          worst(material),
          1e-12);
  // points that are packed, whatever the width of the registers
  const double values[] = {
    30., 5.8e9, .28, .53, .84, 1., .13, 1.05, 100., 1e-4, 5., 2., .5, 6., 0.};
  set_law<HypoplasticIntergranular>(
    material, read_parameters<HypoplasticIntergranular>(values));
  verdict("the same with hypoplastic sand", worst(material), 1e-9);
  std::printf("unknown instruction set refused: %s\n",
              select_kernels("NEON") == nullptr ? "yes" : "no");
}



int
main()
{
  heading("instruction sets");
  check_instruction_sets();
}
