// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The water beneath a lid that is sealed: its volume follows body and plug, and
// its pressure follows from its volume.
#ifndef caisson_mpm_water_sealed_lid_h
#define caisson_mpm_water_sealed_lid_h

#include <caisson_mpm/base/named_numbers.h>
#include <caisson_mpm/base/run_totals.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  /**
   * Between lid and plug there is water of the volume V_0 at the start, and gas
   * of the volume V_g at the ambient pressure p_0. With the suction s, both
   * have expanded by
   *
   *   E(s) = C s + V_g s / (p_0 - s),   C = V_0 / K,
   *
   * with the bulk modulus K of the water. The compartment grows as the body
   * rises, and shrinks as the surface of the plug rises; water flows in through
   * the plug and through the leak. So, with the area A of the lid, the velocity
   * v of the body upward, the rates Q_p of the plug and Q_s of the seepage, and
   * the conductance L of the leak,
   *
   *   dE/dt = A v - Q_p - Q_s - L s.
   *
   * At the suction at which water boils, it grows no more: what E exceeds that
   * of this suction is a cavity of vapor, which closes before the suction
   * falls.
   *
   * The rates are those of the step before. That is stable while the
   * compartment gives way by more than soil and seepage do in a step; C is
   * raised to this where V_0 is small. Not collective; the same on all ranks.
   */
  class SealedLid
  {
  public:
    /** What does not change. Units: m3/(s Pa), Pa, m3. */
    struct Properties
    {
      double leak = 0., bulk_modulus = 2.2e9;
      double gas = 0., ambient = 1.; // gas, and its pressure
    };

    /** Rates of volume, in m3/s, and by how much the flow of plug and seepage
     * changes in a step with the suction, in m3/(s Pa). */
    struct Rates
    {
      double plug = 0., seepage = 0., response = 0.;
    };

    void
    set_properties(const Properties &properties)
    {
      own = properties;
    }

    /** Begin with this suction and volume of water, and with the cavity that a
     * run before has left, while the body displaces the volume @p displaced, A
     * times its travel downward. Units: Pa, m3. */
    void
    start(const double suction, const double volume, const double displaced)
    {
      started            = true;
      C                  = std::max(volume, 0.) / own.bulk_modulus;
      suction_           = suction;
      expansion_at_start = expansion(suction);
      cavity_at_start    = cavity_; // that of the run before
      displaced_ = displaced_at_start = displaced;
    }

    /** Whether start() has been called, in this run. */
    bool
    has_started() const
    {
      return started;
    }

    /** Advance by a step, after which the body displaces the volume @p
     * displaced and water boils at the suction @p boiling. */
    void
    advance(const double dt,
            const double displaced,
            const Rates &rates,
            const double boiling)
    {
      // 1. the least compliance that is stable; what water and gas have
      //    expanded grows with it, and is counted
      constexpr double margin = 2.;
      const double     least  = margin * dt * (rates.response + own.leak);
      if (compliance(suction_) < least)
        {
          const double more = least - compliance(suction_);
          C += more;
          raised += more * suction_;
        }
      // 2. by how much more they expand
      const double leak = dt * own.leak * suction_;
      const double plug = dt * rates.plug, flow = dt * rates.seepage,
                   lid = displaced - displaced_;
      const double expanded =
        expansion(suction_) + cavity_ - lid - plug - flow - leak;
      displaced_ = displaced;
      risen_ += plug;
      seepage += flow;
      leaked += leak;
      passed +=
        std::abs(lid) + std::abs(plug) + std::abs(flow) + std::abs(leak);
      // 3. the suction, which is at most that at which water boils
      const double largest = expansion(boiling);
      cavity_              = std::max(expanded - largest, 0.);
      suction_             = cavity_ > 0. ? boiling : suction_of(expanded);
    }

    /** Units: Pa. */
    double
    suction() const
    {
      return suction_;
    }

    /** The volume of vapor. Units: m3. */
    double
    cavity() const
    {
      return cavity_;
    }

    /** By how much the compartment has grown. Units: m3. */
    double
    growth() const
    {
      return displaced_at_start - displaced_;
    }

    /** Return the numbers of a record. */
    NamedNumbers
    columns() const
    {
      const double expanded = expansion(suction_) - expansion_at_start - raised,
                   error = expanded + (cavity_ - cavity_at_start) - growth() +
                           risen_ + seepage + leaked;
      return {{"lid_growth_m3", growth()},
              {"plug_rise_m3", risen_},
              {"lid_leak_m3", leaked},
              {"lid_expansion_m3", expanded},
              {"lid_cavity_m3", cavity_},
              {"lid_water_balance", passed > 0. ? error / passed : 0.}};
    }

    void
    register_totals(RunTotals &totals)
    {
      totals.keep("sealed_started", started);
      totals.keep("sealed_compliance", C);
      totals.keep("sealed_suction", suction_);
      totals.keep("sealed_expansion_at_start", expansion_at_start);
      totals.carry("sealed_cavity", cavity_);
      totals.keep("sealed_cavity_at_start", cavity_at_start);
      totals.keep("sealed_displaced", displaced_);
      totals.keep("sealed_displaced_at_start", displaced_at_start);
      totals.keep("sealed_risen", risen_);
      totals.keep("sealed_seepage", seepage);
      totals.keep("sealed_leaked", leaked);
      totals.keep("sealed_raised", raised);
      totals.keep("sealed_passed", passed);
    }

  private:
    /** E(s), and dE/ds. */
    double
    expansion(const double suction) const
    {
      return C * suction + own.gas * suction / (own.ambient - suction);
    }

    double
    compliance(const double suction) const
    {
      const double left = own.ambient - suction;
      return C + own.gas * own.ambient / (left * left);
    }

    /** Return the suction at which water and gas have expanded by this. */
    double
    suction_of(const double wanted) const
    {
      if (own.gas <= 0.)
        return wanted / C;
      // (E - C s)(p_0 - s) = V_g s, of which the smaller root is below p_0
      const double b = wanted + C * own.ambient + own.gas,
                   c = wanted * own.ambient;
      return 2. * c / (b + std::sqrt(b * b - 4. * C * c));
    }

    Properties own;
    bool       started  = false;
    double     C        = 0.;               // m3/Pa
    double     suction_ = 0., cavity_ = 0.; // Pa, m3
    // E and cavity at the start, and what has passed since then, m3
    double expansion_at_start = 0., cavity_at_start = 0., displaced_ = 0.,
           displaced_at_start = 0., risen_ = 0., seepage = 0., leaked = 0.,
           raised = 0.;
    double passed = 0.; // the sum of all magnitudes, m3
  };
} // namespace CaissonMPM

#endif
