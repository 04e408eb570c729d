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
    add_parameter(
      "Prescribed region",
      region_text,
      "Nodes whose velocity is prescribed: an expression in the "
      "current place r and z of a node, the time t and pi, positive "
      "at these nodes. Empty: none. Units: none.");
    add_parameter(
      "Prescribed velocity",
      velocity_text,
      "Velocity of these nodes: two expressions as above, for its r "
      "and z components, with a semicolon between them; a component "
      "that reads free is not prescribed. It takes precedence over "
      "the sides and the contact. Units: m/s.");
  }

  void
  BoundaryConditions::check_parameters(const GridLines &lines) const
  {
    if (lines.axisymmetric() && axis == "free" && lines.reaches_axis())
      throw BadInput("Boundary conditions/Axis = free: on the axis of an "
                     "axisymmetric mesh nothing can move radially. Set Axis = "
                     "roller, or Grid/Inner radius above 0.");
    parse_region();
    parse_velocity();
  }

  Expression
  BoundaryConditions::parse_region() const
  {
    return region_text.empty() ?
             Expression() :
             Expression(region_text,
                        "Boundary conditions/Prescribed region = " +
                          region_text);
  }

  VectorExpression
  BoundaryConditions::parse_velocity() const
  {
    return parse_vector(velocity_text,
                        "Boundary conditions/Prescribed velocity",
                        "free");
  }

  void
  BoundaryConditions::initialize(const BackgroundGrid &grid)
  {
    const std::string kinds[4] = {axis, outer, bottom, top};
    region                     = parse_region();
    velocity                   = parse_velocity();
    circumference              = grid.circumference();
    n_owned_nodes              = grid.n_owned_nodes();
    prescribed.clear();
    fixed[0].clear();
    fixed[1].clear();
    for (unsigned int node = 0; node < grid.n_nodes(); ++node)
      {
        bool is_fixed[2] = {false, false};
        for (unsigned int side = 0; side < 4; ++side)
          if (grid.is_at(node, BackgroundGrid::Side(side)))
            for (unsigned int d = 0; d < 2; ++d)
              is_fixed[d] = is_fixed[d] || kinds[side] == "fixed" ||
                            (kinds[side] == "roller" && d == side / 2);
        for (unsigned int d = 0; d < 2; ++d)
          if (is_fixed[d])
            fixed[d].push_back(node);
      }
  }

  void
  BoundaryConditions::prepare(const BackgroundGrid &grid,
                              const double          time,
                              const double          dt)
  {
    if (region.empty())
      return;
    prescribed.clear();
    for (unsigned int node = 0; node < grid.n_nodes(); ++node)
      {
        const Point<2> x(grid.r_of(node), grid.z_of(node));
        if (!(region(x, time) > 0.))
          continue;
        for (unsigned int d = 0; d < 2; ++d)
          if (!velocity[d].empty())
            prescribed.push_back({node, d, velocity[d](x, time + .5 * dt)});
      }
  }

  double
  BoundaryConditions::apply(const std::vector<double> &mass,
                            Kernels::NodalVector      *v)
  {
    double work = 0.;
    for (const Prescribed &p : prescribed)
      {
        if (p.node >= n_owned_nodes)
          continue;
        const double impulse = circumference * mass[p.node] *
                               (p.velocity - v[p.node].value[p.component]);
        impulse_[p.component] += impulse;
        work += impulse * p.velocity;
      }
    constrain(v);
    return work;
  }

  void
  BoundaryConditions::constrain(Kernels::NodalVector *v) const
  {
    constrain_difference(v);
    for (const Prescribed &p : prescribed)
      v[p.node].value[p.component] = p.velocity;
  }

  void
  BoundaryConditions::constrain_difference(Kernels::NodalVector *v) const
  {
    for (unsigned int d = 0; d < 2; ++d)
      for (const unsigned int node : fixed[d])
        v[node].value[d] = 0.;
    for (const Prescribed &p : prescribed)
      v[p.node].value[p.component] = 0.;
  }
} // namespace CaissonMPM
