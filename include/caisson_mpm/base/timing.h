// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Wall time per section of the time step, and the memory in use.
#ifndef caisson_mpm_base_timing_h
#define caisson_mpm_base_timing_h

#include <caisson_mpm/base/named_numbers.h>

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  /**
   * Sums the wall time that is spent in named sections. The name is looked up
   * once; a scope then costs two readings of the clock (about 50 ns), so it
   * may stand around each line of a time step, but not around work on one
   * cell. Sections may nest: each counts its full time. Local to a rank.
   *
   * @code
   * const unsigned int transfer = timer.section("points to grid");
   * {
   *   SectionTimer::Scope scope(timer, transfer);
   *   points_to_grid();
   * }
   * @endcode
   */
  class SectionTimer
  {
  public:
    /** The time from construction to destruction goes to one section. */
    class Scope
    {
    public:
      Scope(SectionTimer &timer, const unsigned int section)
        : timer(timer)
        , section(section)
        , start(Clock::now())
      {}

      ~Scope()
      {
        timer.sections[section].second += Clock::now() - start;
      }

      Scope(const Scope &) = delete;
      Scope &
      operator=(const Scope &) = delete;

    private:
      using Clock = std::chrono::steady_clock;

      SectionTimer           &timer;
      const unsigned int      section;
      const Clock::time_point start;
    };

    /** The index of the section of this name, which is added if new. */
    unsigned int
    section(const std::string &name);

    /** Name and seconds of each section, in the order of their first use. */
    NamedNumbers
    seconds() const;

    /** The seconds, with names for a checkpoint. */
    NamedNumbers
    state() const;

    /** Add those of an earlier process, which are among other numbers. */
    void
    resume(const NamedNumbers &state);

  private:
    std::vector<std::pair<std::string, std::chrono::steady_clock::duration>>
      sections;
  };

  /** The largest resident memory of this process so far. Units: bytes. */
  double
  peak_memory_bytes();
} // namespace CaissonMPM

#endif
