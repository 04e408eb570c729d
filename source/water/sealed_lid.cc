// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/water/sealed_lid.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  double
  SealedLid::expansion(const double suction) const
  {
    return C * suction + own.gas * suction / (own.ambient - suction);
  }

  double
  SealedLid::compliance(const double suction) const
  {
    const double left = own.ambient - suction;
    return C + own.gas * own.ambient / (left * left);
  }

  double
  SealedLid::suction_of(const double wanted) const
  {
    if (own.gas <= 0.)
      return wanted / C;
    // (E - C s)(p_0 - s) = V_g s, of which the smaller root is below p_0
    const double b = wanted + C * own.ambient + own.gas,
                 c = wanted * own.ambient;
    return 2. * c / (b + std::sqrt(b * b - 4. * C * c));
  }

  void
  SealedLid::start(const double suction,
                   const double volume,
                   const double displaced)
  {
    started            = true;
    C                  = std::max(volume, 0.) / own.bulk_modulus;
    suction_           = suction;
    expansion_at_start = expansion(suction);
    cavity_at_start    = cavity_; // that of the run before
    displaced_ = displaced_at_start = displaced;
  }

  void
  SealedLid::advance(const double dt,
                     const double displaced,
                     const Rates &rates,
                     const double boiling)
  {
    // 1. the least compliance that is stable; what water and gas have expanded
    //    grows with it, and is counted
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
    passed += std::abs(lid) + std::abs(plug) + std::abs(flow) + std::abs(leak);
    // 3. the suction, which is at most that at which water boils
    const double largest = expansion(boiling);
    cavity_              = std::max(expanded - largest, 0.);
    suction_             = cavity_ > 0. ? boiling : suction_of(expanded);
  }

  NamedNumbers
  SealedLid::columns() const
  {
    const double expanded = expansion(suction_) - expansion_at_start - raised,
                 error    = expanded + (cavity_ - cavity_at_start) - growth() +
                         risen_ + seepage + leaked;
    return {{"lid_growth_m3", growth()},
            {"plug_rise_m3", risen_},
            {"lid_leak_m3", leaked},
            {"lid_expansion_m3", expanded},
            {"lid_cavity_m3", cavity_},
            {"lid_water_balance", passed > 0. ? error / passed : 0.}};
  }

  void
  SealedLid::register_totals(RunTotals &totals)
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
} // namespace CaissonMPM
