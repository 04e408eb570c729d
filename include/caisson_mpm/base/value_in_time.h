// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A quantity that an entry gives as an expression in the time alone.
#ifndef caisson_mpm_base_value_in_time_h
#define caisson_mpm_base_value_in_time_h

#include <caisson_mpm/base/expression.h>

namespace CaissonMPM
{
  /** Return its value at a time. Throws BadInput, which names the @p entry with
   * its text, where it is not finite. Units of the time: s. */
  double
  value_at(const Expression  &expression,
           const double       time,
           const std::string &entry);
} // namespace CaissonMPM

#endif
