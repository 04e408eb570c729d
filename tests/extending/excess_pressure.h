// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A pore pressure in excess of the hydrostatic one, u(r, z, t), given as an
// expression. With the effective stress sigma' the total one is sigma' - u I,
// which adds to the nodal forces
//   f_I += int (grad N_I + e_r kappa N_I / r) u dV.
#ifndef caisson_mpm_operators_excess_pressure_h
#define caisson_mpm_operators_excess_pressure_h

#include <caisson_mpm/base/expression.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/nodal_force.h>


namespace CaissonMPM
{
  /** The pressure is interpolated from the nodes, and integrated as the stress
   * is. */
  class ExcessPressure : public NodalForce, public Section
  {
  public:
    ExcessPressure()
      : Section("/Loads")
    {
      add_parameter(
        "Excess pore pressure",
        text,
        "Pa",
        "Pore pressure in excess of the hydrostatic one, positive in "
        "compression, as an expression in the place r and z of a node, the "
        "time t and pi.");
    }

    void
    check_parameters() const override
    {
      parse();
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
      const BackgroundGrid &grid = context.grid;
      of_nodes.resize(grid.n_nodes());
      for (unsigned int n = 0; n < grid.n_nodes(); ++n)
        of_nodes[n] =
          pressure(dealii::Point<2>(grid.r_of(n), grid.z_of(n)), context.time);
      context.kernels.pressure_force(context.step, of_nodes.data(), force);
    }

    Expression
    parse() const
    {
      return Expression(text, "Loads/Excess pore pressure = " + text);
    }

    std::string         text = "0";
    Expression          pressure;
    std::vector<double> of_nodes; // Pa
  };
} // namespace CaissonMPM

#endif
