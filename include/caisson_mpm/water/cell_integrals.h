// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Integrals over one cell for the equations of the pore water, with 2 x 2 Gauss
// points, per radian (per meter in plane strain); and the integral of a
// pressure over the tip of the body and the faces of steps and rings of its
// wall.
#ifndef caisson_mpm_water_cell_integrals_h
#define caisson_mpm_water_cell_integrals_h

#include <caisson_mpm/domain/background_grid.h>
#include <caisson_mpm/water/soil_columns.h>

#include <deal.II/base/mpi.h>

#include <deal.II/fe/fe_values.h>

#include <array>
#include <vector>

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

  /**
   * Integrates over the tip, or over the mantle of a cylinder. The pressure
   * under the lid acts on the area inside the tip, and on faces of rings and
   * steps within: these add what the soil at them has besides, less what it has
   * on faces that look up.
   */
  class TipIntegral
  {
  public:
    /** Find the cells of this rank at the tip; @p soil_columns knows the columns
     * below the body. Not collective. */
    void
    reinit(const BackgroundGrid &grid,
           const BodyShape      &shape,
           const SoilColumns    &soil_columns);

    /** Integrate value(cell, corner), which is @p in_plug in the water under
     * the lid, over the tip, and over the share(cell) of a step or ring that
     * soil covers. Collective. */
    template <typename Function, typename Share>
    void
    integrate(const BackgroundGrid &grid,
              const Function       &value,
              const double          in_plug,
              const Share          &share)
    {
      std::array<double, 3> sums = {{0., 0., 0.}};
      for (const Ledge &ledge : ledges)
        for (unsigned int i = 0; i < 2; ++i)
          sums[2] += share(ledge.cell) * ledge.areas[i] *
                     (value(ledge.cell, ledge.first_corner + i) -
                      (ledge.is_inside ? in_plug : 0.));
      for (const unsigned int cell : cells)
        {
          const auto area = areas_at_tip(grid, cell);
          for (unsigned int i = 0; i < 2; ++i)
            {
              sums[0] += area[i] * value(cell, of_cylinder ? 2 * i : 2 + i);
              sums[1] += area[i];
            }
        }
      dealii::Utilities::MPI::sum(
        dealii::ArrayView<const double>(sums.data(), sums.size()),
        grid.communicator(),
        dealii::ArrayView<double>(sums.data(), sums.size()));
      at_tip_ = grid.circumference() * sums[0];
      value_  = grid.circumference() * (sums[0] + sums[2]);
      area_   = grid.circumference() * sums[1];
    }

    /** The integral. Units: those of the integrand times m2. */
    double
    value() const
    {
      return value_;
    }

    /** The integral over the tip alone. */
    double
    at_tip() const
    {
      return at_tip_;
    }

    /** The area of the tip, looking down. Units: m2. */
    double
    area() const
    {
      return area_;
    }

  private:
    /** Return the areas that belong to the two corners of a cell at the tip.
     * Units: m2 per radian (m in plane strain). */
    std::array<double, 2>
    areas_at_tip(const BackgroundGrid &grid, const unsigned int cell) const;

    /** A cell of this rank below or above a face of a step or ring. */
    struct Ledge
    {
      unsigned int          cell, first_corner;
      bool                  is_inside; // the wall
      std::array<double, 2> areas;     // negative for a face that looks up
    };
    void
    find_ledges(const BackgroundGrid &grid,
                const BodyShape      &shape,
                const SoilColumns    &soil_columns);

    std::vector<unsigned int> cells;
    std::vector<Ledge>        ledges;
    bool                      of_cylinder = false;
    double                    value_ = 0., at_tip_ = 0., area_ = 0.;
  };
} // namespace CaissonMPM

#endif
