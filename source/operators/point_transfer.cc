// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/nodal_data.h>
#include <caisson_mpm/operators/point_transfer.h>

namespace CaissonMPM
{
  using Kernels::NodalVector;

  void
  PointTransfer::initialize(const BackgroundGrid &grid)
  {
    for (NodalData *v : {&transfer_velocity,
                         &strain_velocity,
                         &filtered,
                         &after_round_trip,
                         &constrained_old})
      grid.reinit(*v, 2);
  }

  void
  PointTransfer::prepare(const MethodSettings       &settings,
                         const StepSize             &size,
                         const Kernels::KernelTable &kernels,
                         const Kernels::StepContext &step,
                         const NodalMomentum        &momentum,
                         const NodalConstraints     &constraints,
                         NodalReactions             &reactions)
  {
    const Context context = {kernels, step, momentum, constraints, reactions};
    const std::size_t n   = 2 * momentum.raised_mass().size();
    const double     *old = momentum.old_velocity().begin(),
                 *v       = momentum.new_velocity().begin();
    const double keep     = settings.keep_velocity(size);

    transfer_of_body = 1. - keep;
    // 1. what is added to a V_p (a = keep) by FLIP and PIC together:
    //    a (v+ - v) + (1 - a) v+ = v+ - a v
    double *const transfer = transfer_velocity.begin();
    for (std::size_t i = 0; i < n; ++i)
      transfer[i] = v[i] - keep * old[i];
    // 2. XPIC besides: (1 - a) sum_{k=1}^{n-1} (I - A)^k v
    if (settings.filter_order() > 1 && keep < 1.)
      add_filter(context, settings.filter_order(), 1. - keep);
    // 3. the velocity that strains the points: v+ (USL) or S+ V_p (MUSL)
    strains_with_new = !settings.uses_musl();
    if (!strains_with_new)
      compute_strain_velocity(context, keep);
  }

  void
  PointTransfer::round_trip(const Context   &context,
                            const NodalData &from,
                            const double     share_of_body,
                            NodalData       &to)
  {
    const ContactCorners &corners = context.constraints.contact.corners();
    apply_consistent_mass(context.kernels,
                          context.step,
                          context.constraints.hanging_nodes,
                          from,
                          to,
                          [&](NodalVector *product) {
                            corners.correct_mass(context.step,
                                                 nodal_vectors(from),
                                                 share_of_body,
                                                 product);
                          });
    const Kernels::NodalSums *const node = context.momentum.sums();
    NodalVector *const              v    = nodal_vectors(to);
    for (std::size_t i = 0; i < context.momentum.raised_mass().size(); ++i)
      if (node[i].mass > 0.)
        for (unsigned int d = 0; d < 2; ++d)
          v[i].value[d] /= node[i].mass;
    corners.divide_by_mass(node, share_of_body, v);
  }

  void
  PointTransfer::add_filter(const Context     &context,
                            const unsigned int order,
                            const double       share)
  {
    const std::size_t n = 2 * context.momentum.raised_mass().size();
    context.constraints.constrain_old(context.momentum.old_velocity(),
                                      filtered);
    for (unsigned int k = 1; k < order; ++k)
      {
        round_trip(context, filtered, k == 1 ? 1. : 0., after_round_trip);
        // From the second round on the field is a difference. The round trip
        // keeps momentum, and constraining it does not: the points lose its
        // share.
        context.constraints.constrain(context.momentum.sums(),
                                      -share,
                                      k > 1,
                                      after_round_trip,
                                      context.reactions);
        double *const w = filtered.begin(), *const a = after_round_trip.begin(),
                      *const transfer = transfer_velocity.begin();
        for (std::size_t i = 0; i < n; ++i)
          {
            // (I - A)^k v; differences of constrained fields stay so
            w[i] -= a[i];
            transfer[i] += share * w[i];
          }
      }
  }

  void
  PointTransfer::compute_strain_velocity(const Context &context,
                                         const double   keep)
  {
    // S+ (keep V_p + S transfer) = keep v + A transfer
    round_trip(context, transfer_velocity, 1. - keep, strain_velocity);
    context.constraints.constrain_old(context.momentum.old_velocity(),
                                      constrained_old);
    const double *const old    = constrained_old.begin();
    double *const       strain = strain_velocity.begin();
    for (std::size_t i = 0; i < 2 * context.momentum.raised_mass().size(); ++i)
      strain[i] += keep * old[i];
    context.constraints.constrain(strain_velocity);
  }

  Kernels::NodalFields
  PointTransfer::fields(const NodalMomentum &momentum) const
  {
    const NodalData &v = momentum.new_velocity();
    return {nodal_vectors(v),
            nodal_vectors(transfer_velocity),
            nodal_vectors(strains_with_new ? v : strain_velocity),
            transfer_of_body};
  }
} // namespace CaissonMPM
