// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How large a run is going to be, before it is started.
#ifndef caisson_mpm_simulation_run_cost_h
#define caisson_mpm_simulation_run_cost_h

#include <string>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  /** The size of a scene at its start, of all ranks. */
  struct RunCost
  {
    std::string   grid; // in words
    unsigned long n_points  = 0;
    unsigned int  n_frames  = 0;
    double        step_size = 0.;  // s
    std::string   limit;           // what limits the step
    std::string   end;             // when, and by which entry
    double        n_steps    = 0.; // infinite where it is not known
    double        peak_bytes = 0.; // memory so far
    unsigned int  n_ranks    = 1;
    /** Time of the processor, measured in the first steps; 0 where there is no
     * measurement. */
    double seconds_per_step = 0.;
    /** Why the first steps fail; empty where they do not. */
    std::string failure;
    /** Whether points are split where the mesh is fine. */
    bool splits = false;
    /** Return the least and the most time of the processor that the run may
     * take (s): 1.5 times less and more than the likely one. */
    std::pair<double, double>
    seconds() const;
    /** What would make the run shorter, in words. */
    std::vector<std::string> savings;
  };

  /** Return the cost in words, a line for each quantity. The number of points
   * may change by splitting and merging, the step by the deformed mesh. */
  std::string
  describe(const RunCost &cost);
} // namespace CaissonMPM

#endif
