// SPDX-License-Identifier: LGPL-2.1-or-later
//
// When a run ends, and when it writes records and frames.
#ifndef caisson_mpm_simulation_schedule_h
#define caisson_mpm_simulation_schedule_h

#include <caisson_mpm/base/run_totals.h>
#include <caisson_mpm/base/section.h>
#include <caisson_mpm/bodies/rigid_body.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  /** Owned by the simulation, which alone sets it; the same on all ranks. */
  struct Clock
  {
    double        time      = 0.; // s
    double        step_size = 0.; // of the last step, s
    unsigned long step      = 0;  // number of steps so far
  };

  /**
   * The events of a run, at times or at penetrations of the body.
   *
   * An event at a penetration is met exactly if the motion knows when the body
   * will be there, as a prescribed motion does: the steps before it are
   * shortened. Otherwise it is due after the step in which the body has come
   * there. The future is not needed for anything else.
   *
   * @code
   * schedule.start();
   * while (!schedule.is_finished())
   *   {
   *     advance(schedule.shorten(stable_step));
   *     const Schedule::Due due = schedule.take_due();
   *     if (due.record)
   *       record();
   *   }
   * @endcode
   *
   * The same on all ranks; not collective.
   */
  class Schedule : public Section
  {
  public:
    /** What is to be done after a step. */
    struct Due
    {
      bool record = false, frame = false;
    };

    /** Both must outlive this object. */
    Schedule(const RigidBody &body, const Clock &clock);

    /** Throw BadInput for a run that has no end. */
    void
    check_parameters() const;

    /** Report which entries have no effect without a body. */
    void
    name_unused_entries(ParameterOrigins &origins) const override;

    /** Return the smallest and the largest travel of the body that the mesh
     * must be able to hold. Units: m. */
    std::pair<double, double>
    travel_to_hold() const;

    /** Begin a run. */
    void
    start();

    /** Continue a run at the clock's time, with the state of the totals. */
    void
    resume();

    /** Return the step, shortened such that steps of this size lead to the
     * next event. Units: s. */
    double
    shorten(const double step_size) const;

    /** Whether the run has come to its end. */
    bool
    is_finished() const;

    /** Whether the body has come to Time/End penetration. */
    bool
    is_at_end_penetration() const
    {
      return last_penetration && has_reached(*last_penetration);
    }

    /** Return what is due now; it will not be due again. */
    Due
    take_due();

    /** The time of the end, infinite where the motion cannot know it. Units: s.
     */
    double
    end_time() const
    {
      return end;
    }

    /** How many steps of this size are left, infinite where the end is not
     * known. Units: s. */
    double
    steps_left(const double step_size) const;

    /** How much of the run is done, from 0 to 1. */
    double
    fraction_done() const;

    /** Return the number of frames of the whole run, those at the start and at
     * the end included. */
    unsigned int
    n_frames() const;

    /** Return the penetrations at which the scene asks for frames. Units: m. */
    const std::vector<double> &
    penetrations_of_frames() const
    {
      return frame_penetrations;
    }

    /** Return those of them that the body does not pass. Units: m. */
    std::vector<double>
    frames_out_of_reach() const;

    /** Return the number of rows of history.csv, infinite where every step has
     * one, or where the end is not known. */
    double
    n_records() const;

    /** Return the end in words. */
    std::string
    end_description() const;

    /** Return the entry that decides when the run ends. */
    std::string
    entry_of_end() const;

    /** Register what a continued run must know. */
    void
    register_totals(RunTotals &totals);

  private:
    /** Return the time at which the body is at a depth, infinite where that
     * never happens or is not known. */
    double
    time_of(const double depth) const;

    /** Whether the motion knows when the body will be where. */
    bool
    times_are_known() const;

    /** Return the travel at which the body is at a depth. */
    double
    travel_at(const double depth) const
    {
      return depth - body.shape().initial_depth();
    }

    /** Whether the body is at a depth or has passed it, for a motion that
     * cannot know when. */
    bool
    has_reached(const double depth) const;

    double
    find_end() const;
    double
    next_frame_time(const double after) const;

    /** Whether a frame at a penetration, whose time was not known, was written
     * just now, so that none is needed for the interval. */
    bool
    follows_a_frame() const;

    /** Forget the frames up to the present. */
    void
    pass_frames();

    const RigidBody &body;
    const Clock     &clock;

    std::optional<double> last_time, last_penetration;
    std::optional<double> record_interval = 0.1, frame_interval;
    std::vector<double>   frame_penetrations;

    double              end         = 0.;
    double              next_record = 0.;
    double              passed      = 0.; // frames up to here are written
    double              last_frame  = 0.;
    std::vector<double> frame_times;  // of penetrations, increasing
    std::vector<double> frame_depths; // whose times are not known
  };
} // namespace CaissonMPM

#endif
