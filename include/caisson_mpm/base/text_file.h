// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Writing files so that a full disk is noticed and a killed run leaves no
// half-written file under its final name.
#ifndef caisson_mpm_base_text_file_h
#define caisson_mpm_base_text_file_h

#include <cstdio>
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
   * A file that is written piece by piece to path.tmp. finish() brings it to
   * the
   * disk and renames it to @p path: the file is there completely, or as it was
   * before. Without finish() nothing is left. Not collective.
   */
  class AtomicFile
  {
  public:
    explicit AtomicFile(const std::string &path);
    ~AtomicFile();

    AtomicFile(const AtomicFile &) = delete;
    AtomicFile &
    operator=(const AtomicFile &) = delete;

    /** Add a piece; nothing after an error. */
    void
    append(const std::string &text);

    /** Return 0 or an errno of anything that went wrong, so that all ranks can
     * agree before one throws. To be called once, at the end. */
    int
    finish();

  private:
    const std::string path, temporary;
    std::FILE        *file;
    int               error = 0;
  };

  /** Write @p text by means of an AtomicFile. Returns 0 or an errno. Not
   * collective. */
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
