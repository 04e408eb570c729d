// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/compat.h>
#include <caisson_mpm/domain/hanging_nodes.h>

#include <deal.II/base/mpi.h>

#include <deal.II/dofs/dof_tools.h>

namespace CaissonMPM
{
  using namespace dealii;

  void
  HangingNodes::initialize(const DoFHandler<2>               &dof_handler,
                           const Utilities::MPI::Partitioner &partitioner,
                           const std::vector<bool>           &is_at_own_cell)
  {
    nodes.clear();
    const auto known       = Compat::locally_relevant_dofs(dof_handler);
    auto       constraints = Compat::empty_constraints(dof_handler);
    DoFTools::make_hanging_node_constraints(dof_handler, constraints);
    constraints.close();
    bool is_distant = false;
    for (const auto dof : known)
      {
        if (!constraints.is_constrained(dof))
          continue;
        const auto &masters = *constraints.get_constraint_entries(dof);
        AssertThrow(masters.size() == 2, ExcInternalError());
        Node node     = {};
        node.node     = partitioner.global_to_local(dof);
        bool is_known = true;
        for (unsigned int i = 0; i < 2; ++i)
          {
            is_known = is_known && known.is_element(masters[i].first);
            if (!is_known)
              break;
            node.masters[i] = partitioner.global_to_local(masters[i].first);
            node.weights[i] = masters[i].second;
            is_distant |=
              is_at_own_cell[node.node] && !is_at_own_cell[node.masters[i]];
          }
        AssertThrow(is_known || !is_at_own_cell[node.node], ExcInternalError());
        if (is_known)
          nodes.push_back(node);
      }
    has_distant_masters =
      Utilities::MPI::max(is_distant ? 1 : 0, dof_handler.get_communicator()) ==
      1;
  }

  void
  HangingNodes::distribute(NodalData         &sums,
                           const unsigned int n_components) const
  {
    double *const value = sums.begin();
    for (const Node &n : nodes)
      for (unsigned int c = 0; c < n_components; ++c)
        {
          double &own = value[n.node * n_components + c];
          for (unsigned int i = 0; i < 2; ++i)
            value[n.masters[i] * n_components + c] += n.weights[i] * own;
          own = 0.;
        }
  }

  void
  HangingNodes::interpolate(NodalData         &values,
                            const unsigned int n_components) const
  {
    if (has_distant_masters)
      values.update_ghost_values();
    double *const value = values.begin();
    for (const Node &n : nodes)
      for (unsigned int c = 0; c < n_components; ++c)
        value[n.node * n_components + c] =
          n.weights[0] * value[n.masters[0] * n_components + c] +
          n.weights[1] * value[n.masters[1] * n_components + c];
  }
} // namespace CaissonMPM
