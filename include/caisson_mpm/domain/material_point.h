// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One material point of the soil, as the code outside the kernels sees it.
#ifndef caisson_mpm_domain_material_point_h
#define caisson_mpm_domain_material_point_h

#include <caisson_mpm/base/conventions.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/kernels/point_fields.h>
#include <caisson_mpm/materials/soil.h>

#include <deal.II/base/point.h>

#include <vector>

namespace CaissonMPM
{
  using Kernels::n_state_variables;

// the members that are not a component of a vector, from the list of fields
#define CAISSON_NO_MEMBER(...)
#define CAISSON_LIST_MEMBER(name, n, ...) std::array<double, n> name = {};
#define CAISSON_MEMBER(name, ...) double name = 0.;

  /** Its state; kernels/point_fields.h describes the members. SI units. */
  struct MaterialPoint
  {
    dealii::Point<2> position;
    double           velocity[2] = {0., 0.};
    dealii::Point<2> initial_position;
    double           size[2]  = {0., 0.}; // in r and z, as stretched
    unsigned int     material = 0;
    CAISSON_BLOCK_FIELDS(CAISSON_NO_MEMBER, CAISSON_LIST_MEMBER, CAISSON_MEMBER)
    CAISSON_HISTORY_FIELDS(CAISSON_NO_MEMBER,
                           CAISSON_LIST_MEMBER,
                           CAISSON_MEMBER)

    /** What a user's law keeps (Kernels::UserState): of all points as many
     * numbers, and none where no soil has such a law. */
    std::vector<double> user_state;

    double
    void_ratio(const double initial_void_ratio) const
    {
      return (1. + initial_void_ratio) * volume / initial_volume - 1.;
    }

    /** Return the point with its pore pressure as a part of its stress. */
    MaterialPoint
    with_pressure_in_stress() const
    {
      MaterialPoint result = *this;
      for (const unsigned int component : {rr, zz, tt})
        result.stress[component] -= pore_pressure;
      result.pore_pressure = 0.;
      return result;
    }
  };

#undef CAISSON_NO_MEMBER
#undef CAISSON_LIST_MEMBER
#undef CAISSON_MEMBER
} // namespace CaissonMPM

#endif
