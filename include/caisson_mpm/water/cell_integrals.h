// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Integrals over one cell for the equations of the pore water, with 2 x 2 Gauss
// points, per radian (per meter in plane strain).
#ifndef caisson_mpm_water_cell_integrals_h
#define caisson_mpm_water_cell_integrals_h

#include <caisson_mpm/kernels/cells.h>
#include <caisson_mpm/water/pressure_solver.h>

#include <array>

namespace CaissonMPM
{
  /** A property of a cell in r and z. */
  struct Conductance
  {
    double horizontal = 0., vertical = 0.;
  };

  /** Shape functions and gradients at the Gauss points of a cell. */
  class CellIntegrals
  {
  public:
    /** @p axisymmetric: 1, or 0 in plane strain. */
    CellIntegrals(const Kernels::CellGeometry &geometry,
                  const double                 axisymmetric);

    /** int c_r dN_i/dr dN_j/dr + c_z dN_i/dz dN_j/dz. */
    PressureSolver::CellMatrix
    stiffness(const Conductance &c) const;

    /** int div v for the nodal velocities v_r and v_z in turn. */
    std::array<double, 8>
    divergence() const;

    /** int N_j. */
    std::array<double, 4>
    shares() const;

    double
    volume() const;

  private:
    static constexpr unsigned int n_points = 4;

    struct GaussPoint
    {
      double weight, hoop; // of the volume; kappa / r
      double shape[4], gradient[4][2];
    };
    std::array<GaussPoint, n_points> points;
  };
} // namespace CaissonMPM

#endif
