// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The shape, the motion, the nodal force and the counter that doc/extending.md
// adds.
#include <caisson_mpm/base/run_totals.h>
#include <caisson_mpm/kernels/dispatch.h>
#include <caisson_mpm/kernels/layout.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <cstdio>

#include "../shared/scene.h"
#include "sinking.h"
#include "slab.h"
#include "updraft.h"

using dealii::ParameterAcceptor;

namespace
{
  void
  expect(const char *what, const bool holds)
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
    expect("extent",
           slab.left() == 0. && slab.right() == 2. && slab.bottom() == 0. &&
             slab.top() == .5);
    expect("width of cells", slab.cell_width() == .25);
    const Slab::Point inside(1., .2), below(1., -.2);
    expect("contains", slab.contains(inside, 0.) && !slab.contains(below, 0.));
    expect("contains after a travel",
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
    expect("velocity of the fall", std::abs(body.velocity() - .981) < 1e-12);
    expect("travel of the fall", std::abs(body.travel() - .04905) < 1e-4);
    for (int i = 0; i < 1000; ++i)
      body.advance(1e-4, -2. * 9810.);
    expect("at rest", std::abs(body.velocity()) < 1e-12);
    expect("needs the force", body.traits.needs_force);
    expect("does not know its future", !body.time_of_travel(1.).has_value());
  }

  /** The forces on all nodes make the force on the volume of the soil. */
  void
  check_force()
  {
    Scene s("subsection Grid\nset Outer radius = 2\nset Bottom = -3\n"
            "set Top = 1\nend\n");
    s.generator.generate(s.grid, s.body.shape(), s.soil, s.points);
    Updraft updraft;
    ParameterAcceptor::declare_all_parameters();
    expect("does not act by itself", !updraft.is_active());
    ParameterAcceptor::prm.parse_input_from_string(
      "subsection Loads\nset Updraft = 100\nend\n");
    ParameterAcceptor::parse_all_parameters();

    std::vector<Kernels::NodalSums> nodes(s.grid.n_nodes());
    const Kernels::StepContext      step = {};
    updraft.collect(
      {*Kernels::select_kernels("auto"), step, s.points, s.grid, 0.},
      nodes.data());
    double force = 0.;
    for (const auto &node : nodes)
      force += node.force[1];
    // a cylinder of 2 m radius and 3 m height, per radian
    expect("sum of the forces", std::abs(force / 600. - 1.) < 1e-12);
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
  check_force();
  check_counter();
  return 0;
}
