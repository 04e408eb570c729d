// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The material points of all ranks in one place, for what looks at single
// points: observations and checks.
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
    /** Collective. */
    AllPoints(const MaterialPoints &points, const MPI_Comm communicator);

    /** Call action(const MaterialPoint &) for every point. */
    template <typename Action>
    void
    for_each(const Action &action) const
    {
      if (on_one_rank)
        points.for_each(
          [&](const MaterialPoint &p, const unsigned int) { action(p); });
      for (const MaterialPoint &p : gathered)
        action(p);
    }

  private:
    const MaterialPoints      &points;
    const bool                 on_one_rank;
    std::vector<MaterialPoint> gathered; // in the order of their numbers
  };
} // namespace CaissonMPM

#endif
