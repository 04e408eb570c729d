// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The entries of section Design.
#ifndef caisson_mpm_water_design_settings_h
#define caisson_mpm_water_design_settings_h

#include <caisson_mpm/base/section.h>

#include <deque>

namespace CaissonMPM
{
  /**
   * The factors on the limits of suction, and the steel of the wall. The
   * program only hands them on to the report, in run.json: nothing that it
   * computes depends on them.
   */
  struct DesignSettings : public Section
  {
    DesignSettings();

  private:
    std::deque<double> values; // of the entries, which keep their places
  };
} // namespace CaissonMPM

#endif
