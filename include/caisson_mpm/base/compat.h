// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Everything that differs between deal.II 9.4 (Debian 12) and 9.6 (Debian 13).
#ifndef caisson_mpm_base_compat_h
#define caisson_mpm_base_compat_h

#include <deal.II/base/config.h>

#include <deal.II/base/index_set.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>

#include <deal.II/lac/affine_constraints.h>

namespace CaissonMPM
{
  namespace Compat
  {
    inline dealii::IndexSet
    locally_relevant_dofs(const dealii::DoFHandler<2> &dof_handler)
    {
#if DEAL_II_VERSION_GTE(9, 5, 0)
      return dealii::DoFTools::extract_locally_relevant_dofs(dof_handler);
#else
      dealii::IndexSet result;
      dealii::DoFTools::extract_locally_relevant_dofs(dof_handler, result);
      return result;
#endif
    }

    /** Constraints, still empty, of the dofs that this rank knows. */
    inline dealii::AffineConstraints<double>
    empty_constraints(const dealii::DoFHandler<2> &dof_handler)
    {
      const auto known = locally_relevant_dofs(dof_handler);
#if DEAL_II_VERSION_GTE(9, 6, 0)
      return dealii::AffineConstraints<double>(dof_handler.locally_owned_dofs(),
                                               known);
#else
      return dealii::AffineConstraints<double>(known);
#endif
    }
  } // namespace Compat
} // namespace CaissonMPM

#endif
