// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The parts of a simulation.
#ifndef caisson_mpm_simulation_simulation_parts_h
#define caisson_mpm_simulation_simulation_parts_h

#include <caisson_mpm/base/run_totals.h>
#include <caisson_mpm/base/stop_request.h>
#include <caisson_mpm/base/timing.h>
#include <caisson_mpm/bodies/rigid_body.h>
#include <caisson_mpm/domain/background_grid.h>
#include <caisson_mpm/domain/material_points.h>
#include <caisson_mpm/domain/point_generator.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/materials/soil.h>
#include <caisson_mpm/operators/boundary_conditions.h>
#include <caisson_mpm/operators/contact.h>
#include <caisson_mpm/operators/energy_balance.h>
#include <caisson_mpm/operators/nodal_force.h>
#include <caisson_mpm/operators/nodal_motion.h>
#include <caisson_mpm/operators/time_step.h>
#include <caisson_mpm/simulation/installation.h>
#include <caisson_mpm/simulation/schedule.h>
#include <caisson_mpm/water/pore_water.h>

#include <memory>
#include <vector>

namespace CaissonMPM
{
  /** What the simulation owns and the recorder reports on; reporting closes the
   * energy balance, and brings the totals to the first rank. */
  struct SimulationParts
  {
    explicit SimulationParts(const MPI_Comm communicator)
      : grid(lines, communicator)
      , points(grid)
      , schedule(body, clock)
    {}

    // in the order of their sections in a .prm file
    Installation       installation;
    GridLines          lines;
    BackgroundGrid     grid;
    Soil               soil;
    RigidBody          body;
    PointGenerator     generator;
    BoundaryConditions boundary_conditions;
    WaterSettings      water_settings;
    NodalForces        nodal_forces = make_nodal_forces();
    NodalMotion        nodal_motion;
    TimeStep           time_step;
    StopRequest        stop_request;

    // state
    Clock                          clock;
    MaterialPoints                 points;
    Contact                        contact;
    std::vector<Kernels::Material> materials;
    EnergyBalance                  energy;
    RunTotals                      totals;
    // of the level that the settings choose; after the totals, where it is
    std::unique_ptr<PoreWater> water;
    SectionTimer               timer;
    Schedule                   schedule;
  };
} // namespace CaissonMPM

#endif
