// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/mpi_settings.h>

#include <cstdlib>
#include <utility>

namespace CaissonMPM
{
  namespace
  {
    /** What the ways to start several processes set in each of them: PMIx (Open
     * MPI's mpirun, Slurm, LSF), PMI-1 and PMI-2, Slurm and ALPS. */
    constexpr const char *signs_of_others[] = {"OMPI_COMM_WORLD_SIZE",
                                               "PMIX_RANK",
                                               "PMI_RANK",
                                               "PMI_FD",
                                               "SLURM_PROCID",
                                               "ALPS_APP_PE"};

    /** Parameters of Open MPI. */
    constexpr std::pair<const char *, const char *> settings[] = {
      {"OMPI_MCA_ess_singleton_isolated", "1"},
      {"OMPI_MCA_orte_create_session_dirs", "0"},
      {"OMPI_MCA_pml", "ob1"},
      {"OMPI_MCA_btl", "self"}};
  } // namespace

  bool
  set_up_mpi()
  {
    setenv("OMPI_MCA_io", "^ompio", 1);
    setenv("HWLOC_COMPONENTS", "-gl", 0);
    for (const char *sign : signs_of_others)
      if (std::getenv(sign) != nullptr)
        return false;
    for (const auto &[name, value] : settings)
      setenv(name, value, 1);
    return true;
  }
} // namespace CaissonMPM

/** ADOL-C, which deal.II loads and this program does not use, finds this
 * function in the place of its own, which reads a file .adolcrc in the current
 * folder, and waits there where it is a pipe. */
extern "C" void
readConfigFile()
{}
