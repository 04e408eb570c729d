// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The entries of section Design.
#ifndef caisson_mpm_water_design_settings_h
#define caisson_mpm_water_design_settings_h

#include <caisson_mpm/base/section.h>

#include <deque>
#include <string>

namespace CaissonMPM
{
  /**
   * The factors on the limits of suction, the steel of the wall, and what a
   * certifier asks for. The program only hands them on to the report, in
   * run.json: nothing that it computes depends on them.
   */
  struct DesignSettings : public Section
  {
    DesignSettings();

  private:
    std::deque<double> values; // of the entries, which keep their places
    std::string        number_of_buckets = "1";
    std::string        spread_of_buckets;
    std::string        source_of_factors;
  };
} // namespace CaissonMPM

#endif
