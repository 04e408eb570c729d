// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The cells of the background grid as blocks of a lattice, some of them halved:
// a quadtree in each cell of the coarse lines, known on all ranks.
#ifndef caisson_mpm_domain_cell_tree_h
#define caisson_mpm_domain_cell_tree_h

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace CaissonMPM
{
  /** The number of a cell of the whole grid, the same on all ranks and for any
   * number of them: row by row of the coarse lines, from the lower left cell,
   * and in a cell that is halved the lower left part, the lower right one and
   * the upper ones. The cells that a rank knows have local numbers besides
   * (BackgroundGrid), of type unsigned int. */
  enum class GlobalCell : unsigned int
  {
  };

  /** Return the place of a cell in a list of [n_global_cells]. */
  constexpr unsigned int
  index_of(const GlobalCell cell)
  {
    return static_cast<unsigned int>(cell);
  }

  /** A square of the lattice of the finest lines: its lower left cell, and how
   * many cells of the lattice it has in each direction. */
  struct CellBlock
  {
    unsigned int column, row, size;
  };

  /** The crossing of two lines of the lattice. */
  struct LatticeNode
  {
    unsigned int column, row;
  };

  /**
   * Which blocks of the lattice are cells.
   *
   * The coarse lines make n_columns x n_rows roots. Each can be halved in both
   * directions up to @p levels times; the lattice has all lines that this would
   * give. Cells that touch differ by one level at most. Nothing here is
   * collective.
   */
  class CellTree
  {
  public:
    /** Say something of a block. */
    using Levels = std::function<unsigned int(const CellBlock &)>;
    using Kind   = std::function<bool(const CellBlock &)>;

    CellTree() = default;

    /** Roots that are the cells. */
    CellTree(const unsigned int n_columns,
             const unsigned int n_rows,
             const unsigned int levels = 0);

    /**
     * Halve the cells until each has the level that @p wanted gives for it, and
     * more where neighbors need it: they differ by one level at most, and not
     * at all where one of them is of a kind that the other is not. Stop where
     * there are more than @p largest_number cells.
     */
    void
    refine(const Levels      &wanted,
           const Kind        &kind,
           const unsigned int largest_number);

    unsigned int
    n_cells() const
    {
      return cells.size();
    }

    unsigned int
    levels() const
    {
      return n_levels;
    }

    /** Return the size of a root as a block. */
    unsigned int
    root_size() const
    {
      return 1u << n_levels;
    }

    const CellBlock &
    block(const GlobalCell cell) const
    {
      return cells[index_of(cell)];
    }

    /** Return the cell that contains this one of the lattice. */
    GlobalCell
    cell_at(const unsigned int column, const unsigned int row) const;

    /** Return how often the root of a block was halved to make it. */
    unsigned int
    level_of(const CellBlock &block) const;

    /** Return the ends of the edge in whose middle a node hangs, if it does. */
    std::optional<std::array<LatticeNode, 2>>
    masters_of(const LatticeNode &node) const;

  private:
    /** A node of the tree. */
    struct Branch
    {
      CellBlock    block;
      unsigned int first_child; // of four in a row, or none
      unsigned int number;      // of the cell, without children
    };

    unsigned int
    find(const unsigned int column, const unsigned int row) const;
    void
    split(const unsigned int branch);
    /** Split the neighbors of a leaf that are too coarse. */
    bool
    balance(const unsigned int leaf, const Kind &kind);
    void
    number_cells();

    unsigned int           n_columns = 0, n_rows = 0, n_levels = 0;
    std::vector<Branch>    branches; // the roots first
    std::vector<CellBlock> cells;
  };
} // namespace CaissonMPM

#endif
