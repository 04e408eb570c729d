// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/output/energy_balance.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
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
    force_work += nodes.forces;
    load_work += nodes.load;
    friction_heat += nodes.friction;
    damping += nodes.damping;
    floor += nodes.floor;
    stress_work += stress;
  }



  void
  EnergyBalance::close(const PointEnergies &points)
  {
    kinetic_gain = points.kinetic - initial_kinetic;
    gravity_work = initial_potential - points.potential;
    // the points have gained what the nodes were given, less this
    dissipation = force_work + work_of_body - friction_heat - damping - floor -
                  kinetic_gain;
    residual = gravity_work + load_work - force_work - stress_work;
    largest  = std::max({largest,
                         std::abs(work_of_body),
                         std::abs(gravity_work),
                         std::abs(load_work)});
    relative = largest > 0. ? residual / largest : 0.;
  }



  std::vector<double>
  EnergyBalance::state() const
  {
    return {work_of_body,
            force_work,
            load_work,
            stress_work,
            friction_heat,
            damping,
            floor,
            initial_kinetic,
            initial_potential,
            largest};
  }



  void
  EnergyBalance::resume(const std::vector<double> &state)
  {
    double *const values[] = {&work_of_body,
                              &force_work,
                              &load_work,
                              &stress_work,
                              &friction_heat,
                              &damping,
                              &floor,
                              &initial_kinetic,
                              &initial_potential,
                              &largest};
    for (unsigned int i = 0; i < std::size(values); ++i)
      *values[i] = state.at(i);
  }



  std::vector<std::pair<std::string, double>>
  EnergyBalance::entries() const
  {
    return {{"gravity_work_J", gravity_work},
            {"load_work_J", load_work},
            {"stress_work_J", stress_work},
            {"friction_heat_J", friction_heat},
            {"damping_J", damping},
            {"mass_floor_J", floor},
            {"numerical_dissipation_J", dissipation},
            {"energy_residual_J", residual},
            {"energy_residual", relative}};
  }
} // namespace CaissonMPM
