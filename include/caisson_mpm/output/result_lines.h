// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The forces of a finished run in words.
#ifndef caisson_mpm_output_result_lines_h
#define caisson_mpm_output_result_lines_h

#include <caisson_mpm/base/console.h>
#include <caisson_mpm/output/error_bar.h>
#include <caisson_mpm/output/records.h>

namespace CaissonMPM
{
  /**
   * Return the largest force on the way down, the largest pull, and the forces
   * at most ten or so of the depths of ResultTable, on the way down with the
   * error of the total force where it is known, and on the way up. The records
   * need the columns of forces and penetration. The units fit the largest force
   * and the length of the body (m).
   */
  Console::Lines
  result_lines(const Records  &records,
               const ErrorBar &error_bar,
               const double    length);
} // namespace CaissonMPM

#endif
