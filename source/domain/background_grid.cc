// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/compat.h>
#include <caisson_mpm/domain/background_grid.h>

namespace CaissonMPM
{
  using namespace dealii;

  BackgroundGrid::BackgroundGrid(const GridLines &lines,
                                 const MPI_Comm   communicator)
    : lines_(lines)
    , triangulation_(communicator)
    , fe(1)
    , dof_handler_(triangulation_)
    , n_ranks_(Utilities::MPI::n_mpi_processes(communicator))
    , rank(Utilities::MPI::this_mpi_process(communicator))
  {}

  // ------------------------------------------------------------ mesh

  void
  BackgroundGrid::create_mesh()
  {
    create_triangulation();
    set_up_part();
  }

  void
  BackgroundGrid::create_triangulation()
  {
    const unsigned int      n = lines_.n_columns() + 1;
    std::vector<Point<dim>> points;
    for (unsigned int j = 0; j <= lines_.n_rows(); ++j)
      for (unsigned int i = 0; i <= lines_.n_columns(); ++i)
        points.push_back(lines_.node_start(i, j));
    std::vector<CellData<dim>> cells(lines_.n_cells());
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        const GlobalCell   number{c};
        const unsigned int i = lines_.column_of(number),
                           j = lines_.row_of(number);
        cells[c].vertices    = {j * n + i,
                                j * n + i + 1,
                                (j + 1) * n + i,
                                (j + 1) * n + i + 1};
        cells[c].material_id = lines_.is_body_cell(number) ? 1 : 0;
      }
    triangulation_.create_triangulation(points, cells, SubCellData());
    // the boundary ids are those of Side
    for (const auto &cell : triangulation_.active_cell_iterators())
      for (const unsigned int face : cell->face_indices())
        if (cell->face(face)->at_boundary())
          cell->face(face)->set_boundary_id(face);
  }

  void
  BackgroundGrid::repartition(const std::vector<unsigned int> &costs)
  {
    const auto connection = triangulation_.signals.weight.connect(
      [&costs](const auto &cell, const auto) { return costs[cell->index()]; });
    triangulation_.repartition();
    connection.disconnect();
    set_up_part();
  }

  void
  BackgroundGrid::set_up_part()
  {
    dof_handler_.distribute_dofs(fe);
    partitioner = std::make_shared<const Utilities::MPI::Partitioner>(
      dof_handler_.locally_owned_dofs(),
      Compat::locally_relevant_dofs(dof_handler_),
      communicator());
    partitioners.clear();
    number_cells();
    find_dofs();
    find_neighbors();
    flag_cells_at_body();
    number_nodes();
    is_prepared = false;
    move_to(0.);
  }

  void
  BackgroundGrid::number_cells()
  {
    local_numbers.assign(n_global_cells(), numbers::invalid_unsigned_int);
    iterators.clear();
    global_numbers.clear();
    owners.clear();
    rigid.clear();
    for (const auto &cell : triangulation_.active_cell_iterators())
      if (!cell->is_artificial())
        {
          local_numbers[cell->index()] = iterators.size();
          iterators.push_back(cell);
          // a CellId would give the number of p4est's tree
          global_numbers.push_back(GlobalCell(cell->index()));
          owners.push_back(cell->subdomain_id());
          rigid.push_back(lines_.is_body_cell(global_numbers.back()));
        }
    for (auto &g : geometries)
      g.resize(iterators.size());
  }

  void
  BackgroundGrid::find_dofs()
  {
    nodes.resize(iterators.size());
    std::vector<types::global_dof_index> dofs(4);
    for (unsigned int c = 0; c < n_cells(); ++c)
      {
        const auto &cell = iterators[c];
        DoFHandler<dim>::active_cell_iterator(&triangulation_,
                                              cell->level(),
                                              cell->index(),
                                              &dof_handler_)
          ->get_dof_indices(dofs);
        for (unsigned int k = 0; k < 4; ++k)
          nodes[c].node[k] = partitioner->global_to_local(dofs[k]);
      }
  }

  void
  BackgroundGrid::find_neighbors()
  {
    neighbors.assign(Kernels::neighbors_per_cell * n_cells(), -1);
    soil_neighbors = neighbors;
    for (unsigned int c = 0; c < n_cells(); ++c)
      for (unsigned int face = 0; face < 4; ++face)
        {
          const auto &cell = iterators[c];
          if (cell->at_boundary(face) || cell->neighbor(face)->is_artificial())
            continue;
          const unsigned int neighbor =
            local_number(GlobalCell(cell->neighbor(face)->index()));
          neighbors[place_of_neighbor(c, face)] = neighbor;
          if (!rigid[neighbor])
            soil_neighbors[place_of_neighbor(c, face)] = neighbor;
        }
  }

  void
  BackgroundGrid::flag_cells_at_body()
  {
    flags.assign(n_cells(), 0);
    // a soil cell is next to the body where the two share a node
    std::vector<bool> at_body(partitioner->locally_owned_size() +
                                partitioner->n_ghost_indices(),
                              false);
    for (unsigned int c = 0; c < n_cells(); ++c)
      if (rigid[c])
        for (const unsigned int node : nodes[c].node)
          at_body[node] = true;
    for (unsigned int c = 0; c < n_cells(); ++c)
      for (const unsigned int node : nodes[c].node)
        if (!rigid[c] && at_body[node])
          flags[c] |= Kernels::next_to_body;
  }

  void
  BackgroundGrid::number_nodes()
  {
    const unsigned int n =
      partitioner->locally_owned_size() + partitioner->n_ghost_indices();
    node_r.assign(n, 0.);
    node_z.assign(n, 0.);
    node_start.assign(n, Point<dim>());
    node_rate.assign(n, Tensor<1, dim>());
    node_sides.assign(n, 0);
    vertices.clear();
    std::vector<bool> seen(n, false);
    for (unsigned int c = 0; c < n_cells(); ++c)
      for (unsigned int k = 0; k < 4; ++k)
        {
          const unsigned int node = nodes[c].node[k];
          if (seen[node])
            continue;
          const unsigned int i = lines_.column_of(global_numbers[c]) + k % 2,
                             j = lines_.row_of(global_numbers[c]) + k / 2;
          seen[node]           = true;
          node_start[node]     = lines_.node_start(i, j);
          node_rate[node]      = lines_.node_rate(i, j);
          node_sides[node]     = lines_.sides_of(i, j);
          vertices.emplace_back(node, &iterators[c]->vertex(k));
        }
  }

  void
  BackgroundGrid::reinit(NodalData &vector, const unsigned int components) const
  {
    auto &scaled = partitioners[components];
    if (!scaled)
      {
        const auto scale = [&](const IndexSet &set) {
          IndexSet result(set.size() * components);
          for (const auto index : set)
            result.add_range(index * components, (index + 1) * components);
          result.compress();
          return result;
        };
        scaled = std::make_shared<const Utilities::MPI::Partitioner>(
          scale(partitioner->locally_owned_range()),
          scale(partitioner->ghost_indices()),
          communicator());
      }
    vector.reinit(scaled);
  }

  bool
  BackgroundGrid::at_side(const unsigned int cell,
                          const unsigned int face) const
  {
    const GlobalCell   number = global_numbers[cell];
    const unsigned int line =
      face < 2 ? lines_.column_of(number) : lines_.row_of(number);
    const unsigned int n = face < 2 ? lines_.n_columns() : lines_.n_rows();
    return line == (face % 2 == 0 ? 0 : n - 1);
  }

  // ------------------------------------------------------------ motion

  void
  BackgroundGrid::prepare_motion(const double travel)
  {
    for (unsigned int n = 0; n < n_nodes(); ++n)
      {
        node_r[n] = node_start[n][radial] + node_rate[n][radial] * travel;
        node_z[n] = node_start[n][vertical] + node_rate[n][vertical] * travel;
      }
    auto &next = geometries[1 - current];
    for (unsigned int c = 0; c < n_cells(); ++c)
      {
        const auto  &n    = nodes[c].node;
        const double left = node_z[n[0]], right = node_z[n[1]];
        next[c] = {node_r[n[0]],
                   node_r[n[1]] - node_r[n[0]],
                   left,
                   right,
                   node_z[n[2]] - left,
                   node_z[n[3]] - right};
      }
    is_prepared          = true;
    vertices_are_current = false;
  }

  void
  BackgroundGrid::advance()
  {
    Assert(is_prepared, ExcMessage("prepare_motion() must come first"));
    is_prepared = false;
    current     = 1 - current;
  }

  void
  BackgroundGrid::move_to(const double travel)
  {
    prepare_motion(travel);
    advance();
  }

  void
  BackgroundGrid::write_vertices()
  {
    Assert(!is_prepared, ExcMessage("advance() must follow prepare_motion()"));
    for (const auto &vertex : vertices)
      *vertex.second = Point<dim>(node_r[vertex.first], node_z[vertex.first]);
    vertices_are_current = true;
  }

  const Mapping<BackgroundGrid::dim> &
  BackgroundGrid::mapping() const
  {
    Assert(vertices_are_current,
           ExcMessage("write_vertices() must be called before deal.II reads "
                      "the geometry"));
    return mapping_;
  }

  Kernels::GridView
  BackgroundGrid::view() const
  {
    return {geometries[current].data(),
            nodes.data(),
            flags.data(),
            soil_neighbors.data(),
            axisymmetric() ? 1. : 0.};
  }

  Kernels::GridView
  BackgroundGrid::next() const
  {
    Assert(is_prepared, ExcMessage("prepare_motion() must come first"));
    Kernels::GridView result = view();
    result.geometry          = geometries[1 - current].data();
    return result;
  }
} // namespace CaissonMPM
