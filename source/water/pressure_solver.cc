// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/compat.h>
#include <caisson_mpm/water/pressure_solver.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>

namespace CaissonMPM
{
  using namespace dealii;

  void
  PressureSolver::initialize(const BackgroundGrid &grid_of_run)
  {
    grid             = &grid_of_run;
    const auto &dofs = grid->dof_handler();
    hanging          = Compat::empty_constraints(dofs);
    DoFTools::make_hanging_node_constraints(dofs, hanging);
    hanging.close();

    const auto             known = Compat::locally_relevant_dofs(dofs);
    const auto            &own   = dofs.locally_owned_dofs();
    DynamicSparsityPattern pattern(known);
    DoFTools::make_sparsity_pattern(dofs,
                                    pattern,
                                    hanging,
                                    true,
                                    Utilities::MPI::this_mpi_process(
                                      grid->communicator()));
    SparsityTools::distribute_sparsity_pattern(pattern,
                                               own,
                                               grid->communicator(),
                                               known);
    multigrid.initialize(own, pattern, grid->communicator(), .1);

    for (NodalData *v :
         {&states, &right_side, &correction, &product, &with_ghosts})
      grid->reinit(*v, 1);
    dof_of_node.resize(grid->n_nodes());
    std::vector<types::global_dof_index> of_cell(4);
    for (unsigned int cell = 0; cell < grid->n_cells(); ++cell)
      {
        const auto &of_mesh = grid->cell_iterator(cell);
        DoFHandler<2>::active_cell_iterator(&grid->triangulation(),
                                            of_mesh->level(),
                                            of_mesh->index(),
                                            &dofs)
          ->get_dof_indices(of_cell);
        for (unsigned int k = 0; k < 4; ++k)
          dof_of_node[grid->cell_nodes(cell).node[k]] = of_cell[k];
      }
  }

  void
  PressureSolver::find_states(const BackgroundGrid &grid,
                              const Mudline        &mudline,
                              const OpenSides      &sides)
  {
    const auto raise = [this](const unsigned int node, const State state) {
      double &other = states.local_element(node);
      other         = std::max(other, static_cast<double>(state));
    };
    states.zero_out_ghost_values();
    for (unsigned int node = 0; node < grid.n_nodes(); ++node)
      states.local_element(node) = no_water;
    cells_.clear();
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      {
        if (mudline.filled()[cell] == 0.)
          continue;
        if (grid.is_owned(cell))
          cells_.push_back(cell);
        const auto &node = grid.cell_nodes(cell).node;
        for (unsigned int k = 0; k < 4; ++k)
          raise(node[k],
                (sides.outer && grid.is_at(node[k], GridLines::Side::outer)) ||
                    (sides.bottom &&
                     grid.is_at(node[k], GridLines::Side::bottom)) ?
                  open :
                  unknown);
        const bool in_plug = mudline.side_of(cell) == Mudline::Side::plug;
        if (mudline.is_top(cell) && (in_plug || sides.surface))
          for (unsigned int k = 2; k < 4; ++k)
            raise(node[k], in_plug ? plug : open);
      }
    matrices_.resize(cells_.size());
    // a rank knows all cells around the nodes that it owns, and only there
    states.update_ghost_values();
  }

  void
  PressureSolver::assemble()
  {
    constraints = Compat::empty_constraints(grid->dof_handler());
    constraints.merge(hanging);
    for (unsigned int node = 0; node < grid->n_nodes(); ++node)
      if (state(node) != unknown &&
          !constraints.is_constrained(dof_of_node[node]))
        constraints.add_line(dof_of_node[node]);
    constraints.close();

    auto &matrix = multigrid.matrix();
    matrix       = 0.;
    std::vector<types::global_dof_index> dofs(4);
    FullMatrix<double>                   of_cell(4, 4);
    for (std::size_t i = 0; i < cells_.size(); ++i)
      {
        of_cell.fill(matrices_[i].data());
        for (unsigned int k = 0; k < 4; ++k)
          dofs[k] = dof_of_node[grid->cell_nodes(cells_[i]).node[k]];
        constraints.distribute_local_to_global(of_cell, dofs, matrix);
      }
    matrix.compress(VectorOperation::add);
    // rows that no cell has met
    for (unsigned int node = 0; node < grid->n_owned_nodes(); ++node)
      if (state(node) == no_water)
        matrix.set(dof_of_node[node], dof_of_node[node], 1.);
    matrix.compress(VectorOperation::insert);
  }

