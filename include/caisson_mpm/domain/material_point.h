// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One material point of the soil, as the code outside the kernels sees it.
#ifndef caisson_mpm_domain_material_point_h
#define caisson_mpm_domain_material_point_h

#include <caisson_mpm/base/conventions.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/materials/soil.h>

#include <deal.II/base/point.h>

namespace CaissonMPM
{
  /** Its state; SI units. */
  struct MaterialPoint
  {
    dealii::Point<2> position;
    double           velocity[2]        = {0., 0.};
    Stress           stress             = {{0., 0., 0., 0.}};
    double           mass               = 0.; // scaled, kg per radian
    double           volume             = 0.; // m3 per radian
    double           plastic_deviatoric = 0., plastic_volumetric = 0.;
    StateVariables   state = {}; // of the material law
    dealii::Point<2> initial_position;
    double           initial_volume = 0.;
    double           size[2]        = {0., 0.}; // in r and z when it was made
    double           id             = 0.;
    unsigned int     material       = 0;

    double
    void_ratio(const double initial_void_ratio) const
    {
      return (1. + initial_void_ratio) * volume / initial_volume - 1.;
    }
  };
} // namespace CaissonMPM

#endif
