// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Velocity boundary conditions on the four sides of the domain.
#ifndef caisson_mpm_operators_boundary_conditions_h
#define caisson_mpm_operators_boundary_conditions_h

#include <caisson_mpm/bodies/background_grid.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <vector>

namespace CaissonMPM
{
  /** roller: no normal velocity; fixed: no velocity; free: nothing. */
  class BoundaryConditions : public dealii::ParameterAcceptor
  {
  public:
    BoundaryConditions();

    void
    check_parameters(const BackgroundGrid &grid) const;

    void
    initialize(const BackgroundGrid &grid);

    /** Set the fixed components of @p v [n_nodes] to zero. */
    void
    apply(Kernels::NodalVector *v) const;

  private:
    std::string axis = "roller", outer = "roller", bottom = "fixed",
                top = "free";
    std::vector<unsigned int> fixed[2]; // nodes by component
  };
} // namespace CaissonMPM

#endif
