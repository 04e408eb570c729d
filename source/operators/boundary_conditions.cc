// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/operators/boundary_conditions.h>

#include <deal.II/base/patterns.h>

namespace CaissonMPM
{
  using namespace dealii;

  BoundaryConditions::BoundaryConditions()
    : ParameterAcceptor("/Boundary conditions")
  {
    const Patterns::Selection kinds("roller|fixed|free");
    const std::string         text =
      " roller: no normal velocity; fixed: no velocity; free. Units: none.";
    add_parameter("Axis",
                  axis,
                  "On the side of the smallest r, the axis if that is 0." +
                    text,
                  prm,
                  kinds);
    add_parameter(
      "Side", outer, "On the side of the largest r." + text, prm, kinds);
    add_parameter("Bottom", bottom, "On the lower side." + text, prm, kinds);
    add_parameter("Top", top, "On the upper side." + text, prm, kinds);
  }

  void
  BoundaryConditions::check_parameters(const BackgroundGrid &grid) const
  {
    if (grid.axisymmetric() && axis == "free" && grid.reaches_axis())
      throw BadInput("Boundary conditions/Axis = free: on the axis of an "
                     "axisymmetric mesh nothing can move radially. Set Axis = "
                     "roller, or Grid/Inner radius above 0.");
  }

  void
  BoundaryConditions::initialize(const BackgroundGrid &grid)
  {
    const std::string kinds[4] = {axis, outer, bottom, top};
    fixed[0].clear();
    fixed[1].clear();
    for (unsigned int node = 0; node < grid.n_nodes(); ++node)
      {
        bool is_fixed[2] = {false, false};
        for (unsigned int side = 0; side < 4; ++side)
          if (grid.sides_of(node) & (1u << side))
            for (unsigned int d = 0; d < 2; ++d)
              is_fixed[d] = is_fixed[d] || kinds[side] == "fixed" ||
                            (kinds[side] == "roller" && d == side / 2);
        for (unsigned int d = 0; d < 2; ++d)
          if (is_fixed[d])
            fixed[d].push_back(node);
      }
  }

  void
  BoundaryConditions::apply(Kernels::NodalVector *v) const
  {
    for (unsigned int d = 0; d < 2; ++d)
      for (const unsigned int node : fixed[d])
        v[node].value[d] = 0.;
  }
} // namespace CaissonMPM
