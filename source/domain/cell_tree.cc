// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/domain/cell_tree.h>

namespace CaissonMPM
{
  namespace
  {
    constexpr unsigned int none = static_cast<unsigned int>(-1);
  }

  CellTree::CellTree(const unsigned int n_columns,
                     const unsigned int n_rows,
                     const unsigned int levels)
    : n_columns(n_columns)
    , n_rows(n_rows)
    , n_levels(levels)
  {
    const unsigned int size = root_size();
    for (unsigned int j = 0; j < n_rows; ++j)
      for (unsigned int i = 0; i < n_columns; ++i)
        branches.push_back({{i * size, j * size, size}, none, none});
    number_cells();
  }

  unsigned int
  CellTree::level_of(const CellBlock &block) const
  {
    unsigned int level = 0;
    for (unsigned int size = block.size; size < root_size(); size *= 2)
      ++level;
    return level;
  }

  unsigned int
  CellTree::find(const unsigned int column, const unsigned int row) const
  {
    unsigned int branch = (row >> n_levels) * n_columns + (column >> n_levels);
    for (unsigned int bit = n_levels; branches[branch].first_child != none;)
      {
        --bit;
        branch = branches[branch].first_child + ((column >> bit) & 1u) +
                 2u * ((row >> bit) & 1u);
      }
    return branch;
  }

  GlobalCell
  CellTree::cell_at(const unsigned int column, const unsigned int row) const
  {
    return GlobalCell(branches[find(column, row)].number);
  }

  // ------------------------------------------------------------ refinement

  void
  CellTree::split(const unsigned int branch)
  {
    const CellBlock    block     = branches[branch].block;
    const unsigned int half      = block.size / 2;
    branches[branch].first_child = branches.size();
    for (unsigned int k = 0; k < 4; ++k)
      branches.push_back(
        {{block.column + half * (k % 2), block.row + half * (k / 2), half},
         none,
         none});
  }

  void
  CellTree::refine(const Levels      &wanted,
                   const Kind        &kind,
                   const unsigned int largest_number)
  {
    // what is split comes again further on, as its four parts
    for (unsigned int i = 0;
         i < branches.size() && branches.size() <= 2 * largest_number;
         ++i)
      if (branches[i].first_child == none &&
          level_of(branches[i].block) < wanted(branches[i].block))
        split(i);
    for (bool again = true; again;)
      {
        again = false;
        for (unsigned int i = 0;
             i < branches.size() && branches.size() <= 2 * largest_number;
             ++i)
          if (branches[i].first_child == none)
            again = balance(i, kind) || again;
      }
    number_cells();
  }

  bool
  CellTree::balance(const unsigned int leaf, const Kind &kind)
  {
    const CellBlock block  = branches[leaf].block;
    const bool      is_one = kind(block);
    bool            any    = false;
    for (int dj = -1; dj <= 1; ++dj)
      for (int di = -1; di <= 1; ++di)
        {
          // a place in the block of the same size that lies beside it
          const long column = static_cast<long>(block.column) +
                              di * static_cast<long>(block.size),
                     row = static_cast<long>(block.row) +
                           dj * static_cast<long>(block.size),
                     size = root_size();
          if (column < 0 || row < 0 || column >= n_columns * size ||
              row >= n_rows * size)
            continue;
          const unsigned int other       = find(column, row);
          const CellBlock    beside      = branches[other].block;
          const bool         shares_face = di == 0 || dj == 0;
          const unsigned int largest =
            shares_face && kind(beside) != is_one ? block.size : 2 * block.size;
          if (beside.size > largest)
            {
              split(other);
              any = true;
            }
        }
    return any;
  }

  void
  CellTree::number_cells()
  {
    cells.clear();
    std::vector<unsigned int> waiting;
    for (unsigned int root = n_columns * n_rows; root-- > 0;)
      waiting.push_back(root);
    while (!waiting.empty())
      {
        Branch &branch = branches[waiting.back()];
        waiting.pop_back();
        if (branch.first_child == none)
          {
            branch.number = cells.size();
            cells.push_back(branch.block);
          }
        else
          for (unsigned int k = 4; k-- > 0;)
            waiting.push_back(branch.first_child + k);
      }
  }

  // ------------------------------------------------------------ nodes

  std::optional<std::array<LatticeNode, 2>>
  CellTree::masters_of(const LatticeNode &node) const
  {
    using Edge = std::array<LatticeNode, 2>;
    if (n_levels == 0)
      return {};
    for (unsigned int k = 0; k < 4; ++k)
      {
        // the cell to the upper right of the node, and the others around it
        if (node.column < k % 2 || node.row < k / 2)
          continue;
        const unsigned int column = node.column - k % 2, row = node.row - k / 2,
                           size = root_size();
        if (column >= n_columns * size || row >= n_rows * size)
          continue;
        const CellBlock    b = branches[find(column, row)].block;
        const unsigned int x = node.column - b.column, y = node.row - b.row;
        if (x > 0 && x < b.size)
          return Edge{{{b.column, node.row}, {b.column + b.size, node.row}}};
        if (y > 0 && y < b.size)
          return Edge{{{node.column, b.row}, {node.column, b.row + b.size}}};
      }
    return {};
  }
} // namespace CaissonMPM
