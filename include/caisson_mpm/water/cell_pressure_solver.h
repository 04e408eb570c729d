// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Linear equations for one pressure in each cell of the soil below the mudline.
// What passes a face follows from the pressures on both sides of it:
//   sum_f G_f (p_c - p_f) = q_c   for all cells c with water,
// with p_f of the cell beyond the face, or known at an open face.
#ifndef caisson_mpm_water_cell_pressure_solver_h
#define caisson_mpm_water_cell_pressure_solver_h

#include <caisson_mpm/operators/boundary_conditions.h>
#include <caisson_mpm/water/kept_multigrid.h>
#include <caisson_mpm/water/soil_columns.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_dgq.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <array>
#include <vector>

namespace CaissonMPM
{
  /** A number for each cell that a rank knows, at the place of the cell. */
  using CellData = dealii::LinearAlgebra::distributed::Vector<double>;

  /**
   * Finds the faces through which water passes, and solves with conjugate
   * gradients and algebraic multigrid. The matrix is applied face by face, and
   * assembled only to set the multigrid up; that of an earlier matrix is kept
   * as long as it serves. All functions are collective but where it says so.
   */
  class CellPressureSolver
  {
  public:
    struct Face
    {
      Beyond       beyond;
      bool         is_horizontal; // water passes in z
      unsigned int cell, other;   // other: the same cell at an open face
      unsigned int place, other_place;
      std::array<unsigned int, 2> nodes;
      bool                        is_open; // water passes
      double free_share; // of its nodes, which give way to pressure
      double area;       // m2 per radian
      double distance, other_distance; // from the centers, m
    };

    /** Set up what knows the cells of this rank. */
    void
    initialize(const BackgroundGrid &grid);

    /** Find cells with water and the faces, also those at sides of the domain
     * that are open or give way. Where two cells share a face, and
     * one of them belongs to another rank, both ranks know it. */
    void
    find_faces(const SoilColumns        &soil_columns,
               const OpenSides          &open,
               const BoundaryConditions &conditions);

    /** The cells of this rank with water. */
    const std::vector<unsigned int> &
    cells() const
    {
      return cells_;
    }
    const std::vector<Face> &
    faces() const
    {
      return faces_;
    }
    /** The place of a cell that this rank knows in CellData. */
    unsigned int
    place(const unsigned int cell) const
    {
      return places[cell];
    }
    void
    reinit(CellData &data) const
    {
      data.reinit(partitioner);
    }

    /** Return whether some pressure is known. */
    bool
    has_known_value() const
    {
      return is_known;
    }

    /** G of the faces [n_faces], to be filled before solve(). They should be of
     * order one. */
    std::vector<double> &
    conductances()
    {
      return conductances_;
    }

    /** Solve for @p p, which is the first guess. The residual becomes smaller
     * than @p accuracy times that of the guess; throws RunFailure where it does
     * not. */
    void
    solve(const CellData       &source,
          const KnownPressures &known,
          const double          accuracy,
          CellData             &p);

    /** What is left of the equations after solve(): q_c - sum_f G_f (p_c -
     * p_f). */
    const CellData &
    residual() const
    {
      return residual_;
    }

    /** to_c = sum_f G_f (p_c - p_f), with p_f = 0 at open faces, for
     * SolverCG. */
    void
    vmult(CellData &to, const CellData &from) const;

    unsigned int
    n_iterations() const
    {
      return multigrid.n_iterations();
    }

  private:
    using HeldNodes = std::array<std::vector<bool>, 2>; // by component
    void
    add_face(const Beyond       beyond,
             const unsigned int cell,
             const unsigned int other,
             const unsigned int face,
             const bool         is_open    = true,
             const double       free_share = 1.);
    /** Add those faces of a cell that are the surface or a side of the domain,
     * where they are open or give way. */
    void
    add_sides(const unsigned int cell,
              const SoilColumns &soil_columns,
              const OpenSides   &open,
              const HeldNodes   &held);
    /** Return the share of the nodes of a face that may move across it. */
    double
    free_nodes_of(const unsigned int cell,
                  const unsigned int face,
                  const HeldNodes   &held) const;
    void
    assemble();
    /** Subtract what passes the faces from @p to. */
    void
    subtract_flow(const CellData       &p,
                  const KnownPressures &known,
                  CellData             &to) const;

    const BackgroundGrid     *grid = nullptr;
    std::vector<unsigned int> places; // [n_cells]
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
    KeptMultigrid                                              multigrid;
    std::vector<unsigned int>                                  cells_;
    std::vector<Face>                                          faces_;
    const double       *filled   = nullptr; // [n_cells]
    bool                is_known = false;
    std::vector<double> conductances_; // [n_faces]
    std::vector<char>   has_water;     // [n_places]
    CellData            residual_, correction;
    mutable CellData    with_ghosts; // memory of vmult()
  };
} // namespace CaissonMPM

#endif
