// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Requests to end a run early but in order, with a checkpoint: signals, a
// limit on the wall time, and a file that the user creates.
#ifndef caisson_mpm_base_stop_request_h
#define caisson_mpm_base_stop_request_h

#include <caisson_mpm/base/section.h>

#include <deal.II/base/mpi.h>

#include <array>
#include <chrono>
#include <csignal>
#include <optional>
#include <string>

namespace CaissonMPM
{
  /**
   * Tells the time loop when it has been asked to stop.
   *
   * From arm() to the destructor SIGINT, SIGTERM, SIGHUP (the terminal is
   * closed), SIGUSR1, SIGUSR2 and SIGXCPU (a batch system announces its limit)
   * are caught; a second SIGINT ends the program at once. SIGPIPE and SIGXFSZ
   * are ignored: writing then returns an error, as on a full disk.
   * The wall time is counted from the construction of the object, so construct
   * it early. Only one object may be armed at a time.
   *
   * The answer is local to a rank (a signal or file may be seen by one rank
   * first): the time loop agrees on it before it acts.
   *
   * @code
   * stop_request.arm(output_directory);
   * while (time < end_time)
   *   {
   *     advance();
   *     if (!stop_request.reason().empty())
   *       break;
   *   }
   * @endcode
   */
  class StopRequest : public Section
  {
  public:
    using Signals = std::array<int, 9>;

    StopRequest();

    StopRequest(const StopRequest &) = delete;
    StopRequest &
    operator=(const StopRequest &) = delete;

    /** Restores the signal handlers that were found by arm(). */
    ~StopRequest() override;

    /** Throws BadInput for a stop file that is more than a name in the output
     * directory, or a result there: the run would remove it. */
    void
    check_parameters() const;

    /**
     * Catch signals from now on, and look for the stop file in this
     * directory.
     */
    void
    arm(const std::string &output_directory);

    /** Throw BadInput on all ranks where the stop file is there already, as one
     * of the user; one with the name stop, which nobody else uses, ends the
     * run. Collective, after arm(). */
    void
    refuse_file_of_user(const MPI_Comm communicator) const;

    /**
     * Why the run must stop, e.g. "SIGTERM received"; empty while it need
     * not. Once given, the answer stays. Cheap enough for every step: the
     * stop file (removed when found) is looked for twice a second at most.
     */
    std::string
    reason();

    /** How long ago the first reason was found; 0 if there is none, and
     * infinite for a signal to a process of mpirun, which ends it soon. Units:
     * s. */
    double
    seconds_since() const;

  private:
    using Clock = std::chrono::steady_clock;

    std::string
    find_reason();

    /** Whether the stop file was there; it is removed. */
    bool
    take_stop_file() const;

    std::optional<double> wall_time_limit;
    std::string           stop_file = "stop";

    const Clock::time_point start_time;
    Clock::time_point       next_look, found_at;
    std::string             stop_file_path;
    std::string             found_reason;
    bool                    is_armed = false;
    struct sigaction        previous_actions[std::tuple_size<Signals>::value];
  };
} // namespace CaissonMPM

#endif
