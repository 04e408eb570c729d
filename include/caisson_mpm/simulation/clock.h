// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Where a run is in time.
#ifndef caisson_mpm_simulation_clock_h
#define caisson_mpm_simulation_clock_h

namespace CaissonMPM
{
  /** Owned by the simulation, which alone sets it; the same on all ranks. */
  struct Clock
  {
    double        time      = 0.; // s
    double        step_size = 0.; // of the last step, s
    unsigned long step      = 0;  // number of steps so far
  };
} // namespace CaissonMPM

#endif
