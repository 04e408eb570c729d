// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The directory that a run writes to.
#ifndef caisson_mpm_base_output_directory_h
#define caisson_mpm_base_output_directory_h

#include <string>

namespace CaissonMPM
{
  /**
   * Make the directory if it is missing, and try to write in it. Throws
   * BadInput if that fails.
   */
  void
  prepare_output_directory(const std::string &directory);
} // namespace CaissonMPM

#endif
