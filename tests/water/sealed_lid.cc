// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The water beneath a sealed lid over rigid soil that conducts water: its
// suction in closed form, its balance, gas, and the cavity at which water
// boils.
#include <caisson_mpm/water/sealed_lid.h>

#include <algorithm>
#include <cmath>

#include "../shared/verdict.h"

using namespace CaissonMPM;

constexpr double area = 28., volume = 40.;    // m2, m3
constexpr double seepage = 2e-6, leak = 1e-6; // m3/(s Pa)
constexpr double modulus = 2e8, boiling = 4e5;
constexpr double dt = 2e-3; // s

double
balance_of(const SealedLid &lid)
{
  return std::abs(*number_named("lid_water_balance", lid.columns()));
}

/** Pull at a velocity (m/s, upward) for a time, from a place (m). */
void
pull(SealedLid   &lid,
     const double velocity,
     const double time,
     double      &place,
     const double conductance)
{
  const unsigned int n = std::lround(time / dt);
  for (unsigned int i = 0; i < n; ++i)
    {
      place += velocity * dt;
      const double in = conductance * lid.suction();
      lid.advance(dt, -area * place, {0., in, conductance}, boiling);
    }
}

void
check_pull_at_a_rate()
{
  heading("a pull at 10 mm/s: s = A v / L (1 - exp(- L t / C))");
  constexpr double velocity = .01, L = seepage + leak, C = volume / modulus;
  SealedLid        lid;
  lid.set_properties({leak, modulus, 0., 1e6});
  lid.start(0., volume, 0.);
  double error = 0., place = 0.;
  for (unsigned int i = 1; i <= 10; ++i)
    {
      constexpr double part = .02;
      pull(lid, velocity, part, place, seepage);
      const double exact =
        area * velocity / L * (1. - std::exp(-L * i * part / C));
      error = std::max(error, std::abs(lid.suction() - exact));
    }
  verdict("  largest error over A v / L", error * L / (area * velocity), .006);
  pull(lid, velocity, 2., place, seepage);
  verdict("  suction at last, error over A v / L",
          std::abs(lid.suction() * L / (area * velocity) - 1.),
          1e-8);
  pull(lid, 0., 2., place, seepage);
  verdict("  held, suction over that before",
          std::abs(lid.suction()) * L / (area * velocity),
          1e-8);
  verdict("  balance", balance_of(lid), 1e-12);
}

void
check_cycles()
{
  heading("a hundred cycles");
  SealedLid lid;
  lid.set_properties({leak, modulus, .5, 4e5});
  lid.start(2e3, volume, 0.);
  double place = 0., largest = 0.;
  for (unsigned int i = 0; i < 100; ++i)
    for (const double velocity : {.01, -.01})
      {
        pull(lid, velocity, .1, place, seepage);
        largest = std::max(largest, balance_of(lid));
      }
  verdict("  balance", largest, 1e-12);
}

void
check_gas()
{
  heading(
    "tight soil, 1 m3 of gas at p_0: pulled by V, s = p_0 V / (1 m3 + V)");
  constexpr double ambient = 4e5, gas = 1., lifted = .02;
  SealedLid        lid;
  lid.set_properties({0., 1e30, gas, ambient});
  lid.start(0., volume, 0.);
  double place = 0.;
  pull(lid, lifted / 1., 1., place, 0.);
  const double V = area * lifted;
  verdict("  error over p_0",
          std::abs(lid.suction() / ambient - V / (gas + V)),
          1e-12);
}

void
check_cavity()
{
  heading("tight soil, pulled until water boils, and back");
  SealedLid lid;
  lid.set_properties({0., modulus, 0., 1e6});
  lid.start(0., volume, 0.);
  double place = 0.;
  pull(lid, .01, 1., place, 0.);
  const double expected = area * .01 - volume / modulus * boiling;
  verdict("  suction less that at which it boils",
          std::abs(lid.suction() - boiling),
          0.);
  verdict("  volume of the cavity, error",
          std::abs(lid.cavity() - expected),
          1e-12);
  pull(lid, -.01, 1., place, 0.);
  verdict("  back: suction, Pa", std::abs(lid.suction()), 1e-4);
  verdict("  back: cavity", lid.cavity(), 0.);
  verdict("  balance", balance_of(lid), 1e-12);
}

