// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The sands of the tests of HypoplasticSand.
#ifndef caisson_mpm_tests_hypoplastic_test_h
#define caisson_mpm_tests_hypoplastic_test_h

#include <caisson_mpm/kernels/hypoplastic.h>

#include "law_test.h"

constexpr double karlsruhe[] =
  {30., 5.8e9, 0.28, 0.53, 0.84, 1., 0.13, 1.05, 1.};
constexpr double hochstetten[] =
  {33., 1e9, 0.25, 0.55, 0.95, 1.05, 0.25, 1.5, 1.};



inline HypoplasticSand::Parameters
parameters_of(const double *values)
{
  return read_parameters<HypoplasticSand>(values);
}

#endif
