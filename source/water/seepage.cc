// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/compat.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/water/seepage.h>

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_values.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int max_iterations = 1000;
    constexpr double       tolerance      = 1e-11; // of the right side

    /** Incomplete factors smooth best where cells are long and flat: with
     * Chebyshev polynomials, six times as many iterations are needed. */
    TrilinosWrappers::PreconditionAMG::AdditionalData
    multigrid_settings()
    {
      TrilinosWrappers::PreconditionAMG::AdditionalData settings;
      settings.smoother_type         = "ILU";
      settings.smoother_sweeps       = 1;
      settings.aggregation_threshold = .1;
      return settings;
    }

    /** The cell of the grid as one that knows its dofs. */
    DoFHandler<2>::active_cell_iterator
    dof_cell(const BackgroundGrid &grid, const unsigned int cell)
    {
      const auto &of_mesh = grid.cell_iterator(cell);
      return DoFHandler<2>::active_cell_iterator(&grid.triangulation(),
                                                 of_mesh->level(),
                                                 of_mesh->index(),
                                                 &grid.dof_handler());
    }
  } // namespace

  void
  Seepage::initialize(const BackgroundGrid &grid)
  {
    const auto &dofs = grid.dof_handler();
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
                                      grid.communicator()));
    SparsityTools::distribute_sparsity_pattern(pattern,
                                               own,
                                               grid.communicator(),
                                               known);
    matrix.reinit(own, own, pattern, grid.communicator());
    n_at_setup = 0;

    grid.reinit(phi, 1);
    grid.reinit(right_side, 1);
    grid.reinit(states, 1);
    grid.reinit(residual, 1);
    dof_of_node.resize(grid.n_nodes());
    std::vector<types::global_dof_index> of_cell(4);
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      {
        dof_cell(grid, cell)->get_dof_indices(of_cell);
        for (unsigned int k = 0; k < 4; ++k)
          dof_of_node[grid.cell_nodes(cell).node[k]] = of_cell[k];
      }
  }

  void
  Seepage::find_states(const BackgroundGrid &grid,
                       const Mudline        &mudline,
                       const FarSides       &drained)
  {
    const auto raise = [this](const unsigned int node, const State state) {
      double &other = states.local_element(node);
      other         = std::max(other, static_cast<double>(state));
    };
    states.zero_out_ghost_values();
    for (unsigned int node = 0; node < grid.n_nodes(); ++node)
      states.local_element(node) = no_water;
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      {
        if (mudline.filled()[cell] == 0.)
          continue;
        const auto &node = grid.cell_nodes(cell).node;
        for (unsigned int k = 0; k < 4; ++k)
          raise(node[k],
                (drained.outer &&
                 grid.is_at(node[k], GridLines::Side::outer)) ||
                    (drained.bottom &&
                     grid.is_at(node[k], GridLines::Side::bottom)) ?
                  zero :
                  unknown);
        if (mudline.is_top(cell))
          for (unsigned int k = 2; k < 4; ++k)
            raise(node[k],
                  mudline.side_of(cell) == Mudline::Side::plug ? one : zero);
      }
    // a rank knows all cells around the nodes that it owns, and only there
    states.update_ghost_values();

    constraints = Compat::empty_constraints(grid.dof_handler());
    constraints.merge(hanging);
    for (unsigned int node = 0; node < grid.n_nodes(); ++node)
      {
        const auto dof   = dof_of_node[node];
        const int  state = static_cast<int>(states.local_element(node));
        if (state == unknown || constraints.is_constrained(dof))
          continue;
        constraints.add_line(dof);
        if (state == one)
          constraints.set_inhomogeneity(dof, 1.);
      }
    constraints.close();
  }

  double
  Seepage::largest_permeability(
    const BackgroundGrid            &grid,
    const std::vector<Permeability> &permeability) const
  {
    double largest = 0.;
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      if (grid.is_owned(cell))
        largest = std::max({largest,
                            permeability[cell].horizontal,
                            permeability[cell].vertical});
    return Utilities::MPI::max(largest, grid.communicator());
  }

  void
  Seepage::find_conductances(const BackgroundGrid            &grid,
                             const Mudline                   &mudline,
                             const std::vector<Permeability> &permeability)
  {
    const QGauss<2> quadrature(2);
    FEValues<2>     values(grid.mapping(),
                       grid.dof_handler().get_fe(),
                       quadrature,
                       update_gradients | update_JxW_values |
                         update_quadrature_points);
    conductances.clear();
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      {
        const double filled = mudline.filled()[cell];
        if (!grid.is_owned(cell) || filled == 0.)
          continue;
        values.reinit(dof_cell(grid, cell));
        const double       k[2] = {permeability[cell].horizontal * filled,
                                   permeability[cell].vertical / filled};
        FullMatrix<double> of_cell(4, 4);
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            const double weight =
              values.JxW(q) *
              (grid.axisymmetric() ? values.quadrature_point(q)[radial] : 1.);
            for (unsigned int i = 0; i < 4; ++i)
              for (unsigned int j = 0; j < 4; ++j)
                for (unsigned int d = 0; d < 2; ++d)
                  of_cell(i, j) += weight * k[d] * values.shape_grad(i, q)[d] *
                                   values.shape_grad(j, q)[d];
          }
        conductances.emplace_back(cell, of_cell);
      }
  }

  void
  Seepage::assemble(const BackgroundGrid &grid)
  {
    matrix     = 0.;
    right_side = 0.;
    const Vector<double>                 no_source(4);
    std::vector<types::global_dof_index> dofs(4);
    for (const auto &[cell, of_cell] : conductances)
      {
        for (unsigned int k = 0; k < 4; ++k)
          dofs[k] = dof_of_node[grid.cell_nodes(cell).node[k]];
        constraints.distribute_local_to_global(
          of_cell, no_source, dofs, matrix, right_side);
      }
    matrix.compress(VectorOperation::add);
    right_side.compress(VectorOperation::add);
    // rows that no cell has met
    for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
      if (states.local_element(node) == no_water)
        matrix.set(dof_of_node[node], dof_of_node[node], 1.);
    matrix.compress(VectorOperation::insert);
  }

  void
  Seepage::solve(const BackgroundGrid            &grid,
                 const Mudline                   &mudline,
                 const std::vector<Permeability> &permeability,
                 const FarSides                  &drained)
  {
    find_states(grid, mudline, drained);
    // of order one, as the rows without water
    scale             = largest_permeability(grid, permeability);
    auto of_order_one = permeability;
    for (auto &k : of_order_one)
      k = {k.horizontal / scale, k.vertical / scale};
    find_conductances(grid, mudline, of_order_one);
    assemble(grid);

    phi.zero_out_ghost_values();
    for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
      if (constraints.is_constrained(dof_of_node[node]))
        phi.local_element(node) = 0.;
    iterate();
    constraints.distribute(phi);
    phi.update_ghost_values();
    find_residual(grid);
  }

  bool
  Seepage::iterate(const unsigned int max_iterations)
  {
    SolverControl control(max_iterations, tolerance * right_side.l2_norm());
    SolverCG<NodalData> solver(control);
    try
      {
        solver.solve(matrix, phi, right_side, multigrid);
      }
    catch (const SolverControl::NoConvergence &)
      {}
    n_iterations_ = control.last_step();
    return control.last_check() == SolverControl::success;
  }

  void
  Seepage::iterate()
  {
    // The multigrid of an earlier matrix serves as long as it costs only some
    // more iterations than a new one.
    if (n_at_setup > 0 && iterate(n_at_setup + n_at_setup / 2 + 2))
      return;
    multigrid.initialize(matrix, multigrid_settings());
    if (!iterate(max_iterations))
      throw RunFailure(
        "the flow of the pore water was not found in " +
        to_text(max_iterations) +
        " iterations. Reduce the contrast of the permeabilities, or the ratio "
        "of width to height of the cells.");
    n_at_setup = std::max(n_iterations_, 1u);
  }

  void
  Seepage::find_residual(const BackgroundGrid &grid)
  {
    residual = 0.;
    for (const auto &[cell, of_cell] : conductances)
      {
        const auto &node = grid.cell_nodes(cell).node;
        for (unsigned int i = 0; i < 4; ++i)
          for (unsigned int j = 0; j < 4; ++j)
            residual.local_element(node[i]) +=
              scale * of_cell(i, j) * phi.local_element(node[j]);
      }
    grid.hanging_nodes().distribute(residual, 1);
    residual.compress(VectorOperation::add);
  }

  Seepage::Flow
  Seepage::flow(const BackgroundGrid &grid) const
  {
    Flow flow;
    for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
      if (states.local_element(node) == one)
        flow.out += residual.local_element(node);
      else if (states.local_element(node) == zero)
        flow.in -= residual.local_element(node);
    flow.out =
      grid.circumference() * Utilities::MPI::sum(flow.out, grid.communicator());
    flow.in =
      grid.circumference() * Utilities::MPI::sum(flow.in, grid.communicator());
    return flow;
  }

  NodalData
  Seepage::conductivity_of_plug(
    const BackgroundGrid            &grid,
    const Mudline                   &mudline,
    const std::vector<Permeability> &permeability) const
  {
    NodalData conductivity;
    grid.reinit(conductivity, 1);
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      {
        if (!grid.is_owned(cell) || !mudline.is_top(cell) ||
            mudline.side_of(cell) != Mudline::Side::plug)
          continue;
        const auto &node = grid.cell_nodes(cell).node;
        const auto  area =
          areas_of_side(grid.geometry(cell), grid.axisymmetric());
        for (unsigned int i = 0; i < 2; ++i)
          conductivity.local_element(node[2 + i]) +=
            permeability[cell].vertical * area[i];
      }
    conductivity.compress(VectorOperation::add);
    return conductivity;
  }

  Seepage::ExitGradient
  Seepage::exit_gradient(const BackgroundGrid            &grid,
                         const Mudline                   &mudline,
                         const std::vector<Permeability> &permeability) const
  {
    // The flow out of a node over the permeability and the area that belong to
    // it: more accurate than the gradient in the cell below.
    const NodalData conductivity =
      conductivity_of_plug(grid, mudline, permeability);
    using Place = std::pair<double, double>; // r, gradient
    std::vector<Place> own;
    for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
      if (conductivity.local_element(node) > 0.)
        own.emplace_back(grid.r_of(node),
                         residual.local_element(node) /
                           conductivity.local_element(node));
    std::vector<Place> places;
    for (const auto &of_rank :
         Utilities::MPI::all_gather(grid.communicator(), own))
      places.insert(places.end(), of_rank.begin(), of_rank.end());
    std::sort(places.begin(), places.end());
    ExitGradient result;
    if (places.empty())
      return result;
    result.axis = places.front().second;
    result.wall = places.back().second;
    return result;
  }
} // namespace CaissonMPM
