// SPDX-License-Identifier: LGPL-2.1-or-later
//
// MPI in a program that runs without mpirun.
#ifndef caisson_mpm_base_single_process_h
#define caisson_mpm_base_single_process_h

namespace CaissonMPM
{
  /**
   * Let MPI start faster where this process has no others to talk to. Open MPI
   * 4 would start a daemon, load the libraries of all networks and wait a
   * second for one of them at the end, which takes longer than reading a scene.
   *
   * The settings are variables of the environment, which other MPI libraries
   * do not read; what the user has set there is replaced. Nothing is done in a
   * process that mpirun or a batch system has started. Call it before MPI is
   * initialized.
   *
   * @return whether this process is alone
   */
  bool
  set_up_single_process();
} // namespace CaissonMPM

#endif
