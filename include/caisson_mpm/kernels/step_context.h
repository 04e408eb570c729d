// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the kernels work on in a step: the arguments that all of them take, and
// those of grid_to_points.
#ifndef caisson_mpm_kernels_step_context_h
#define caisson_mpm_kernels_step_context_h

#include <caisson_mpm/kernels/forward.h>
#include <caisson_mpm/kernels/settings.h>
#include <caisson_mpm/kernels/views.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    /** What all kernels of a step work on. They write to the points and to the
     * moments, and read the rest. */
    struct StepContext
    {
      PointsView          points;
      GridView            grid; // at the start of the step
      const Material     *materials;
      IntegrationSettings integration;
      CellMoments        *moments; // [n_cells]
      // [n_nodes], mean filled fraction of the soil cells at a node
      const double *filled_at_node;
      // [n_corners], for grid_to_points
      const CornerView *corners   = nullptr;
      unsigned int      n_corners = 0;
      // [n_cells], excess pore pressure of undrained soil; null: none (Pa)
      const double *pore_pressure = nullptr;
      // [n_cells], by which the mass of the points counts as inertia in a
      // cell; null: 1
      const double *inertia = nullptr;
    };

    /** The factor of the inertia in a cell. */
    inline double
    inertia_in(const StepContext &step, const unsigned int cell)
    {
      return step.inertia != nullptr ? step.inertia[cell] : 1.;
    }

    /** The nodal velocities that update the points, each [n_nodes]. */
    struct NodalFields
    {
      const NodalVector *advection; // moves the MPs
      const NodalVector *transfer;  // added to keep_velocity * velocity
      const NodalVector *strain;    // its gradient strains the MPs
      double transfer_of_body = 1.; // share of the body's velocity in it
    };

    /** What grid_to_points needs besides the context of the step. */
    struct PointUpdate
    {
      GridView       moved; // the grid at the end of the step
      UpdateSettings settings;
      NodalFields    fields;
      // [n_cells], div v that strains the points, in the place of the mean of
      // the field; NaN or no list: that mean (1/s)
      const double *volume_rates = nullptr;
    };
  } // namespace Kernels
} // namespace CaissonMPM

#endif
