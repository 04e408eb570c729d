// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a layer says of a UMAT, and what it learns of it (umat_law.h).
#ifndef caisson_mpm_materials_umat_settings_h
#define caisson_mpm_materials_umat_settings_h

#include <limits>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /** What points have in the place of state that their law does not keep. */
  constexpr double no_state = std::numeric_limits<double>::quiet_NaN();

  /** What the user says of a UMAT. */
  struct UmatSettings
  {
    std::string         library; // as the scene has it
    std::string         routine = "umat";
    std::string         name; // CMNAME; empty: that of the section
    unsigned int        n_components = 4;
    double              unit         = 1.; // of its stress, Pa
    std::vector<double> properties;
    unsigned int        n_variables = 0;
    std::vector<double> variables; // the first of them, at the start
  };

  /** The stiffness of a law in a state, as the time step needs it. */
  struct UmatStiffness
  {
    double p_wave_modulus = 0.; // a bound of rho c^2 of all plane waves, Pa
    double poisson        = 0.;
    bool   varies         = false; // with stress
  };

  class UmatLaw;
} // namespace CaissonMPM

#endif
