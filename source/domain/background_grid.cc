// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/compat.h>
#include <caisson_mpm/domain/background_grid.h>
#include <caisson_mpm/kernels/layout.h>

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
    number_part();
    signals.after_change();
  }

  void
  BackgroundGrid::create_triangulation()
  {
    // the roots of the tree of cells
    const unsigned int size      = lines_.tree().root_size(),
                       n_columns = lines_.n_columns() / size,
                       n_rows = lines_.n_rows() / size, n = n_columns + 1;
    std::vector<Point<dim>> points;
    for (unsigned int j = 0; j <= n_rows; ++j)
      for (unsigned int i = 0; i <= n_columns; ++i)
        points.push_back(lines_.node_start(i * size, j * size));
    std::vector<CellData<dim>> cells(n_columns * n_rows);
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        const unsigned int i = c % n_columns, j = c / n_columns;
        cells[c].vertices = {j * n + i,
                             j * n + i + 1,
                             (j + 1) * n + i,
                             (j + 1) * n + i + 1};
        cells[c].material_id =
          lines_.is_body_cell(lines_.tree().cell_at(i * size, j * size)) ? 1 :
                                                                           0;
      }
    triangulation_.create_triangulation(points, cells, SubCellData());
    // the boundary ids are those of Side
    for (const auto &cell : triangulation_.active_cell_iterators())
      for (const unsigned int face : cell->face_indices())
        if (cell->face(face)->at_boundary())
          cell->face(face)->set_boundary_id(face);
    refine_triangulation();
  }

  namespace
  {
    /** The block of the lattice that a cell of the triangulation is. */
    CellBlock
    block_of(const BackgroundGrid::Triangulation::cell_iterator &cell,
             const GridLines                                    &lines)
    {
      const unsigned int root_size = lines.tree().root_size();
      CellBlock          block     = {0, 0, root_size >> cell->level()};
      auto               ancestor  = cell;
      for (unsigned int size = block.size; ancestor->level() > 0; size *= 2)
        {
          const auto   parent = ancestor->parent();
          unsigned int k      = 0;
          while (parent->child_index(k) != ancestor->index())
            ++k;
          block.column += size * (k % 2);
          block.row += size * (k / 2);
          ancestor = parent;
        }
      // a CellId would give the number of p4est's tree
      const unsigned int root      = ancestor->index(),
                         n_columns = lines.n_columns() / root_size;
      block.column += root_size * (root % n_columns);
      block.row += root_size * (root / n_columns);
      return block;
    }
  } // namespace

  GlobalCell
  BackgroundGrid::number_of(const Triangulation::cell_iterator &cell) const
  {
    const CellBlock block = block_of(cell, lines_);
    return lines_.tree().cell_at(block.column, block.row);
  }

  void
  BackgroundGrid::refine_triangulation()
  {
    for (unsigned int level = 0; level < lines_.tree().levels(); ++level)
      {
        for (const auto &cell : triangulation_.active_cell_iterators())
          if (cell->is_locally_owned() &&
              lines_.tree().block(number_of(cell)).size <
                lines_.tree().root_size() >> cell->level())
            cell->set_refine_flag();
        triangulation_.execute_coarsening_and_refinement();
      }
    AssertThrow(triangulation_.n_global_active_cells() == n_global_cells(),
                ExcInternalError());
  }

  void
  BackgroundGrid::repartition(const std::vector<unsigned int> &costs)
  {
    signals.before_change();
    const auto connection =
      triangulation_.signals.weight.connect([&](const auto &cell, const auto) {
        return costs[index_of(number_of(cell))];
      });
    triangulation_.repartition();
    connection.disconnect();
    number_part();
    signals.after_change();
  }

  void
  BackgroundGrid::rebuild()
  {
    signals.before_change();
    move_to(0.);
    signals.after_change();
  }

  void
  BackgroundGrid::number_part()
  {
    dof_handler_.distribute_dofs(fe);
    partitioner = std::make_shared<const Utilities::MPI::Partitioner>(
      dof_handler_.locally_owned_dofs(),
      Compat::locally_relevant_dofs(dof_handler_),
      communicator());
    partitioners.clear();
    number_cells();
    find_dofs();
    find_hanging_nodes();
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
    std::map<GlobalCell, Triangulation::active_cell_iterator> known;
    for (const auto &cell : triangulation_.active_cell_iterators())
      if (!cell->is_artificial())
        known.emplace(number_of(cell), cell);
    iterators.clear();
    global_numbers.clear();
    owners.clear();
    rigid.clear();
    for (const auto &[number, cell] : known)
      {
        local_numbers[index_of(number)] = iterators.size();
        iterators.push_back(cell);
        global_numbers.push_back(number);
        owners.push_back(cell->subdomain_id());
        rigid.push_back(lines_.is_body_cell(number));
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
          if (at_side(c, face))
            continue;
          const auto beyond    = iterators[c]->neighbor(face);
          const bool is_halved = beyond->has_children();
          for (int i = 0; i < (is_halved ? Kernels::neighbors_per_face : 1);
               ++i)
            {
              const auto cell =
                is_halved ? iterators[c]->neighbor_child_on_subface(face, i) :
                            beyond;
              if (cell->is_artificial())
                continue;
              const unsigned int neighbor = local_number(number_of(cell)),
                                 place    = place_of_neighbor(c, face) + i;
              neighbors[place]            = neighbor;
              if (!rigid[neighbor])
                soil_neighbors[place] = neighbor;
            }
        }
  }

  void
  BackgroundGrid::find_hanging_nodes()
  {
    std::vector<bool> is_at_own_cell(partitioner->locally_owned_size() +
                                       partitioner->n_ghost_indices(),
                                     false);
    for (unsigned int c = 0; c < n_cells(); ++c)
      if (is_owned(c))
        for (const unsigned int node : nodes[c].node)
          is_at_own_cell[node] = true;
    if (lines_.tree().levels() > 0)
      hanging_nodes_.initialize(dof_handler_, *partitioner, is_at_own_cell);
  }

  void
  BackgroundGrid::flag_cells_at_body()
  {
    flags.assign(n_cells(), 0);
    // a soil cell is next to the body where the two share a node
    std::vector<unsigned int> n_rigid(partitioner->locally_owned_size() +
                                        partitioner->n_ghost_indices(),
                                      0);
    for (unsigned int c = 0; c < n_cells(); ++c)
      if (rigid[c])
        for (const unsigned int node : nodes[c].node)
          ++n_rigid[node];
    for (unsigned int c = 0; c < n_cells(); ++c)
      for (const unsigned int node : nodes[c].node)
        if (!rigid[c] && n_rigid[node] > 0)
          {
            flags[c] |= Kernels::next_to_body;
            if (n_rigid[node] == 1)
              flags[c] |= Kernels::at_corner_of_body;
          }
    for (unsigned int c = 0; c < n_cells(); ++c)
      for (unsigned int face = 0; !rigid[c] && face < 4; ++face)
        if (const int beyond = neighbor(c, face);
            beyond >= 0 && rigid[beyond] && !is_lid(beyond))
          flags[c] |= Kernels::body_to_the_left << face;
  }

  void
  BackgroundGrid::number_nodes()
  {
    const unsigned int n =
      partitioner->locally_owned_size() + partitioner->n_ghost_indices();
    for (NodalData *const field : {&node_start, &node_rate, &node_position})
      reinit(*field, dim);
    node_sides.assign(n, 0);
    vertices.clear();
    std::vector<bool> seen(n, false);
    for (unsigned int c = 0; c < n_cells(); ++c)
      for (unsigned int k = 0; k < 4; ++k)
        {
          const unsigned int node = nodes[c].node[k];
          if (seen[node])
            continue;
          const CellBlock   &b = lines_.tree().block(global_numbers[c]);
          const unsigned int i = b.column + b.size * (k % 2),
                             j = b.row + b.size * (k / 2);
          seen[node]           = true;
          node_sides[node]     = lines_.sides_of(i, j);
          const auto start     = lines_.node_start(i, j);
          const auto rate      = lines_.node_rate(i, j);
          for (unsigned int d = 0; d < dim; ++d)
            {
              node_start.local_element(dim * node + d) = start[d];
              node_rate.local_element(dim * node + d)  = rate[d];
            }
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
    return iterators[cell]->at_boundary(face);
  }

  unsigned int
  BackgroundGrid::n_body_cells() const
  {
    unsigned int n = 0;
    for (unsigned int c = 0; c < n_global_cells(); ++c)
      n += lines_.is_body_cell(GlobalCell(c));
    return n;
  }

  double
  BackgroundGrid::mass_of_body(const double density) const
  {
    double mass = 0.;
    for (unsigned int c = 0; c < n_cells(); ++c)
      if (rigid[c] && is_owned(c))
        {
          const auto  &g = geometry(c);
          const double r = g.left + .5 * g.width;
          mass += density * ((axisymmetric() ? 2. * pi * r : 1.) * g.width *
                             height_of(g));
        }
    return Utilities::MPI::sum(mass, communicator());
  }

  // ------------------------------------------------------------ motion

  void
  BackgroundGrid::prepare_motion(const double travel)
  {
    // each rank knows the start and the rate of its ghost nodes
    double *const       x    = node_position.begin();
    const double *const from = node_start.begin(), *const rate =
                                                     node_rate.begin();
    for (unsigned int i = 0; i < dim * n_nodes(); ++i)
      x[i] = from[i] + travel * rate[i];
    auto &next = geometries[1 - current];
    for (unsigned int c = 0; c < n_cells(); ++c)
      {
        const auto r_at = [&](const int k) {
          return x[dim * nodes[c].node[k]];
        };
        const auto z_at = [&](const int k) {
          return x[dim * nodes[c].node[k] + vertical];
        };
        next[c] = {r_at(0),
                   r_at(1) - r_at(0),
                   z_at(0),
                   z_at(1),
                   z_at(2) - z_at(0),
                   z_at(3) - z_at(1)};
      }
    is_prepared = true;
  }

  void
  BackgroundGrid::advance()
  {
    Assert(is_prepared, ExcMessage("prepare_motion() must come first"));
    is_prepared = false;
    current     = 1 - current;
    for (const auto &[node, vertex] : vertices)
      *vertex = Point<dim>(r_of(node), z_of(node));
  }

  void
  BackgroundGrid::move_to(const double travel)
  {
    prepare_motion(travel);
    advance();
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
