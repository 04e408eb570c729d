// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The nodal fields from which the points take velocity and strain.
//
// With v = p / m the velocity that the points bring, v+ the new one, and
// A = S+ S the round trip from nodes to points and back (S interpolates, S+ is
// the mass-weighted average; A = M / m with the consistent mass matrix M):
//   FLIP       V_p <- V_p + S (v+ - v)
//   PIC        V_p <- S v+
//   XPIC(n)    V_p <- S (v+ + sum_{k=1}^{n-1} (I - A)^k v)
//   blend      V_p <- a FLIP + (1 - a) XPIC(n)
// (Sulsky et al. 1994; Hammerquist & Nairn 2017, doi:10.1016/j.cma.2017.01.035).
// MUSL strains the points with the velocity that they bring back to the nodes,
// S+ V_p; as A is known per cell, no second pass over the points is needed.
// USL strains them with v+.
//
// The velocities of the sums of XPIC and MUSL are constrained by the boundary
// conditions and the contact found for v+: the transfer must not undo them.
#ifndef caisson_mpm_operators_point_transfer_h
#define caisson_mpm_operators_point_transfer_h

#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/method_settings.h>
#include <caisson_mpm/operators/nodal_momentum.h>

namespace CaissonMPM
{
  /**
   * Owns the fields of the transfer and the memory to find them. prepare() is
   * collective over MPI if XPIC or MUSL needs the round trip.
   */
  class PointTransfer
  {
  public:
    /** Set up for the nodes that this rank knows. */
    void
    initialize(const BackgroundGrid &grid);

    /** Find the fields, from the velocities before and after the step. What the
     * constraints take from the momentum of the points meanwhile is added to
     * @p reactions. */
    void
    prepare(const MethodSettings       &settings,
            const StepSize             &size,
            const Kernels::KernelTable &kernels,
            const Kernels::StepContext &step,
            const NodalMomentum        &momentum,
            const NodalConstraints     &constraints,
            NodalReactions             &reactions);

    /** Return the fields that update the points, with the new velocities of
     * @p momentum. */
    Kernels::NodalFields
    fields(const NodalMomentum &momentum) const;

  private:
    /** What the functions below share during prepare(). */
    struct Context
    {
      const Kernels::KernelTable &kernels;
      const Kernels::StepContext &step;
      const NodalMomentum        &momentum;
      const NodalConstraints     &constraints;
      NodalReactions             &reactions;
    };

    /** to = A from. @p share_of_body: of the body's velocity in @p from. */
    void
    round_trip(const Context   &context,
               const NodalData &from,
               const double     share_of_body,
               NodalData       &to);

    /** Add share * sum_{k=1}^{order-1} (I - A)^k v to the transfer field. */
    void
    add_filter(const Context     &context,
               const unsigned int order,
               const double       share);

    /** S+ V_p of the points after the update. */
    void
    compute_strain_velocity(const Context &context, const double keep);

    NodalData transfer_velocity, strain_velocity;
    NodalData filtered, after_round_trip; // memory of add_filter()
    NodalData constrained_old;
    bool      strains_with_new = false; // USL
    double    transfer_of_body = 1.;    // see NodalFields
  };
} // namespace CaissonMPM

#endif
