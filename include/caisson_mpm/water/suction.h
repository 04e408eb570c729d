// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The suction beneath the lid of a caisson: how large it is, and what limits
// it.
#ifndef caisson_mpm_water_suction_h
#define caisson_mpm_water_suction_h

#include <caisson_mpm/base/parameter_origins.h>
#include <caisson_mpm/base/run_totals.h>

#include <deal.II/base/parameter_acceptor.h>

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
  };

  /**
   * The suction is either given over time, or the one that a body that moves as
   * prescribed requires: with the resistance R, the weight W and the area A,
   * (R - W)/A, but never negative. The required suction is followed with a
   * delay, because suction weakens the soil: at depth, 1 kPa takes several
   * times as much resistance as it loads the lid, and following at once would
   * swing.
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
   * Not collective; the same on all ranks.
   */
  class Suction : public dealii::ParameterAcceptor
  {
  public:
    Suction();

    /** Tell the @p unit_weight of the water. Units: N/m3. */
    void
    initialize(const double unit_weight)
    {
      unit_weight_of_water = unit_weight;
    }

    /** Throw BadInput where the entries contradict each other. */
    void
    check_parameters() const;

    /** Tell which entries the control leaves without effect. */
    void
    name_unused_entries(ParameterOrigins &origins) const;

    /** Tell that no entry of the suction has an effect, and why. */
    static void
    name_all_unused(ParameterOrigins &origins, const std::string &why);

    /** Whether the motion of the body decides how large the suction is. */
    bool
    is_result() const
    {
      return control == Control::required;
    }

    /** Whether the body must follow its loads. */
    bool
    moves_body() const
    {
      return control == Control::flow;
    }

    /** Go on after another run with its suction, while this @p volume of water
     * has left the caisson. Units: m3. */
    void
    go_on_at(const double volume)
    {
      last_volume = volume;
    }

    /** Let the water beneath the lid have no excess pressure. */
    void
    release()
    {
      suction = required_ = 0.;
    }

    /** Continue by a step of length @p dt to @p time, that of the table; at 0 and
     * before, a given suction or flow waits. Units: s. */
    void
    advance(const double time, const double dt, const SuctionLoad &load);

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

    /** Return the largest suction of the table; 0 where it is not used. Units:
     * Pa. */
    double
    largest_of_table() const;

    /** Return the largest suction of the pump; 0 where it has no limit. Units:
     * Pa. */
    double
    largest_of_pump() const
    {
      return largest.value_or(0.);
    }

    void
    register_totals(RunTotals &totals);

  private:
    enum class Control
    {
      required,
      table,
      flow
    };

    void
    fill_tables();
    /** The absolute pressure of the open water on the mudline. Units: Pa. */
    double
    ambient_pressure() const;
    /** Let the pump take its flow for a step. */
    void
    pump(const double time, const double dt, const SuctionLoad &load);

    Control                                control = Control::required;
    std::string                            table_text, flow_text;
    double                                 delay = 0.02, pump_delay = 0.1;
    std::optional<double>                  largest;
    double                                 water_depth = 30.;
    double                                 gas         = 0.; // at p_0, m3
    std::vector<std::pair<double, double>> table;            // s, Pa
    std::vector<std::pair<double, double>> flow_table;       // s, m3/s

    double unit_weight_of_water = 0.; // N/m3
    double suction = 0., required_ = 0.;
    double last_volume = 0.; // m3
  };
} // namespace CaissonMPM

#endif
