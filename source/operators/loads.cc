// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/operators/loads.h>

#include <deal.II/base/geometry_info.h>

namespace CaissonMPM
{
  using namespace dealii;

  Loads::Loads()
    : ParameterAcceptor("/Loads")
  {
    add_parameter(
      "Body force",
      body_force_text,
      "Acceleration besides gravity: two expressions in the initial "
      "coordinates r and z of a point, the time t and pi, for its "
      "r and z components, with a semicolon between them. It acts "
      "on the mass of grains and water; mass scaling leaves the "
      "force as it is. Units: m/s2.");
    add_parameter("Surrounding pressure",
                  pressure_text,
                  "Pressure on all free surfaces of the soil, positive in "
                  "compression: an expression in the time t. Units: Pa.");
  }

  VectorExpression
  Loads::parse_body_force() const
  {
    return parse_vector(body_force_text, "Loads/Body force");
  }

  Expression
  Loads::parse_pressure() const
  {
    return Expression(pressure_text,
                      "Loads/Surrounding pressure = " + pressure_text);
  }

  void
  Loads::check_parameters() const
  {
    parse_body_force();
    parse_pressure();
  }

  void
  Loads::initialize(const double mass_scaling)
  {
    this->mass_scaling = mass_scaling;
    body_force         = parse_body_force();
    pressure           = parse_pressure();
  }

  double
  Loads::surrounding_pressure(const double time) const
  {
    return pressure.is_zero() ? 0. : pressure(Point<2>(), time);
  }

  void
  Loads::find_body_force(const MaterialPoints &points,
                         const BackgroundGrid &grid,
                         const double          time,
                         const unsigned int    n_nodes,
                         std::vector<double>  &nodal_force) const
  {
    nodal_force.clear();
    if (body_force[radial].is_zero() && body_force[vertical].is_zero())
      return;
    nodal_force.resize(2 * n_nodes);
    points.for_each([&](const MaterialPoint &p, const unsigned int cell) {
      const auto  x    = to_reference(grid.geometry(cell), p.position);
      const auto &node = grid.cell_nodes(cell).node;
      for (unsigned int d = 0; d < 2; ++d)
        if (!body_force[d].is_zero())
          {
            const double force =
              p.mass / mass_scaling * body_force[d](p.initial_position, time);
            for (unsigned int i = 0; i < 4; ++i)
              nodal_force[2 * node[i] + d] +=
                GeometryInfo<2>::d_linear_shape_function(x, i) * force;
          }
    });
  }
} // namespace CaissonMPM
