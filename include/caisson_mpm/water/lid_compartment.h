// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a caisson adds to water that flows: the suction beneath its lid, which a
// pump or a pull causes (suction.h, sealed_lid.h), the plug of soil that it
// loads (plug.h), and from where on this is not feasible.
#ifndef caisson_mpm_water_lid_compartment_h
#define caisson_mpm_water_lid_compartment_h

#include <caisson_mpm/bodies/rest.h>
#include <caisson_mpm/water/plug.h>
#include <caisson_mpm/water/pore_water.h>
#include <caisson_mpm/water/sealed_lid.h>
#include <caisson_mpm/water/suction.h>

#include <optional>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * Notes where piping begins, and where the suction lifts the plug. A plug is
   * lifted where its surface rises, beyond what the wall displaces, by more
   * than half of what the caisson goes down: the suction then draws in soil
   * rather than the caisson. Whether the pump or boiling ends the run is the
   * matter of Suction. Not collective.
   */
  class Feasibility
  {
  public:
    explicit Feasibility(const FeasibilitySettings &settings)
      : settings(settings)
    {}

    /** See the state at a record: the heave of the plug beyond what the wall
     * displaces, the gradient over the critical one, and in which @p window of
     * penetration a rise is measured. Units: m, m, Pa, none, m. */
    void
    update(const double penetration,
           const double extra_heave,
           const double suction,
           const double gradient,
           const double window);

    /** Where it became infeasible, and why. */
    struct Place
    {
      double      penetration; // m
      std::string reason;      // in one or two words
    };

    std::optional<Place>
    place() const;

    /** Return why a run ends that is at this @p penetration, or an empty text.
     * Units: m. */
    std::string
    reason_to_end(const double penetration) const;

    void
    register_totals(RunTotals &totals);

  private:
    const FeasibilitySettings &settings;
    double piping = -1., lift = -1.;   // penetration where it began; m
    double at = -1., heave_there = 0.; // where the last rise was measured; m
  };

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
   * Lets these parts work together, and knows whether the soil touches the lid.
   * A model of the water calls it in each step with the flow
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

    Plug &
    plug()
    {
      return plug_;
    }

    /** Continue after another run. */
    void
    continue_after(const SoilColumns &soil_columns);

    /** Find where the soil touches the lid. Collective. */
    void
    update_touching(const SoilColumns &now);

    /** Let the lid touch soil only where the plug has reached it. */
    void
    open(Contact &contact) const;

    /** Continue by a step, at the end of which it is @p time. Units: s, N. */
    void
    end_step(const double       time,
             const double       dt,
             const double       force_on_body,
             const SoilColumns &soil_columns,
             const WaterFlow   &flow);

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

    /** The suction at which water boils beneath a lid at the mudline. Units:
     * Pa. */
    double
    boiling_at_mudline() const
    {
      return suction_.cavitation(0.);
    }

    /** The load of the suction on the lid. Units: N. */
    double
    load() const
    {
      return suction_.value() * plug_.area();
    }

    const SuctionSettings &
    settings() const
    {
      return scene.settings.suction;
    }

    /** Compute which gradients the plug withstands, and whether the
     * installation is still feasible. Collective. */
    void
    update_limits(const SoilColumns &now, const WaterFlow &flow);

    /** Return from where on the installation is not feasible, and why. */
    std::optional<Feasibility::Place>
    infeasible() const;

    /** Return the numbers of a record. Collective. */
    NamedNumbers
    columns(const SoilColumns &soil_columns, const WaterFlow &flow);

    /** Append warnings of the plug. @p where: at which penetration. */
    void
    warn(const std::string        &where,
         const SoilColumns        &soil_columns,
         const WaterFlow          &flow,
         std::vector<std::string> &warnings);

    /** Return why the run cannot continue, or an empty text. @p soil_columns: null
     * before the flow is known. */
    std::string
    reason_to_end(const SoilColumns *soil_columns) const;

    /** Return what a run prints at its beginning. */
    std::string
    description() const;

  private:
    /** Of its lower face over the original mudline. Units: m. */
    double
    height_of_lid() const;
    /** Continue the water beneath a sealed lid by a step. */
    void
                        advance_sealed(const double       dt,
                                       const SoilColumns &soil_columns,
                                       const WaterFlow   &flow);
    const WaterScene    scene;
    Suction             suction_;
    SealedLid           sealed;
    Plug                plug_;
    Feasibility         feasibility;
    std::vector<double> filled;               // [n_cells], at the last look
    double              touched         = 0.; // share of the area of the lid
    double              time_of_suction = 0.; // of its table, s
    double              seepage_volume  = 0.; // through the plug, m3
    // the volume that body and plug had displaced when this run began, m3
    double     volume_at_start = 0.;
    RecentMean recent_heave; // of the plug, m
    bool       has_warned_of_cavity = false;
  };
} // namespace CaissonMPM

#endif
