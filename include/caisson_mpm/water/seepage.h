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

#include <caisson_mpm/water/mudline.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <utility>
#include <vector>

namespace CaissonMPM
{
  /** The permeability of a cell. Units: m/s. */
  struct Permeability
  {
    double horizontal = 0., vertical = 0.;
  };

  /**
   * Solves for phi on the nodes of the grid, with FE_Q(1), conjugate gradients
   * and algebraic multigrid. A cell that the mudline cuts is replaced by its
   * lower part: its vertical conductance is divided by the filled share and its
   * radial one multiplied with it. The solution then changes continuously when
   * the mudline moves through the mesh. All functions are collective.
   */
  class Seepage
  {
  public:
    /** Set up what knows the nodes of this rank. */
    void
    initialize(const BackgroundGrid &grid);

    /** Which far sides of the domain keep the pressure of the open water. */
    struct FarSides
    {
      bool outer = false, bottom = false;
    };

    /**
     * Find the field, beginning with the last one. @p permeability [n_cells] is
     * read of the cells of this rank; the grid's vertices must be current.
     * Throws RunFailure where the solver does not converge.
     */
    void
    solve(const BackgroundGrid            &grid,
          const Mudline                   &mudline,
          const std::vector<Permeability> &permeability,
          const FarSides                  &drained);

    /** The field, of all nodes that this rank knows. [n_nodes] */
    const NodalData &
    field() const
    {
      return phi;
    }

    /** The iterations of the last solution. */
    unsigned int
    n_iterations() const
    {
      return n_iterations_;
    }

    /** Return the flow out of the mudline of the plug and into that outside (or
     * the far sides), for grad phi in place of a hydraulic gradient: times
     * s/gamma_w it is a volume per time. Units: m2/s on the circumference. */
    struct Flow
    {
      double out = 0., in = 0.;
    };
    Flow
    flow(const BackgroundGrid &grid) const;

    /** Return the upward component of grad phi at the mudline of the plug: at
     * the wall and at the axis. Units: 1/m. */
    struct ExitGradient
    {
      double wall = 0., axis = 0.;
    };
    ExitGradient
    exit_gradient(const BackgroundGrid            &grid,
                  const Mudline                   &mudline,
                  const std::vector<Permeability> &permeability) const;

  private:
    /** What is known of phi at a node. */
    enum State : int
    {
      no_water,
      unknown,
      zero,
      one
    };
    void
    find_states(const BackgroundGrid &grid,
                const Mudline        &mudline,
                const FarSides       &drained);
    double
    largest_permeability(const BackgroundGrid            &grid,
                         const std::vector<Permeability> &permeability) const;
    void
    find_conductances(const BackgroundGrid            &grid,
                      const Mudline                   &mudline,
                      const std::vector<Permeability> &permeability);
    void
    assemble(const BackgroundGrid &grid);
    /** Iterate with the present multigrid; return whether that converged. */
    bool
    iterate(const unsigned int max_iterations);
    void
    iterate();
    void
    find_residual(const BackgroundGrid &grid);
    /** Return the permeability times the area of the mudline of the plug that
     * belongs to each node. [n_nodes], m3/s per radian */
    NodalData
    conductivity_of_plug(const BackgroundGrid            &grid,
                         const Mudline                   &mudline,
                         const std::vector<Permeability> &permeability) const;

    dealii::AffineConstraints<double>         hanging, constraints;
    dealii::TrilinosWrappers::SparseMatrix    matrix;
    dealii::TrilinosWrappers::PreconditionAMG multigrid;
    unsigned int                              n_iterations_ = 0;
    unsigned int n_at_setup = 0; // of the multigrid, 0: there is none
    std::vector<dealii::types::global_dof_index> dof_of_node; // [n_nodes]
    // of the cells of this rank that have water, over the scale
    std::vector<std::pair<unsigned int, dealii::FullMatrix<double>>>
              conductances;
    double    scale = 1.;      // m/s
    NodalData phi, right_side; // [n_nodes]
    NodalData states;          // of State
    NodalData residual; // integral of k grad phi grad N over the soil, m2/s
  };
} // namespace CaissonMPM

#endif
