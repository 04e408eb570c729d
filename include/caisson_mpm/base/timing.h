// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Wall time per section of the time step, and the memory in use.
#ifndef caisson_mpm_base_timing_h
#define caisson_mpm_base_timing_h

#include <caisson_mpm/base/named_numbers.h>

#include <chrono>
#include <string>

namespace CaissonMPM
{
  /**
   * Sums the wall time that is spent in named sections. It may stand around
   * each line of a time step, but not around work on one cell. Sections may
   * nest: each counts its full time. Local to a rank.
   *
   * @code
   * timer.time("points to grid", [&]() { points_to_grid(); });
   * @endcode
   */
  class SectionTimer
  {
  public:
    /** Call action(), whose time goes to the section of this name. */
    template <typename Action>
    void
    time(const std::string &section, const Action &action)
    {
      using Clock      = std::chrono::steady_clock;
      const auto start = Clock::now();
      action();
      seconds_of(section) +=
        std::chrono::duration<double>(Clock::now() - start).count();
    }

    /** Name and seconds of each section, in the order of their first use. */
    const NamedNumbers &
    seconds() const
    {
      return sections;
    }

    /** The seconds, with names for a checkpoint. */
    NamedNumbers
    state() const;

    /** Add those of an earlier process, which are among other numbers. */
    void
    resume(const NamedNumbers &state);

  private:
    /** Those of a section, which is added if new. */
    double &
    seconds_of(const std::string &section);

    NamedNumbers sections;
  };

  /** The largest resident memory of this process so far. Units: bytes. */
  double
  peak_memory_bytes();
} // namespace CaissonMPM

#endif
