// SPDX-License-Identifier: LGPL-2.1-or-later
//
// run.json: what was run, how large it was and how long it took.
#ifndef caisson_mpm_output_run_summary_h
#define caisson_mpm_output_run_summary_h

#include <string>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  /** The entries of run.json, in its order; those with a unit end with it. */
  struct RunSummary
  {
    std::string version;
    std::string dealii_version;
    std::string scene_file;
    std::string instruction_set;
    /** Of all parameters of the physics that are not defaults. */
    std::string fingerprint;
    /** How the run ended, e.g. "finished". */
    std::string   status;
    unsigned int  ranks                  = 1;
    unsigned int  repartitions           = 0; // to even out the work of ranks
    unsigned long material_points        = 0;
    unsigned long cells                  = 0;
    unsigned long body_points            = 0;
    unsigned long steps                  = 0;
    unsigned long limiter_count          = 0;
    unsigned long held_back              = 0;
    unsigned long points_lost            = 0;
    unsigned long max_points_in_body     = 0;
    unsigned long points_split           = 0;
    unsigned long points_merged          = 0; // pairs
    double        point_steps            = 0.;
    double        wall_time_s            = 0.;
    double        point_steps_per_second = 0.;
    double        peak_memory_bytes      = 0.; // of all ranks together
    double        body_mass_kg           = 0.;
    double        soil_mass_kg           = 0.; // scaled, as added_mass_kg
    double        time_step_s            = 0.;
    /** What limits the time step. */
    std::string time_step_limit;
    /** The limit of the step in each zone of the mesh. */
    std::vector<std::pair<std::string, double>> zone_limits;
    /** Seconds in each section of the time step, of the first rank. */
    std::vector<std::pair<std::string, double>> sections;
    /** The energy balance at the end: external_work_J, ... */
    std::vector<std::pair<std::string, double>> energies;
    /** Lengths that the scripts draw: diameter_m, wall_thickness_m, ... */
    std::vector<std::pair<std::string, double>> scene;
  };

  /**
   * Write the summary as a JSON object, all at once. Throws RunFailure where
   * that is not possible. Called by one rank; not collective.
   */
  void
  write_run_summary(const std::string &path, const RunSummary &summary);
} // namespace CaissonMPM

#endif
