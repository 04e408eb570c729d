// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One .vtu file with what all ranks have, in pieces.
#ifndef caisson_mpm_output_vtu_file_h
#define caisson_mpm_output_vtu_file_h

#include <deal.II/base/mpi.h>

#include <functional>
#include <string>

namespace CaissonMPM
{
  /**
   * Write one file of the format VTU from pieces of all ranks: its name and its
   * form are the same on any number of ranks and for any number of pieces.
   *
   * make(i) gives the text of the file that the i-th piece of this rank would
   * be, or no text, of @p n_pieces, the same number on each rank. One piece is in the memory
   * of each rank at a time; the first rank gets them one after the other and
   * writes. A piece takes less than 2 GB. Throws RunFailure on all ranks where
   * the file cannot be written. Collective.
   */
  void
  write_vtu_file(const std::string                              &path,
                 const MPI_Comm                                  communicator,
                 const unsigned int                              n_pieces,
                 const std::function<std::string(unsigned int)> &make);
} // namespace CaissonMPM

#endif
