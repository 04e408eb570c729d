// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The rigid body: its motion and its shape.
#include <caisson_mpm/bodies/dropped_motion.h>
#include <caisson_mpm/bodies/prescribed_motion.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <vector>

#include "../shared/scene.h"

const PrescribedMotion &
motion_of(const Scene &s)
{
  return dynamic_cast<const PrescribedMotion &>(s.body.motion());
}

void
check_motion()
{
  Scene        s(caisson + "subsection Rigid body\n"
                           "set Velocity table = 0:0, 2:0.1, 4:0.1, 6:0.3\nend\n");
  const auto  &motion   = motion_of(s);
  double       distance = 0., speed = 0., time = 0.;
  const double exact[][3] = {{1., .025, .05},
                             {2., .1, .1},
                             {3., .2, .1},
                             {5., .45, .2},
                             {6., .7, .3},
                             {8., 1.3, .3}};
  for (const auto &e : exact)
    {
      distance = std::max(distance, std::abs(motion.travel_at(e[0]) - e[1]));
      speed    = std::max(speed, std::abs(motion.velocity_at(e[0]) - e[2]));
      time     = std::max(time, std::abs(*motion.time_of_travel(e[1]) - e[0]));
    }
  verdict("velocity table: travel error", distance, 1e-14);
  verdict("velocity table: velocity error", speed, 1e-14);
  verdict("velocity table: time of travel error", time, 1e-12);

  Scene ramp(caisson + "subsection Rigid body\nset Velocity = 0.1\n"
                       "set Ramp time = 0.5\nend\n");
  verdict("ramp: travel error",
          std::abs(motion_of(ramp).travel_at(.25) - .00625) +
            std::abs(motion_of(ramp).travel_at(2.) - .175),
          1e-14);
  Scene pulled(caisson + "subsection Rigid body\n"
                         "set Velocity table = 0:0.1, 2:-0.1, 3:-0.1\nend\n");
  // down by 0.05 m until 1 s, back at 2 s, and up from there
  const auto range = *motion_of(pulled).travel_range(4.);
  verdict("down and up: range error",
          std::abs(range.first + .2) + std::abs(range.second - .05),
          1e-14);
  verdict("down and up: time of travel error",
          std::abs(*motion_of(pulled).time_of_travel(.0375) - .5) +
            std::abs(*motion_of(pulled).time_of_travel(-.05) - 2.5) +
            std::abs(*motion_of(pulled).time_of_travel(-.15) - 3.5),
          1e-12);
  std::printf("a depth never reached: %s\n",
              std::isinf(*motion_of(pulled).time_of_travel(.051)) ? "infinite" :
                                                                    "finite");
  Scene stops(caisson + "subsection Rigid body\n"
                        "set Velocity table = 0:0.1, 1:0\nend\n");
  std::printf("a depth never reached: %s\n",
              std::isinf(*motion_of(stops).time_of_travel(.051)) ? "infinite" :
                                                                   "finite");
}

void
check_shape()
{
  Scene        s(caisson);
  const double h = .1 * std::tan(pi / 3.);
  verdict("tip height error", std::abs(s.body.shape().tip_height() - h), 1e-14);
  verdict("tip surface error",
          std::abs(s.body.shape().lower_surface(2.9) + .5) +
            std::abs(s.body.shape().lower_surface(2.8) + .5 - h) +
            std::abs(s.body.shape().lower_surface(2.95) + .5 - .5 * h),
          1e-14);
  const auto inside = [&s](const double r, const double z) {
    return s.body.shape().contains(dealii::Point<2>(r, z), 1.);
  };
  std::printf("inside: %d%d%d%d%d%d\n",
              inside(2.9, 0.),
              inside(2.9, -1.49),
              inside(2.81, -1.45),
              inside(2.79, 0.),
              inside(2.9, 1.6),
              inside(3.01, 0.));

  // its cells, with the mass of the steel
  unsigned int n_outside = 0;
  for (unsigned int cell = 0; cell < s.grid.n_cells(); ++cell)
    n_outside +=
      s.grid.is_rigid(cell) &&
      !s.body.shape().contains(to_position(s.grid.geometry(cell), {.5, .5}),
                               0.);
  const double volume = s.grid.mass_of_body(1.),
               mass   = s.grid.mass_of_body(7850.);
  const double exact =
    pi * (9. - 2.8 * 2.8) * (3. - h) + .5 * h * pi * (9. - 2.8 * 2.8);
  verdict("cells of the body outside", n_outside, 0.);
  verdict("body volume error", std::abs(volume / exact - 1.), 1e-3);
  verdict("body density error", std::abs(mass / volume / 7850. - 1.), 1e-12);
}