  void
  PressureSolver::apply(const NodalData &from, NodalData &to) const
  {
    to = 0.;
    to.zero_out_ghost_values();
    const double *const x = from.begin();
    double *const       y = to.begin();
    for (std::size_t i = 0; i < cells_.size(); ++i)
      {
        const double *const       k        = matrices_[i].data();
        const unsigned int *const node     = grid->cell_nodes(cells_[i]).node;
        const double              value[4] = {x[node[0]],
                                              x[node[1]],
                                              x[node[2]],
                                              x[node[3]]};
        for (unsigned int j = 0; j < 4; ++j)
          y[node[j]] += k[4 * j] * value[0] + k[4 * j + 1] * value[1] +
                        k[4 * j + 2] * value[2] + k[4 * j + 3] * value[3];
      }
    grid->hanging_nodes().distribute(to, 1);
    to.compress(VectorOperation::add);
  }

  void
  PressureSolver::keep_unknown(NodalData &field) const
  {
    for (unsigned int node = 0; node < grid->n_owned_nodes(); ++node)
      if (state(node) != unknown)
        field.local_element(node) = 0.;
    for (const auto &hanging_node : grid->hanging_nodes().list())
      if (hanging_node.node < grid->n_owned_nodes())
        field.local_element(hanging_node.node) = 0.;
  }

  void
  PressureSolver::vmult(NodalData &to, const NodalData &from) const
  {
    with_ghosts.zero_out_ghost_values();
    with_ghosts.copy_locally_owned_data_from(from);
    keep_unknown(with_ghosts);
    with_ghosts.update_ghost_values();
    grid->hanging_nodes().interpolate(with_ghosts, 1);
    apply(with_ghosts, to);
    const auto keep = [&](const unsigned int node) {
      to.local_element(node) = from.local_element(node);
    };
    for (unsigned int node = 0; node < grid->n_owned_nodes(); ++node)
      if (state(node) != unknown)
        keep(node);
    for (const auto &hanging_node : grid->hanging_nodes().list())
      if (hanging_node.node < grid->n_owned_nodes())
        keep(hanging_node.node);
  }

  void
  PressureSolver::solve(const NodalData &source,
                        const double     accuracy,
                        NodalData       &field)
  {
    // f - K p, and its norm for the known values alone
    const auto find_residual = [&](NodalData &p) {
      p.update_ghost_values();
      grid->hanging_nodes().interpolate(p, 1);
      apply(p, product);
      right_side.copy_locally_owned_data_from(source);
      right_side.add(-1., product);
      keep_unknown(right_side);
      return right_side.l2_norm();
    };
    correction.copy_locally_owned_data_from(field);
    for (unsigned int node = 0; node < grid->n_owned_nodes(); ++node)
      {
        if (state(node) == unknown)
          correction.local_element(node) = 0.;
        else if (state(node) == no_water)
          correction.local_element(node) = field.local_element(node) = 0.;
      }
    const double tolerance = accuracy * find_residual(correction);
    find_residual(field);
    multigrid.solve(
      *this, [this]() { assemble(); }, tolerance, right_side, correction);
    field.zero_out_ghost_values();
    field.add(1., correction);
    field.update_ghost_values();
    grid->hanging_nodes().interpolate(field, 1);
  }

  PressureSolver::SumsByState
  PressureSolver::sums_by_state(const NodalData &of_nodes) const
  {
    SumsByState sums = {};
    for (unsigned int node = 0; node < grid->n_owned_nodes(); ++node)
      sums[state(node)] += of_nodes.local_element(node);
    Utilities::MPI::sum(ArrayView<const double>(sums.data(), sums.size()),
                        grid->communicator(),
                        ArrayView<double>(sums.data(), sums.size()));
    for (double &sum : sums)
      sum *= grid->circumference();
    return sums;
  }
} // namespace CaissonMPM
