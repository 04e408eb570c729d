// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Where the work that is put into the soil goes, from the start of a run.
//
//   body + prescribed + gravity + load = kinetic + stress + friction + damping
//                    + floor + inertia of deformation + dissipation + residual
// The dissipation is what the transfer between points and nodes loses; it is
// found from the identity of the nodal works. The residual is what the scheme
// creates (negative) or loses because it integrates the nodal forces and the
// stress power differently (doc/theory.md, section 14). Units: J.
#ifndef caisson_mpm_operators_energy_balance_h
#define caisson_mpm_operators_energy_balance_h

#include <caisson_mpm/base/run_totals.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/nodal_work.h>

#include <string>
#include <vector>

namespace CaissonMPM
{
  /** The sums over the points that the balance needs. Units: J. */
  struct PointEnergies
  {
    double kinetic   = 0.;
    double potential = 0.; // of the weight
    double weight    = 0.; // sum of |terms| of the potential energy
  };

  /** Find these sums, of all ranks and the whole circumference, with the
   * factors of the inertia in the cells [n_cells] (null: 1). Collective. */
  PointEnergies
  compute_point_energies(const MaterialPoints                 &points,
                         const std::vector<Kernels::Material> &materials,
                         const BackgroundGrid                 &grid,
                         const double *inertia = nullptr);

  /**
   * The balance of a run. add() is called in every step, close() at records;
   * the values are those of the last record. Not collective: of several ranks
   * each adds its own works, which are summed on one of them before close().
   */
  class EnergyBalance
  {
  public:
    /** Begin at this state of the points. */
    void
    start(const PointEnergies &points);

    /** Add a step. @p stress_work is that of the soil. */
    void
    add(const NodalWork &nodes, const double stress_work);

    /** Draw up the balance for this state of the points. */
    void
    close(const PointEnergies &points);

    /** Register what add() sums and what a continued run needs. */
    void
    register_totals(RunTotals &totals);

    /** A term of the balance with its name and unit. */
    struct Term
    {
      const char *name;
      double EnergyBalance::*value;
    };

    /** The terms in the order of history.csv. */
    static const std::vector<Term> &
    terms();

    double work_of_body        = 0.; // on the soil, prescribed nodes included
    double work_on_water       = 0.; // of the body; not a part of the balance
    double gravity_work        = 0.;
    double load_work           = 0.; // of the nodal forces of section Loads
    double kinetic_gain        = 0.;
    double stress_work         = 0.; // elastic energy and plastic work
    double friction_heat       = 0.;
    double damping             = 0.;
    double floor               = 0.;
    double deformation_inertia = 0.; // of selective mass scaling
    double dissipation         = 0.;
    double residual            = 0.;
    double relative            = 0.; // of the largest work so far

  private:
    double force_work = 0., initial_kinetic = 0., initial_potential = 0.,
           largest = 0.;
  };
} // namespace CaissonMPM

#endif
