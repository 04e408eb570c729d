// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The conventions of the whole program, stated once.
//
//  - SI units inside: m, kg, s, N, Pa, rad. Angles are degrees in .prm files.
//  - Coordinates (r, z): r is the distance from the axis (in plane strain: the
//    horizontal coordinate), z points upward. The soil surface is at z = 0 at
//    the start.
//  - Stress and strain are positive in tension; pore pressure is positive in
//    compression. Components come in the order rr, zz, tt (hoop), rz; the
//    shear strain is tensorial.
//  - Masses, volumes, momenta and nodal forces are per radian; forces that the
//    user reads are those of the whole circumference (times 2 pi), upward
//    positive, acting on the body. In plane strain everything is per meter.
//  - Mass scaling multiplies inertia and leaves weight: the masses of material
//    points and nodes, momenta and kinetic energies are the scaled ones, and
//    body forces are divided by the factor. Only Soil knows the factor.
//    The factors of an inertia tolerance are by cell, and TimeStep knows them:
//    they multiply what the points bring to nodes and to the kinetic energy.
//    The masses of the points do not contain them.
//  - Penetration is the depth of the skirt tip's lowest point below z = 0.
#ifndef caisson_mpm_base_conventions_h
#define caisson_mpm_base_conventions_h

#include <deal.II/base/tensor.h>

#include <array>

namespace CaissonMPM
{
  constexpr double pi = 3.14159265358979323846;

  /** The one type of a vector with the components r and z. */
  using Vector2 = dealii::Tensor<1, 2>;

  /** The two coordinates. */
  enum Component : unsigned int
  {
    radial   = 0,
    vertical = 1
  };

  /** The components of a stress. */
  enum StressComponent : unsigned int
  {
    rr = 0,
    zz = 1,
    tt = 2,
    rz = 3
  };

  using Stress = std::array<double, 4>;

  /** Degrees to radians. */
  constexpr double
  radians(const double degrees)
  {
    return degrees * (pi / 180.);
  }
} // namespace CaissonMPM

#endif
