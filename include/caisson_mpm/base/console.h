// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the program prints while it runs.
#ifndef caisson_mpm_base_console_h
#define caisson_mpm_base_console_h

#include <caisson_mpm/base/named_numbers.h>

#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  /** One line of progress: the present row of history.csv, of which a scene
   * with a body shows the penetration, the forces and what the water has, and
   * another one the time, the kinetic energy and the largest speed. */
  struct RecordLine
  {
    const NamedNumbers &row;
    double              fraction_done; // of the whole run, from 0 to 1
    double              eta_seconds;   // left out where it is not finite
    double length = 1.; // of the body, in m: of a small one lengths are mm
  };

  /** What a warning is about, the most important first: the results, the input,
   * or what changes no result. */
  enum class WarningRank
  {
    result,
    input,
    cosmetic
  };

  struct Warning
  {
    std::string text;
    WarningRank rank;
  };

  /**
   * All printing of the program, to one stream that is flushed after each
   * call. With Verbosity::plain nothing appears that depends on time, path or
   * version, and numbers have six significant digits, so that the output of
   * two runs can be compared. In parallel, all ranks but one are silent.
   */
  class Console
  {
  public:
    enum class Verbosity
    {
      silent,
      plain,
      full
    };

    using Lines = std::vector<std::pair<std::string, std::string>>;

    /** The stream must outlive the console. */
    explicit Console(const Verbosity verbosity, std::ostream &out = std::cout);

    /** What the run depends on: version, machine, paths. Only full. */
    void
    header(const Lines &lines);

    /** What the scene consists of: cells, material points. Full and plain. */
    void
    summary(const Lines &lines);

    /** Progress; without remaining time and speed in plain. */
    void
    record(const RecordLine &line);

    void
    message(const std::string &text);

    void
    warning(const std::string &text,
            const WarningRank  rank = WarningRank::result);

    /** All warnings so far, also those that were not printed. */
    const std::vector<Warning> &
    warnings() const
    {
      return warnings_;
    }

  private:
    void
    print(const std::string &text);

    const Verbosity      verbosity;
    std::ostream        &out;
    std::vector<Warning> warnings_;
  };

  /** Throw RunFailure where a list, as of all entries, has not been printed as
   * a whole; @p out has no buffer on the ranks that do not print. */
  void
  finish_list(std::ostream &out);
} // namespace CaissonMPM

#endif
