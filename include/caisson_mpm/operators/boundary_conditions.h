// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Velocity boundary conditions on the four sides of the domain, and at nodes in
// a region of place and time where a velocity is prescribed.
#ifndef caisson_mpm_operators_boundary_conditions_h
#define caisson_mpm_operators_boundary_conditions_h

#include <caisson_mpm/base/expression.h>
#include <caisson_mpm/domain/background_grid.h>

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/tensor.h>

#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * Sides: roller: no normal velocity; fixed: no velocity; free: nothing. A
   * prescribed velocity takes precedence over the sides, and over the contact.
   */
  class BoundaryConditions : public dealii::ParameterAcceptor
  {
  public:
    BoundaryConditions();

    void
    check_parameters(const GridLines &lines) const;

    void
    initialize(const BackgroundGrid &grid);

    /** Find the prescribed nodes of the step from @p time on: their region at
     * its beginning, their velocity in its middle, at the current places. */
    void
    prepare(const BackgroundGrid &grid, const double time, const double dt);

    /**
     * Set the fixed and the prescribed components of the new velocities @p v
     * [n_nodes], and add the impulse on the soil at prescribed nodes to
     * impulse(). @p mass [n_nodes] is the mass that accelerates.
     * Returns the work on the soil there, of the nodes of this rank. Units: J.
     */
    double
    apply(const std::vector<double> &mass, Kernels::NodalVector *v);

    /** Hold another velocity field to the conditions of the last apply(). */
    void
    constrain(Kernels::NodalVector *v) const;

    /** The same for the difference of two fields that are held. */
    void
    constrain_difference(Kernels::NodalVector *v) const;

    /** The impulse on the soil at this rank's prescribed nodes since the last
     * reset. Units: N s, whole circumference (per metre in plane strain). */
    const dealii::Tensor<1, 2> &
    impulse() const
    {
      return impulse_;
    }
    void
    reset_impulse(const dealii::Tensor<1, 2> &start = dealii::Tensor<1, 2>())
    {
      impulse_ = start;
    }

  private:
    /** A component of the velocity of a node. */
    struct Prescribed
    {
      unsigned int node, component;
      double       velocity;
    };

    Expression
    parse_region() const;
    VectorExpression
    parse_velocity() const;

    std::string axis = "roller", outer = "roller", bottom = "fixed",
                top = "free";
    std::string               region_text, velocity_text = "0 ; 0";
    std::vector<unsigned int> fixed[2]; // nodes by component
    Expression                region;
    VectorExpression          velocity;
    std::vector<Prescribed>   prescribed; // in this step
    dealii::Tensor<1, 2>      impulse_;
    double                    circumference = 2. * pi;
    unsigned int              n_owned_nodes = 0;
  };
} // namespace CaissonMPM

#endif
