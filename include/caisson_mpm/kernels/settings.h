// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The settings of the two transfer kernels.
#ifndef caisson_mpm_kernels_settings_h
#define caisson_mpm_kernels_settings_h

namespace CaissonMPM
{
  namespace Kernels
  {
    /** Whether the slope of the mean stress in a full cell acts on its nodes.
     */
    enum class PressureSlope
    {
      by_dilation, // acts in soil that has not dilated
      acts,
      ignored
    };

    /** How the internal force is integrated. */
    struct IntegrationSettings
    {
      double full_at_surface; // filled fraction from which a cell is full
      double full_inside;     // the same away from free surfaces
      bool   has_minimum_nodal_mass; // sum the stiffness bound
      PressureSlope pressure_slope;
    };

    /** How grid_to_points updates the points. */
    struct UpdateSettings
    {
      double time_step;
      double keep_velocity;      // share of the MP's own velocity (FLIP 1)
      bool   mean_volume_change; // B-bar
      double limiter;            // k of |v| <= k H / dt; 0: off
      double stress_filter;      // share of the misfit removed; 0: off
    };
  } // namespace Kernels
} // namespace CaissonMPM

#endif
