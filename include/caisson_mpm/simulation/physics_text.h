// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The parameters of a scene that its state depends on, as text.
#ifndef caisson_mpm_simulation_physics_text_h
#define caisson_mpm_simulation_physics_text_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace CaissonMPM
{
  /** Return all entries that influence the state at a given time, one per line
   * in the order of their declaration: a run may only be continued with the
   * same ones. */
  std::string
  physics(const dealii::ParameterHandler &prm);

  /** Return those that are not defaults, in alphabetical order: a new entry or
   * another order of declaration does not change the text. */
  std::string
  changed_physics(const dealii::ParameterHandler &prm);
} // namespace CaissonMPM

#endif
