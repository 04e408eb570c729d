// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/kernels/cell_map.h>
#include <caisson_mpm/kernels/layout.h>
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
    grid.reinit(predicted, 2);
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
               0,
               soil.pore_pressure,
               soil.inertia};
    momentum.collect({*kernels, step, soil.points, soil.grid, time},
                     soil.deformation_inertia,
                     forces);
  }

  void
  NodalMotion::accelerate(const StepSize    &step_size,
                          const NodalForces &forces,
                          const Vector2     &body_velocity,
                          Contact           &contact)
  {
    enter(Stage::accelerated);
    size = step_size;
    contact.cover(momentum.filled());
    contact.corners().collect(*kernels,
                              step,
                              settings_.keep_velocity(size),
                              forces);
    accelerate(body_velocity, contact, false);
  }

  void
  NodalMotion::accelerate(const Vector2 &body_velocity,
                          Contact       &contact,
                          const bool     is_corrected)
  {
    momentum.accelerate(size.seconds,
                        settings_.local_damping(),
                        body_velocity,
                        contact,
                        is_corrected);
    velocity_of_body = body_velocity;
    show_corners(contact);
  }

  void
  NodalMotion::show_corners(const Contact &contact)
  {
    step.corners   = contact.corners().views().data();
    step.n_corners = contact.corners().views().size();
  }

  void
  NodalMotion::correct(const SoilOnGrid &soil,
                       NodalForces      &forces,
                       const double      time,
                       const Vector2    &body_velocity,
                       NodalConstraints &constraints,
                       Contact          &contact)
  {
    enter(Stage::corrected);
    std::vector<NodalForce *> implicit;
    for (const auto &force : forces)
      if (force->is_active() && force->is_implicit())
        implicit.push_back(force.get());
    if (implicit.empty())
      return;
    // 1. predict: v+ with the forces of the last step, and constrained
    momentum.predict(predicted);
    momentum.constrain(size.seconds, body_velocity, constraints, predicted);
    // 2. compute the forces that follow from it
    for (NodalForce *const force : implicit)
      force->solve(nodal_vectors(predicted),
                   contact.corners().views(),
                   momentum.scaled_mass());
    // 3. correct v+ by their change
    momentum.correct({*kernels, step, soil.points, soil.grid, time}, forces);
    contact.corners().add_forces(step, forces);
    accelerate(body_velocity, contact, true);
  }

  Contact::Response
  NodalMotion::respond(Contact &contact) const
  {
    return momentum.respond(size.seconds, velocity_of_body, contact);
  }

  void
  NodalMotion::replace_body_velocity(const Vector2 &body_velocity,
                                     Contact       &contact)
  {
    momentum.accelerate_corners(size.seconds, body_velocity, contact);
    show_corners(contact);
  }

  void
  NodalMotion::constrain(const Vector2    &body_velocity,
                         NodalConstraints &constraints)
  {
    enter(Stage::constrained);
    reactions_ = momentum.constrain(size.seconds,
                                    body_velocity,
                                    constraints,
                                    momentum.new_velocity());
    if (step.integration.has_minimum_nodal_mass)
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
                             const double            *volume_rates,
                             Kernels::UpdateResult   &result)
  {
    enter(Stage::points_updated);
    kernels->grid_to_points(
      step,
      {moved, settings_.update(size), transfer.fields(momentum), volume_rates},
      result);
  }

  std::array<double, 2>
  NodalMotion::rate_of_stretch(const BackgroundGrid   &grid,
                               const unsigned int      cell,
                               const dealii::Point<2> &place) const
  {
    const Kernels::CellMap<>          map(grid.geometry(cell));
    const Kernels::LocalPoint<double> p =
      map.at_position(place[radial], place[vertical]);
    const Kernels::NodalVector *const v =
      nodal_vectors(momentum.new_velocity());
    std::array<double, 2> rates;
    for (unsigned int d = 0; d < 2; ++d)
      {
        double at_corner[4], field[4], slope[2];
        for (unsigned int k = 0; k < 4; ++k)
          at_corner[k] = v[grid.cell_nodes(cell).node[k]].value[d];
        Kernels::coefficients(at_corner, field);
        Kernels::gradient(field, p, map.inverse_width, slope[0], slope[1]);
        rates[d] = slope[d];
      }
    return rates;
  }
} // namespace CaissonMPM
