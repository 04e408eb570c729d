// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Selective mass scaling: inertia for the deformation of a cell, and none for
// its translation (Olovsson, Simonsson & Unosson 2005).
//
// A cell whose points bring the masses m_i to its corners gets the inertia
//   L_c = (s - t) (diag(m_i) - m_i m_j / m_c),   m_c = sum_i m_i,
// with the factor s that its step needs and the factor t with which its points
// bring mass and momentum. L is symmetric and semidefinite, and L 1 = 0: a cell
// that moves as one has no more inertia than its points. With the lumped mass M
// of the points, (M + L) a = f gives the accelerations. The lumped mass of all
// of the inertia,
//   D = M + sum_c (s - t) diag(m_i),
// bounds it: the eigenvalues of D^-1 (M + L) lie between 1/s and 1.
//
// The solution is a polynomial of Chebyshev in D^-1 (M + L) times D^-1 f, from
// zero and with a fixed degree. So it is itself a symmetric mass: it creates no
// energy, and needs neither inner products nor a tolerance. Its error on
// [1/20, 1] is at most r = 1 / T_5(21/19); divided by 1 + r it makes no motion
// lighter than M + L. Motions below 1/20 get part of the inertia of D: those of
// many cells that move as one (doc/theory.md, section 12).
//
// Cells at the body and at the sides of the domain have t = s, since contact
// and supports see lumped masses; all others have t = 1.
#ifndef caisson_mpm_operators_selective_mass_h
#define caisson_mpm_operators_selective_mass_h

#include <caisson_mpm/domain/background_grid.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/nodal_data.h>

#include <array>
#include <vector>

namespace CaissonMPM
{
  /** Return the factors t of translation in the cells from the factors s
   * [n_cells]. Collective. */
  std::vector<double>
  factors_of_translation(const BackgroundGrid      &grid,
                         const std::vector<double> &factors);

  /** D of a node. Units: kg per radian. */
  double
  lumped_mass(const Kernels::NodalSums &node);

  /** Owns the cells with an inertia of their deformation, and the fields that
   * the solution needs. accelerate() is collective over MPI. */
  class SelectiveMass
  {
  public:
    /** Set up for the nodes that this rank knows. */
    void
    initialize(const BackgroundGrid &grid);

    /** Find the cells of a step from the factors s [n_cells], null where no
     * rank has any, and add their part of D to @p nodes. */
    void
    collect(const Kernels::StepContext &step,
            const double               *factors,
            Kernels::NodalSums         *nodes);

    /** Replace the velocities @p u = v + dt M^-1 f by v + dt a. */
    void
    accelerate(const Kernels::NodalSums   *nodes,
               const Kernels::NodalVector *v,
               Kernels::NodalVector       *u);

    /** Replace the velocities @p u = v + dt M^-1 (f + g) by v + dt (a + D^-1 g),
     * with the a and f of the step: of forces that answer to D. */
    void
    correct(const Kernels::NodalSums   *nodes,
            const Kernels::NodalVector *v,
            Kernels::NodalVector       *u);

    /** Return the work of the impulses that go into the inertia of deformation
     * in the last step, with the mean velocities @p v [n_nodes], of the first
     * @p n_owned nodes. Units: J per radian. */
    double
    work(const Kernels::NodalVector *v, const unsigned int n_owned) const;

    /** Set @p to to L @p from, whose hanging nodes follow their masters.
     * Collective. */
    void
    apply(NodalData &from, NodalData &to) const;

  private:
    /** Add the next term of the polynomial to the increment; @p rho is that of
     * the term before. Returns that of this one. Collective. */
    double
    add_term(const Kernels::NodalSums *nodes, const double rho);

    struct Cell
    {
      std::array<unsigned int, 4> node;
      std::array<double, 4>       mass; // (s - t) m_i
      double                      inverse_sum;
    };

    const HangingNodes       *hanging_nodes = nullptr;
    unsigned int              n_nodes       = 0;
    bool                      is_active     = false;
    std::vector<Cell>         cells;
    std::vector<unsigned int> coupled; // nodes of cells of any rank
    // dt a and what is withheld of the impulse dt f; memory of accelerate()
    NodalData increment, withheld, residual, direction, product;
  };
} // namespace CaissonMPM

#endif
