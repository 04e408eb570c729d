// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/simulation/schedule.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    constexpr double never     = std::numeric_limits<double>::infinity();
    constexpr double tolerance = 1e-9; // of a time, s
    constexpr double close     = .05;  // frames, in intervals between frames
  }                                    // namespace

  Schedule::Schedule(const RigidBody &body, const Clock &clock)
    : Section("/", Influence::none)
    , body(body)
    , clock(clock)
  {
    const Patterns::Double not_negative(0.);
    enter_subsection("Time");
    add_word_or_number(
      *this,
      "End time",
      last_time,
      "never",
      0.,
      "s",
      "The run ends at this time, unless End penetration ends it earlier.",
      not_negative);
    add_word_or_number(
      *this,
      "End penetration",
      last_penetration,
      "never",
      0.,
      "m",
      "The run ends when the tip of the body has come to this depth, unless "
      "End time ends it earlier.",
      not_negative);
    leave_subsection();
    enter_subsection("Output");
    add_word_or_number(
      *this,
      "Record interval",
      record_interval,
      "every step",
      0.,
      "s",
      "The rows of history.csv are this time apart, and their forces are means "
      "over it.",
      not_negative);
    add_word_or_number(
      *this,
      "Frame interval",
      frame_interval,
      "never",
      0.,
      "s",
      "Frames (VTU) are written this time apart, besides the first, the last "
      "and those at Frame penetrations.",
      Patterns::Double(1e-9));
    add_parameter("Frame penetrations",
                  frame_penetrations,
                  "m",
                  "Further frames are written at these penetrations.",
                  Patterns::List(Patterns::Double(0.), 0, 1000));
    leave_subsection();
  }

  double
  Schedule::time_of(const double depth) const
  {
    return body.motion().time_of_travel(travel_at(depth)).value_or(never);
  }

  bool
  Schedule::times_are_known() const
  {
    return body.motion().time_of_travel(0.).has_value();
  }

  bool
  Schedule::has_reached(const double depth) const
  {
    const double travel = body.motion().travel(), wanted = travel_at(depth);
    return wanted >= body.motion().beginning().travel ? travel >= wanted :
                                                        travel <= wanted;
  }

  double
  Schedule::find_end() const
  {
    return std::min(last_time.value_or(never),
                    last_penetration ? time_of(*last_penetration) : never);
  }

  double
  Schedule::steps_left(const double step_size) const
  {
    return std::ceil((end_time() - clock.time) / step_size);
  }

  void
  Schedule::name_unused_entries(ParameterOrigins &origins) const
  {
    if (!body.shape().exists())
      origins.add_unused({"Time/End penetration", "Output/Frame penetrations"},
                         "Rigid body/Kind is none");
  }

  void
  Schedule::check_parameters() const
  {
    constexpr double same_place = 1e-6; // m
    const double     start      = body.motion().beginning().travel;
    if (last_penetration && start != 0. &&
        std::abs(travel_at(*last_penetration) - start) < same_place)
      throw BadInput("Time/End penetration = " + to_text(*last_penetration) +
                     " m is where the body is at the end of the run in "
                     "Installation/Directory. Set the depth at which this run "
                     "ends, or never and Time/End time.");
    if (last_penetration && !last_time && body.motion().traits.follows_loads)
      throw BadInput("Rigid body/Motion is " + body.motion().name +
                     ": the body may rest before it has come to Time/End "
                     "penetration. Set Time/End time, too.");
    if (std::isfinite(find_end()) || (last_penetration && !times_are_known()))
      return;
    const double depth = body.shape().initial_depth();
    if (last_penetration && *last_penetration < depth && start == 0.)
      throw BadInput(
        "Time/End penetration = " + to_text(*last_penetration) +
        " m is less than Rigid body/Initial penetration = " + to_text(depth) +
        " m. Push deeper, start higher, or pull with a negative velocity.");
    if (last_penetration && !body.shape().exists())
      throw BadInput(
        "Rigid body/Kind is none, so there is no body that Time/End "
        "penetration could end: the run has no end. Set Rigid body/Kind, or "
        "Time/End time.");
    throw BadInput(
      "the run has no end: set Time/End time, or Time/End penetration to a "
      "depth that the body reaches with its velocity.");
  }

  std::pair<double, double>
  Schedule::travel_to_hold() const
  {
    if (const auto range = body.motion().travel_range(find_end()))
      return *range;
    if (!last_penetration)
      throw BadInput("Time/End penetration must be set: the motion of the body "
                     "is not known in advance, and the mesh must be made for "
                     "all of it.");
    const double travel = travel_at(*last_penetration),
                 start  = body.motion().beginning().travel;
    return {std::min(start, travel), std::max(start, travel)};
  }

  void
  Schedule::start()
  {
    next_record = record_interval.value_or(0.);
    resume();
  }

  void
  Schedule::resume()
  {
    end = find_end();
    frame_times.clear();
    frame_depths.clear();
    for (const double depth : frame_penetrations)
      if (times_are_known())
        frame_times.push_back(time_of(depth));
      else
        frame_depths.push_back(depth);
    std::sort(frame_times.begin(), frame_times.end());
    pass_frames();
  }

  void
  Schedule::pass_frames()
  {
    passed = clock.time + tolerance;
    frame_depths.erase(std::remove_if(frame_depths.begin(),
                                      frame_depths.end(),
                                      [this](const double depth) {
                                        return has_reached(depth);
                                      }),
                       frame_depths.end());
  }

  double
  Schedule::next_frame_time(const double after) const
  {
    double     next = end;
    const auto listed =
      std::upper_bound(frame_times.begin(), frame_times.end(), after);
    if (listed != frame_times.end())
      next = std::min(next, *listed);
    if (frame_interval)
      {
        double at =
          (std::floor(after / *frame_interval) + 1.) * *frame_interval;
        if (at <= after) // rounded
          at += *frame_interval;
        // none close to one that is listed, or to the end
        const auto is_close = [&](const double time) {
          return std::abs(time - at) < close * *frame_interval;
        };
        while (is_close(end) ||
               std::any_of(frame_times.begin(), frame_times.end(), is_close))
          at += *frame_interval;
        if (at < end - tolerance)
          next = std::min(next, at);
      }
    return next;
  }

  double
  Schedule::shorten(const double step_size) const
  {
    double event = std::min(end, next_frame_time(passed));
    if (record_interval)
      event = std::min(event, next_record);
    const double left = event - clock.time;
    // share what is left evenly
    return left > 0. && std::isfinite(left) ?
             left / std::ceil(left / step_size * (1. - 1e-9)) :
             step_size;
  }

  bool
  Schedule::is_finished() const
  {
    if (last_penetration && !times_are_known() &&
        has_reached(*last_penetration))
      return true;
    return clock.time >= end - tolerance * std::max(1., end);
  }

  bool
  Schedule::follows_a_frame() const
  {
    return frame_interval && frame_times.empty() &&
           clock.time - last_frame < close * *frame_interval;
  }

  Schedule::Due
  Schedule::take_due()
  {
    const double now      = clock.time + tolerance;
    const bool   finished = is_finished();
    Due          due;
    due.record            = finished || now >= next_record;
    const bool is_at_time = now >= next_frame_time(passed);
    due.frame             = finished || (is_at_time && !follows_a_frame()) ||
                std::any_of(frame_depths.begin(),
                            frame_depths.end(),
                            [this](const double d) { return has_reached(d); });
    if (now >= next_record)
      next_record += record_interval.value_or(0.);
    if (due.frame || is_at_time)
      pass_frames();
    if (due.frame)
      last_frame = clock.time;
    return due;
  }

  double
  Schedule::fraction_done() const
  {
    double fraction = clock.time / end; // 0 where the end is not known
    if (last_penetration && !times_are_known())
      {
        const double start  = body.motion().beginning().travel,
                     travel = travel_at(*last_penetration) - start;
        fraction =
          std::max(fraction,
                   travel != 0. ? (body.motion().travel() - start) / travel :
                                  1.);
      }
    return std::min(1., fraction);
  }

  unsigned int
  Schedule::n_frames() const
  {
    // the first, and those at depths whose times are not known
    double n = 1. + frame_depths.size();
    if (!std::isfinite(end))
      return n + 1. + frame_times.size();
    constexpr double many = 1e6;
    if (frame_interval && end / *frame_interval > many)
      return std::min(end / *frame_interval, 1e9);
    for (double time = passed; time < end; ++n)
      time = next_frame_time(time) + tolerance;
    return n;
  }

  std::vector<double>
  Schedule::frames_out_of_reach() const
  {
    constexpr double    same_place = 1e-6; // m
    const auto          range      = travel_to_hold();
    std::vector<double> result;
    for (const double depth : frame_penetrations)
      if (body.shape().exists() &&
          (travel_at(depth) < range.first - same_place ||
           travel_at(depth) > range.second + same_place))
        result.push_back(depth);
    return result;
  }

  double
  Schedule::n_records() const
  {
    return record_interval ? end / *record_interval : never;
  }

  std::string
  Schedule::end_description() const
  {
    return std::isfinite(end) ?
             to_text(end, 6) + " s" :
             "at a penetration of " + to_text(*last_penetration) + " m";
  }

  std::string
  Schedule::entry_of_end() const
  {
    if (!last_penetration)
      return "Time/End time";
    const double time = time_of(*last_penetration);
    if (!last_time || time <= *last_time)
      return "Time/End penetration";
    return std::isfinite(time) ? "Time/End time" :
                                 "Time/End penetration or Time/End time";
  }

  void
  Schedule::register_totals(RunTotals &totals)
  {
    totals.keep("next_record", next_record);
    totals.keep("last_frame", last_frame);
  }
} // namespace CaissonMPM