constexpr double body_mass = 1000., weight = 9810.; // kg, N

/** Set up a body of 1 t that begins to fall. */
struct Falling : EmptyParameters
{
  Falling()
  {
    dealii::ParameterAcceptor::declare_all_parameters();
    dealii::ParameterAcceptor::parse_all_parameters();
    motion.start();
    motion.surroundings.mass = body_mass;
    motion.surroundings.load = weight;
  }

  DroppedMotion motion;
};

/** Without resistance the fall is exact, whatever the steps are. */
void
check_fall()
{
  Falling fall;
  double  time = 0.;
  for (unsigned int i = 0; i < 1000; ++i)
    {
      const double dt = 1e-3 * (1 + i % 7);
      fall.motion.advance(dt, 0.);
      time += dt;
    }
  const double g = weight / body_mass;
  verdict("fall: travel error",
          std::abs(fall.motion.travel() / (.5 * g * time * time) - 1.),
          1e-12);
  verdict("fall: velocity error",
          std::abs(fall.motion.velocity() / (g * time) - 1.),
          1e-12);
}

/** An impulse that was not foreseen is not lost. */
void
check_momentum()
{
  Falling          hit;
  constexpr double dt = 1e-3, force = -5e4;
  hit.motion.surroundings.load = 0.;
  hit.motion.advance(dt, 0.);
  hit.motion.advance(dt, force);
  for (unsigned int i = 0; i < 1000; ++i)
    hit.motion.advance(dt, 0.);
  verdict("impulse: velocity error",
          std::abs(hit.motion.velocity() * body_mass / (dt * force) - 1.),
          1e-12);
}

/** On a spring the body swings between 0 and twice the travel at rest, with the
 * frequency that its mass and that of the soil that it holds have. */
void
check_spring(const char *what, const double soil)
{
  const double   stiffness = 4e4, total = body_mass + soil, dt = 1e-3;
  const double   period   = 2. * pi * std::sqrt(total / stiffness);
  constexpr long n_swings = 20;
  Falling        swing;
  double         turn = 0., least = 0., most = 0., force = 0.;
  for (long i = 0; i < std::lround(n_swings * period / dt); ++i)
    {
      const double before                = swing.motion.velocity();
      const double spring                = -stiffness * swing.motion.travel(),
                   last                  = swing.motion.mean_velocity();
      swing.motion.surroundings.response = {spring, soil};
      swing.motion.advance(dt, force);
      // the soil is accelerated with the body
      force = spring - soil * (swing.motion.mean_velocity() - last) / dt;
      if (before < 0. && swing.motion.velocity() >= 0.)
        turn = i * dt; // the last return to the highest place
      least = std::min(least, swing.motion.travel());
      most  = std::max(most, swing.motion.travel());
    }
  std::printf("spring, %s\n", what);
  verdict("  period error",
          std::abs(std::remainder(turn / period, 1.)) / n_swings,
          1e-3);
  verdict("  amplitude error",
          std::max(std::abs(most * stiffness / (2. * weight) - 1.),
                   -least * stiffness / weight),
          1e-3);
}

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_motion();
  check_shape();
  check_fall();
  check_momentum();
  check_spring("heavy body", 0.);
  check_spring("body that is light against the soil", 100. * body_mass);
  return 0;
}
