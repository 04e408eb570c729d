// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What grid_to_points returns.
#ifndef caisson_mpm_kernels_update_result_h
#define caisson_mpm_kernels_update_result_h

namespace CaissonMPM
{
  namespace Kernels
  {
    /** An MP that left its cell. */
    struct LeavingPoint
    {
      unsigned int cell;
      int          block;
      int          lane;
    };

    /** What grid_to_points returns: the MPs that left their cells, in room that
     * the caller provides, and sums over all MPs. */
    struct UpdateResult
    {
      LeavingPoint *leaving;     // [capacity]
      unsigned int  capacity;    // at least the number of all MPs
      unsigned int  n_leaving;   // entries of leaving that are in use
      unsigned int  n_limited;   // MPs whose velocity was cut
      double        stress_work; // of the total stress, J per radian
    };
  } // namespace Kernels
} // namespace CaissonMPM

#endif
