// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/water/plug_balance.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  using namespace dealii;

  PlugBalance::PlugBalance(const BackgroundGrid &grid,
                           const MaterialPoints &points,
                           const RigidBody      &body)
    : grid(grid)
    , points(points)
    , body(body)
  {}

  void
  PlugBalance::start()
  {
    has_started   = true;
    soil_at_start = find_soil();
  }

  PlugBalance::Soil
  PlugBalance::find_soil() const
  {
    const double radius = body.shape().left(), tip = -body.penetration();
    const auto   share_inside = [&](const MaterialPoint &p) {
      const double inside = radius - p.position[radial];
      if (p.position[vertical] > tip)
        return inside > 0. ? 1. : 0.;
      return std::clamp(.5 + inside / p.size[radial], 0., 1.);
    };
    Soil sum;
    for (const unsigned int cell : points.cells_with_points())
      if (grid.geometry(cell).left - grid.geometry(cell).width < radius)
        points.for_each_in(cell, [&](const MaterialPoint &p) {
          const double share = share_inside(p);
          sum.initial += share * p.initial_volume;
          sum.present += share * p.volume;
        });
    for (double *const value : {&sum.initial, &sum.present})
      *value =
        grid.circumference() * Utilities::MPI::sum(*value, grid.communicator());
    return sum;
  }

  NamedNumbers
  PlugBalance::columns(const double heave_volume) const
  {
    double inflow = 0., dilation = 0.;
    if (has_started)
      {
        const Soil now = find_soil();
        inflow         = now.initial - soil_at_start.initial;
        dilation       = now.present - soil_at_start.present - inflow;
      }
    const double largest =
      std::max({std::abs(heave_volume), std::abs(inflow), std::abs(dilation)});
    const double error = heave_volume - inflow - dilation;
    return {{"plug_heave_volume_m3", heave_volume},
            {"plug_inflow_m3", inflow},
            {"plug_dilation_m3", dilation},
            {"plug_balance_error", largest > 0. ? error / largest : 0.}};
  }

  void
  PlugBalance::register_totals(RunTotals &totals)
  {
    totals.carry("plug_has_started", has_started);
    totals.carry("plug_soil_at_start", soil_at_start.initial);
    totals.carry("plug_volume_at_start", soil_at_start.present);
  }
} // namespace CaissonMPM
