// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Steady flow of the pore water:  div(k grad phi) = 0.
//
// phi is the share of the suction that has reached a place: 1 on the mudline of
// the plug, 0 on that outside, no flow through the body and the sides of the
// domain. With the suction s, the excess pore pressure is p = -s phi, and the
// water flows with k s / gamma_w grad phi.
#ifndef caisson_mpm_water_seepage_h
#define caisson_mpm_water_seepage_h

#include <caisson_mpm/water/cell_integrals.h>

#include <vector>

namespace CaissonMPM
{
  /**
   * Finds phi on the nodes of the grid. A cell that the mudline cuts is
   * replaced by its lower part: its vertical conductance is divided by the
   * filled share and its radial one multiplied with it. The solution then
   * changes continuously when the mudline moves through the mesh. All functions
   * are collective.
   */
  class Seepage
  {
  public:
    /** Set up what knows the nodes of this rank. */
    void
    initialize(const BackgroundGrid &grid);

    /**
     * Find the field, beginning with the last one. @p permeability [n_cells] in
     * m/s is read of the cells of this rank. Throws RunFailure where the solver
     * does not converge.
     */
    void
    solve(const BackgroundGrid            &grid,
          const Mudline                   &mudline,
          const std::vector<Conductance>  &permeability,
          const PressureSolver::OpenSides &sides);

    /** The field, of all nodes that this rank knows. [n_nodes] */
    const NodalData &
    field() const
    {
      return phi;
    }

    NodalData &
    field()
    {
      return phi;
    }

    /** int k grad phi grad N over the soil: what flows out of the soil at the
     * nodes of the plug, and minus what flows in at open ones. [n_nodes], m2/s
     * per radian */
    const NodalData &
    residual() const
    {
      return residual_;
    }

    const PressureSolver &
    solver() const
    {
      return solver_;
    }

  private:
    PressureSolver solver_;
    NodalData      phi, no_source, residual_; // [n_nodes]
  };

  /** Return the conductance of the lower part of a cell that the mudline cuts.
   */
  Conductance
  of_lower_part(const Conductance &c, const double filled);

  /** Return the largest conductance of the cells of all ranks. Collective. */
  double
  largest_conductance(const BackgroundGrid           &grid,
                      const std::vector<Conductance> &conductance);

  /** The upward hydraulic gradient at the mudline of the plug, at the wall and
   * at the axis. */
  struct ExitGradient
  {
    double wall = 0., axis = 0.;
  };

  /**
   * Return the exit gradient of the flow @p outflow [n_nodes] out of the nodes,
   * which is more accurate than the gradient in the cell below. The one at the
   * radius @p wall is the value there of the even parabola i = a + b d^2 that
   * fits the flow over the @p width beside it, with weights that fall to zero
   * with it: no water crosses the wall, so that the gradient is even in the
   * distance d, and single nodes, which change when the mudline crosses a row
   * of cells, hardly matter. Units: m; those of the flow, times radian, over
   * those of the permeability and m2. Collective.
   */
  ExitGradient
  exit_gradient(const BackgroundGrid           &grid,
                const Mudline                  &mudline,
                const std::vector<Conductance> &permeability,
                const NodalData                &outflow,
                const double                    wall,
                const double                    width);
} // namespace CaissonMPM

#endif
