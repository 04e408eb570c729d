# shellcheck shell=bash
# SPDX-License-Identifier: LGPL-2.1-or-later
#
# The environment of tests, for scripts/test and `tools/workshop sanitize`.
# Tests run side by side, so each keeps to one thread; in a container they may
# run as root on fewer cores than ranks.
export OMP_NUM_THREADS=1 DEAL_II_NUM_THREADS=1
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
# where /sys is not mounted hwloc complains into the outputs
export HWLOC_HIDE_ERRORS=2
export OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_rmaps_base_oversubscribe=1
