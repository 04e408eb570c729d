// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Strain cycles of hypoplastic sand with intergranular strain, against an
// independent integration (scripts/lab element-tests cycles): small cycles
// accumulate next to nothing.
#include <vector>

#include "intergranular_test.h"

/** Oedometric cycles of strain; amplitude from peak to peak. */
std::vector<double>
cycles(const double amplitude, const int n_cycles, const int n_steps)
{
  const auto          p = parameters();
  std::vector<double> axial;
  Point               point;
  point.stress = {-5e4, -1e5, -5e4, 0.};
  for (int half = 0; half < 2 * n_cycles; ++half)
    {
      const double sign = half % 2 == 0 ? -1. : 1.;
      for (int i = 0; i < n_steps; ++i)
        strain(point, {0., sign * amplitude / n_steps, 0., 0.}, p);
      axial.push_back(-point.stress.zz[0]);
    }
  return axial;
}



void
test_cycles()
{
  // scripts/lab element-tests cycles: axial stress at each reversal
  struct Case
  {
    double amplitude, axial[6];
  };
  const Case cases[] = {{1e-05,
                         {1.027956e+05,
                          1.000000e+05,
                          1.027956e+05,
                          1.000000e+05,
                          1.027956e+05,
                          1.000000e+05}},
                        {0.0001,
                         {1.304394e+05,
                          9.993318e+04,
                          1.304289e+05,
                          9.992723e+04,
                          1.304254e+05,
                          9.992503e+04}},
                        {0.001,
                         {3.089106e+05,
                          5.705540e+04,
                          2.512108e+05,
                          4.112245e+04,
                          2.023140e+05,
                          2.921860e+04}}};
  std::printf("Cycles of strain\n");
  for (const Case &c : cases)
    {
      double error = 0.;
      for (const int n_steps : {1, 20, 1000})
        {
          const auto found = cycles(c.amplitude, 3, n_steps);
          for (int i = 0; i < 6; ++i)
            raise(error, std::fabs(found[i] / c.axial[i] - 1.));
        }
      char name[80];
      std::snprintf(name, sizeof(name), "amplitude %g, error", c.amplitude);
      report(name, error, 5e-3);
    }
  std::printf("axial stress after 50 cycles of 2e-5: %.1f kPa\n",
              cycles(2e-5, 50, 10).back() / 1e3);
}



int
main()
{
  test_cycles();
}
