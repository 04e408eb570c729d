// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Where the soil ends and free water begins: the height of the soil in each
// column of the mesh, and how far each cell is filled with soil.
#ifndef caisson_mpm_water_soil_columns_h
#define caisson_mpm_water_soil_columns_h

#include <caisson_mpm/bodies/body_shape.h>
#include <caisson_mpm/domain/background_grid.h>
#include <caisson_mpm/domain/material_points.h>

#include <vector>

namespace CaissonMPM
{
  /** Which sides of the domain keep the pressure of the open water. */
  struct OpenSides
  {
    bool outer = false, bottom = false, surface = true;
  };

  /** What is beyond a face of a cell, or beyond a node. */
  enum class Beyond : unsigned char
  {
    cell,
    plug,    // the water above the mudline inside the body
    outside, // the open water
    bottom   // of the mesh, if it is open
  };

  /** The known pressures; that of the open water is 0. Units: Pa. */
  struct KnownPressures
  {
    double plug = 0., bottom = 0.;

    double
    operator[](const Beyond beyond) const
    {
      return beyond == Beyond::plug   ? plug :
             beyond == Beyond::bottom ? bottom :
                                        0.;
    }
  };

  /**
   * The height of a column follows from the tops of its highest points, and not
   * from how full its cells are: a cell with three points in its height fills
   * in thirds, but points move continuously.
   *
   * Below the mudline every cell that is not the body's belongs to the ground
   * water, also if a gap beside the wall has no point in it.
   */
  class SoilColumns
  {
  public:
    /** Where the pore water of a column ends. */
    enum class Side : unsigned char
    {
      plug,  // inside the body
      body,  // at its lower surface
      beyond // outside, or there is no body
    };

    /** Find the columns of the mesh that lie inside the body. Not collective.
     */
    void
    initialize(const BackgroundGrid &grid, const BodyShape &body);

    /** Find the height of the soil in all columns. Collective. */
    void
    find(const BackgroundGrid &grid, const MaterialPoints &points);

    /** Whether the heights are known. */
    bool
    is_found() const
    {
      return !heights.empty();
    }

    /** Return the share of the height of a cell that is below the mudline, 0
     * for cells above it and for those of the body, at least least_filled for
     * all others. [n_cells] */
    const std::vector<double> &
    filled() const
    {
      return filled_;
    }

    /** Return whether the mudline is in a cell, or at its upper face. */
    bool
    is_top(const unsigned int cell) const
    {
      return top[cell];
    }

    /** Return where the column of a cell ends, or the part of it above a step
     * of the wall. */
    Side
    side_of(const unsigned int cell) const
    {
      return sides_of_cells[cell];
    }

    /** Return what is beyond each node where the pressure is known, and cell
     * elsewhere; right for the nodes of this rank. [n_nodes] */
    std::vector<Beyond>
    find_beyond(const BackgroundGrid &grid, const OpenSides &open) const;
    /** Return the mean height of the soil in the columns of a side, by area.
     * Units: m. */
    double
    mean_height(const Side side) const;

    /** Return the height of the soil beside the inner wall, or the rings there,
     * or beside the outer one. Units: m. */
    double
    height_at_wall(const Side side) const;

    /** Return the largest change of a height against those of @p other, over
     * the height of the cells there. */
    double
    largest_change(const SoilColumns &other) const;

    /** Return the share of the lid's area that the soil touches, 0 where the
     * mesh has no lid. Collective. */
    double
    touched_share_of_lid(const BackgroundGrid &grid) const;

    /** Soil that fills a cell to this share touches the lid above it. */
    static constexpr double touching = .98;

    /** Below this share, the conductance of a cut cell grows no more. */
    static constexpr double least_filled = .002;

  private:
    /** Points at the top of the soil. */
    struct Top
    {
      unsigned int column, n_columns; // of the lattice
      double       height, size, volume;
    };

    /** Return the side of a cell above the tip in a column of the body: soil
     * may be on a step of the wall. */
    static Side
    side_above_step(const GridLines &lines,
                    const BodyShape &body,
                    const GlobalCell cell);

    std::vector<Top>
    find_tops(const BackgroundGrid &grid, const MaterialPoints &points) const;
    void
    fill_cells(const BackgroundGrid &grid);
    /** Find the cells with water that have none above. */
    void
    find_tops_of_water(const BackgroundGrid &grid);

    // of the columns of the lattice [n_columns]
    std::vector<Side>   sides;
    unsigned int        at_inner_wall = 0; // column beside wall and rings
    std::vector<double> left, width;       // m
    std::vector<double> heights;           // m; of no use at the body
    std::vector<double> cell_height;       // m, of the cell at the mudline
    bool                axisymmetric = true;
    double              tolerance    = 0.; // of heights, m
    // [n_cells]
    std::vector<Side>          sides_of_cells;
    std::vector<unsigned int>  first_column, n_columns;
    std::vector<double>        filled_;
    std::vector<unsigned char> top, is_below_body;
  };
} // namespace CaissonMPM

#endif
