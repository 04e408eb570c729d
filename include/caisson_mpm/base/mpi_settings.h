// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How MPI starts, and how it writes files.
#ifndef caisson_mpm_base_mpi_settings_h
#define caisson_mpm_base_mpi_settings_h

namespace CaissonMPM
{
  /**
   * Choose what Open MPI does in this program; call it before MPI is
   * initialized. The settings are variables of the environment, which other MPI
   * libraries do not read; what the user has set there is replaced.
   *
   * In every process, files are written by ROMIO: Open MPI's own component puts
   * the path of a file into a field of 256 bytes, and a longer one ends the
   * program. No process looks for graphics processors through a display.
   *
   * A process that has no others to talk to starts faster. Open MPI 4 would
   * start a daemon, load the libraries of all networks and wait a second for
   * one of them at the end, which takes longer than reading a scene. This is
   * not done in a process that mpirun or a batch system has started.
   *
   * @return whether this process is alone
   */
  bool
  set_up_mpi();
} // namespace CaissonMPM

#endif
