// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Velocity boundary conditions on the four sides of the domain, and at nodes in
// a region of place and time where a velocity is prescribed.
#ifndef caisson_mpm_operators_boundary_conditions_h
#define caisson_mpm_operators_boundary_conditions_h

#include <caisson_mpm/base/expression.h>
#include <caisson_mpm/base/parameter_origins.h>
#include <caisson_mpm/base/section.h>
#include <caisson_mpm/domain/background_grid.h>
#include <caisson_mpm/kernels/layout.h>

#include <array>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /** What a side of the domain does to the nodes on it. */
  enum class SideCondition
  {
    roller, // no normal velocity
    fixed,  // no velocity
    free    // nothing
  };

  /** What prescribed velocities did in one step, at the nodes that this rank
   * owns. */
  struct PrescribedResult
  {
    // on the soil, whole circumference (per meter in plane strain); N s
    Vector2 impulse;
    double  work = 0.; // on the soil; J
  };

  /**
   * Conditions on the four sides, and prescribed velocities, which take
   * precedence over the sides and over the contact. Each rank treats all nodes
   * that it knows. Not collective.
   */
  class BoundaryConditions : public Section
  {
  public:
    BoundaryConditions();

    void
    check_parameters(const GridLines &lines) const;

    /** Report which entries the other choices leave without effect. */
    void
    name_unused_entries(ParameterOrigins &origins) const override;

    /** Whether there is a region whose velocity is prescribed. */
    bool
    prescribe_a_region() const
    {
      return !region_text.empty();
    }

    void
    initialize(const BackgroundGrid &grid);

    /** Find the prescribed nodes of the step from @p time on: their region at
     * its beginning, their velocity in its middle, at the current places. */
    void
    prepare(const BackgroundGrid &grid, const double time, const double dt);

    /** Return by component which nodes [n_nodes] have a velocity that their
     * side or the last prepare() sets. */
    std::array<std::vector<bool>, 2>
    held_nodes(const unsigned int n_nodes) const;

    /**
     * Set the fixed and the prescribed components of the new velocities @p v
     * [n_nodes] of nodes with the given @p mass [n_nodes].
     */
    PrescribedResult
    apply(const std::vector<double> &mass, Kernels::NodalVector *v);

    /** Constrain another velocity field as the last apply() did. */
    void
    constrain(Kernels::NodalVector *v) const;

    /** The same for the difference of two constrained fields. */
    void
    constrain_difference(Kernels::NodalVector *v) const;

    /** Add to @p result what the prescribed nodes do to the soil, which gains
     * the momentum @p share times m_I v_I, when the field @p v is constrained, as a
     * velocity or as a difference. Call it before. */
    void
    add_impulses(const Kernels::NodalSums   *sums,
                 const double                share,
                 const bool                  as_difference,
                 const Kernels::NodalVector *v,
                 PrescribedResult           &result) const;

  private:
    /** A component of the velocity of a node. */
    struct Prescribed
    {
      unsigned int node, component;
      double       velocity;
    };

    /** The entry with its text, for messages. */
    std::string
    region_entry() const;
    Expression
    parse_region() const;
    VectorExpression
    parse_velocity() const;

    // in the order of BackgroundGrid's sides: axis, outer, bottom, top
    SideCondition             sides[4] = {SideCondition::roller,
                                          SideCondition::roller,
                                          SideCondition::fixed,
                                          SideCondition::free};
    std::string               region_text, velocity_text = "0 ; 0";
    std::vector<unsigned int> fixed[2]; // nodes by component
    Expression                region;
    VectorExpression          velocity;
    std::vector<Prescribed>   prescribed; // in this step
    double                    circumference = 2. * pi;
    unsigned int              n_owned_nodes = 0;
  };
} // namespace CaissonMPM

#endif