/** A lid over tight soil that leaks, in closed form: suction and cavity. */
struct Leaking
{
  double C, L; // m3/Pa, m3/(s Pa)
  double suction = 0., cavity = 0.;

  /** Grow by the rate @p q for a time. Units: m3/s, s. */
  void
  grow(const double q, double time)
  {
    if (cavity > 0.) // the leak fills it, and the lid, which comes back
      {
        const double rate   = q - L * boiling,
                     closes = rate < 0. ? -cavity / rate : time;
        if (closes >= time)
          {
            cavity += rate * time;
            return;
          }
        cavity = 0.;
        time -= closes;
      }
    const double last = q / L,
                 end  = last + (suction - last) * std::exp(-L / C * time);
    if (end > boiling)
      {
        const double opens =
          C / L * std::log((last - suction) / (last - boiling));
        suction = boiling;
        cavity += (q - L * boiling) * (time - opens);
      }
    else
      suction = end;
  }
};

void
check_cavity_in_cycles()
{
  heading("a leak, and cycles in which a cavity opens and closes again");
  constexpr double velocity = .01, of_valve = 2e-7; // m/s, m3/(s Pa)
  SealedLid        lid;
  lid.set_properties({of_valve, modulus, 0., 1e6});
  lid.start(0., volume, 0.);
  Leaking exact{volume / modulus, of_valve};
  double  place = 0., error = 0., of_cavity = 0., above = 0., open = 0.;
  for (const double v : {velocity, -velocity, velocity, -velocity, velocity})
    {
      constexpr unsigned int parts = 10;
      for (unsigned int i = 0; i < parts; ++i)
        {
          pull(lid, v, 1. / parts, place, 0.);
          exact.grow(area * v, 1. / parts);
          error = std::max(error, std::abs(lid.suction() - exact.suction));
          of_cavity =
            std::max(of_cavity, std::abs(lid.cavity() - exact.cavity));
          above = std::max(above, lid.suction() - boiling);
          open  = std::max(open, exact.cavity);
        }
      if (v < 0.)
        verdict("  back: cavity", lid.cavity(), 0.);
    }
  verdict("  error over the suction at which it boils", error / boiling, .005);
  verdict("  above that suction", above, 0.);
  verdict("  cavity, error over the largest", of_cavity / open, .01);
  verdict("  balance", balance_of(lid), 1e-12);
}

/** Another run begins with the cavity that the one before has left. */
void
check_cavity_goes_on()
{
  heading("a cavity that another run begins with");
  SealedLid lid;
  lid.set_properties({0., modulus, 0., 1e6});
  lid.start(0., volume, 0.);
  double place = 0.;
  pull(lid, .01, 1., place, 0.);
  const double left = lid.cavity();
  lid.start(lid.suction(), volume, -area * place);
  verdict("  cavity", std::abs(lid.cavity() - left), 0.);
  const double half = left / area / 2.;
  pull(lid, -half, 1., place, 0.);
  verdict("  suction while half of it is left",
          std::abs(lid.suction() - boiling),
          0.);
  verdict("  half of it", std::abs(lid.cavity() / left - .5), 1e-12);
  verdict("  balance", balance_of(lid), 1e-12);
}

void
check_least_compliance()
{
  heading("no water at the start: stable by what the soil gives way in a step");
  SealedLid lid;
  lid.set_properties({0., modulus, 0., 1e6});
  lid.start(0., 0., 0.);
  double place = 0., largest = 0.;
  for (unsigned int i = 0; i < 100; ++i)
    {
      pull(lid, .01, dt, place, seepage);
      largest = std::max(largest, lid.suction());
    }
  verdict("  error over A v / G",
          std::abs(lid.suction() * seepage / (area * .01) - 1.),
          1e-12);
  verdict("  largest over A v / G",
          largest * seepage / (area * .01),
          1. + 1e-12);
  verdict("  balance", balance_of(lid), 1e-12);
}

int
main(int, char **)
{
  check_pull_at_a_rate();
  check_cycles();
  check_gas();
  check_cavity();
  check_cavity_in_cycles();
  check_cavity_goes_on();
  check_least_compliance();
  return 0;
}
