// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/value_in_time.h>
#include <caisson_mpm/operators/surrounding_pressure.h>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    /** The entry with what it is set to, for messages. */
    std::string
    entry_with(const std::string &text)
    {
      return "Loads/Surrounding pressure = " + text;
    }
  } // namespace

  SurroundingPressure::SurroundingPressure()
    : ParameterAcceptor("/Loads")
  {
    add_parameter("Surrounding pressure",
                  text,
                  "Pressure on all free surfaces of the soil, positive in "
                  "compression, as an expression in the time t. Units: Pa.");
  }

  std::string
  SurroundingPressure::name() const
  {
    return "surrounding pressure";
  }

  Expression
  SurroundingPressure::parse() const
  {
    return Expression(text, entry_with(text));
  }

  void
  SurroundingPressure::check_parameters() const
  {
    value_at(parse(), 0., entry_with(text));
  }

  void
  SurroundingPressure::initialize(const double /*mass_scaling*/)
  {
    pressure = parse();
  }

  bool
  SurroundingPressure::acts() const
  {
    return !pressure.is_zero();
  }

  void
  SurroundingPressure::add(const ForceContext   &context,
                           Kernels::NodalVector *force)
  {
    // The pressure outside acts on the soil as a negative one inside would.
    of_nodes.assign(context.grid.n_nodes(),
                    -value_at(pressure, context.time, entry_with(text)));
    context.kernels.pressure_force(context.step, of_nodes.data(), force);
  }
} // namespace CaissonMPM
