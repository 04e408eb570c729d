// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/kernels/cell_map.h>
#include <caisson_mpm/water/cell_integrals.h>

#include <cmath>

namespace CaissonMPM
{
  CellIntegrals::CellIntegrals(const Kernels::CellGeometry &geometry,
                               const double                 axisymmetric)
  {
    const Kernels::CellMap<> map(geometry);
    const double             low = .5 - std::sqrt(1. / 12.);
    for (unsigned int q = 0; q < n_points; ++q)
      {
        const double xi  = q % 2 == 0 ? low : 1. - low,
                     eta = q / 2 == 0 ? low : 1. - low;
        const auto   p   = map.at_reference(xi, eta);
        const double r   = map.left + map.width * xi;
        GaussPoint  &g   = points[q];
        g.weight = .25 * map.width * p.height * (axisymmetric > 0. ? r : 1.);
        g.hoop   = axisymmetric / (axisymmetric > 0. ? r : 1.);
        const double shape[4] = {(1. - xi) * (1. - eta),
                                 xi * (1. - eta),
                                 (1. - xi) * eta,
                                 xi * eta},
                     d_xi[4]  = {eta - 1., 1. - eta, -eta, eta},
                     d_eta[4] = {xi - 1., -xi, 1. - xi, xi};
        for (unsigned int i = 0; i < 4; ++i)
          {
            g.shape[i] = shape[i];
            g.gradient[i][0] =
              (d_xi[i] - d_eta[i] * p.slope) * map.inverse_width;
            g.gradient[i][1] = d_eta[i] * p.inverse_height;
          }
      }
  }

  PressureSolver::CellMatrix
  CellIntegrals::stiffness(const Conductance &c) const
  {
    PressureSolver::CellMatrix result = {};
    for (const GaussPoint &g : points)
      for (unsigned int i = 0; i < 4; ++i)
        for (unsigned int j = 0; j < 4; ++j)
          result[4 * i + j] +=
            g.weight * (c.horizontal * g.gradient[i][0] * g.gradient[j][0] +
                        c.vertical * g.gradient[i][1] * g.gradient[j][1]);
    return result;
  }

  std::array<double, 8>
  CellIntegrals::divergence() const
  {
    std::array<double, 8> result = {};
    for (const GaussPoint &g : points)
      for (unsigned int j = 0; j < 4; ++j)
        {
          result[2 * j] += g.weight * (g.gradient[j][0] + g.hoop * g.shape[j]);
          result[2 * j + 1] += g.weight * g.gradient[j][1];
        }
    return result;
  }

  std::array<double, 4>
  CellIntegrals::shares() const
  {
    std::array<double, 4> result = {};
    for (const GaussPoint &g : points)
      for (unsigned int j = 0; j < 4; ++j)
        result[j] += g.weight * g.shape[j];
    return result;
  }

  double
  CellIntegrals::volume() const
  {
    double result = 0.;
    for (const GaussPoint &g : points)
      result += g.weight;
    return result;
  }
} // namespace CaissonMPM
