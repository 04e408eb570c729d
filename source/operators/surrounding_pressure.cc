// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/kernels/kernel_table.h>
#include <caisson_mpm/kernels/nodal_sums.h>
#include <caisson_mpm/kernels/step_context.h>
#include <caisson_mpm/operators/surrounding_pressure.h>

namespace CaissonMPM
{
  using namespace dealii;

  SurroundingPressure::SurroundingPressure()
    : Section("/Loads", Influence::motion)
  {
    add_parameter(
      "Surrounding pressure",
      text,
      "Pa",
      "Pressure on all free surfaces of the soil, positive in compression, as "
      "an expression in the time t.");
  }

  std::string
  SurroundingPressure::name() const
  {
    return "surrounding pressure";
  }

  Expression
  SurroundingPressure::parse() const
  {
    return Expression(text, "Loads/Surrounding pressure = " + text);
  }

  void
  SurroundingPressure::check_parameters() const
  {
    parse().at_time(0.);
  }

  void
  SurroundingPressure::initialize(const double /*mass_scaling*/)
  {
    pressure = parse();
  }

  bool
  SurroundingPressure::is_active() const
  {
    return !pressure.is_zero();
  }

  void
  SurroundingPressure::add(const ForceContext   &context,
                           Kernels::NodalVector *force)
  {
    // The pressure outside acts on the soil as a negative one inside would.
    of_nodes.assign(context.grid.n_nodes(), -pressure.at_time(context.time));
    context.kernels.pressure_force(context.step, of_nodes.data(), force);
  }
} // namespace CaissonMPM
