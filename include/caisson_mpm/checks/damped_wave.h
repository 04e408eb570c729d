// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The damped wave that fits a series of numbers best,
//   c + exp(-g t) (a cos(w t) + b sin(w t)),
// in the least-squares sense. For given w and g the other three follow from
// their normal equations; w and g are searched.
#ifndef caisson_mpm_checks_damped_wave_h
#define caisson_mpm_checks_damped_wave_h

#include <caisson_mpm/output/records.h>

namespace CaissonMPM
{
  struct DampedWave
  {
    double frequency; // w (rad/s)
    double damping;   // g (1/s)

    /** exp(-g t) after two periods. */
    double
    left_after_two_periods() const;
  };

  /** The wave in a series that holds at least one period, and some ten records
   * in each; not a number where there are fewer than two changes of sign about
   * the mean or eight records. */
  DampedWave
  fit_damped_wave(const Series &series);
} // namespace CaissonMPM

#endif
