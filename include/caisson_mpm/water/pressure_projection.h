// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Pore pressure and motion of the soil together, in time:
//   rho dv/dt = div sigma' - grad p + rho g,   div v = div(k / gamma_w grad p),
// with one pressure in each cell. Each step predicts the velocity with the old
// pressure p', and projects it (Chorin 1968,
// doi:10.1090/S0025-5718-1968-0242392-2):
//   int_c div v* + sum_f (F_f + dt I_f) (p_c - p_f) = dt sum_f I_f (p'_c -
//   p'_f)
// over the faces of the cell c below the mudline. A face of the area A between
// centers at the distance d has F = k / gamma_w A / d and I = A / (rho d), with
// the density rho that mass scaling has made larger. See doc/theory.md, section
// 16.
#ifndef caisson_mpm_water_pressure_projection_h
#define caisson_mpm_water_pressure_projection_h

#include <caisson_mpm/base/run_totals.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/water/cell_integrals.h>
#include <caisson_mpm/water/cell_pressure_solver.h>

#include <optional>
#include <vector>

namespace CaissonMPM
{
  /** What the soil of a cell is to the water. */
  struct WaterProperties
  {
    Conductance mobility;             // k / gamma_w, m4/(N s)
    double      specific_volume = 0.; // 1 / rho, m3/kg
  };

  /**
   * Owns the pressure, which a step takes over from the one before. All
   * functions are collective but where it says so.
   */
  class PressureProjection
  {
  public:
    /** Set up what knows the cells of this rank; the pressure becomes zero. */
    void
    initialize(const BackgroundGrid &grid);

    void
    register_totals(RunTotals &totals);

    /** Take the known pressures of the step before from another run. */
    void
    begin_with(const KnownPressures &known)
    {
      known_ = known;
    }

    /** Find the equations at the start of a step. @p properties [n_cells] are
     * read of the cells of this rank. */
    void
    set_up(const BackgroundGrid               &grid,
           const SoilColumns                  &soil_columns,
           const std::vector<WaterProperties> &properties,
           const OpenSides                    &sides,
           const BoundaryConditions           &conditions,
           const double                        dt);

    /**
     * Solve for the pressure. @p velocity [n_nodes] is predicted with the
     * present one and held to all constraints, and cells at @p corners of the
     * body see it as these say. The pressure accelerates the @p mass of the
     * nodes [n_nodes], kg per radian. What the solver leaves of an equation is
     * made good in the next step. Throws RunFailure where it does not converge.
     */
    void
    solve(const Kernels::NodalVector             *velocity,
          const std::vector<Kernels::CornerView> &corners,
          const std::vector<double>              &mass,
          const KnownPressures                   &known);

    /** Add the force of the pressure to @p force [n_nodes]: that of the water
     * in the soil and above it, less what the body bears. A uniform pressure
     * has none. Not collective. Units: N per radian. */
    void
    add_force(Kernels::NodalVector *force) const;

    /** Return what a cell of this rank adds to the force at a corner. */
    Vector2
    force_at(const unsigned int cell, const unsigned int corner) const
    {
      Vector2 force;
      for (unsigned int d = 0; d < 2; ++d)
        force[d] = acting[cell] * force_of[cell][2 * corner + d];
      return force;
    }

    /** Return the mean rate of volume change of the cells of this rank, NaN
     * where there is no water. [n_cells], 1/s. Not collective. */
    const std::vector<double> &
    find_volume_rates(const Kernels::NodalVector             *velocity,
                      const std::vector<Kernels::CornerView> &corners);

    /** The pressure, at CellPressureSolver::place(). Units: Pa. */
    CellData &
    pressure()
    {
      return pressure_;
    }
    /** Return that of a cell that this rank knows. */
    double
    pressure_in(const unsigned int cell) const
    {
      return pressure_.local_element(solver_.place(cell));
    }

    /** What the solver left of the equations, which the next step begins with
     * as with the pressure. Units: m3 per radian. */
    CellData &
    remainder()
    {
      return remainder_;
    }

    /** 1 where a cell had water in the last step, else 0, and -1 before the
     * first: cells that soil enters begin with the pressure of the free water.
     */
    CellData &
    wet_cells()
    {
      return wet_;
    }

