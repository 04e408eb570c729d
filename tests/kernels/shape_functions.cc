// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The map and the shape functions of distorted cells, against deal.II's
// FE_Q<2>(1) under MappingQ1.
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>

#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "../shared/verdict.h"
#include "kernel_cell.h"

/** deal.II's cell of this geometry. */
void
make_cell(const CellGeometry &g, dealii::Triangulation<2> &triangulation)
{
  std::vector<dealii::Point<2>> v;
  v.emplace_back(g.left, g.bottom_left);
  v.emplace_back(g.left + g.width, g.bottom_right);
  v.emplace_back(g.left, g.bottom_left + g.height_left);
  v.emplace_back(g.left + g.width, g.bottom_right + g.height_right);
  dealii::CellData<2> cell;
  cell.vertices = {0, 1, 2, 3};
  triangulation.create_triangulation(v, {cell}, dealii::SubCellData());
}



void
check_shape_functions()
{
  double map = 0., value = 0., grad = 0., volume = 0.;
  for (unsigned int k = 0; k < 50; ++k)
    {
      const CellGeometry       g = {uniform(0., 3.),
                                    uniform(.1, 2.),
                                    uniform(-1., 1.),
                                    uniform(-1., 1.),
                                    uniform(.2, 2.),
                                    uniform(.2, 2.)};
      dealii::Triangulation<2> triangulation;
      make_cell(g, triangulation);
      const dealii::FE_Q<2> fe(1);
      dealii::DoFHandler<2> dofs(triangulation);
      dofs.distribute_dofs(fe);
      const dealii::MappingQ1<2> mapping;
      const dealii::Point<2>     unit(uniform(0., 1.), uniform(0., 1.));
      dealii::FEValues<2>        at_point(mapping,
                                   fe,
                                   dealii::Quadrature<2>(unit),
                                   dealii::update_values |
                                     dealii::update_gradients |
                                     dealii::update_quadrature_points);
      dealii::FEValues<2>        integral(mapping,
                                   fe,
                                   dealii::QGauss<2>(3),
                                   dealii::update_JxW_values |
                                     dealii::update_quadrature_points);
      at_point.reinit(dofs.begin_active());
      integral.reinit(dofs.begin_active());
      const dealii::Point<2>   x = at_point.quadrature_point(0);
      const LocalPoint<Scalar> p =
        CellMap<>(g).at_position(Scalar(x[0]), Scalar(x[1]));
      map = std::max(
        {map, std::abs(p.xi[0] - unit[0]), std::abs(p.eta[0] - unit[1])});
      const Shape shape(g, x[0], x[1]);
      for (unsigned int i = 0; i < 4; ++i)
        {
          value =
            std::max(value,
                     std::abs(shape.value[i] - at_point.shape_value(i, 0)));
          const auto exact = at_point.shape_grad(i, 0);
          grad             = std::max({grad,
                                       std::abs(shape.d_dr[i] - exact[0]),
                                       std::abs(shape.d_dz[i] - exact[1])});
        }
      double exact = 0.;
      for (unsigned int q = 0; q < 9; ++q)
        exact += integral.JxW(q) * integral.quadrature_point(q)[0];
      volume = std::max(volume, std::abs(CellMap<>(g).volume(1.) - exact));
    }
  verdict("inverse map error", map, 1e-12);
  verdict("shape value error", value, 1e-12);
  verdict("shape gradient error", grad, 1e-10);
  verdict("volume error", volume, 1e-12);
}



int
main(int, char **)
{
  heading("shape functions");
  check_shape_functions();
  return 0;
}
