// SPDX-License-Identifier: LGPL-2.1-or-later
//
// An acceleration b besides gravity, given as an expression:
//   f_I += sum m_p N_I(x_p) b(X_p, t),
// with the initial place X_p of the point and its mass without mass scaling.
#ifndef caisson_mpm_operators_body_force_h
#define caisson_mpm_operators_body_force_h

#include <caisson_mpm/base/expression.h>
#include <caisson_mpm/base/section.h>
#include <caisson_mpm/operators/nodal_force.h>

#include <deal.II/base/geometry_info.h>

namespace CaissonMPM
{
  /** The nodal force of the entry "Loads/Body force". */
  class BodyForce : public NodalForce, public Section
  {
  public:
    BodyForce()
      : Section("/Loads", Influence::motion)
    {
      add_parameter(
        "Body force",
        text,
        "m/s2",
        "Acceleration of the soil besides gravity: two expressions in the "
        "initial coordinates r and z of a point, the time t and pi give its r "
        "and z components, with a semicolon between them. It acts on the mass "
        "of grains and water, and mass scaling leaves the force as it is.");
    }

    void
    check_parameters() const override
    {
      parse();
    }

    void
    initialize(const double mass_scaling) override
    {
      this->mass_scaling = mass_scaling;
      acceleration       = parse();
    }

    bool
    is_active() const override
    {
      return !acceleration[radial].is_zero() ||
             !acceleration[vertical].is_zero();
    }

  private:
    void
    add(const ForceContext &context, Kernels::NodalVector *force) override
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
                    dealii::GeometryInfo<2>::d_linear_shape_function(x, i) *
                    of_point;
              }
        });
    }

    VectorExpression
    parse() const
    {
      return parse_vector(text, "Loads/Body force");
    }

    std::string      text = "0 ; 0";
    VectorExpression acceleration;
    double           mass_scaling = 1.;
  };
} // namespace CaissonMPM

#endif
