// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The mesh of the background grid: what this rank holds of it, and its motion.
#ifndef caisson_mpm_domain_background_grid_h
#define caisson_mpm_domain_background_grid_h

#include <caisson_mpm/domain/cell_geometry.h>
#include <caisson_mpm/domain/grid_lines.h>
#include <caisson_mpm/domain/hanging_nodes.h>
#include <caisson_mpm/kernels/layout.h>

#include <deal.II/base/partitioner.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/mapping_q1.h>

#include <boost/signals2/signal.hpp>

#include <array>
#include <map>
#include <memory>
#include <vector>

namespace CaissonMPM
{
  /**
   * The mesh of the grid lines, its dofs and its motion.
   *
   * A rank knows the cells that it owns and the ghost cells around them, and
   * the nodes of both, by local numbers: cells in the order of their global
   * numbers, nodes by the local index of their dof, those that it owns first.
   * Where a function takes a plain number of a cell, it is the local one; a
   * GlobalCell is the number of a cell for all ranks.
   *
   * deal.II owns the mesh: advance() moves the vertices of the triangulation,
   * so that mapping() is always the moving mesh. The kernels read a copy of the
   * geometry by cells.
   */
  class BackgroundGrid
  {
  public:
    static constexpr unsigned int dim = 2;
    using Triangulation = dealii::parallel::distributed::Triangulation<dim>;
    using Zone          = GridLines::Zone;
    using Side          = GridLines::Side;

    /** An object that keeps values of the cells or nodes of this rank connects
     * itself to these. */
    struct Signals
    {
      /** The cells and nodes are still those of before. */
      boost::signals2::signal<void()> before_change;
      /** The rank has other cells and nodes, or the same ones, whose values are
       * to be built again; the mesh is at the start of the travel. */
      boost::signals2::signal<void()> after_change;
    };
    Signals signals;

    /** The lines must outlive the grid, and be placed before create_mesh(). */
    BackgroundGrid(const GridLines &lines, const MPI_Comm communicator);

    /** Create mesh, dofs and geometry from the lines. Collective. */
    void
    create_mesh();

    /**
     * Give each rank a part of about the same costs, and renumber its cells and
     * nodes, at the start of the travel. @p costs [n_global_cells] are used
     * of the cells that this rank owns. Collective.
     */
    void
    repartition(const std::vector<unsigned int> &costs);

    /** Let all that know the cells and nodes of this rank build their values
     * again, as after a change of the parts. Collective. */
    void
    rebuild();

    /** Compute the geometry at @p travel, which next() gives until advance(). */
    void
    prepare_motion(const double travel);

    /** Make the geometry of prepare_motion() the current one, also in the
     * triangulation. */
    void
    advance();

    /** Compute the geometry at @p travel and make it the current one. */
    void
    move_to(const double travel);

    /** Return a kernel view of the current geometry. Valid until
     * prepare_motion() is called a second time, or the parts change. */
    Kernels::GridView
    view() const;

    /** Return a kernel view of the prepared geometry. */
    Kernels::GridView
    next() const;

    /** Make a vector of n doubles per node, interleaved; zero. */
    void
    reinit(NodalData &vector, const unsigned int components) const;

    const GridLines &
    lines() const
    {
      return lines_;
    }
    const Triangulation &
    triangulation() const
    {
      return triangulation_;
    }
    const dealii::DoFHandler<dim> &
    dof_handler() const
    {
      return dof_handler_;
    }
    /** Return the mapping of the current geometry. */
    const dealii::Mapping<dim> &
    mapping() const
    {
      return mapping_;
    }

    MPI_Comm
    communicator() const
    {
      return triangulation_.get_communicator();
    }
    unsigned int
    n_ranks() const
    {
      return n_ranks_;
    }
    bool
    is_first_rank() const
    {
      return rank == 0;
    }

