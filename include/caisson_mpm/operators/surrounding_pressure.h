// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A pressure p(t) on all free surfaces of the soil. No surface is looked for:
// with
//   int_Gamma p N_I n dA = int_Omega p (grad N_I + e_r kappa N_I / r) dV
// the traction -p n takes the form of the internal force of the stress p I, and
// is integrated at the same places. Soil with sigma = -p I is then at rest to
// round-off, in any mesh and at any place of the points. This is the virtual
// stress of Liang, Given & Soga (2023), CMAME 404, 115785. Where the soil
// touches a wall or a body, their reactions are those beyond p.
#ifndef caisson_mpm_operators_surrounding_pressure_h
#define caisson_mpm_operators_surrounding_pressure_h

#include <caisson_mpm/base/expression.h>
#include <caisson_mpm/base/section.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/nodal_force.h>

namespace CaissonMPM
{
  /**
   * The nodal force of the entry "Loads/Surrounding pressure": that of the
   * pressure field -p, the same at all nodes. A pressure that differs from node
   * to node takes the same kernel with its own nodal values.
   */
  class SurroundingPressure : public NodalForce, public Section
  {
  public:
    SurroundingPressure()
      : Section("/Loads", Influence::motion)
    {
      add_parameter(
        "Surrounding pressure",
        text,
        "Pa",
        "Pressure on all free surfaces of the soil, positive in compression, "
        "as an expression in the time t.");
    }

    void
    check_parameters() const override
    {
      parse().at_time(0.);
    }

    void
    initialize(const double /*mass_scaling*/) override
    {
      pressure = parse();
    }

    bool
    is_active() const override
    {
      return !pressure.is_zero();
    }

  private:
    void
    add(const ForceContext &context, Kernels::NodalVector *force) override
    {
      // The pressure outside acts on the soil as a negative one inside would.
      of_nodes.assign(context.grid.n_nodes(), -pressure.at_time(context.time));
      context.kernels.pressure_force(context.step, of_nodes.data(), force);
    }

    Expression
    parse() const
    {
      return Expression(text, "Loads/Surrounding pressure = " + text);
    }

    std::string         text = "0";
    Expression          pressure;
    std::vector<double> of_nodes; // Pa
  };
} // namespace CaissonMPM

#endif
