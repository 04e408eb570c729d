// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Writing files so that a full disk is noticed and a killed run leaves no
// half-written file under its final name.
#ifndef caisson_mpm_base_text_file_h
#define caisson_mpm_base_text_file_h

#include <string>

namespace CaissonMPM
{
  /**
   * Throw RunFailure "cannot write <path>: <reason>", with the system's text
   * for @p error (an errno), and @p consequence after it.
   */
  [[noreturn]] void
  report_unwritable(const std::string &path,
                    const int          error,
                    const std::string &consequence = "");

  /**
   * Write @p text to path.tmp, bring it to the disk and rename it to @p path:
   * the file is there completely, or as it was before. Returns 0 or an errno,
   * so that all ranks can agree before one throws. Not collective.
   */
  int
  try_to_write(const std::string &path, const std::string &text);

  /** As try_to_write(), but throws RunFailure. */
  void
  write_atomically(const std::string &path, const std::string &text);

  /** The contents of a file; empty where it cannot be read. */
  std::string
  read_text(const std::string &path);
} // namespace CaissonMPM

#endif