    /** Return the pressure at the nodes: the known one where there is one, else
     * that through which as much flows in as out. [n_nodes], Pa */
    const NodalData &
    find_nodal_pressure();

    /** Return the pressure that is known at a node, if it is. */
    std::optional<double>
    known_at(const unsigned int node) const;

    /** Return the water that leaves the soil at the nodes of open faces.
     * [n_nodes], m3/s per radian */
    const NodalData &
    find_outflow();

    /** What flows out of the plug and in everywhere else, and what the solver
     * left of all equations, in the last step. Units: m3/s. */
    struct Flow
    {
      double out = 0., in = 0., left = 0.;
    };
    const Flow &
    flow() const
    {
      return flow_;
    }

    /** By how much more volume would leave the plug in the next step, over the
     * suction: by seepage and by acceleration. Units: m3/(s Pa). */
    double
    conductance_of_plug() const
    {
      return plug_conductance;
    }

    const CellPressureSolver &
    solver() const
    {
      return solver_;
    }

  private:
    using OfCorners = std::array<double, 8>; // r and z in turn
    /** What is known at the nodes, [n_nodes]. */
    struct AtNodes
    {
      std::vector<Beyond> beyond; // cell: no pressure is known
      NodalData           outflow, pressure, conductance;
      NodalData           volume;          // m3 per radian, 0 at the mudline
      NodalData           specific_volume; // m3/kg
    };
    /** Find the integrals over a cell whose shape has changed. */
    void
    find_integrals(const unsigned int cell, CellIntegrals &integrals);
    void
    find_conductances(const std::vector<WaterProperties> &properties);
    /** Find how much volume below the mudline belongs to each node.
     * Collective. */
    void
    find_volume_of_nodes();
    /** Raise I of faces whose nodes have so little @p mass, as at a gap in the
     * soil, that the step would be unstable. Points change that mass at once
     * where they enter an empty cell, so that each step does this.
     * Collective. */
    void
    raise_inertia(const std::vector<double> &mass);
    /** Sum those of the open faces. Collective. */
    void
    sum_open_conductances();
    /** Begin with the pressure of the free water in cells that soil enters. */
    void
    begin_in_new_cells();
    /** Return the pressure of the free water above a cell. */
    double
    pressure_above(const unsigned int cell) const;
    void
    subtract_pressure_of_body(const unsigned int cell, OfCorners &of) const;
    /** Find the pressure of each cell with that of the free water in it. */
    void
    find_acting();
    /** Compute the right side of the equations per cell, with the known
     * pressures of the step @p before. m3/s per radian */
    void
    compute_source(const KnownPressures &before);
    /** What the solver left of each equation is small, but adds up. Shift all
     * pressures by the one value whose flow through the open faces takes the
     * sum
     * of it away, from @p left_now, too. Collective. */
    void
    shift_pressures(CellData &left_now);
    /** Find flow(), with what the solver left of the equations. */
    void
    find_flow(const CellData &left_now);
    /** Find the lower faces of hardly filled cells. */
    void
    find_faces_below();
    /** Return what leaves through a side: that of a hardly filled cell, whose
     * own pressure hardly differs from that above it, comes from the cell
     * below. m3/s per radian */
    double
    outflow_through(const std::size_t side) const;

    const BackgroundGrid *grid         = nullptr;
    const SoilColumns    *soil_columns = nullptr;
    CellPressureSolver    solver_;
    double                step = 0., long_step = 0., scale = 1.;
    Flow                  flow_;
    KnownPressures        known_;
    // [n_cells]: the shape for which there are the integrals, int div N_j, the
    // same less the faces of the body, int N_j, the volume
    std::vector<Kernels::CellGeometry> shapes;
    std::vector<std::array<double, 4>> shares;
    std::vector<OfCorners>             divergence, force_of;
    std::vector<double>                volumes, acting, volume_rates_;
    // [n_faces]
    std::vector<double> seepage, inertia, inertia_of_soil, steepness;
    std::vector<std::array<int, 2>> faces_below; // -1: none, as at most faces
    double   open_conductance = 0., plug_conductance = 0.;
    CellData pressure_, remainder_, wet_, source, mobility[2], inverse_density;
    AtNodes  at_nodes;
  };
} // namespace CaissonMPM

#endif
