// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/operators/body_force.h>
#include <caisson_mpm/operators/nodal_force.h>
#include <caisson_mpm/operators/surrounding_pressure.h>

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

  NodalForces
  make_nodal_forces()
  {
    NodalForces forces;
    forces.push_back(std::make_unique<BodyForce>());
    forces.push_back(std::make_unique<SurroundingPressure>());
    return forces;
  }
} // namespace CaissonMPM
