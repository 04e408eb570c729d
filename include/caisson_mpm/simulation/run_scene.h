// SPDX-License-Identifier: LGPL-2.1-or-later
//
// From the command line to a finished run.
#ifndef caisson_mpm_simulation_run_scene_h
#define caisson_mpm_simulation_run_scene_h

#include <caisson_mpm/base/command_line.h>
#include <caisson_mpm/base/exceptions.h>

#include <ostream>

namespace CaissonMPM
{
  /**
   * Read the scene and run, check or print it, as the command line says. Notes
   * on the input go to @p out. Throws RunFailure, and BadInput with the places
   * at which the entries were set that it names. Collective.
   */
  ExitStatus
  run_scene(const CommandLine &command_line, std::ostream &out);
} // namespace CaissonMPM

#endif