    unsigned int
    n_cells() const
    {
      return nodes.size();
    }
    unsigned int
    n_global_cells() const
    {
      return lines_.n_cells();
    }
    unsigned int
    n_nodes() const
    {
      return node_sides.size();
    }
    /** Return the number of cells of the body, of all ranks. */
    unsigned int
    n_body_cells() const;
    /** Return the mass of a body of this density, which is that of its cells at
     * the start of the travel. Collective. Units: kg/m3; kg. */
    double
    mass_of_body(const double density) const;
    /** Return the number of nodes that this rank owns: those with a smaller
     * local number. What is summed over the nodes of all ranks must be summed
     * over these. */
    unsigned int
    n_owned_nodes() const
    {
      return partitioner->locally_owned_size();
    }
    /** Return the nodes that follow others. */
    const HangingNodes &
    hanging_nodes() const
    {
      return hanging_nodes_;
    }
    /** Return the rank that a cell belongs to. */
    unsigned int
    owner_of(const unsigned int cell) const
    {
      return owners[cell];
    }
    bool
    is_owned(const unsigned int cell) const
    {
      return owners[cell] == rank;
    }
    GlobalCell
    global_number(const unsigned int cell) const
    {
      return global_numbers[cell];
    }
    /** Return the local number of a cell, or numbers::invalid_unsigned_int
     * where this rank does not know it. */
    unsigned int
    local_number(const GlobalCell cell) const
    {
      return local_numbers[index_of(cell)];
    }
    /** Return whether this rank owns a cell. */
    bool
    is_owned(const GlobalCell cell) const
    {
      const unsigned int local = local_number(cell);
      return local != dealii::numbers::invalid_unsigned_int && is_owned(local);
    }
    bool
    is_rigid(const unsigned int cell) const
    {
      return rigid[cell];
    }
    /** Return whether a cell of the body belongs to the lid of a caisson. */
    bool
    is_lid(const unsigned int cell) const
    {
      return lines_.is_lid_cell(global_numbers[cell]);
    }
    Zone
    zone(const unsigned int cell) const
    {
      return lines_.zone_of(global_numbers[cell]);
    }
    /** Return the cell beyond face 0 (left), 1, 2 (below), 3; -1 where there
     * is none, or none that this rank knows. Where two smaller cells lie beyond
     * it, this is the left or lower one, or with @p second the other. */
    int
    neighbor(const unsigned int cell,
             const unsigned int face,
             const bool         second = false) const
    {
      const int *const both = &neighbors[place_of_neighbor(cell, face)];
      return second && both[1] >= 0 ? both[1] : both[0];
    }
    /** Return whether the face lies on a side of the domain. */
    bool
    at_side(const unsigned int cell, const unsigned int face) const;

    const Kernels::CellGeometry &
    geometry(const unsigned int cell) const
    {
      return geometries[current][cell];
    }
    const Kernels::CellNodes &
    cell_nodes(const unsigned int cell) const
    {
      return nodes[cell];
    }
    const Triangulation::active_cell_iterator &
    cell_iterator(const unsigned int cell) const
    {
      return iterators[cell];
    }
    /** Return whether a node lies on a side of the domain. */
    bool
    is_at(const unsigned int node, const Side side) const
    {
      return node_sides[node] & (1u << static_cast<unsigned int>(side));
    }
    double
    r_of(const unsigned int node) const
    {
      return node_position.local_element(dim * node + radial);
    }
    double
    z_of(const unsigned int node) const
    {
      return node_position.local_element(dim * node + vertical);
    }

    bool
    axisymmetric() const
    {
      return lines_.axisymmetric();
    }
    double
    circumference() const
    {
      return lines_.circumference();
    }

  private:
    static constexpr unsigned int
    place_of_neighbor(const unsigned int cell, const unsigned int face)
    {
      return Kernels::neighbors_per_cell * cell +
             Kernels::neighbors_per_face * face;
    }
    void
    create_triangulation();
    /** Halve cells of the triangulation until they are those of the lines. */
    void
    refine_triangulation();
    /** Return the number of a cell of the triangulation. */
    GlobalCell
    number_of(const Triangulation::cell_iterator &cell) const;
    /** Number the cells and nodes of this rank's part of the mesh, at the start
     * of the travel: after each change of the parts. Collective. */
    void
    number_part();
    void
    number_cells();
    void
    find_dofs();
    void
    find_neighbors();
    void
    find_hanging_nodes();
    void
    flag_cells_at_body();
    void
    number_nodes();

    const GridLines        &lines_;
    Triangulation           triangulation_;
    dealii::FE_Q<dim>       fe;
    dealii::DoFHandler<dim> dof_handler_;
    dealii::MappingQ1<dim>  mapping_;
    const unsigned int      n_ranks_, rank;

    // [n_cells] or, neighbors, [n_cells][4][neighbors_per_face]
    std::vector<Triangulation::active_cell_iterator> iterators;
    std::vector<GlobalCell>                          global_numbers;
    std::vector<unsigned int>                        owners;
    std::vector<Kernels::CellNodes>                  nodes;
    std::vector<int>                                 neighbors;
    std::vector<int>                                 soil_neighbors;
    std::vector<unsigned char>                       rigid, flags;
    std::vector<unsigned int> local_numbers; // [n_global_cells]

    std::array<std::vector<Kernels::CellGeometry>, 2> geometries;
    unsigned int                                      current     = 0;
    bool                                              is_prepared = false;

    HangingNodes hanging_nodes_;

    // FE_Q fields of r and z: position = start + travel * rate
    NodalData                 node_start, node_rate, node_position;
    std::vector<unsigned int> node_sides;
    std::vector<std::pair<unsigned int, dealii::Point<dim> *>> vertices;

    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
    mutable std::map<unsigned int,
                     std::shared_ptr<const dealii::Utilities::MPI::Partitioner>>
      partitioners;
  };
} // namespace CaissonMPM

#endif
