// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/simulation/run_cost.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  namespace
  {
    // Of a point in a compressed frame, and while the frame is made; frames are
    // made of pieces of at most so many points.
    constexpr double bytes_on_disk = 80., bytes_in_memory = 1000.,
                     points_in_piece = 100000.;
    // As many points as at the start has a run that splits them at its end:
    // 1.8 to 2.1 times in 150 runs of caissons, 1.3 to 1.5 in few.
    constexpr double split = 2.;

    std::string
    megabytes(const double bytes)
    {
      return rough(1e-6 * bytes) + " MB";
    }

    std::string
    duration(const std::pair<double, double> &seconds)
    {
      const double      most = seconds.second;
      const double      unit = most < 90. ? 1. : most < 5400. ? 60. : 3600.;
      const std::string name = most < 90. ? " s" : most < 5400. ? " min" : " h";
      return rough(seconds.first / unit) + " to " + rough(most / unit) + name;
    }
  } // namespace

  std::pair<double, double>
  RunCost::seconds() const
  {
    // Where points are split, there are 1.6 times as many in the mean over the
    // steps; frames, checkpoints and the search for the step add a little.
    const double     later  = splits ? 1.5 : 1.1;
    constexpr double within = 1.5;
    const double     likely = later * n_steps * seconds_per_step;
    return {likely / within, likely * within};
  }

  std::string
  describe(const RunCost &cost)
  {
    const double n_points = cost.n_points, n_steps = cost.n_steps,
                 // no more than one for each step, and the first
      n_frames = std::min(n_steps + 1., 1. * cost.n_frames);
    std::string text =
      "  grid       " + cost.grid + "\n  points     " + to_text(cost.n_points) +
      (cost.splits ? " at the start, and about " + rough(split * n_points) +
                       " at the end by splitting" :
                     "") +
      "\n  time step  " + to_text(cost.step_size, 4) + " s, limited by " +
      cost.limit;
    text += "\n  end        " + cost.end;
    if (std::isfinite(n_steps))
      text += "\n  steps      about " + rough(n_steps);
    text += "\n  memory     about " +
            megabytes(cost.peak_bytes +
                      bytes_in_memory * std::min(n_points, points_in_piece)) +
            (cost.n_ranks > 1 ? "" :
                                " on one rank, and as much again for each "
                                "further one") +
            "\n  frames     " + rough(n_frames) + ", about " +
            megabytes(n_frames * bytes_on_disk * n_points *
                      (cost.splits ? split : 1.)) +
            " on the disk";
    if (std::isfinite(n_steps) && cost.seconds_per_step > 0.)
      text += "\n  duration   about " + duration(cost.seconds()) + " on " +
              (cost.n_ranks > 1 ? to_text(cost.n_ranks) + " cores" :
                                  std::string("one core")) +
              ": by the speed of the first steps";
    for (const std::string &saving : cost.savings)
      text += "\n  cheaper    " + saving;
    return text + "\n";
  }
} // namespace CaissonMPM
