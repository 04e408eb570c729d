// SPDX-License-Identifier: LGPL-2.1-or-later
//
// F and I of the faces.
#include <caisson_mpm/domain/cell_geometry.h>
#include <caisson_mpm/water/pressure_projection.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    /** Return how steep the middle of a cell rises or falls. */
    double
    slope_of(const Kernels::CellGeometry &g)
    {
      const double rise = g.bottom_right + .5 * g.height_right - g.bottom_left -
                          .5 * g.height_left;
      return std::abs(rise) / g.width;
    }

    /** Return the factor of I on inclined rows, where differences along and
     * across the row act together. */
    double
    factor_of_slope(const CellPressureSolver::Face &face,
                    const BackgroundGrid           &grid)
    {
      const double s = std::max(slope_of(grid.geometry(face.cell)),
                                slope_of(grid.geometry(face.other)));
      return (1. + s / std::sqrt(1. + s * s)) *
             (face.is_horizontal ? 1. + s * s : 1.);
    }
  } // namespace

  void
  PressureProjection::find_conductances(
    const std::vector<WaterProperties> &properties)
  {
    // 1. Mobility k / gamma_w and specific volume 1 / rho of the cells, also of
    //    those of other ranks across a face.
    for (CellData *v : {&mobility[0], &mobility[1], &inverse_density})
      v->zero_out_ghost_values();
    for (const unsigned int cell : solver_.cells())
      {
        const unsigned int i             = solver_.place(cell);
        mobility[0].local_element(i)     = properties[cell].mobility.horizontal;
        mobility[1].local_element(i)     = properties[cell].mobility.vertical;
        inverse_density.local_element(i) = properties[cell].specific_volume;
      }
    for (CellData *v : {&mobility[0], &mobility[1], &inverse_density})
      v->update_ghost_values();

    // 2. Through a face of the area A between centers at the distances a and b:
    //    F = A / (a gamma_w / k_a + b gamma_w / k_b), as the resistances of
    //    both halves add up, and the same with the density, I = A / (a rho_a +
    //    b rho_b).
    const auto through = [](const CellPressureSolver::Face &face,
                            const CellData                 &property) {
      const double a     = property.local_element(face.place),
                   b     = property.local_element(face.other_place);
      const double per_a = face.distance / a, per_b = face.other_distance / b;
      return face.area / (per_a + per_b);
    };
    const auto &faces = solver_.faces();
    seepage.resize(faces.size());
    inertia.resize(faces.size());
    steepness.resize(faces.size());
    auto &conductances = solver_.conductances();
    conductances.resize(faces.size());
    double largest = 0.;
    for (std::size_t f = 0; f < faces.size(); ++f)
      {
        seepage[f]   = faces[f].is_open ?
                         through(faces[f], mobility[faces[f].is_horizontal]) :
                         0.;
        steepness[f] = factor_of_slope(faces[f], *grid);
        inertia[f]   = faces[f].free_share * steepness[f] *
                     through(faces[f], inverse_density);
        conductances[f] = seepage[f] + long_step * inertia[f];
        largest         = std::max(largest, conductances[f]);
      }
    inertia_of_soil = inertia;
    // 3. The solver gets F + dt I over the largest of them.
    find_faces_below();
    scale = Utilities::MPI::max(largest, grid->communicator());
    sum_open_conductances();
    for (double &g : conductances)
      g /= scale;
  }

  void
  PressureProjection::find_volume_of_nodes()
  {
    NodalData &v = at_nodes.volume;
    v            = 0.;
    // the soil of a cell that the mudline cuts is in its lower part
    for (const unsigned int cell : solver_.cells())
      {
        const double x = soil_columns->filled()[cell];
        for (unsigned int j = 0; j < 4; ++j)
          v.local_element(grid->cell_nodes(cell).node[j]) +=
            (j < 2 ? x * (2. - x) : x * x) * shares[cell][j];
      }
    grid->hanging_nodes().distribute(v, 1);
    v.compress(VectorOperation::add);
    // the mass of a node at the mudline is that of few points, however the
    // soil lies there, and share_of_own() takes care of it
    for (unsigned int cell = 0; cell < grid->n_cells(); ++cell)
      if (soil_columns->filled()[cell] > 0. && soil_columns->is_top(cell))
        for (const unsigned int j : {2, 3})
          if (const unsigned int node = grid->cell_nodes(cell).node[j];
              node < grid->n_owned_nodes())
            v.local_element(node) = 0.;
  }

  void
  PressureProjection::raise_inertia(const std::vector<double> &mass)
  {
    // 1. volume over mass; a node without soil does not move
    NodalData &per_mass = at_nodes.specific_volume;
    for (unsigned int node = 0; node < grid->n_owned_nodes(); ++node)
      per_mass.local_element(node) =
        mass[node] > 0. ? at_nodes.volume.local_element(node) / mass[node] : 0.;
    per_mass.update_ghost_values();
    grid->hanging_nodes().interpolate(per_mass, 1);
    // 2. with A of the nodes of a face, the step is stable for
    //    A <= 4/3 I + 2/3 F / dt
    const auto &faces = solver_.faces();
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (const auto &face = faces[f]; face.beyond == Beyond::cell)
        {
          const double of_nodes = .5 *
                                  (per_mass.local_element(face.nodes[0]) +
                                   per_mass.local_element(face.nodes[1])) *
                                  steepness[f] * face.area /
                                  (face.distance + face.other_distance);
          inertia[f] = std::max(inertia_of_soil[f],
                                of_nodes - .5 * seepage[f] / long_step);
          solver_.conductances()[f] =
            (seepage[f] + long_step * inertia[f]) / scale;
        }
  }

  void
  PressureProjection::sum_open_conductances()
  {
    double      open = 0., of_plug = 0.;
    const auto &faces = solver_.faces();
    for (std::size_t f = 0; f < faces.size(); ++f)
      {
        const double conductance = seepage[f] + long_step * inertia[f];
        if (faces[f].beyond != Beyond::cell)
          open += conductance;
        // The cell below takes part where soil hardly fills that at the
        // surface.
        const double half = .5 * height_of(grid->geometry(faces[f].cell));
        if (faces[f].beyond == Beyond::plug)
          of_plug += conductance * std::min(1., faces[f].distance / half);
      }
    open_conductance = Utilities::MPI::sum(open, grid->communicator());
    plug_conductance = grid->circumference() *
                       Utilities::MPI::sum(of_plug, grid->communicator());
  }
} // namespace CaissonMPM
