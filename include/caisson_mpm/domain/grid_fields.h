// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Fields on the nodes or in the cells of the grid, independent of how the ranks
// share it: for a checkpoint, and while the parts of the ranks change.
#ifndef caisson_mpm_domain_grid_fields_h
#define caisson_mpm_domain_grid_fields_h

#include <caisson_mpm/domain/background_grid.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  /** A field, which somebody else owns. */
  struct GridField
  {
    std::string name;
    NodalData  *values = nullptr;
    // where the values have that of a cell; empty for a field of nodes
    std::function<unsigned int(const unsigned int cell)> place_of_cell;
  };

  /** The values of fields [n_places] by name: a place for each node of the
   * lattice of the grid lines, in rows from below, which stands for the node,
   * or for the cell of which it is the lower left corner. NaN where there is no
   * such node or cell. */
  using NamedFields = std::vector<std::pair<std::string, std::vector<double>>>;

  /** Return the values of all ranks. Collective. */
  NamedFields
  gather(const BackgroundGrid &grid, const std::vector<GridField> &fields);

  /** Give each of the fields its values of @p values, if these have them.
   * Collective. */
  void
  scatter(const BackgroundGrid         &grid,
          const NamedFields            &values,
          const std::vector<GridField> &fields);

  /** Return the place of the corner @p k of a cell. */
  std::size_t
  place_of_corner(const BackgroundGrid &grid,
                  const unsigned int    cell,
                  const unsigned int    k);

  /** Return the values of this name, or null. */
  const std::vector<double> *
  field_named(const std::string &name, const NamedFields &fields);
} // namespace CaissonMPM

#endif
