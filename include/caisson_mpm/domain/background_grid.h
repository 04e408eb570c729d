// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The background grid: a graded mesh of quadrilaterals that fits the rigid
// body, moves with it, and compresses below it.
//
// Grid lines: rows and columns. Vertical lines stay vertical, so that every
// cell is a trapezoid; rows bend only around a triangular tip or a cone. The
// position of a node is linear in the travel d of the body:
//   z = z0 - d                                      in the moving zone,
//   z = z0 - d (z0 - bottom) / (zone bottom - bottom)    below it,
//   z = z0 - d, or z0 - d (top - z0) / (top - zone top)  above the body,
// and around a cylinder whose radius grows from a by d
//   r = r0 + d (outer radius - r0) / (outer radius - a),  r0 >= a.
// For tests of the method without a body, the cells can be distorted: columns
// and the heights of nodes displaced irregularly.
#ifndef caisson_mpm_domain_background_grid_h
#define caisson_mpm_domain_background_grid_h

#include <caisson_mpm/bodies/rigid_body.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/materials/soil.h>

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/partitioner.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/mapping_q1.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace CaissonMPM
{
  using NodalData = dealii::LinearAlgebra::distributed::Vector<double>;

  /** The coordinates xi and eta of a place in a cell, 0 to 1 inside. */
  dealii::Point<2>
  to_reference(const Kernels::CellGeometry &g, const dealii::Point<2> &p);

  /** The place of these coordinates in a cell. */
  dealii::Point<2>
  to_position(const Kernels::CellGeometry &g, const dealii::Point<2> &x);

  /**
   * The mesh, its dofs and its motion.
   *
   * A rank knows the cells that it owns and the ghost cells around them, and
   * the nodes of both, by local numbers: cells in the order of the active cells
   * of the triangulation, nodes by the local index of their dof, those that it
   * owns first. Lines, and thus the place of every cell, are known to all. The
   * global number of a cell is the same on all ranks and for any number of
   * them.
   *
   * deal.II owns the mesh; the geometry that the kernels read is kept here and
   * is current after advance(), while the triangulation's own vertices follow
   * only when write_vertices() is called, before deal.II reads them.
   */
  class BackgroundGrid : public dealii::ParameterAcceptor
  {
  public:
    static constexpr unsigned int dim = 2;
    using Triangulation = dealii::parallel::distributed::Triangulation<dim>;

    enum class Zone : unsigned char
    {
      moving,
      compressing,
      upper
    };

    static constexpr unsigned int n_zones = 3;
    /** "moving", "compressing" or "upper". */
    static const char *
    name_of(const Zone zone)
    {
      constexpr const char *names[n_zones] = {"moving", "compressing", "upper"};
      return names[static_cast<unsigned int>(zone)];
    }

    /** The four sides of the domain, which are also its boundary ids. */
    enum Side : unsigned int
    {
      axis        = 0,
      outer       = 1,
      bottom_side = 2,
      top_side    = 3
    };

    explicit BackgroundGrid(const MPI_Comm communicator);

    /** Throws BadInput where the entries contradict each other. */
    void
    check_parameters() const;

    /**
     * Place the grid lines for the body and its whole travel, from -uplift to
     * travel. Throws BadInput, with the numbers to change, if the mesh cannot
     * hold it. Units: m.
     */
    void
    place_lines(const RigidBody &body,
                const Soil      &soil,
                const double     travel,
                const double     uplift = 0.);

    /** Create mesh, dofs and geometry from the lines. Collective. */
    void
    create_mesh();

    /**
     * Give each rank a part of about the same costs, and number its cells and
     * nodes anew, at the start of the travel. @p costs [n_global_cells] are used
     * of the cells that this rank owns. Collective.
     */
    void
    repartition(const std::vector<unsigned int> &costs);

    /** Compute the geometry at @p travel, which next() gives until advance(). */
    void
    prepare_motion(const double travel);

    /** Make the geometry of prepare_motion() the current one. */
    void
    advance();

    /** Write the current node positions into the triangulation. */
    void
    write_vertices();

    /** The height of a node at reference height z0. Units: m. */
    double
    height_at(const double z0, const double travel) const;

    /** Kernel views of the current geometry, and of the prepared one. */
    Kernels::GridView
    view() const;
    Kernels::GridView
    next() const;

    /** A vector of n doubles per node, interleaved; zero. */
    void
    reinit(NodalData &vector, const unsigned int components) const;

    MPI_Comm
    communicator() const
    {
      return triangulation.get_communicator();
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
      return n_columns() * n_rows();
    }
    unsigned int
    n_nodes() const
    {
      return node_r.size();
    }
    /** The nodes below this number belong to this rank. What is summed over
     * the nodes of all ranks must be summed over these. */
    unsigned int
    n_owned_nodes() const
    {
      return partitioner->locally_owned_size();
    }
    /** The rank that a cell belongs to. */
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
    unsigned int
    global_number(const unsigned int cell) const
    {
      return global_numbers[cell];
    }
    bool
    is_rigid(const unsigned int cell) const
    {
      return rigid[cell];
    }
    /** Whether a cell of the body belongs to the lid of a caisson. */
    bool
    is_lid(const unsigned int cell) const
    {
      return rigid[cell] && column_of(cell) < body_column_begin;
    }
    Zone
    zone(const unsigned int cell) const
    {
      return zones[cell];
    }
    /** The cell beyond face 0 (left), 1, 2 (below), 3; -1 where there is none,
     * or none that this rank knows. */
    int
    neighbor(const unsigned int cell, const unsigned int face) const
    {
      return neighbors[4 * cell + face];
    }
    /** Whether the face lies on a side of the domain. */
    bool
    at_side(const unsigned int cell, const unsigned int face) const
    {
      const unsigned int line = face < 2 ? column_of(cell) : row_of(cell);
      return line ==
             (face % 2 == 0 ? 0 : (face < 2 ? n_columns() : n_rows()) - 1);
    }
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
    unsigned int
    column_of(const unsigned int cell) const
    {
      return global_numbers[cell] % n_columns();
    }
    unsigned int
    row_of(const unsigned int cell) const
    {
      return global_numbers[cell] / n_columns();
    }
    unsigned int
    n_columns() const
    {
      return columns.size() - 1;
    }
    unsigned int
    n_rows() const
    {
      return rows.size() - 1;
    }
    /** The local number of a cell, or numbers::invalid_unsigned_int where this
     * rank does not know it. */
    unsigned int
    local_number(const unsigned int global_number) const
    {
      return local_numbers[global_number];
    }
    const Triangulation::active_cell_iterator &
    cell_iterator(const unsigned int cell) const
    {
      return iterators[cell];
    }
    /** The sides of the domain that a node lies on, as bits 1 << Side. */
    unsigned int
    sides_of(const unsigned int node) const
    {
      return node_sides[node];
    }
    double
    r_of(const unsigned int node) const
    {
      return node_r[node];
    }
    double
    z_of(const unsigned int node) const
    {
      return node_z[node];
    }

    /** The geometry at the start of the cell with this global number. */
    Kernels::CellGeometry
    initial_geometry(const unsigned int global_number) const;

    /** Whether the cell with this global number is one of the body. */
    bool
    is_body_cell(const unsigned int global_number) const
    {
      return inside_body(global_number % n_columns(),
                         global_number / n_columns());
    }

    /**
     * The smallest height that any cell takes of those that contain soil of
     * the cell with this global number at some time of the travel. Units: m.
     * Used for the spacing of material points.
     */
    double
    smallest_height_met(const unsigned int global_number) const;

    /**
     * Around an expanding cylinder: the smallest width, as seen at the start,
     * of the columns that soil of the cell with this global number will meet
     * if it flows without change of volume; else the width of the cell. Units:
     * m.
     */
    double
    smallest_width_met(const unsigned int global_number) const;

    bool
    axisymmetric() const
    {
      return geometry_text == "axisymmetric";
    }

    /** What the values per radian that the program computes with are worth:
     * 2 pi, or 1 in plane strain, where they are per metre. */
    double
    circumference() const
    {
      return axisymmetric() ? 2. * pi : 1.;
    }

    bool
    reaches_axis() const
    {
      return inner_radius == 0.;
    }

    /** Height of the domain below the soil surface at the start. Units: m. */
    double
    depth() const
    {
      return -bottom;
    }

    double
    total_travel() const
    {
      return travel_to_hold;
    }

    /** Lines for the header of the terminal output. */
    std::string
    description() const;

    Triangulation           triangulation;
    dealii::FE_Q<dim>       fe;
    dealii::DoFHandler<dim> dof_handler;
    dealii::MappingQ1<dim>  mapping;

  private:
    /** Number the cells and nodes of this rank's part of the mesh, at the start
     * of the travel: after each change of the parts. Collective. */
    void
    set_up_part();
    void
    place_columns(const RigidBody &body);
    void
    place_rows(const RigidBody &body, const Soil &soil);
    void
    check_travel() const;
    void
    check_travel_down() const;
    void
    check_travel_up() const;
    void
    check_expansion() const;
    double
    smallest_row_at(const double travel, const bool above_body) const;
    double
    radial_rate(const double r0) const;
    double
    finest_cell(const RigidBody &body, const double otherwise) const;
    void
    create_triangulation();
    void
    number_nodes();
    void
    collect_cells();
    double
    reference_height(const unsigned int column_line,
                     const unsigned int row_line) const;
    bool
    inside_body(const unsigned int column, const unsigned int row) const;
    void
    distort(const std::vector<double> &straight_rows);

    std::string  geometry_text  = "axisymmetric";
    double       inner_radius   = 0.;
    double       outer_radius   = 15.;
    double       bottom         = -18.;
    double       top            = 8.;
    double       cell_width     = 1.;
    double       cell_height    = 1.;
    double       growth         = 1.15;
    double       fine_width     = 0.2;
    double       fine_height    = 0.2;
    double       fine_size      = 0.;
    double       zone_below_tip = 1.5;
    std::string  upper_text     = "free";
    double       smallest_row   = 0.01;
    double       distortion     = 0.;
    unsigned int refinement     = 1;

    // lines at the start; rows before they bend around the tip
    std::vector<double> columns, rows;
    // displacement of the nodes by the distortion, [row][column]; or empty
    std::vector<std::vector<double>> node_shift;
    double                           zone_bottom = 0., zone_top = 0.;
    double                           travel_to_hold = 0., uplift_to_hold = 0.;
    // the body in line numbers [begin, end), and its lower surface by column
    unsigned int        body_column_begin = 0, body_column_end = 0;
    unsigned int        body_row_begin = 0, body_row_end = 0;
    unsigned int        lid_row_begin    = 0;  // body_row_end without a lid
    double              expanding_radius = 0.; // of a cylinder, else 0
    double              shoulder = 0., decay_below = 1., decay_above = 1.;
    std::vector<double> dip; // [columns] depth of the tip below the shoulder

    std::vector<Triangulation::active_cell_iterator> iterators;
    std::vector<unsigned int>                        global_numbers;
    std::vector<unsigned int>                        local_numbers; // by global
    std::vector<unsigned int>                        owners;
    std::vector<Kernels::CellNodes>                  nodes;
    std::vector<int>                                 neighbors;
    std::vector<int>                                 soil_neighbors;
    std::vector<unsigned char>                       rigid, flags;
    std::vector<Zone>                                zones;

    const unsigned int n_ranks_, rank;

    std::array<std::vector<Kernels::CellGeometry>, 2> geometries;
    unsigned int                                      current = 0;

    // x = node_start + node_rate travel, r and z
    std::vector<double>                                        node_r, node_z;
    std::vector<dealii::Point<dim>>                            node_start;
    std::vector<dealii::Tensor<1, dim>>                        node_rate;
    std::vector<unsigned int>                                  node_sides;
    std::vector<std::pair<unsigned int, dealii::Point<dim> *>> vertices;

    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
    mutable std::map<unsigned int,
                     std::shared_ptr<const dealii::Utilities::MPI::Partitioner>>
      partitioners;
  };
} // namespace CaissonMPM

#endif
