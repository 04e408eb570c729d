// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Single steps of the nodal motion of soil without a body and without sides:
// momentum, the work of nodal forces, equilibrium under a surrounding pressure,
// the nodal force that doc/extending.md adds, and the order of the calls.
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>

#include "stepper.h"

const std::string soil_text = R"(
  subsection Soil
    set Submerged        = false
    set Gravity          = 0, 0
    set Initial stress   = uniform
    set Uniform stress   = -5e3, -5e3, -5e3, 0
    set Initial velocity = 1 + r*z ; 2 - r
  end
  subsection Grid
    set Geometry     = plane strain
    set Outer radius = 3
    set Bottom       = -3
    set Top          = 0
    set Cell width   = 0.25
    set Cell height  = 0.25
    set Distortion   = 0.3
  end
  subsection Material points
    set Region           = 1 - (r - 1.5)^2 - (z + 1.5)^2
    set Random positions = 1
  end
  )" + free_sides;



/** A bar above a plate, which flies against it. */
const std::string bar_text = R"(
  subsection Rigid body
    set Kind       = box
    set Box left   = 0
    set Box right  = 0.2
    set Box bottom = -0.1
    set Box top    = 0
    set Velocity   = 0
  end
  subsection Soil
    set Submerged        = false
    set Gravity          = 0, 0
    set Initial stress   = none
    set Initial velocity = 0 ; -0.1
    subsection Layer 1
      set Law            = linear elastic
      set Youngs modulus = 2e5
      set Poisson ratio  = 0
      set Porosity       = 0
      set Solid density  = 1000
    end
  end
  subsection Grid
    set Geometry     = plane strain
    set Outer radius = 0.2
    set Bottom       = -0.1
    set Top          = 0.7
    set Cell width   = 0.05
    set Cell height  = 0.05
  end
  subsection Material points
    set Per direction in path = 2
    set Per direction near    = 2
    set Per direction far     = 2
    set Region bottom         = 0.05
    set Region top            = 0.55
  end
  subsection Boundary conditions
    set Axis = roller
    set Side = roller
    set Top  = free
  end
  )";



/** What sets the transfers of velocities. */
const std::map<std::string, std::string> transfers = {
  {"FLIP", "\nset FLIP fraction = 1"},
  {"PIC", "\nset FLIP fraction = 0\nset XPIC order = 1"},
  {"XPIC", "\nset FLIP fraction = 0"},
  {"blend", ""}};



/** Momentum is that of the start and of the body force, in all transfers. */
void
check_momentum(const std::string &mass_floor)
{
  for (const std::string transfer : {"FLIP", "PIC", "XPIC", "blend"})
    for (const std::string load : {"0 ; 0", "3 ; -7"})
      {
        Stepper         s(soil_text,
                  "subsection Method\nset Mass floor = " + mass_floor +
                    transfers.at(transfer) +
                    "\nend\nsubsection Loads\nset Body force = " + load +
                    "\nend\n");
        const auto      before = s.sums();
        const NodalWork work   = s.step();
        const auto      after  = s.sums();
        const Vector2   b = load == "0 ; 0" ? Vector2() : Vector2({3., -7.});
        const Vector2   expected = before.momentum + dt * before.mass * b;
        verdict(
          (transfer + ", body force " + load + ": momentum, error").c_str(),
          (after.momentum - expected).norm() / before.momentum.norm(),
          1e-13);
        // with the mean of the velocities before and after the step
        const double power = .5 * (before.momentum + expected) * b;
        verdict("  work of the body force, error",
                std::abs(work.load - dt * power) / before.mass,
                1e-8);
      }
}



/** The mass floor acts at the edge of the disc, and takes energy. */
void
check_mass_floor()
{
  Stepper         s(soil_text, "");
  const NodalWork work = s.step();
  verdict("mass floor: no added mass", 1e-6 / s.motion.added_inertia(), 1.);
  std::printf("mass floor: its energy: %s\n",
              work.mass_floor > 0. ? "taken" : "created");
}



/** A bar that hits a plate exchanges its momentum with it: the impulse of the
 * body is what the points lose, and the bar leaves no faster than it came. */
