// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/compat.h>
#include <caisson_mpm/water/seepage.h>

#include <deal.II/base/mpi.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    constexpr double tolerance = 1e-11;
  }

  void
  Seepage::initialize(const BackgroundGrid &grid_of_run)
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
         {&states, &phi, &residual_, &right_side, &correction, &with_ghosts})
      grid->reinit(*v, 1);
  }

  void
  Seepage::find_states(const SoilColumns &soil_columns, const OpenSides &sides)
  {
    const auto beyond = soil_columns.find_beyond(*grid, sides);
    states.zero_out_ghost_values();
    for (unsigned int node = 0; node < grid->n_nodes(); ++node)
      states.local_element(node) = no_water;
    cells.clear();
    for (unsigned int cell = 0; cell < grid->n_cells(); ++cell)
      {
        if (soil_columns.filled()[cell] == 0.)
          continue;
        if (grid->is_owned(cell))
          cells.push_back(cell);
        for (const unsigned int node : grid->cell_nodes(cell).node)
          states.local_element(node) = beyond[node] == Beyond::cell ? unknown :
                                       beyond[node] == Beyond::plug ? plug :
                                                                      open;
      }
    // a rank knows all cells around the nodes that it owns, and only there
    states.update_ghost_values();
  }

  void
  Seepage::assemble()
  {
    const auto dof_of = [this](const unsigned int node) {
      return phi.get_partitioner()->local_to_global(node);
    };
    auto constraints = Compat::empty_constraints(grid->dof_handler());
    constraints.merge(hanging);
    for (unsigned int node = 0; node < grid->n_nodes(); ++node)
      if (state(node) != unknown && !constraints.is_constrained(dof_of(node)))
        constraints.add_line(dof_of(node));
    constraints.close();

    auto &matrix = multigrid.matrix();
    matrix       = 0.;
    std::vector<types::global_dof_index> dofs(4);
    FullMatrix<double>                   of_cell(4, 4);
    for (std::size_t i = 0; i < cells.size(); ++i)
      {
        of_cell.fill(matrices[i].data());
        for (unsigned int k = 0; k < 4; ++k)
          dofs[k] = dof_of(grid->cell_nodes(cells[i]).node[k]);
        constraints.distribute_local_to_global(of_cell, dofs, matrix);
      }
    matrix.compress(VectorOperation::add);
    // rows that no cell has met
    for (unsigned int node = 0; node < grid->n_owned_nodes(); ++node)
      if (state(node) == no_water)
        matrix.set(dof_of(node), dof_of(node), 1.);
    matrix.compress(VectorOperation::insert);
  }

  void
  Seepage::apply(const NodalData &from, NodalData &to) const
  {
    to                    = 0.;
    const double *const x = from.begin();
    double *const       y = to.begin();
    for (std::size_t i = 0; i < cells.size(); ++i)
      {
        const double *const       k        = matrices[i].data();
        const unsigned int *const node     = grid->cell_nodes(cells[i]).node;
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

  template <typename Action>
  void
  Seepage::for_each_given(const Action &action) const
  {
    for (unsigned int node = 0; node < grid->n_owned_nodes(); ++node)
      if (state(node) != unknown)
        action(node);
    for (const auto &hanging_node : grid->hanging_nodes().list())
      if (hanging_node.node < grid->n_owned_nodes())
        action(hanging_node.node);
  }

  void
  Seepage::vmult(NodalData &to, const NodalData &from) const
  {
    with_ghosts.zero_out_ghost_values();
    with_ghosts.copy_locally_owned_data_from(from);
    for_each_given([this](const unsigned int node) {
      with_ghosts.local_element(node) = 0.;
    });
    with_ghosts.update_ghost_values();
    grid->hanging_nodes().interpolate(with_ghosts, 1);
    apply(with_ghosts, to);
    for_each_given([&](const unsigned int node) {
      to.local_element(node) = from.local_element(node);
    });
  }

  double
  Seepage::find_right_side(NodalData &p)
  {
    p.update_ghost_values();
    grid->hanging_nodes().interpolate(p, 1);
    apply(p, right_side);
    right_side *= -1.;
    for_each_given(
      [this](const unsigned int node) { right_side.local_element(node) = 0.; });
    return right_side.l2_norm();
  }

  void
  Seepage::solve(const SoilColumns              &soil_columns,
                 const std::vector<Conductance> &permeability,
                 const OpenSides                &sides)
  {
    // 1. the matrices of the cells, with entries of order one
    find_states(soil_columns, sides);
    double scale = 0.;
    for (unsigned int cell = 0; cell < grid->n_cells(); ++cell)
      if (grid->is_owned(cell))
        scale = std::max(
          {scale, permeability[cell].horizontal, permeability[cell].vertical});
    scale = Utilities::MPI::max(scale, grid->communicator());
    CellIntegrals integrals(*grid);
    matrices.clear();
    for (const unsigned int cell : cells)
      {
        const double      filled = soil_columns.filled()[cell];
        const Conductance k      = {permeability[cell].horizontal * filled,
                                    permeability[cell].vertical / filled};
        integrals.reinit(cell);
        matrices.push_back(
          integrals.stiffness({k.horizontal / scale, k.vertical / scale}));
      }
    // 2. the known values alone, from which the tolerance follows
    phi.zero_out_ghost_values();
    correction = 0.;
    for (unsigned int node = 0; node < grid->n_owned_nodes(); ++node)
      if (state(node) != unknown)
        correction.local_element(node) = phi.local_element(node) =
          state(node) == plug ? 1. : 0.;
    const double accuracy = tolerance * find_right_side(correction);
    // 3. the correction of the last field
    find_right_side(phi);
    multigrid.solve(
      *this, [this]() { assemble(); }, accuracy, right_side, correction);
    phi.zero_out_ghost_values();
    phi.add(1., correction);
    phi.update_ghost_values();
    grid->hanging_nodes().interpolate(phi, 1);
    apply(phi, residual_);
    residual_ *= scale;
  }

  std::array<double, 2>
  Seepage::sums_of_plug_and_open() const
  {
    std::array<double, 2> sums = {};
    for (unsigned int node = 0; node < grid->n_owned_nodes(); ++node)
      if (state(node) >= open)
        sums[state(node) == open] += residual_.local_element(node);
    for (double &sum : sums)
      sum =
        grid->circumference() * Utilities::MPI::sum(sum, grid->communicator());
    return sums;
  }
} // namespace CaissonMPM
