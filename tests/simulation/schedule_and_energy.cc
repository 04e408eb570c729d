// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a run consists of besides the step: its schedule, with a motion that
// knows its future and with one that does not, its totals, and the balance of
// its energies.
#include <caisson_mpm/base/run_totals.h>
#include <caisson_mpm/operators/energy_balance.h>
#include <caisson_mpm/simulation/schedule.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "../shared/scene.h"

namespace
{
  const std::string caisson = R"(
    subsection Rigid body
      set Kind                = caisson
      set Initial penetration = 0.5
      set Velocity            = 0.1
    end
    )";

  /** A schedule with its body and clock. */
  struct Run : EmptyParameters
  {
    explicit Run(const std::string &parameters)
      : schedule(body, clock)
    {
      auto &prm = dealii::ParameterAcceptor::prm;
      prm.parse_input_from_string(caisson + parameters);
      dealii::ParameterAcceptor::parse_all_parameters(prm);
      body.motion().start();
      schedule.start();
    }

    /** Make steps of at most @p step_size until the end. */
    void
    go(const double step_size)
    {
      while (!schedule.is_finished())
        {
          const double dt = schedule.shorten(step_size);
          body.motion().advance(dt, 0.);
          clock.time += dt;
          ++clock.step;
          const Schedule::Due due = schedule.take_due();
          if (due.record)
            records.push_back(clock.time);
          if (due.frame)
            frames.push_back(clock.time);
        }
    }

    void
    print(const char *what) const
    {
      std::printf("%s: %lu steps, records at", what, clock.step);
      for (const double time : records)
        std::printf(" %.6g", time);
      std::printf(", frames at");
      for (const double time : frames)
        std::printf(" %.6g", time);
      std::printf(", fraction %.6g\n", schedule.fraction_done());
    }

    RigidBody           body;
    Clock               clock;
    Schedule            schedule;
    std::vector<double> records, frames;
  };

  std::string
  output(const std::string &entries)
  {
    return "subsection Output\n" + entries + "end\n";
  }

  void
  check_schedule()
  {
    Run run(output("set Record interval = 0.5\nset Frame interval = 0.8\n"
                   "set Frame penetrations = 0.53, 0.9\n") +
            "subsection Time\nset End penetration = 0.7\nend\n");
    std::printf("frames %u, end %s\n",
                run.schedule.n_frames(),
                run.schedule.end_description().c_str());
    run.go(.3);
    run.print("events are met exactly");
    verdict("depth at the end", std::abs(run.body.penetration() - .7), 1e-12);

    Run every(output("set Record interval = every step\n") +
              "subsection Time\nset End time = 1\nend\n");
    every.go(.4);
    every.print("every step");

    // 0.5 and 1 of the interval are a frame at a depth and the end
    Run once(
      output("set Frame interval = 0.5\nset Frame penetrations = 0.52\n") +
      "subsection Time\nset End penetration = 0.6\nend\n");
    const unsigned int n = once.schedule.n_frames();
    once.go(.1);
    once.print("frames that coincide");
    verdict("number of frames", n - 1. - once.frames.size(), 0.);
  }

  /** A motion that knows only its present. */
  class Unknown : public BodyMotion
  {
  public:
    Unknown()
      : BodyMotion("unknown", "not known in advance")
    {}

  protected:
    void
    move(const double dt, const double force) override
    {
      velocity_ += dt * force;
      travel_ += dt * velocity_;
    }
  };

  void
  check_motion()
  {
    Unknown   motion;
    RunTotals totals;
    motion.register_totals(totals);
    motion.start();
    motion.advance(.5, 2.);
    motion.advance(.5, 0.);
    verdict("travel under a force", std::abs(motion.travel() - 1.), 1e-14);
    verdict("mean velocity", std::abs(motion.mean_velocity() - 1.), 1e-14);
    const NamedNumbers state = totals.state();
    motion.start();
    const std::string missing = totals.resume(state, true);
    verdict("travel after a restart", std::abs(motion.travel() - 1.), 0.);
    std::printf("missing: \"%s\", future known: %s\n",
                missing.c_str(),
                motion.time_of_travel(1.) ? "yes" : "no");
  }

  void
  check_totals()
  {
    RunTotals     totals;
    unsigned long count = 3;
    double        work = 1. / 3., time = .7;
    totals.count("count", count);
    totals.sum("work", work);
    totals.keep("time", time);
    totals.bring_to_first_rank(MPI_COMM_SELF);
    const NamedNumbers state = totals.state();
    std::printf("counts: %u, of them reported: %u\n",
                int(state.size()),
                int(totals.counts().size()));
    count = 0;
    work = time = 0.;
    totals.resume(state, true);
    verdict("the same after a restart",
            std::abs(count - 3.) + std::abs(work - 1. / 3.) +
              std::abs(time - .7),
            0.);
    totals.resume(state, false);
    verdict("another rank has no part of the sums",
            count + std::abs(work) + std::abs(time - .7),
            0.);
    std::printf("missing: %s\n", totals.resume({{"count", 1.}}, true).c_str());
  }

  void
  check_balance()
  {
    EnergyBalance energy;
    PointEnergies points;
    points.kinetic   = 1.;
    points.potential = 5.;
    energy.start(points);
    NodalWork work;
    work.body   = 10.; // on the soil
    work.forces = -6.;
    energy.add(work, 5.);
    points.kinetic   = 4.;
    points.potential = 4.;
    energy.close(points);
    verdict("kinetic energy", std::abs(energy.kinetic_gain - 3.), 0.);
    verdict("work of gravity", std::abs(energy.gravity_work - 1.), 0.);
    verdict("dissipation", std::abs(energy.dissipation - 1.), 0.);
    verdict("residual", std::abs(energy.residual - 2.), 0.);
    verdict("relative residual", std::abs(energy.relative - .2), 1e-15);
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_schedule();
  check_motion();
  check_totals();
  check_balance();
  return 0;
}