void
check_impact(const std::string &transfer, const std::string &mass_floor)
{
  Stepper    s(bar_text,
            "subsection Method\nset Mass floor = " + mass_floor +
              transfers.at(transfer) + "\nend\n");
  const auto before = s.sums();
  Vector2    impulse;
  double     added_mass = 0.;
  for (unsigned int step = 0; step < 800; ++step)
    {
      s.step();
      s.scene.grid.advance();
      s.scene.points.relocate();
      for (const Vector2 &part : s.motion.reactions().contact.impulse)
        impulse += part;
      added_mass = std::max(added_mass, s.motion.added_inertia());
    }
  const auto after = s.sums();
  verdict(("impact, " + transfer + ", mass floor " + mass_floor +
           ": momentum, error")
            .c_str(),
          std::abs(after.momentum[1] - before.momentum[1] + impulse[1]) /
            std::abs(before.momentum[1]),
          1e-12);
  const double rebound = -after.momentum[1] / before.momentum[1];
  verdict("  velocity of the rebound, less 0.95", std::abs(rebound - .95), .05);
  std::printf("  mass was added: %s\n", added_mass > 0. ? "yes" : "no");
}



/** A pressure around soil with the same stress moves no node. */
void
check_equilibrium()
{
  std::string at_rest = soil_text;
  at_rest.replace(at_rest.find("1 + r*z ; 2 - r"), 15, "0 ; 0");
  Stepper s(at_rest, "subsection Loads\nset Surrounding pressure = 5e3\nend\n");
  s.step();
  verdict("surrounding pressure: speed", s.sums().max_speed, 1e-13);
  Stepper other(at_rest, "");
  other.step();
  verdict("without it, no speed", 1e-6 / other.sums().max_speed, 1.);
}



/** Soil without stress bears the same pressure inside and around it, and is
 * driven apart by one that is inside only. */
void
check_excess_pressure()
{
  std::string bare = soil_text;
  bare.replace(bare.find("1 + r*z ; 2 - r"), 15, "0 ; 0");
  bare.replace(bare.find("-5e3, -5e3, -5e3, 0"), 19, "0, 0, 0, 0");
  Stepper s(bare,
            "subsection Loads\nset Surrounding pressure = 5e3\n"
            "set Excess pore pressure = 5e3\nend\n");
  s.step();
  verdict("pressure inside and around: speed", s.sums().max_speed, 1e-13);
  Stepper         open(bare,
               "subsection Loads\nset Excess pore pressure = 5e3\nend\n"
                       "subsection Method\nset Mass floor = false\nend\n");
  const NodalWork work = open.step();
  std::printf("pressure inside only, its work: %s\n",
              work.load > 0. ? "positive" : "not positive");
  verdict("pressure inside only: momentum",
          open.sums().momentum.norm() / open.sums().mass,
          1e-13);
}



/** A call out of turn is refused. */
void
check_order()
{
  Stepper    s(soil_text, "");
  const auto refused = [](const auto &call) {
    try
      {
        call();
      }
    catch (const dealii::ExceptionBase &)
      {
        return "refused";
      }
    return "accepted";
  };
  std::printf("accelerate before collect: %s\n", refused([&]() {
                s.motion.accelerate({dt, StepSize::reference_courant},
                                    s.forces,
                                    Vector2(),
                                    s.contact);
              }));
  std::printf("collect: %s\n", refused([&]() { s.collect(); }));
  std::printf("collect again: %s\n", refused([&]() { s.collect(); }));
  std::printf("work before the transfer: %s\n", refused([&]() {
                s.motion.work_of_step(s.forces, s.constraints);
              }));
  std::printf("accelerate: %s\n", refused([&]() {
                s.motion.accelerate({dt, StepSize::reference_courant},
                                    s.forces,
                                    Vector2(),
                                    s.contact);
              }));
}



int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  heading("momentum and work of a body force");
  check_momentum("false");
  check_momentum("true");
  heading("mass floor");
  check_mass_floor();
  heading("impact on a body");
  for (const std::string transfer : {"blend", "XPIC"})
    for (const std::string mass_floor : {"false", "true"})
      check_impact(transfer, mass_floor);
  heading("surrounding pressure");
  check_equilibrium();
  heading("excess pore pressure");
  check_excess_pressure();
  heading("order of the calls");
  check_order();
  return 0;
}
