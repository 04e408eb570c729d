// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/kernels/nodal_sums.h>
#include <caisson_mpm/operators/body_force.h>

#include <deal.II/base/geometry_info.h>

namespace CaissonMPM
{
  using namespace dealii;

  BodyForce::BodyForce()
    : Section("/Loads", Influence::motion)
  {
    add_parameter(
      "Body force",
      text,
      "m/s2",
      "Acceleration of the soil besides gravity: two expressions in the "
      "initial coordinates r and z of a point, the time t and pi give its r "
      "and z components, with a semicolon between them. It acts on the mass of "
      "grains and water, and mass scaling leaves the force as it is.");
  }

  std::string
  BodyForce::name() const
  {
    return "body force";
  }

  VectorExpression
  BodyForce::parse() const
  {
    return parse_vector(text, "Loads/Body force");
  }

  void
  BodyForce::check_parameters() const
  {
    parse();
  }

  void
  BodyForce::initialize(const double mass_scaling)
  {
    this->mass_scaling = mass_scaling;
    acceleration       = parse();
  }

  bool
  BodyForce::is_active() const
  {
    return !acceleration[radial].is_zero() || !acceleration[vertical].is_zero();
  }

  void
  BodyForce::add(const ForceContext &context, Kernels::NodalVector *force)
  {
    const BackgroundGrid &grid = context.grid;
    context.points.for_each(
      [&](const MaterialPoint &p, const unsigned int cell) {
        const auto  x    = to_reference(grid.geometry(cell), p.position);
        const auto &node = grid.cell_nodes(cell).node;
        for (unsigned int d = 0; d < 2; ++d)
          if (!acceleration[d].is_zero())
            {
              const double of_point =
                p.mass / mass_scaling *
                acceleration[d](p.initial_position, context.time);
              for (unsigned int i = 0; i < 4; ++i)
                force[node[i]].value[d] +=
                  GeometryInfo<2>::d_linear_shape_function(x, i) * of_point;
            }
      });
  }
} // namespace CaissonMPM
