// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/boundary_conditions.h>

#include <cmath>

namespace CaissonMPM
{
  using namespace dealii;

  BoundaryConditions::BoundaryConditions()
    : Section("/Boundary conditions")
  {
    const Choices<SideCondition> kinds = {{"roller", SideCondition::roller},
                                          {"fixed", SideCondition::fixed},
                                          {"free", SideCondition::free}};
    const std::string            text =
      ": roller sets its normal velocity to zero, fixed sets both components "
      "to zero, and free imposes nothing.";
    add_choice(*this,
               "Axis",
               sides[0],
               kinds,
               "",
               "Condition on the side of the smallest r, which is the axis if "
               "that r is 0" +
                 text);
    add_choice(*this,
               "Side",
               sides[1],
               kinds,
               "",
               "Condition on the side of the largest r" + text);
    add_choice(*this,
               "Bottom",
               sides[2],
               kinds,
               "",
               "Condition on the lower side" + text);
    add_choice(
      *this, "Top", sides[3], kinds, "", "Condition on the upper side" + text);
    add_parameter(
      "Prescribed region",
      region_text,
      "",
      "The velocity is prescribed at nodes where this expression in the "
      "current position r and z of a node, the time t and pi is positive; if "
      "it is empty, no velocity is prescribed.");
    add_parameter(
      "Prescribed velocity",
      velocity_text,
      "m/s",
      "Velocity of the nodes in the prescribed region: two expressions in the "
      "same variables for its r and z components, with a semicolon between "
      "them; a component that reads free is not prescribed. It takes "
      "precedence over the sides and the contact.");
  }

  void
  BoundaryConditions::check_parameters(const GridLines &lines) const
  {
    if (lines.axisymmetric() && sides[0] == SideCondition::free &&
        lines.reaches_axis())
      throw BadInput("Boundary conditions/Axis = free: on the axis of an "
                     "axisymmetric mesh nothing can move radially. Set Axis = "
                     "roller, or Grid/Inner radius above 0.");
    parse_region();
    parse_velocity();
  }

  void
  BoundaryConditions::name_unused_entries(ParameterOrigins &origins) const
  {
    if (region_text.empty())
      origins.add_unused({"Boundary conditions/Prescribed velocity"},
                         "Boundary conditions/Prescribed region is empty");
  }

  std::string
  BoundaryConditions::region_entry() const
  {
    return "Boundary conditions/Prescribed region = " + region_text;
  }

  namespace
  {
    /** The value, if it is finite. */
    double
    finite_value(const Expression  &expression,
                 const Point<2>    &x,
                 const double       time,
                 const std::string &where)
    {
      const double value = expression(x, time);
      if (!std::isfinite(value))
        throw BadInput(
          where + " is " + to_text(value) + " at r = " + to_text(x[radial]) +
          " m, z = " + to_text(x[vertical]) + " m, t = " + to_text(time) +
          " s. Write an expression that is finite everywhere and "
          "at all times of the run.");
      return value;
    }
  } // namespace

  Expression
  BoundaryConditions::parse_region() const
  {
    return region_text.empty() ? Expression() :
                                 Expression(region_text, region_entry());
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
    region        = parse_region();
    velocity      = parse_velocity();
    circumference = grid.circumference();
    n_owned_nodes = grid.n_owned_nodes();
    prescribed.clear();
    fixed[0].clear();
    fixed[1].clear();
    for (unsigned int node = 0; node < grid.n_nodes(); ++node)
      {
        bool is_fixed[2] = {false, false};
        for (unsigned int side = 0; side < 4; ++side)
          if (grid.is_at(node, BackgroundGrid::Side(side)))
            for (unsigned int d = 0; d < 2; ++d)
              is_fixed[d] =
                is_fixed[d] || sides[side] == SideCondition::fixed ||
                (sides[side] == SideCondition::roller && d == side / 2);
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
    // for messages; not built for each node
    const std::string of_region = region_entry(),
                      of_velocity =
                        "Boundary conditions/Prescribed velocity = " +
                        velocity_text;
    for (unsigned int node = 0; node < grid.n_nodes(); ++node)
      {
        const Point<2> x(grid.r_of(node), grid.z_of(node));
        if (finite_value(region, x, time, of_region) <= 0.)
          continue;
        for (unsigned int d = 0; d < 2; ++d)
          if (!velocity[d].empty())
            prescribed.push_back(
              {node,
               d,
               finite_value(velocity[d], x, time + .5 * dt, of_velocity)});
      }
  }

  std::array<std::vector<bool>, 2>
  BoundaryConditions::held_nodes(const unsigned int n_nodes) const
  {
    std::array<std::vector<bool>, 2> constrained;
    for (unsigned int d = 0; d < 2; ++d)
      {
        constrained[d].assign(n_nodes, false);
        for (const unsigned int node : fixed[d])
          constrained[d][node] = true;
      }
    for (const Prescribed &p : prescribed)
      constrained[p.component][p.node] = true;
    return constrained;
  }

  PrescribedResult
  BoundaryConditions::apply(const std::vector<double> &mass,
                            Kernels::NodalVector      *v)
  {
    PrescribedResult result;
    for (const Prescribed &p : prescribed)
      {
        if (p.node >= n_owned_nodes)
          continue;
        const double impulse = circumference * mass[p.node] *
                               (p.velocity - v[p.node].value[p.component]);
        result.impulse[p.component] += impulse;
        result.work += impulse * p.velocity;
      }
    constrain(v);
    return result;
  }

  void
  BoundaryConditions::add_impulses(const Kernels::NodalSums   *sums,
                                   const double                share,
                                   const bool                  as_difference,
                                   const Kernels::NodalVector *v,
                                   PrescribedResult           &result) const
  {
    for (const Prescribed &p : prescribed)
      if (p.node < n_owned_nodes)
        {
          const double target  = as_difference ? 0. : p.velocity;
          const double impulse = circumference * share *
                                 std::max(0., sums[p.node].mass) *
                                 (target - v[p.node].value[p.component]);
          result.impulse[p.component] += impulse;
          result.work += impulse * p.velocity;
        }
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
