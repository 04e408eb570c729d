// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/operators/body_force.h>
#include <caisson_mpm/operators/nodal_force.h>
#include <caisson_mpm/operators/surrounding_pressure.h>

#include <algorithm>

namespace CaissonMPM
{
  void
  NodalForce::collect(const ForceContext &context, Kernels::NodalSums *nodes)
  {
    force.clear();
    if (!is_active())
      return;
    force.resize(context.grid.n_nodes(), {{0., 0.}});
    add(context, force.data());
    for (std::size_t i = 0; i < force.size(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
        nodes[i].force[d] += force[i].value[d];
  }

  void
  NodalForce::correct(const ForceContext &context, Kernels::NodalVector *change)
  {
    if (!is_active() || !is_implicit())
      return;
    const std::vector<Kernels::NodalVector> before = force;
    force.assign(context.grid.n_nodes(), {{0., 0.}});
    add(context, force.data());
    for (std::size_t i = 0; i < force.size(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
        change[i].value[d] += force[i].value[d] - before[i].value[d];
  }

  double
  NodalForce::work(const double                dt,
                   const Kernels::NodalVector *start,
                   const Kernels::NodalVector *end) const
  {
    double work = 0.;
    for (std::size_t i = 0; i < force.size(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
        work +=
          dt * force[i].value[d] * .5 * (start[i].value[d] + end[i].value[d]);
    return work;
  }

  // ------------------------------------------------------------ the list

  NodalForces::NodalForces()
  {
    add(std::make_unique<BodyForce>());
    add(std::make_unique<SurroundingPressure>());
  }

  void
  NodalForces::add(std::unique_ptr<NodalForce> force)
  {
    forces.push_back(std::move(force));
  }

  void
  NodalForces::check_parameters() const
  {
    for (const auto &force : forces)
      force->check_parameters();
  }

  void
  NodalForces::initialize(const double mass_scaling)
  {
    for (const auto &force : forces)
      force->initialize(mass_scaling);
  }

  void
  NodalForces::collect(const ForceContext &context, Kernels::NodalSums *nodes)
  {
    for (const auto &force : forces)
      force->collect(context, nodes);
  }

  bool
  NodalForces::have_implicit() const
  {
    return std::any_of(forces.begin(), forces.end(), [](const auto &force) {
      return force->is_active() && force->is_implicit();
    });
  }

  void
  NodalForces::solve(const Kernels::NodalVector             *velocity,
                     const std::vector<Kernels::CornerView> &corners,
                     const std::vector<double>              &mass)
  {
    for (const auto &force : forces)
      if (force->is_active() && force->is_implicit())
        force->solve(velocity, corners, mass);
  }

  void
  NodalForces::correct(const ForceContext   &context,
                       Kernels::NodalVector *change)
  {
    for (const auto &force : forces)
      force->correct(context, change);
  }

  Vector2
  NodalForces::at_corner(const unsigned int cell,
                         const unsigned int corner) const
  {
    Vector2 sum;
    for (const auto &force : forces)
      if (force->is_active())
        sum += force->at_corner(cell, corner);
    return sum;
  }

  double
  NodalForces::work(const double                dt,
                    const Kernels::NodalVector *start,
                    const Kernels::NodalVector *end) const
  {
    double work = 0.;
    for (const auto &force : forces)
      work += force->work(dt, start, end);
    return work;
  }
} // namespace CaissonMPM
