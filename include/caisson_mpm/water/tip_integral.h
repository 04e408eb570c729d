// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The integral of a pressure over the tip of the body.
#ifndef caisson_mpm_water_tip_integral_h
#define caisson_mpm_water_tip_integral_h

#include <caisson_mpm/water/cell_integrals.h>

#include <deal.II/base/mpi.h>

#include <array>
#include <vector>

namespace CaissonMPM
{
  /** Integrates over the tip, or over the mantle of a cylinder. */
  class TipIntegral
  {
  public:
    /** Find the cells of this rank at the tip; @p mudline knows the columns
     * below the body. Not collective. */
    void
    reinit(const BackgroundGrid &grid,
           const BodyShape      &shape,
           const Mudline        &mudline);

    /** Integrate value(cell, corner). Collective. */
    template <typename Function>
    void
    integrate(const BackgroundGrid &grid, const Function &value)
    {
      std::array<double, 2> sums = {{0., 0.}};
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
      value_ = grid.circumference() * sums[0];
      area_  = grid.circumference() * sums[1];
    }

    /** The integral. Units: those of the integrand times m2. */
    double
    value() const
    {
      return value_;
    }

    /** The area, looking down. Units: m2. */
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

    std::vector<unsigned int> cells;
    bool                      of_cylinder = false;
    double                    value_ = 0., area_ = 0.;
  };
} // namespace CaissonMPM

#endif
