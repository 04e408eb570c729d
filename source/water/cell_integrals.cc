// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/water/cell_integrals.h>

#include <deal.II/base/quadrature_lib.h>

namespace CaissonMPM
{
  using namespace dealii;

  CellIntegrals::CellIntegrals(const BackgroundGrid &grid)
    : grid(grid)
    , values(grid.mapping(),
             grid.dof_handler().get_fe(),
             QGauss<2>(2),
             update_values | update_gradients | update_quadrature_points |
               update_JxW_values)
  {}

  void
  CellIntegrals::reinit(const unsigned int cell)
  {
    values.reinit(grid.cell_iterator(cell));
  }

  double
  CellIntegrals::weight(const unsigned int q) const
  {
    return values.JxW(q) *
           (grid.axisymmetric() ? values.quadrature_point(q)[radial] : 1.);
  }

  CellMatrix
  CellIntegrals::stiffness(const Conductance &c) const
  {
    CellMatrix result = {};
    for (const unsigned int q : values.quadrature_point_indices())
      for (const unsigned int i : values.dof_indices())
        for (const unsigned int j : values.dof_indices())
          {
            const auto a = values.shape_grad(i, q), b = values.shape_grad(j, q);
            result[4 * i + j] +=
              weight(q) * (c.horizontal * a[radial] * b[radial] +
                           c.vertical * a[vertical] * b[vertical]);
          }
    return result;
  }

  std::array<double, 8>
  CellIntegrals::divergence() const
  {
    std::array<double, 8> result = {};
    for (const unsigned int q : values.quadrature_point_indices())
      for (const unsigned int j : values.dof_indices())
        {
          const auto   gradient = values.shape_grad(j, q);
          const double hoop =
            grid.axisymmetric() ? 1. / values.quadrature_point(q)[radial] : 0.;
          result[2 * j] +=
            weight(q) * (gradient[radial] + hoop * values.shape_value(j, q));
          result[2 * j + 1] += weight(q) * gradient[vertical];
        }
    return result;
  }

  std::array<double, 4>
  CellIntegrals::shares() const
  {
    std::array<double, 4> result = {};
    for (const unsigned int q : values.quadrature_point_indices())
      for (const unsigned int j : values.dof_indices())
        result[j] += weight(q) * values.shape_value(j, q);
    return result;
  }

  double
  CellIntegrals::volume() const
  {
    double result = 0.;
    for (const unsigned int q : values.quadrature_point_indices())
      result += weight(q);
    return result;
  }
} // namespace CaissonMPM
