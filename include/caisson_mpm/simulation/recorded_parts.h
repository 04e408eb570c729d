// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The parts of a simulation that a run reports on.
#ifndef caisson_mpm_simulation_recorded_parts_h
#define caisson_mpm_simulation_recorded_parts_h

#include <caisson_mpm/base/run_totals.h>
#include <caisson_mpm/base/timing.h>
#include <caisson_mpm/bodies/rigid_body.h>
#include <caisson_mpm/domain/background_grid.h>
#include <caisson_mpm/domain/body_points.h>
#include <caisson_mpm/domain/material_points.h>
#include <caisson_mpm/domain/point_generator.h>
#include <caisson_mpm/kernels/material.h>
#include <caisson_mpm/materials/soil.h>
#include <caisson_mpm/operators/boundary_conditions.h>
#include <caisson_mpm/operators/contact.h>
#include <caisson_mpm/operators/energy_balance.h>
#include <caisson_mpm/operators/nodal_motion.h>
#include <caisson_mpm/operators/time_step.h>
#include <caisson_mpm/simulation/clock.h>
#include <caisson_mpm/simulation/schedule.h>
#include <caisson_mpm/water/pore_water.h>

#include <memory>
#include <vector>

namespace CaissonMPM
{
  /** References only: the simulation owns the parts. What is not const is
   * changed by reporting: the grid's vertices are written, the energy
   * balance is closed, and the totals are brought to the first rank. */
  struct RecordedParts
  {
    const Clock                          &clock;
    const Schedule                       &schedule;
    const Soil                           &soil;
    const RigidBody                      &body;
    const TimeStep                       &time_step;
    const PointGenerator                 &generator;
    const BoundaryConditions             &boundary_conditions;
    const NodalMotion                    &nodal_motion;
    const Contact                        &contact;
    const MaterialPoints                 &points;
    const std::vector<BodyPoint>         &body_points;
    const std::vector<Kernels::Material> &materials;
    const SectionTimer                   &timer;
    BackgroundGrid                       &grid;
    EnergyBalance                        &energy;
    RunTotals                            &totals;
    const std::unique_ptr<PoreWater>     &water; // when parameters are known
  };
} // namespace CaissonMPM

#endif
