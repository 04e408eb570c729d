// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a caisson adds to water that flows: the suction beneath its lid, and the
// plug of soil that it loads.
#ifndef caisson_mpm_water_lid_compartment_h
#define caisson_mpm_water_lid_compartment_h

#include <caisson_mpm/bodies/rest.h>
#include <caisson_mpm/water/feasibility.h>
#include <caisson_mpm/water/plug_balance.h>
#include <caisson_mpm/water/plug_strength.h>
#include <caisson_mpm/water/pore_water.h>
#include <caisson_mpm/water/sealed_lid.h>
#include <caisson_mpm/water/seepage.h>

#include <string>
#include <vector>

namespace CaissonMPM
{
  /** The flow of the water as the compartment sees it. */
  struct WaterFlow
  {
    bool   flows = true;           // false in undrained soil
    double scale = 1.;             // of both flows
    double out = 0., in = 0.;      // of the plug, into the rest; m3/s
    double tip_force       = 0.;   // on the tip, upward; N
    double tip_resistance  = 0.;   // of it, what the suction must bear
    double tip_area        = 0.;   // that the suction reaches, m2
    double pressure_factor = 0.;   // at the tip, over the suction
    double plug_rate       = 0.;   // at which the plug's surface rises, m3/s
    double response        = 0.;   // of plug_rate and out to the suction in a
                                   // step, m3/(s Pa)
    unsigned int n_iterations = 0; // of the solver
  };

  /**
   * Owns the suction and the balances of the plug, and knows whether the soil
   * touches the lid. A model of the water calls it in each step with the flow
   * that it has computed. Where it says so, functions are collective.
   */
  class LidCompartment
  {
  public:
    explicit LidCompartment(const WaterScene &scene);

    /** Throw BadInput where the entries contradict each other, or the scene. */
    void
    check_parameters() const;

    /** Prepare for the run, when the soil is known. */
    void
    initialize();

    /** Begin with the plug below the @p mudline; only the first call counts.
     * Collective. */
    void
    start(const Mudline &mudline);

    /** Continue after another run. */
    void
    continue_after(const Mudline &mudline);

    /** Find where the soil touches the lid. Collective. */
    void
    update_touching(const Mudline &now);

    /** Let the lid touch soil only where the plug has reached it. */
    void
    open(Contact &contact) const;

    /** Continue by a step, at the end of which it is @p time. Units: s, N. */
    void
    end_step(const double     time,
             const double     dt,
             const double     force_on_body,
             const Mudline   &mudline,
             const WaterFlow &flow);

    double
    suction() const
    {
      return suction_.value();
    }

    bool
    is_sealed() const
    {
      return settings().control == SuctionSettings::Control::sealed;
    }

    /** The load of the suction on the lid. Units: N. */
    double
    load() const
    {
      return suction_.value() * area();
    }

    /** The area beneath the lid. Units: m2. */
    double
    area() const;

    const SuctionSettings &
    settings() const
    {
      return scene.settings.suction;
    }

    /** Compute the exit gradient of the last flow, whose @p outflow is per
     * node. Collective. */
    void
    update_exit_gradient(const Mudline                  &mudline,
                         const std::vector<Conductance> &permeability,
                         const NodalData                &outflow);

    /** Compute which gradients the plug withstands, and whether the
     * installation is still feasible. Collective. */
    void
    update_limits(const Mudline &now, const WaterFlow &flow);

    /** Return from where on the installation is not feasible, and why. */
    std::optional<Feasibility::Place>
    infeasible() const;

    /** Return the numbers of a record. Collective. */
    NamedNumbers
    columns(const Mudline &mudline, const WaterFlow &flow) const;

    /** Append warnings of the plug. @p where: at which penetration. */
    void
    warn(const std::string        &where,
         const Mudline            &mudline,
         const WaterFlow          &flow,
         std::vector<std::string> &warnings);

    /** Return why the run cannot continue, or an empty text. @p mudline: null
     * before the flow is known. */
    std::string
    reason_to_end(const Mudline *mudline) const;

    /** Return what a run prints at its beginning. */
    std::string
    description() const;

  private:
    /** Of its lower face over the original mudline. Units: m. */
    double
    height_of_lid() const;
    /** How far the plug has risen, and how far the soil that the wall displaces
     * would make it rise. Units: m. */
    double
    heave(const Mudline &mudline) const;
    double
    heave_by_wall() const;
    /** Return the numbers of a record that a lid with a pump has, whose plug
     * has risen by @p rise. Units: m. */
    NamedNumbers
    of_pump(const double rise) const;

    /** Continue the water beneath a sealed lid by a step. */
    void
    advance_sealed(const double     dt,
                   const Mudline   &mudline,
                   const WaterFlow &flow);
    /** The gradient of soil that gives off hardly any water is noise, and less
     * suction than this lifts no soil by its flow. Units: Pa. */
    double
    least_lifting_suction() const;
    /** Whether the flow out of the plug nearly lifts its soil. */
    bool
    carries_soil(const WaterFlow &flow) const;

    const WaterScene    scene;
    Suction             suction_;
    SealedLid           sealed;
    PlugBalance         plug_balance;
    PlugStrength        plug_strength;
    Feasibility         feasibility;
    std::vector<double> filled;               // [n_cells], at the last look
    double              touched = 0.;         // share of the area of the lid
    ExitGradient        exit;                 // over the scale of the flow
    WithstoodGradients  withstood;            // at the last record
    double              time_of_suction = 0.; // of its table, s
    double              seepage_volume  = 0.; // through the plug, m3
    double              plug_height     = 0.; // before the installation, m
    // the volume that body and plug had displaced when this run began, m3
    double     volume_at_start = 0.;
    RecentMean recent_heave; // of the plug, m
    bool       has_started          = false;
    bool       has_warned_of_piping = false, has_warned_of_lift = false,
         has_warned_of_cavity = false;
  };
} // namespace CaissonMPM

#endif
