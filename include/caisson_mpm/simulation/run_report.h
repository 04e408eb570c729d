// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a run reports at its end: run.json, and warnings.
#ifndef caisson_mpm_simulation_run_report_h
#define caisson_mpm_simulation_run_report_h

#include <caisson_mpm/base/console.h>
#include <caisson_mpm/base/named_numbers.h>
#include <caisson_mpm/simulation/simulation_parts.h>

#include <string>

namespace CaissonMPM
{
  /** What a report needs besides the parts. */
  struct RunFacts
  {
    std::string          status;  // how the run ended, for instance "finished"
    std::string          failure; // why the run could not go on, or empty
    std::string          scene_file;
    std::string          command; // words behind the name of the program
    std::string          title = "a scene";
    std::string          fingerprint; // of all parameters that are not defaults
    std::string          installation; // directory of the run before, or empty
    std::string          kernels;
    unsigned int         n_repartitions = 0;
    unsigned int         max_in_body    = 0; // points at any record
    unsigned long        n_steps        = 0;
    double               point_steps    = 0.; // of all ranks
    double               wall_time      = 0.; // s
    std::vector<Warning> warnings;            // of the input and of the run
    std::vector<std::string> assumed;         // entries marked so
    NamedNumbers             progress;        // of a run that has not ended
  };

  /** Write run.json: what was run, how large it was and how long it took. The
   * counts must have been brought to the first rank. Throws RunFailure where
   * the file cannot be written. Collective. */
  void
  write_run_summary(const std::string     &path,
                    const SimulationParts &parts,
                    const RunFacts        &facts);

  /** Write run.json of a run that has not ended, or has failed on this rank,
   * with what is known without the other ranks. Returns 0 or an errno. Not
   * collective. */
  int
  write_early_summary(const std::string     &path,
                      const SimulationParts &parts,
                      const RunFacts        &facts);

  /** Print the energy residual, and warn of what it and the counts say against
   * the run. Not collective. */
  void
  print_run_report(Console &console, const SimulationParts &parts);
} // namespace CaissonMPM

#endif
