// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/kernels/cell_map.h>
#include <caisson_mpm/water/pressure_extremes.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <utility>

namespace CaissonMPM
{
  using namespace dealii;

  PressureExtremes::PressureExtremes(const WaterScene &scene)
    : scene(scene)
  {
    scene.totals.keep("has_warned_of_cavitation", has_warned);
  }

  void
  PressureExtremes::begin()
  {
    unit_weight = scene.soil.unit_weight_of_water();
    at_rest     = scene.settings.sea.cavitation(unit_weight, 0.);
    smallest = largest = 0.;
    lowest             = {{at_rest, 0., 0.}};
  }

  void
  PressureExtremes::include(const double pressure)
  {
    smallest = std::min(smallest, pressure);
    largest  = std::max(largest, pressure);
  }

  void
  PressureExtremes::include_at(const double pressure,
                               const double r,
                               const double z)
  {
    lowest = std::min(lowest, {{at_rest - unit_weight * z + pressure, r, z}});
  }

  void
  PressureExtremes::include_in(const double                 pressure,
                               const Kernels::CellGeometry &cell)
  {
    const Kernels::CellMap<> map(cell);
    include_at(pressure, map.left + .5 * map.width, map.center_z());
  }

  void
  PressureExtremes::end()
  {
    const MPI_Comm communicator = scene.grid.communicator();
    smallest                    = Utilities::MPI::min(smallest, communicator);
    largest                     = Utilities::MPI::max(largest, communicator);
    for (const auto &of_rank : Utilities::MPI::all_gather(communicator, lowest))
      lowest = std::min(lowest, of_rank);
  }

  NamedNumbers
  PressureExtremes::columns() const
  {
    return {{"pore_pressure_smallest_Pa", smallest},
            {"pore_pressure_largest_Pa", largest},
            {"cavitation_margin_Pa", lowest[0]}};
  }

  void
  PressureExtremes::warn(const double              time,
                         const std::string        &place,
                         std::vector<std::string> &warnings)
  {
    if (lowest[0] >= 0. || std::exchange(has_warned, true))
      return;
    warnings.push_back(
      "the pore water falls below its vapor pressure at t = " +
      to_text(time, 5) + " s" + place + ", first at r = " +
      to_text(lowest[1], 4) + " m, z = " + to_text(lowest[2], 4) +
      " m. It would boil there (cavitation), which the program does not "
      "compute: from here on, soil that is drawn apart or dilates carries "
      "more suction than water can, and its resistance is too large. "
      "Check Water/Water depth; see cavitation_margin_Pa in history.csv");
  }
} // namespace CaissonMPM
