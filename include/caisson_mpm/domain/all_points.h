// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The material points of all ranks in one place, for what looks at single
// points: observations.
#ifndef caisson_mpm_domain_all_points_h
#define caisson_mpm_domain_all_points_h

#include <caisson_mpm/domain/material_points.h>

#include <vector>

namespace CaissonMPM
{
  /**
   * Access to every point. On one rank it refers to the points of that rank; of
   * several ranks the first holds a copy of all points, and the others hold
   * none. Valid until the points change.
   */
  class AllPoints
  {
  public:
    /** Collective. Points of materials that @p total names have their pore
     * pressure as a part of their stress. [n_materials] */
    AllPoints(const MaterialPoints    &points,
              const std::vector<bool> &total,
              const MPI_Comm           communicator);

    /** Call action(const MaterialPoint &) for every point. */
    template <typename Action>
    void
    for_each(const Action &action) const
    {
      if (on_one_rank)
        points.for_each(
          [&](const MaterialPoint &p, const unsigned int) { show(p, action); });
      for (const MaterialPoint &p : gathered)
        show(p, action);
    }

  private:
    template <typename Action>
    void
    show(const MaterialPoint &p, const Action &action) const
    {
      if (total[p.material])
        action(p.with_pressure_in_stress());
      else
        action(p);
    }

    const MaterialPoints      &points;
    const std::vector<bool>    total; // [n_materials]
    const bool                 on_one_rank;
    std::vector<MaterialPoint> gathered; // in the order of their numbers
  };
} // namespace CaissonMPM

#endif
