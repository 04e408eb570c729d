// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/operators/nodal_motion.h>

namespace CaissonMPM
{
  void
  NodalMotion::initialize(const BackgroundGrid &grid)
  {
    momentum.initialize(grid);
    mass_floor.initialize(grid);
    transfer.initialize(grid);
    work.initialize(grid);
    stage = Stage::points_updated;
  }

  void
  NodalMotion::enter(const Stage next)
  {
    constexpr int n_stages = static_cast<int>(Stage::work_found) + 1;
    AssertThrow(static_cast<int>(next) ==
                  (static_cast<int>(stage) + 1) % n_stages,
                dealii::ExcMessage("The functions of NodalMotion must be "
                                   "called once each, in their order."));
    stage = next;
  }

  void
  NodalMotion::collect(const SoilOnGrid &soil,
                       NodalForces      &forces,
                       const double      time)
  {
    enter(Stage::collected);
    moments.resize(soil.grid.n_cells());
    kernels = &soil.kernels;
    step    = {soil.points.view(),
               soil.grid.view(),
               soil.materials.data(),
               settings_.integration(),
               moments.data(),
               momentum.filled(),
               nullptr,
               0};
    momentum.collect({*kernels, step, soil.points, soil.grid, time}, forces);
  }

  void
  NodalMotion::accelerate(const StepSize &step_size,
                          const Vector2  &body_velocity,
                          Contact        &contact)
  {
    enter(Stage::accelerated);
    size = step_size;
    contact.corners().collect(*kernels, step);
    momentum.accelerate(size.seconds,
                        settings_.local_damping(),
                        body_velocity,
                        contact);
    step.corners   = contact.corners().views().data();
    step.n_corners = contact.corners().views().size();
  }

  void
  NodalMotion::constrain(const Vector2    &body_velocity,
                         NodalConstraints &constraints)
  {
    enter(Stage::constrained);
    reactions_ = momentum.constrain(size.seconds, body_velocity, constraints);
    if (step.integration.floor_mass)
      mass_floor.distribute(*kernels, step, constraints, momentum, reactions_);
  }

  void
  NodalMotion::prepare_transfer(const NodalConstraints &constraints)
  {
    enter(Stage::transfer_prepared);
    transfer.prepare(
      settings_, size, *kernels, step, momentum, constraints, reactions_);
  }

  NodalWork
  NodalMotion::work_of_step(const NodalForces      &forces,
                            const NodalConstraints &constraints)
  {
    enter(Stage::work_found);
    return work.find(size.seconds,
                     settings_.local_damping(),
                     momentum,
                     mass_floor,
                     transfer.fields(momentum).strain,
                     forces,
                     constraints,
                     reactions_);
  }

  void
  NodalMotion::update_points(const Kernels::GridView &moved,
                             Kernels::UpdateResult   &result)
  {
    enter(Stage::points_updated);
    kernels->grid_to_points(
      step, {moved, settings_.update(size), transfer.fields(momentum)}, result);
  }
} // namespace CaissonMPM
