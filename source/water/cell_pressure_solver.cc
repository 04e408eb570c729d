// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/domain/cell_geometry.h>
#include <caisson_mpm/water/cell_pressure_solver.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    // left, right, below, above
    constexpr unsigned int corners_of_face[4][2] = {{0, 2},
                                                    {1, 3},
                                                    {0, 1},
                                                    {2, 3}};
  } // namespace

  void
  CellPressureSolver::initialize(const BackgroundGrid &grid_of_run)
  {
    grid = &grid_of_run;
    partitioner =
      grid->triangulation().global_active_cell_index_partitioner().lock();
    const IndexSet &own = partitioner->locally_owned_range();
    IndexSet        all = own;
    all.add_indices(partitioner->ghost_indices());
    places.resize(grid->n_cells());
    for (unsigned int cell = 0; cell < grid->n_cells(); ++cell)
      places[cell] = partitioner->global_to_local(
        grid->cell_iterator(cell)->global_active_cell_index());
    for (CellData *v : {&residual_, &correction, &with_ghosts})
      reinit(*v);

    DynamicSparsityPattern pattern(all);
    for (unsigned int cell = 0; cell < grid->n_cells(); ++cell)
      {
        const auto row = partitioner->local_to_global(places[cell]);
        pattern.add(row, row);
        for (unsigned int face = 0; face < 4; ++face)
          for (const bool second : {false, true})
            {
              const int other = grid->neighbor(cell, face, second);
              if (other >= 0)
                pattern.add(row, partitioner->local_to_global(places[other]));
            }
      }
    multigrid.initialize(own, pattern, grid->communicator(), .02);
  }

  void
  CellPressureSolver::add_face(const Beyond       beyond,
                               const unsigned int cell,
                               const unsigned int other,
                               const unsigned int face,
                               const bool         is_open,
                               const double       free_share)
  {
    const auto  &a = grid->geometry(cell), &b = grid->geometry(other);
    const double height       = filled[cell] * height_of(a),
                 other_height = filled[other] * height_of(b);
    const bool  is_horizontal = face >= 2, is_side = beyond != Beyond::cell;
    const auto &narrow = a.width < b.width ? a : b;
    double      area   = is_horizontal ? narrow.width :
                         is_side       ? height :
                                         std::min(height, other_height);
    if (grid->axisymmetric())
      area *= is_horizontal ? narrow.left + .5 * narrow.width :
              face == 0     ? a.left :
                              a.left + a.width;
    const auto distance = [&](const Kernels::CellGeometry &g, const double h) {
      return .5 * (is_horizontal ? h : g.width);
    };
    // those of the smaller cell, which is the other one where they differ
    const auto &smaller = grid->cell_nodes(other).node;
    const auto &corners = corners_of_face[is_side ? face : face ^ 1u];
    const std::array<unsigned int, 2> nodes = {
      {smaller[corners[0]], smaller[corners[1]]}};
    faces_.push_back({beyond,
                      is_horizontal,
                      cell,
                      other,
                      places[cell],
                      places[other],
                      nodes,
                      is_open,
                      free_share,
                      area,
                      distance(a, height),
                      is_side ? 0. : distance(b, other_height)});
  }

  double
  CellPressureSolver::free_nodes_of(const unsigned int cell,
                                    const unsigned int face,
                                    const HeldNodes   &held) const
  {
    double share = 0.;
    for (const unsigned int corner : corners_of_face[face])
      if (!held[face / 2][grid->cell_nodes(cell).node[corner]])
        share += .5;
    return share;
  }

  void
  CellPressureSolver::add_sides(const unsigned int cell,
                                const SoilColumns &soil_columns,
                                const OpenSides   &open,
                                const HeldNodes   &held)
  {
    const bool in_plug = soil_columns.side_of(cell) == SoilColumns::Side::plug;
    const bool is_open[4] = {false,
                             open.outer,
                             open.bottom,
                             in_plug || open.surface};
    for (unsigned int face = 0; face < 4; ++face)
      {
        if (face == 3 ? !soil_columns.is_top(cell) : !grid->at_side(cell, face))
          continue;
        double free_share = free_nodes_of(cell, face, held);
        // A surface within the cell moves with the nodes below it, too, where
        // the upper ones are at the top of the mesh, and held.
        if (face == 3)
          free_share =
            std::max(free_share,
                     (1. - filled[cell]) * free_nodes_of(cell, 2, held));
        if (is_open[face] || free_share > 0.)
          add_face(face == 2            ? Beyond::bottom :
                   face == 3 && in_plug ? Beyond::plug :
                                          Beyond::outside,
                   cell,
                   cell,
                   face,
                   is_open[face],
                   free_share);
      }
  }

  void
  CellPressureSolver::find_faces(const SoilColumns        &soil_columns,
                                 const OpenSides          &open,
                                 const BoundaryConditions &conditions)
  {
    const HeldNodes held = conditions.held_nodes(grid->n_nodes());
    filled               = soil_columns.filled().data();
    cells_.clear();
    faces_.clear();
    has_water.assign(partitioner->locally_owned_size() +
                       partitioner->n_ghost_indices(),
                     0);
    double any = 0.;
    for (unsigned int cell = 0; cell < grid->n_cells(); ++cell)
      {
        if (filled[cell] == 0.)
          continue;
        has_water[places[cell]] = 1;
        if (grid->is_owned(cell))
          cells_.push_back(cell);
        // faces to cells with a larger number, or to smaller ones
        for (unsigned int face = 0; face < 4; ++face)
          for (const bool second : {false, true})
            {
              const int other = grid->neighbor(cell, face, second);
              if (other < 0 || filled[other] == 0. ||
                  (second && other == grid->neighbor(cell, face)))
                continue;
              const bool is_finer = grid->neighbor(cell, face, true) !=
                                    grid->neighbor(cell, face),
                         is_coarser = grid->neighbor(other, face ^ 1u, true) !=
                                      grid->neighbor(other, face ^ 1u);
              if (is_finer || (!is_coarser && face % 2 == 1))
                if (grid->is_owned(cell) || grid->is_owned(other))
                  add_face(Beyond::cell, cell, other, face);
            }
        if (grid->is_owned(cell))
          add_sides(cell, soil_columns, open, held);
      }
    for (const Face &face : faces_)
      if (face.beyond != Beyond::cell && face.is_open)
        any = 1.;
    is_known = Utilities::MPI::max(any, grid->communicator()) > 0.;
  }

  void
  CellPressureSolver::vmult(CellData &to, const CellData &from) const
  {
    with_ghosts.zero_out_ghost_values();
    with_ghosts.copy_locally_owned_data_from(from);
    with_ghosts.update_ghost_values();
    to = 0.;
    subtract_flow(with_ghosts, {}, to);
    to *= -1.;
    for (unsigned int i = 0; i < partitioner->locally_owned_size(); ++i)
      if (!has_water[i])
        to.local_element(i) = from.local_element(i);
    to.zero_out_ghost_values();
  }

  void
  CellPressureSolver::subtract_flow(const CellData       &p,
                                    const KnownPressures &known,
                                    CellData             &to) const
  {
    const double *const x = p.begin();
    double *const       y = to.begin();
    for (std::size_t f = 0; f < faces_.size(); ++f)
      {
        const Face &face = faces_[f];
        if (face.beyond == Beyond::cell)
          {
            const double flow =
              conductances_[f] * (x[face.place] - x[face.other_place]);
            y[face.place] -= flow;
            y[face.other_place] += flow;
          }
        else
          y[face.place] -=
            conductances_[f] * (x[face.place] - known[face.beyond]);
      }
  }

  void
  CellPressureSolver::assemble()
  {
    auto &matrix      = multigrid.matrix();
    matrix            = 0.;
    const auto row_of = [this](const unsigned int i) {
      return partitioner->local_to_global(i);
    };
    const unsigned int n_owned = partitioner->locally_owned_size();
    for (std::size_t f = 0; f < faces_.size(); ++f)
      {
        const Face        &face = faces_[f];
        const double       g    = conductances_[f];
        const unsigned int a = face.place, b = face.other_place;
        if (a < n_owned)
          matrix.add(row_of(a), row_of(a), g);
        if (face.beyond != Beyond::cell)
          continue;
        if (a < n_owned)
          matrix.add(row_of(a), row_of(b), -g);
        if (b < n_owned)
          {
            matrix.add(row_of(b), row_of(b), g);
            matrix.add(row_of(b), row_of(a), -g);
          }
      }
    for (unsigned int i = 0; i < n_owned; ++i)
      if (!has_water[i])
        matrix.add(row_of(i), row_of(i), 1.);
    matrix.compress(VectorOperation::add);
  }

  void
  CellPressureSolver::solve(const CellData       &source,
                            const KnownPressures &known,
                            const double          accuracy,
                            CellData             &p)
  {
    const auto find_residual = [&]() {
      p.update_ghost_values();
      residual_.zero_out_ghost_values();
      residual_.copy_locally_owned_data_from(source);
      subtract_flow(p, known, residual_);
      residual_.zero_out_ghost_values();
    };
    for (unsigned int i = 0; i < partitioner->locally_owned_size(); ++i)
      if (!has_water[i])
        p.local_element(i) = 0.;
    find_residual();
    multigrid.solve(
      *this,
      [this]() { assemble(); },
      accuracy * residual_.l2_norm(),
      residual_,
      correction);
    p.zero_out_ghost_values();
    p.add(1., correction);
    find_residual();
  }
} // namespace CaissonMPM
