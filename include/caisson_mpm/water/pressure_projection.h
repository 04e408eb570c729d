// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Pore pressure and motion of the soil together, in time:
//   rho dv/dt = div sigma' - grad p + rho g,   div v = div(k / gamma_w grad p).
//
// Each step predicts the velocity with a pressure p_kept, and projects it
// (Chorin 1968, doi:10.1090/S0025-5718-1968-0242392-2):
//   (k / gamma_w + dt / rho) grad N . grad p =
//       -N div v* + dt / rho grad N . grad p_kept,
// integrated over the soil below the mudline, with the density rho that mass
// scaling has made larger. p_kept is the old pressure without a share of its
// oscillation from node to node. See doc/theory.md, section 16.
#ifndef caisson_mpm_water_pressure_projection_h
#define caisson_mpm_water_pressure_projection_h

#include <caisson_mpm/water/cell_integrals.h>

#include <vector>

namespace CaissonMPM
{
  /** What the soil of a cell is to the water. */
  struct WaterProperties
  {
    Conductance  mobility;             // k / gamma_w, m4/(N s)
    double       specific_volume = 0.; // 1 / rho, m3/kg
    unsigned int layer           = 0;  // where the permeability may jump
  };

  /** The pressures that are known: at the mudline of the plug, and at an open
   * bottom. Elsewhere that of the open water is 0. Units: Pa. */
  struct KnownPressures
  {
    double plug = 0., bottom = 0.;
  };

  /**
   * Owns the pressure, which a step takes over from the one before. All
   * functions are collective.
   */
  class PressureProjection
  {
  public:
    /** Set up what knows the nodes of this rank; the pressure becomes zero. */
    void
    initialize(const BackgroundGrid &grid, const unsigned int n_layers);

    /** Find the equations at the start of a step. @p properties [n_cells] are
     * read of the cells of this rank. */
    void
    set_up(const BackgroundGrid               &grid,
           const Mudline                      &mudline,
           const std::vector<WaterProperties> &properties,
           const PressureSolver::OpenSides    &sides,
           const double                        dt);

    /**
     * Find the kept() pressure: the present one, less the share @p smoothing of
     * its oscillation. At each unknown node this is what the gradient in the
     * cells drives out, less what the mean gradient at the nodes would, in
     * pressure of this node alone. Each layer has gradients of its own, so that
     * it is zero for pressures that are linear in each layer.
     */
    void
    find_kept(const double smoothing);

    /** The pressure with which the step predicts. [n_nodes], Pa */
    const NodalData &
    kept() const
    {
      return kept_;
    }

    /**
     * Solve for the pressure. @p velocity [n_nodes] is predicted with the
     * kept() pressure and held to all constraints, and cells at @p corners of
     * the body see it as these say. What the solver leaves of an equation is
     * made good in the next step. Throws RunFailure where it does not converge.
     */
    void
    solve(const Kernels::NodalVector             *velocity,
          const std::vector<Kernels::CornerView> &corners,
          const KnownPressures                   &known);

    /**
     * Find the rate of volume change of the cells of this rank, as the pressure
     * sees it: the mean over the cell of what the nodes have. A volume change
     * that alternates from cell to cell meets no pressure, and must not strain
     * the soil.
     */
    void
    find_volume_rates(const Kernels::NodalVector             *velocity,
                      const std::vector<Kernels::CornerView> &corners);

    /** These rates, and NaN in cells without water. [n_cells], 1/s */
    const std::vector<double> &
    volume_rates() const
    {
      return volume_rates_;
    }

    /** The pressure, of all nodes that this rank knows. [n_nodes], Pa */
    const NodalData &
    pressure() const
    {
      return pressure_;
    }
    NodalData &
    pressure()
    {
      return pressure_;
    }

    /** What the solver left of the equations at unknown nodes, which the next
     * step begins with as with the pressure. [n_nodes], m3 per radian */
    NodalData &
    remainder()
    {
      return remainder_;
    }

    /** The water that leaves the soil at each node. [n_nodes], m3/s per radian
     */
    const NodalData &
    outflow() const
    {
      return outflow_;
    }

    /** Find what the gradient of the pressure drives out at each node: the
     * outflow() less what the soil around the node gives off. [n_nodes], m3/s
     * per radian */
    void
    find_flux(NodalData &flux) const;

    const PressureSolver &
    solver() const
    {
      return solver_;
    }

  private:
    /** What the equations of a cell were found for. */
    struct Shape
    {
      double          width = 0., left = 0., heights[2], rise = 0.;
      double          filled = 0.;
      WaterProperties properties;
    };
    using Divergence = std::array<std::array<double, 4>, 8>;
    struct Gradient
    {
      std::array<std::array<double, 4>, 2> mean;
      std::array<double, 4>                volumes;
      double                               specific_volume = 0.;
      unsigned int                         layer           = 0;
    };
    /** Find the equations of a cell whose shape or soil has changed. */
    void
    find_equations(const unsigned int           cell,
                   const Kernels::CellGeometry &geometry,
                   const double                 filled,
                   const WaterProperties       &properties);
    /** to_I = sum_J K_IJ p_J with these matrices of the cells. */
    void
    find_product(const std::vector<PressureSolver::CellMatrix> &matrices,
                 const NodalData                               &p,
                 NodalData                                     &to) const;
    /** Let @p add put in what each cell gives to the nodes, and add it up. */
    template <typename Action>
    void
    sum_cells(NodalData         &to,
              const unsigned int n_components,
              const Action      &add) const;
    /** Add what cells gave to hanging nodes and to nodes of other ranks. */
    void
    add_up(NodalData &of_cells, const unsigned int n_components) const;
    /** Find the mean gradient of the pressure at each node in each layer. */
    void
    find_gradient();
    /** Find the volume and the stiffness of each node, and what a uniform
     * pressure does. */
    void
    find_volumes();
    void
    find_uniform();
    /** Let the equations at unknown nodes add up to zero. */
    void
    close_balance();
    /** to_I = int N_I div v. */
    void
    find_divergence(const Kernels::NodalVector             *velocity,
                    const std::vector<Kernels::CornerView> &corners,
                    NodalData                              &to) const;

    const BackgroundGrid *grid = nullptr;
    PressureSolver        solver_;
    // Each in an array of its own, because a step reads one after the other.
    // [n_cells]
    std::vector<Shape>                      shapes;
    std::vector<PressureSolver::CellMatrix> flow, inertia;
    std::vector<Divergence>                 divergence;
    std::vector<Gradient>                   gradients;
    std::vector<char>                       has_water;
    std::vector<double>                     volume_rates_;
    double       scale = 1., step = 0., step_before = 0.;
    NodalData    pressure_, kept_, outflow_, remainder_, source, rate;
    unsigned int n_layers = 1;
    // the volumes of the layers at a node, and the diagonal of the inertia
    NodalData of_nodes; // [n_nodes][n_layers + 1]
    NodalData gradient; // [n_nodes][n_layers][2]
    // 1 at unknown nodes; K times it, and the sum of that
    NodalData uniform, of_uniform;
    double    conductance = 0.;
  };
} // namespace CaissonMPM

#endif
