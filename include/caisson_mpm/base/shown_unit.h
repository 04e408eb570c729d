// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The units in which results are shown: kN and m, and N and mm of small bodies.
#ifndef caisson_mpm_base_shown_unit_h
#define caisson_mpm_base_shown_unit_h

#include <string>

namespace CaissonMPM
{
  /** A unit, and what a number in SI units is multiplied with. */
  struct ShownUnit
  {
    std::string name;
    double      factor;
  };

  /** That of forces of which none is larger. Units: N. */
  inline ShownUnit
  unit_of_forces(const double largest)
  {
    return largest < 1e3 ? ShownUnit{"N", 1.} : ShownUnit{"kN", 1e-3};
  }

  /** That of stresses of which none is larger. Units: Pa. */
  inline ShownUnit
  unit_of_stresses(const double largest)
  {
    return largest < 1e3 ? ShownUnit{"Pa", 1.} : ShownUnit{"kPa", 1e-3};
  }

  /** That of depths of a body of this length. Units: m. */
  inline ShownUnit
  unit_of_lengths(const double length)
  {
    return length < 1. ? ShownUnit{"mm", 1e3} : ShownUnit{"m", 1.};
  }
} // namespace CaissonMPM

#endif
