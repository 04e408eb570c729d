// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The suction beneath the lid of a caisson: how large it is, and what limits
// it.
#ifndef caisson_mpm_water_suction_h
#define caisson_mpm_water_suction_h

#include <caisson_mpm/base/run_totals.h>
#include <caisson_mpm/base/section.h>
#include <caisson_mpm/materials/soil.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  /** What the suction acts on, at one time. */
  struct SuctionLoad
  {
    double resistance = 0.; // of the soil, effective and upward; N
    double weight     = 0.; // submerged; N
    double area       = 0.; // of the lid, plus that of the tip times the share
                            // of the suction that has reached it; m2
    double volume = 0.;     // of water that has left the caisson so far; m3
    bool   rises  = false;  // whether the body moves up
  };

  /** The sea above the mudline. */
  struct SeaSettings : public Section
  {
    SeaSettings();

    /** Return the absolute pressure of the open water on the mudline; @p
     * unit_weight of the water in N/m3. Units: Pa. */
    double
    ambient_pressure(const double unit_weight) const;

    /** Return the suction at which water boils at this @p height over the
     * original mudline, for instance beneath the lid. Units: N/m3, m; Pa. */
    double
    cavitation(const double unit_weight, const double height) const;

    double depth = 30.; // of the mudline, m
  };

  /** How the suction is given, and what limits it. */
  class SuctionSettings : public Section
  {
  public:
    enum class Control
    {
      automatic, // required where water flows, elsewhere no suction
      required,
      table,
      flow,
      sealed
    };

    SuctionSettings();

    /** Throw BadInput where the entries contradict each other. */
    void
    check_parameters() const;

    /** Report which entries the control leaves without effect. */
    void
    name_unused_entries(ParameterOrigins &origins) const override;

    /** Return the largest suction of the table; 0 where it is not used. Units:
     * Pa. */
    double
    largest_of_table() const;

    /** Whether the suction is the one that the body requires. */
    bool
    is_required() const
    {
      return control == Control::required || control == Control::automatic;
    }

    Control                                control = Control::automatic;
    std::optional<double>                  largest;           // of the pump, Pa
    double                                 gas = 0.;          // at p_0, m3
    std::vector<std::pair<double, double>> table;             // s, Pa
    std::vector<std::pair<double, double>> flow_table;        // s, m3/s
    double                                 largest_flow = 0.; // of it, m3/s
    double bulk_modulus = 2.2e9; // of the water beneath a sealed lid, Pa
    double leak         = 0.;    // of a sealed lid, m3/(s Pa)

  private:
    void
    add_entries_of_pump();
    void
    add_entries_of_water_beneath_lid();

    std::string table_text, flow_text;
  };

  /**
   * The suction is either given over time, or the one that a body that moves as
   * prescribed requires: with the resistance R, the weight W and the area A,
   * (R - W)/A. It is negative, an overpressure, only where it is asked for by
   * name and the body moves up, as R is then negative, too. The required
   * suction is followed with a delay, because suction weakens the soil: at
   * depth, 1 kPa takes several times as much resistance as it loads the lid,
   * and following at once would swing.
   *
   * Or the pump takes a given flow Q, and the body must be free to follow: the
   * suction grows while less water leaves the caisson than the pump takes, as
   * if the water gave way a little. With the load F = W + s A and the largest
   * flow Q_m of the table,
   *   ds/dt = F / (10 A) (Q - dV/dt) / (Q_m T).
   *
   * Gas beneath the lid, V_0 at the ambient pressure p_0, expands to
   * V_0 p_0/(p_0 - s). The pump takes its expansion, too, and where gas gives
   * way more than the above, it alone says what the suction is.
   *
   * Or the lid is sealed: then SealedLid finds the suction.
   * Not collective; the same on all ranks.
   */
  class Suction
  {
  public:
    /** The settings must outlive this object. */
    Suction(const SuctionSettings &settings,
            const SeaSettings     &sea,
            const Soil            &soil);

    /** Continue the suction of another run, while this @p volume of water has
     * left the caisson. Units: m3. */
    void
    continue_at(const double volume)
    {
      last_volume = volume;
    }

    /** Continue by a step of length @p dt to @p time, that of the table; at 0 and
     * before, a given suction or flow waits. Units: s. */
    void
    advance(const double time, const double dt, const SuctionLoad &load);

    /** Set the suction beneath a sealed lid. Units: Pa. */
    void
    set(const double of_sealed_lid)
    {
      suction = of_sealed_lid;
    }

    /** Units: Pa. */
    double
    value() const
    {
      return suction;
    }

    /** The suction of equilibrium, negative where the weight alone is more than
     * the resistance. Units: Pa. */
    double
    required() const
    {
      return required_;
    }

    /** Return by how much the trapped gas has expanded under the suction.
     * Units: m3. */
    double
    gas_expansion() const;

    /** Return the suction at which water boils at this @p height over the
     * original mudline, for instance beneath the lid. Units: m; Pa. */
    double
    cavitation(const double height) const;

    /** Return why the suction cannot grow as it should, or an empty text. @p
     * height: of the lid's lower face over the original mudline, m. */
    std::string
    limit_reached(const double height) const;

    /** Whether the suction is more than the pump has. */
    bool
    exceeds_pump() const
    {
      return settings.largest && suction > *settings.largest;
    }

    void
    register_totals(RunTotals &totals);

  private:
    /** Let the pump take its flow for a step. */
    void
    pump(const double time, const double dt, const SuctionLoad &load);

    const SuctionSettings &settings;
    const SeaSettings     &sea;
    const Soil            &soil;
    double                 suction = 0., required_ = 0.;
    double                 last_volume = 0.; // m3
  };
} // namespace CaissonMPM

#endif
