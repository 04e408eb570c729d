// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The lines of the background grid: a graded mesh of quadrilaterals that fits
// the rigid body, moves with it, and compresses below it.
//
// The lines are columns and rows. Vertical lines stay vertical, so that every
// cell is a trapezoid; rows bend only around a triangular tip or a cone. The
// position of a node is linear in the travel d of the body:
//   z = z0 - d                                      in the moving zone,
//   z = z0 - d (z0 - bottom) / (zone bottom - bottom)    below it,
//   z = z0 - d, or z0 - d (top - z0) / (top - zone top)  above the body,
// and around a cylinder whose radius grows from a by d
//   r = r0 + d (outer radius - r0) / (outer radius - a),  r0 >= a.
// Cells near the body can be halved several times (cell_tree.h). The lines that
// are meant here are then those of the lattice of the smallest cells, and a
// node that hangs in the middle of an edge stays on it.
//
// For tests of the method without a body, the cells can be distorted: columns
// and the heights of nodes are displaced irregularly.
#ifndef caisson_mpm_domain_grid_lines_h
#define caisson_mpm_domain_grid_lines_h

#include <caisson_mpm/base/conventions.h>
#include <caisson_mpm/base/expression.h>
#include <caisson_mpm/base/parameter_origins.h>
#include <caisson_mpm/base/section.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/bodies/body_shape.h>
#include <caisson_mpm/domain/cell_tree.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/materials/soil.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  /**
   * Where the grid lines are, how they move, and which cells are the body's.
   *
   * Everything here follows from the entries, the body and the soil alone, so
   * that all ranks know all lines; there is no mesh, and nothing is collective.
   * place() comes first, once; after it the lines do not change.
   */
  class GridLines : public Section
  {
  public:
    enum class Zone : unsigned char
    {
      moving,
      compressing
    };

    static constexpr unsigned int n_zones = 2;
    /** "moving" or "compressing". */
    static const char *
    name_of(const Zone zone)
    {
      constexpr const char *names[n_zones] = {"moving", "compressing"};
      return names[static_cast<unsigned int>(zone)];
    }

    /** The four sides of the domain, in the order of the faces of a cell. */
    enum class Side : unsigned int
    {
      axis,
      outer,
      bottom,
      top
    };

    GridLines();

    /** Throw BadInput where the entries contradict each other. */
    void
    check_parameters() const;

    /** Report which entries the other choices leave without effect. */
    void
    name_unused_entries(ParameterOrigins &origins) const override;

    /**
     * Place the lines for the body and its whole travel, from -uplift to
     * travel. Throws BadInput, with the numbers to change, if the mesh cannot
     * hold it. Units: m.
     */
    void
    place(const BodyShape &body,
          const Soil      &soil,
          const double     travel,
          const double     uplift = 0.);

    /** Return the number of columns, and of rows, of the lattice of the
     * smallest cells. */
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
    unsigned int
    n_cells() const
    {
      return tree_.n_cells();
    }
    /** Return which blocks of the lattice are cells. */
    const CellTree &
    tree() const
    {
      return tree_;
    }
    /** Return the first column, and row, of the lattice in a cell. */
    unsigned int
    column_of(const GlobalCell cell) const
    {
      return tree_.block(cell).column;
    }
    unsigned int
    row_of(const GlobalCell cell) const
    {
      return tree_.block(cell).row;
    }

    /** Return the z of the lines at the start that no cell of any size crosses,
     * from below. Units: m. */
    std::vector<double>
    row_lines() const;

    /** Return where the node on these two lines is at the start. */
    dealii::Point<2>
    node_start(const unsigned int column_line,
               const unsigned int row_line) const;

    /** Return how far this node moves per travel of the body. */
    dealii::Tensor<1, 2>
    node_rate(const unsigned int column_line,
              const unsigned int row_line) const;

    /** Return the sides of the domain that this node lies on, as bits
     * 1 << Side. */
    unsigned int
    sides_of(const unsigned int column_line, const unsigned int row_line) const;

    /** Return the height of a node at reference height z0. Units: m. */
    double
    height_at(const double z0, const double travel) const;

    /** Return the number that all cell sizes of the entries are divided by. */
    double
    number_to_divide_by() const
    {
      return refinement;
    }

    /** Return the geometry of a cell at the start. */
    Kernels::CellGeometry
    initial_geometry(const GlobalCell cell) const;

    Zone
    zone_of(const GlobalCell cell) const;

    /** Return whether a cell is one of the body. */
    bool
    is_body_cell(const GlobalCell cell) const
    {
      return inside_body(column_of(cell), row_of(cell));
    }

    /** Return whether a cell belongs to the lid of a caisson. */
    bool
    is_lid_cell(const GlobalCell cell) const
    {
      return lid.contains(column_of(cell), row_of(cell));
    }

    /** Return whether a cell is one of the lowest of the body. */
    bool
    is_lowest_cell(const GlobalCell cell) const
    {
      return is_body_cell(cell) && row_of(cell) == body_row_begin;
    }

    /**
     * Return the smallest height that any cell takes of those that contain
     * soil of this cell at some time of the travel. Units: m. Used for the
     * spacing of material points.
     */
    double
    smallest_height_met(const GlobalCell cell) const;

    /**
     * Return the same for the width; around an expanding cylinder as seen at
     * the start, if the soil flows without change of volume. Units: m.
     */
    double
    smallest_width_met(const GlobalCell cell) const;

    bool
    axisymmetric() const
    {
      return geometry == Geometry::axisymmetric;
    }

    /** Return what the values per radian that the program computes with are
     * worth: 2 pi, or 1 in plane strain, where they are per meter. */
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

    /** Return the height of the domain below the soil surface at the start.
     * Units: m. */
    double
    depth() const
    {
      return -bottom;
    }

    /** Return the largest travel of the body down that the lines have been
     * placed for, and the largest one up. Units: m. */
    double
    total_travel() const
    {
      return travel_to_hold;
    }
    double
    total_uplift() const
    {
      return uplift_to_hold;
    }

    /** Return a warning if the body has smaller cells than Fine cell size, or
     * an empty text; the edges of a footing leave half a cell. */
    std::string
    known_limit(const BodyShape &body) const;

    /** Return a line for the header of the terminal output. */
    std::string
    description() const;

  private:
    enum class Geometry
    {
      axisymmetric,
      plane_strain
    };

    void
    declare_domain();
    void
    declare_cells();
    void
    declare_refinement();
    void
    declare_motion();
    /** A line that the grid must have, and why, for messages. */
    struct FixedLine
    {
      double      place;
      std::string reason;
    };

    /** What is wanted of the lines in one direction. Units: m. */
    struct Spacing
    {
      std::vector<FixedLine>        fixed;
      std::function<double(double)> size; // of the cells at a place
      double                        finest;
      std::string                   finest_entry; // that sets it, or empty
    };

    /** Find the zones that follow the body. */
    void
    follow(const BodyShape &body);
    /**
     * Return by how much the mesh puts the free edges of a footing inside its
     * sides: half a cell, if the body has a flat base on the soil surface and
     * sinks by no more than that; otherwise 0. A node at the edge of a footing
     * moves with it, and the velocity falls to that of the free surface within
     * the next cell, of width h. The pressure p of the footing does the work
     * p V int N ds = p V h / 2 there, so that the mesh carries the load of a
     * footing that is wider by h / 2. A body that goes deeper needs its whole
     * volume. Units: m.
     */
    double
    inset_of_footing(const BodyShape &body) const;

    /** Return where the mesh has the left and right side of the body. */
    std::pair<double, double>
    sides_of_body(const BodyShape &body) const;
    /** Return the lowest face above the tip that must be level. Units: m. */
    static double
    lowest_ledge(const BodyShape &body);
    /** Throw BadInput where steps and rings of the wall need smaller cells than
     * those of this size, which an entry sets, between lines at a distance. */
    static void
    check_parts(const BodyShape   &body,
                const double       cell,
                const double       line_spacing,
                const std::string &entry);
    Spacing
    spacing_in_r(const BodyShape &body) const;
    Spacing
    spacing_in_z(const BodyShape &body, const Soil &soil) const;
    /** Return the distance from the fine cells beyond which cells grow faster
     * with a growth of auto. Units: m. */
    static double
    reach_of_yielding(const BodyShape &body);
    /** Return the size of cells at a distance from the fine ones, between
     * @p fine and the entry @p coarse; with a growth of auto they grow faster
     * beyond @p reach. Units: m. */
    double
    size_at(const double distance,
            const double reach,
            const double fine,
            const double coarse) const;
    Spacing
    even_spacing(const std::vector<FixedLine> &fixed, const double size) const;
    /** Return the size of the finest cells and the entry that sets it. */
    std::pair<double, std::string>
    finest_cell(const BodyShape  &body,
                const double      otherwise,
                const std::string entry) const;
    double
    smallest_row_height() const
    {
      return smallest_row / refinement;
    }
    static std::vector<double>
    lines_of(const Spacing &spacing);
    /** Sort the lines and return the number of cells from each to the next. */
    static std::vector<double>
    cells_between(std::vector<FixedLine>              &fixed,
                  const std::function<double(double)> &size);
    void
    check_number_of_cells(const Spacing &in_r, const Spacing &in_z) const;
    static std::string
    reason_for_number(const std::string &what,
                      const std::string &coordinate,
                      const std::string &entry,
                      const double       size,
                      Spacing            spacing);
    /** Find the lines at the body, and its lower surface. */
    void
    find_body(const BodyShape &body);
    void
    find_dips(const BodyShape &body);
    void
    distort_columns();
    void
    distort_rows(const std::vector<FixedLine> &straight_rows);

    Expression
    parse_region() const;
    /** Whether the tip is a wedge, with its edge between both faces. */
    static bool
    is_wedge(const BodyShape &body);
    /** Throw BadInput where halving cells does not lead to the cells that the
     * body asks for. */
    void
    check_refinement(const BodyShape &body) const;
    /** Return the distance from the tip within which cells are the smallest. */
    double
    distance_of_tip(const BodyShape &body) const;

    /** The least distance (m): that from which rows that follow a tip with an
     * edge are level again where cells are no longer halved. */
    double
    least_distance(const BodyShape &body) const;
    /** Return how often the cell of the coarse lines is to be halved for a
     * block. */
    unsigned int
    wanted_level(const CellBlock  &block,
                 const BodyShape  &body,
                 const Expression &region) const;
    bool
    is_in_region(const CellBlock &block, const Expression &region) const;
    void
    make_cells(const BodyShape &body);
    /** Throw BadInput if a cell is too flat where the refined region ends. */
    void
    check_heights(const BodyShape &body) const;
    /** Return where a node would be if it did not hang. */
    dealii::Point<2>
    free_node_start(const LatticeNode &node) const;
    dealii::Tensor<1, 2>
    free_node_rate(const LatticeNode &node) const;
    /** Return a length with its unit, for messages. */
    static std::string
    meters(const double x)
    {
      return to_text(x) + " m";
    }

    void
    check_travel() const;
    void
    check_travel_down() const;
    void
    check_expansion() const;
    /** The height of a row at the end of the travel. Units: m. */
    double
    height_of_row(const unsigned int row) const;
    /** Return the lines that keep a row apart from others, if it lies between
     * two fixed lines, or else nothing. */
    std::string
    neighbors_of_row(const unsigned int row) const;

    double
    radial_rate(const double r0) const;
    double
    reference_height(const unsigned int column_line,
                     const unsigned int row_line) const;
    /** Throw BadInput: this row becomes too flat. */
    [[noreturn]] void
    refuse_flat_row(const unsigned int row) const;
    /** Return the height of a line in a column after a travel. */
    double
    line_height(const unsigned int column,
                const unsigned int row_line,
                const double       travel) const;
    /** Return the first row from @p first on that reaches above the height z in
     * a column. */
    unsigned int
    first_row_above(const unsigned int column,
                    const unsigned int first,
                    const double       z,
                    const double       travel) const;
    bool
    inside_body(const unsigned int column, const unsigned int row) const;
    /** Return smallest_width_met() and smallest_height_met() where the body
     * moves down or up. */
    std::array<double, 2>
    smallest_size_met(const GlobalCell cell) const;

    Geometry              geometry     = Geometry::axisymmetric;
    double                inner_radius = 0.;
    double                outer_radius = 15.;
    double                bottom       = -18.;
    double                top          = 8.;
    double                cell_width   = 1.;
    double                cell_height  = 1.;
    double                fine_width   = 0.2;
    double                fine_height  = 0.2;
    std::optional<double> growth;    // or auto
    std::optional<double> fine_size; // or auto
    double                zone_below_tip = 1.5;
    double                smallest_row   = 0.01;
    double                distortion     = 0.;
    double                refinement     = 1.;
    unsigned int          levels         = 0; // at the tip
    unsigned int          levels_at_wall = 0;
    std::optional<double> refined_distance; // or auto
    std::string           refined_region;
    unsigned int          largest_number = 1000000;

    // lines of the lattice at the start; rows before they bend around the tip
    std::vector<double>    columns, rows;
    CellTree               tree_;
    std::vector<FixedLine> fixed_rows;
    // displacement of the nodes by the distortion, [row][column]; or empty
    std::vector<std::vector<double>> node_shift;
    double                           zone_bottom = 0., zone_top = 0.;
    double                           travel_to_hold = 0., uplift_to_hold = 0.;
    /** Columns and rows [begin, end). */
    struct Range
    {
      unsigned int column_begin = 0, column_end = 0;
      unsigned int row_begin = 0, row_end = 0;

      bool
      contains(const unsigned int column, const unsigned int row) const
      {
        return column >= column_begin && column < column_end &&
               row >= row_begin && row < row_end;
      }
    };
    // the parts of the body, the first of which is at the tip, and its lid
    std::vector<Range> body_ranges;
    Range              lid;
    unsigned int       body_column_begin = 0, body_column_end = 0; // at the tip
    unsigned int       body_row_begin   = 0;
    double             expanding_radius = 0.; // of a cylinder, else 0
    double             shoulder = 0., decay_below = 1., decay_above = 1.;
    std::vector<double> dip; // [columns] of the rows below the shoulder
  };
} // namespace CaissonMPM

#endif
