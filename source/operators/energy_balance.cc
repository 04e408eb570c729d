// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/operators/energy_balance.h>

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



  const EnergyBalance::Members &
  EnergyBalance::works()
  {
    using E                    = EnergyBalance;
    static const Members works = {&E::work_of_body,
                                  &E::force_work,
                                  &E::load_work,
                                  &E::stress_work,
                                  &E::friction_heat,
                                  &E::damping,
                                  &E::floor};
    return works;
  }



  EnergyBalance::Members
  EnergyBalance::state_members()
  {
    using E        = EnergyBalance;
    Members result = works();
    result.insert(result.end(),
                  {&E::initial_kinetic, &E::initial_potential, &E::largest});
    return result;
  }



  std::vector<double>
  EnergyBalance::state() const
  {
    std::vector<double> state;
    for (const auto member : state_members())
      state.push_back(this->*member);
    return state;
  }



  void
  EnergyBalance::resume(const std::vector<double> &state)
  {
    unsigned int i = 0;
    for (const auto member : state_members())
      this->*member = state.at(i++);
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
      {"numerical_dissipation_J", &E::dissipation},
      {"energy_residual_J", &E::residual},
      {"energy_residual", &E::relative}};
    return all;
  }



  std::vector<std::pair<std::string, double>>
  EnergyBalance::entries() const
  {
    std::vector<std::pair<std::string, double>> entries;
    for (const Term &term : terms())
      entries.emplace_back(term.name, this->*term.value);
    return entries;
  }
} // namespace CaissonMPM
