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

  // ------------------------------------------------------------ the tip

  void
  TipIntegral::reinit(const BackgroundGrid &grid,
                      const BodyShape      &shape,
                      const SoilColumns    &soil_columns)
  {
    cells.clear();
    of_cylinder = shape.expands();
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      {
        const int beyond = grid.neighbor(cell, of_cylinder ? 0 : 3);
        if (grid.is_owned(cell) && !grid.is_rigid(cell) && beyond >= 0 &&
            grid.is_rigid(beyond) &&
            (of_cylinder ||
             soil_columns.side_of(cell) == SoilColumns::Side::body))
          cells.push_back(cell);
      }
    ledges.clear();
    if (shape.n_parts() > 1)
      find_ledges(grid, shape, soil_columns);
  }

  void
  TipIntegral::find_ledges(const BackgroundGrid &grid,
                           const BodyShape      &shape,
                           const SoilColumns    &soil_columns)
  {
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      {
        if (!grid.is_owned(cell) || grid.is_rigid(cell) ||
            soil_columns.side_of(cell) == SoilColumns::Side::body)
          continue;
        const bool is_inside =
          soil_columns.side_of(cell) == SoilColumns::Side::plug;
        const int above = grid.neighbor(cell, 3),
                  below = grid.neighbor(cell, 2);
        const auto areas =
          areas_of_side(grid.geometry(cell), grid.axisymmetric());
        if (above >= 0 && grid.is_rigid(above) && !grid.is_lid(above))
          ledges.push_back({cell, 2, is_inside, areas});
        // not what is above the body
        const auto start =
          grid.lines().initial_geometry(grid.global_number(cell));
        if (below >= 0 && grid.is_rigid(below) &&
            start.bottom_left < shape.top() - 1e-9)
          ledges.push_back({cell, 0, is_inside, {{-areas[0], -areas[1]}}});
      }
  }

  std::array<double, 2>
  TipIntegral::areas_at_tip(const BackgroundGrid &grid,
                            const unsigned int    cell) const
  {
    const Kernels::CellGeometry &g        = grid.geometry(cell);
    const bool                   is_round = grid.axisymmetric();
    if (!of_cylinder)
      return areas_of_side(g, is_round);
    const double half = .5 * (is_round ? g.left : 1.) * g.height_left;
    return {{half, half}};
  }
} // namespace CaissonMPM
