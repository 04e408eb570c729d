// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The sands of the tests of hypoplasticity. Their intergranular strain changes
// no stiffness, and is so small that it has the direction of the strain.
#ifndef caisson_mpm_tests_hypoplastic_test_h
#define caisson_mpm_tests_hypoplastic_test_h

#include <caisson_mpm/kernels/hypoplastic_intergranular.h>

#include "law_test.h"

constexpr double karlsruhe[] =
  {30., 5.8e9, 0.28, 0.53, 0.84, 1., 0.13, 1.05, 1.};
constexpr double hochstetten[] =
  {33., 1e9, 0.25, 0.55, 0.95, 1.05, 0.25, 1.5, 1.};



using Law = HypoplasticIntergranular;

inline Law::Parameters
parameters_of(const double *values)
{
  double all[n_entries<Law>] = {
    0., 0., 0., 0., 0., 0., 0., 0., 0., 4e-5, 1., 1., .5, 6., 1.};
  for (int i = 0; i < 9; ++i)
    all[i] = values[i];
  return read_parameters<Law>(all);
}

#endif
