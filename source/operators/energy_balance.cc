// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/operators/energy_balance.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  using namespace dealii;

  PointEnergies
  compute_point_energies(const MaterialPoints                 &points,
                         const std::vector<Kernels::Material> &materials,
                         const BackgroundGrid                 &grid,
                         const double                         *inertia)
  {
    PointEnergies result;
    points.for_each_motion([&](const Point<2>    &position,
                               const Vector2     &velocity,
                               const double       mass,
                               const unsigned int material,
                               const unsigned int cell) {
      const double *const force   = materials[material].body_force;
      const double        rise[2] = {-mass * force[0] * position[0],
                                     -mass * force[1] * position[1]};
      const double        factor  = inertia != nullptr ? inertia[cell] : 1.;
      result.kinetic += .5 * factor * mass * velocity.norm_square();
      result.potential += rise[0] + rise[1];
      result.weight += std::abs(rise[0]) + std::abs(rise[1]);
    });
    for (double *sum : {&result.kinetic, &result.potential, &result.weight})
      *sum =
        grid.circumference() * Utilities::MPI::sum(*sum, grid.communicator());
    return result;
  }

  void
  EnergyBalance::start(const PointEnergies &points)
  {
    *this             = EnergyBalance();
    initial_kinetic   = points.kinetic;
    initial_potential = points.potential;
    // soil at rest moves by round-off, and its works mean nothing
    largest = std::max(points.kinetic, 1e-9 * points.weight);
  }

  void
  EnergyBalance::add(const NodalWork &nodes, const double stress)
  {
    work_of_body += nodes.body + nodes.prescribed;
    work_on_water += nodes.water;
    force_work += nodes.forces;
    load_work += nodes.load;
    friction_heat += nodes.friction;
    damping += nodes.damping;
    floor += nodes.mass_floor;
    deformation_inertia += nodes.deformation_inertia;
    stress_work += stress;
  }

  void
  EnergyBalance::close(const PointEnergies &points)
  {
    kinetic_gain = points.kinetic - initial_kinetic;
    gravity_work = initial_potential - points.potential;
    // the points have gained what the nodes were given, less this
    dissipation = force_work + work_of_body - friction_heat - damping - floor -
                  deformation_inertia - kinetic_gain;
    residual = gravity_work + load_work - force_work - stress_work;
    largest  = std::max({largest,
                         std::abs(work_of_body),
                         std::abs(gravity_work),
                         std::abs(load_work)});
    relative = largest > 0. ? residual / largest : 0.;
  }

  void
  EnergyBalance::register_totals(RunTotals &totals)
  {
    totals.sum("work_of_body", work_of_body);
    totals.sum("work_on_water", work_on_water);
    totals.sum("work_of_forces", force_work);
    totals.sum("work_of_loads", load_work);
    totals.sum("stress_work", stress_work);
    totals.sum("friction_heat", friction_heat);
    totals.sum("damping", damping);
    totals.sum("mass_floor", floor);
    totals.sum("deformation_inertia", deformation_inertia);
    totals.keep("initial_kinetic_energy", initial_kinetic);
    totals.keep("initial_potential_energy", initial_potential);
    totals.keep("largest_work", largest);
  }

  const std::vector<EnergyBalance::Term> &
  EnergyBalance::terms()
  {
    using E                            = EnergyBalance;
    static const std::vector<Term> all = {
      {"gravity_work_J", &E::gravity_work},
      {"load_work_J", &E::load_work},
      {"stress_work_J", &E::stress_work},
      {"friction_heat_J", &E::friction_heat},
      {"damping_J", &E::damping},
      {"mass_floor_J", &E::floor},
      {"deformation_inertia_J", &E::deformation_inertia},
      {"numerical_dissipation_J", &E::dissipation},
      {"energy_residual_J", &E::residual},
      {"energy_residual", &E::relative}};
    return all;
  }
} // namespace CaissonMPM
