// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/base/value_in_time.h>

#include <cmath>

namespace CaissonMPM
{
  using namespace dealii;

  double
  value_at(const Expression  &expression,
           const double       time,
           const std::string &entry)
  {
    const double value = expression(Point<2>(), time);
    if (!std::isfinite(value))
      throw BadInput(entry + " is " + to_text(value) +
                     " at t = " + to_text(time) +
                     " s. Write an expression that is finite at all times of "
                     "the run.");
    return value;
  }
} // namespace CaissonMPM
