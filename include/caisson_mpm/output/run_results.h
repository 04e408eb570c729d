// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What came out of an installation, for scripts: the member "results" of
// run.json.
#ifndef caisson_mpm_output_run_results_h
#define caisson_mpm_output_run_results_h

#include <caisson_mpm/output/error_bar.h>
#include <caisson_mpm/output/json.h>
#include <caisson_mpm/output/result_table.h>

#include <optional>

namespace CaissonMPM
{
  /** Return the penetration by weight alone, from which on there is suction
   * until the end; nothing without a pump. Units: m. */
  std::optional<double>
  self_weight_penetration(const Records &records);

  /**
   * Return the results. Of the way down: the largest force, the forces at each
   * half meter and at the end, with their error bars where they are known, and
   * with suction the penetration by weight, the largest suction, and the
   * margins to piping, boiling of the water, pump and lid, all by ResultTable.
   * Of a way up, the largest pull.
   */
  Json::Members
  run_results(const Records      &records,
              const ErrorBar     &error_bar,
              const ResultLimits &limits);
} // namespace CaissonMPM

#endif
