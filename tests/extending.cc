// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The shape, the motion and the counter that doc/extending.md adds.
#include <caisson_mpm/base/run_totals.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <cstdio>

#include "examples/sinking.h"
#include "examples/slab.h"

using namespace CaissonMPM;
using dealii::ParameterAcceptor;

namespace
{
  void
  verdict(const char *what, const bool holds)
  {
    std::printf("%s: %s\n", what, holds ? "yes" : "no");
  }

  void
  set(const std::string &entry, const std::string &value)
  {
    ParameterAcceptor::prm.enter_subsection("Rigid body");
    ParameterAcceptor::prm.set(entry, value);
    ParameterAcceptor::prm.leave_subsection();
    ParameterAcceptor::parse_all_parameters();
  }

  /** A footing of 2 m radius and 0.5 m thickness. */
  void
  check_shape()
  {
    Slab slab;
    ParameterAcceptor::declare_all_parameters();
    set("Outer diameter", "4");
    set("Cells across the wall", "8");
    set("Slab thickness", "0.5");
    slab.check_parameters();
    verdict("extent",
            slab.left() == 0. && slab.right() == 2. && slab.bottom() == 0. &&
              slab.top() == .5);
    verdict("width of cells", slab.cell_width() == .25);
    const Slab::Point inside(1., .2), below(1., -.2);
    verdict("contains", slab.contains(inside, 0.) && !slab.contains(below, 0.));
    verdict("contains after a travel",
            slab.contains(below, .3) && !slab.contains(inside, .4));
  }

  /** A tenth of a second of free fall, then enough force to come to rest. */
  void
  check_motion()
  {
    Sinking body;
    ParameterAcceptor::declare_all_parameters();
    set("Sinking mass", "1000");
    set("Sinking weight", "9810");
    body.start();
    for (int i = 0; i < 1000; ++i)
      body.advance(1e-4, 0.);
    verdict("velocity of the fall", std::abs(body.velocity() - .981) < 1e-12);
    verdict("travel of the fall", std::abs(body.travel() - .04905) < 1e-4);
    for (int i = 0; i < 1000; ++i)
      body.advance(1e-4, -2. * 9810.);
    verdict("at rest", std::abs(body.velocity()) < 1e-12);
    verdict("needs the force", body.needs_force());
    verdict("does not know its future", !body.time_of_travel(1.).has_value());
  }

  /** Counts drops that fall through. */
  class Sieve
  {
  public:
    void
    drop()
    {
      ++n_drops;
    }

    void
    register_totals(RunTotals &totals)
    {
      // begin: a counter
      totals.count("drop_count", n_drops);
      // end: a counter
    }

  private:
    unsigned long n_drops = 0;
  };

  void
  check_counter()
  {
    Sieve     sieve;
    RunTotals totals;
    sieve.register_totals(totals);
    for (int i = 0; i < 3; ++i)
      sieve.drop();
    const NamedNumbers counts = totals.counts();
    std::printf("%s %g\n", counts[0].first.c_str(), counts[0].second);
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_shape();
  check_motion();
  check_counter();
}
