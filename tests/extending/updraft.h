// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A force per volume of soil that points upward, as that of a steady upward
// seepage: f_I += sum V_p N_I(x_p) j.
#ifndef caisson_mpm_operators_updraft_h
#define caisson_mpm_operators_updraft_h

#include <caisson_mpm/operators/nodal_force.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/patterns.h>

namespace CaissonMPM
{
  /** The nodal force of the entry "Loads/Updraft". */
  class Updraft : public NodalForce, public Section
  {
  public:
    Updraft()
      : Section("/Loads")
    {
      add_parameter("Updraft",
                    per_volume,
                    "N/m3",
                    "An upward force on each volume of soil.",
                    dealii::Patterns::Double(0.));
    }

    bool
    is_active() const override
    {
      return per_volume > 0.;
    }

  private:
    void
    add(const ForceContext &context, Kernels::NodalVector *force) override
    {
      const BackgroundGrid &grid = context.grid;
      context.points.for_each(
        [&](const MaterialPoint &p, const unsigned int cell) {
          const auto  x    = to_reference(grid.geometry(cell), p.position);
          const auto &node = grid.cell_nodes(cell).node;
          for (unsigned int i = 0; i < 4; ++i)
            force[node[i]].value[vertical] +=
              dealii::GeometryInfo<2>::d_linear_shape_function(x, i) *
              p.volume * per_volume;
        });
    }

    double per_volume = 0.;
  };
} // namespace CaissonMPM

#endif
