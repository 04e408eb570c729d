// SPDX-License-Identifier: LGPL-2.1-or-later
//
// history.csv: forces, energies and counts against time and penetration.
#ifndef caisson_mpm_output_history_h
#define caisson_mpm_output_history_h

#include <caisson_mpm/base/named_numbers.h>
#include <caisson_mpm/operators/energy_balance.h>

#include <string>
#include <vector>

namespace CaissonMPM
{
  /** One row. SI units; forces on the body, upward positive, on the whole
   * circumference; the energies and the largest speed are those of the soil.
   * The force at prescribed nodes is that on the soil. */
  struct HistoryRow
  {
    double        time           = 0.;
    double        penetration    = 0.;
    double        tip            = 0.;
    double        inner          = 0.;
    double        outer          = 0.;
    double        top            = 0.;
    double        lid            = 0.;
    double        ring           = 0.;
    double        cavity         = 0.; // mean pressure on a cylinder
    double        total          = 0.;
    double        with_water     = 0.;
    double        kinetic_energy = 0.;
    double        external_work  = 0.;
    double        added_mass     = 0.;
    double        max_speed      = 0.;
    double        time_step      = 0.;
    unsigned int  points_in_body = 0;
    unsigned int  contact_nodes  = 0;
    unsigned int  sticking_nodes = 0;
    unsigned long step           = 0;
    double        prescribed_r   = 0.;
    double        prescribed_z   = 0.;
    EnergyBalance energy;
    NamedNumbers  counts; // of RunTotals
  };

  /** What a scene has; columns of what it lacks are left out. */
  struct SceneParts
  {
    bool body = true, caisson = true, ledges = true, expanding_body = true;
    bool prescribed_soil = true, splitting = true, water_on_body = true;
  };

  /** Return the names of the columns, the counts last. Others' scripts read
   * these names. */
  std::vector<std::string>
  history_names(const SceneParts               &scene,
                const std::vector<std::string> &counts);

  /** One value per column. */
  std::vector<double>
  history_values(const SceneParts &scene, const HistoryRow &row);
} // namespace CaissonMPM

#endif
