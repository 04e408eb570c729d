// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Nodes in the middle of an edge of a larger cell. A field that is continuous
// there has the mean of the values at both ends of the edge, its masters:
//   v_h = (v_a + v_b) / 2,
// and what acts on a hanging node acts on its masters, half on each.
#ifndef caisson_mpm_domain_hanging_nodes_h
#define caisson_mpm_domain_hanging_nodes_h

#include <deal.II/base/partitioner.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <vector>

namespace CaissonMPM
{
  using NodalData = dealii::LinearAlgebra::distributed::Vector<double>;

  /**
   * The hanging nodes that a rank knows, with their masters, from deal.II's
   * constraints. Empty in a mesh of grid lines alone, and then free of cost.
   *
   * Of the masters of a hanging node at a cell that the rank owns it knows
   * both; other hanging nodes are at ghost cells only, where no value is used,
   * and are left out if a master is missing.
   */
  class HangingNodes
  {
  public:
    /** Find them. @p is_at_own_cell [n_nodes] says which nodes belong to a cell
     * that this rank owns. Collective. */
    void
    initialize(const dealii::DoFHandler<2>               &dof_handler,
               const dealii::Utilities::MPI::Partitioner &partitioner,
               const std::vector<bool>                   &is_at_own_cell);

    bool
    empty() const
    {
      return nodes.empty();
    }

    /**
     * Bring the sums of hanging nodes, @p n_components for each node, to their
     * masters, and leave zero there: before the sums of the ranks are added.
     */
    void
    distribute(NodalData &sums, const unsigned int n_components) const;

    /**
     * Give hanging nodes the values that follow from their masters. Other
     * values are changed only at ghost nodes, where those of their owner may
     * replace what this rank has. Collective.
     */
    void
    interpolate(NodalData &values, const unsigned int n_components) const;

    /** A hanging node and its masters. */
    struct Node
    {
      unsigned int node, masters[2];
      double       weights[2];
    };

    /** Return all of them. */
    const std::vector<Node> &
    list() const
    {
      return nodes;
    }

  private:
    std::vector<Node> nodes;
    // of some rank, a master is at no cell that it owns: of the surroundings of
    // this master the rank does not know all, and must ask for its value
    bool has_distant_masters = false;
  };
} // namespace CaissonMPM

#endif
