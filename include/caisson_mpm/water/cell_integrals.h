// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Integrals over one cell for the equations of the pore water, with 2 x 2 Gauss
// points, per radian (per meter in plane strain).
#ifndef caisson_mpm_water_cell_integrals_h
#define caisson_mpm_water_cell_integrals_h

#include <caisson_mpm/domain/background_grid.h>

#include <deal.II/fe/fe_values.h>

#include <array>

namespace CaissonMPM
{
  /** A property of a cell in r and z. */
  struct Conductance
  {
    double horizontal = 0., vertical = 0.;
  };

  /** A matrix of the corners of a cell, by rows. */
  using CellMatrix = std::array<double, 16>;

  /** The integrals over cells of the mesh where it is now. An object is for one
   * position of the mesh: deal.II keeps what it knows of a cell that has not
   * changed its shape from one cell to the next. */
  class CellIntegrals
  {
  public:
    explicit CellIntegrals(const BackgroundGrid &grid);

    void
    reinit(const unsigned int cell);

    /** int c_r dN_i/dr dN_j/dr + c_z dN_i/dz dN_j/dz. */
    CellMatrix
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
    /** The weight of a Gauss point, by the volume per radian. */
    double
    weight(const unsigned int q) const;

    const BackgroundGrid &grid;
    dealii::FEValues<2>   values;
  };
} // namespace CaissonMPM

#endif
