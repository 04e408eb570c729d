// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The functions of simd_math.h: exp, log, pow, roots and sin of one and of
// eight lanes against <cmath>.
#include <caisson_mpm/kernels/simd_math.h>

#include <algorithm>

#include "law_test.h"

template <int n>
void
test_functions()
{
  using Number        = Lanes<n>;
  const auto relative = [](const Number a, const double b) {
    double error = 0.;
    for (int i = 0; i < n; ++i)
      raise(error, std::fabs(a[i] - b) / std::max(std::fabs(b), 1e-300));
    return error;
  };
  double e = 0., l = 0., p = 0., q = 0., s = 0.;
  for (double x = -300.; x < 300.; x += 0.0371)
    raise(e, relative(exp(Number(x)), std::exp(x)));
  for (double x = 1e-12; x < 1e12; x *= 1.0123)
    {
      raise(l, relative(log(Number(x)), std::log(x)));
      for (const double y : {0.13, 0.28, 1.05})
        raise(p, relative(pow(Number(x), y), std::pow(x, y)));
      for (const double y : {0., .25, .5, .75, 5.5, 6.})
        raise(q, relative(quarter_power(Number(x), y), std::pow(x, y)));
    }
  for (double x = -1.57; x < 1.57; x += 0.00123)
    raise(s, std::fabs(sin(Number(x))[n - 1] - std::sin(x)));
  std::printf("Functions of %d lanes\n", n);
  report("exp", e, 1e-15);
  report("log", l, 1e-15);
  report("pow", p, 1e-14);
  report("quarter_power", q, 1e-14);
  report("sin", s, 1e-15);
}

int
main()
{
  test_functions<1>();
  test_functions<8>();
}
