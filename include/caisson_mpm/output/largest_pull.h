// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The largest pull that soil and water bear, and what bears it.
#ifndef caisson_mpm_output_largest_pull_h
#define caisson_mpm_output_largest_pull_h

#include <caisson_mpm/output/json.h>
#include <caisson_mpm/output/records.h>

#include <optional>
#include <string>

namespace CaissonMPM
{
  /** Forces are upward on the soil: what a caisson takes with it. They are
   * means of a record, and contain no weight. */
  struct LargestPull
  {
    double pull = 0., penetration = 0., rise = 0.;       // N, m, m
    double water = 0., outer = 0., inner = 0., tip = 0.; // parts of it, N
    /** Whether friction is mobilized, and the pull has not increased much over
     * the last part of the rise. */
    bool is_capacity = false;
    /** Of a sealed lid, the rise of the plug's surface over that of the lid. */
    std::optional<double> plug_follows;
    /** How a caisson with a sealed lid fails; empty with another lid, and where
     * it does not fail. */
    std::string mechanism;

    Json::Members
    json() const;
  };

  /** Return the largest pull over records in which the body rises, nothing
   * where there are none. It is where a median over five records is largest,
   * over three where there are few. */
  std::optional<LargestPull>
  largest_pull(const Records &records);
} // namespace CaissonMPM

#endif
