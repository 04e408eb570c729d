// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Soil in its loosest state takes no more volume.
//
// A law may know the void ratio above which grains would not touch. Soil that
// reaches it under stress shears at constant volume from then on. Soil that is
// torn apart has a gap: the volume of its point grows beyond that state at no
// stress, and the gap must close before the soil bears again. The law sees to
// both.
//
// The points of a cell are strained with one volume change (B-bar), or in a
// field that hardly varies within the cell. A point in its loosest state, among
// others that dilate, would be stretched by them, lose its stress, and become a
// gap. The growth of a cell is therefore shared out among those of its points
// that can take it,
//
//   theta_firm = theta V / V_firm,   theta_loose = 0,
//
// theta being the mean of the cell, V the volume of all its points, and V_firm
// that of those which are denser. Where hardly one is left, the cell opens, and
// all are strained with theta. When the cell shrinks, all take the mean.
#ifndef caisson_mpm_kernels_loosest_state_h
#define caisson_mpm_kernels_loosest_state_h

#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/kernels/update_stress.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** A cell with a smaller share of denser soil opens. */
    constexpr double least_firm_share = .01;

    /** The points in their loosest state in the lanes from @p lane on; empty
     * lanes are not. */
    template <typename Law, typename Number>
    [[gnu::always_inline]] inline typename Number::Mask
    in_loosest_state(const PointBlock               &b,
                     const PointHistory             &history,
                     const int                       lane,
                     const Material                 &material,
                     const typename Law::Parameters &parameters)
    {
      return Law::is_loosest(load_stress<Number>(b, lane),
                             Number(1. + material.initial_void_ratio) *
                               Number::load(b.volume + lane),
                             Number::load(history.initial_volume + lane),
                             parameters);
    }

    /** The volume of the points of a cell in their loosest state. */
    template <typename Number>
    [[gnu::always_inline]] inline double
    loose_volume(const StepContext &step, const unsigned int cell)
    {
      const PointsView &points = step.points;
      Number            volume(0.);
      for_each_block(points, cell, [&](const int block) CAISSON_LAMBDA {
        const PointBlock &b        = points.blocks[block];
        const Material   &material = step.materials[points.material(block)];
        if (!material.has_loosest_state)
          return;
        with_law(material, [&](auto law, const auto &p) CAISSON_LAMBDA {
          using Law = decltype(law);
          if constexpr (Law::has_loosest_state)
            for (int lane = 0; lane < block_size; lane += Number::width)
              volume += select(in_loosest_state<Law, Number>(
                                 b, points.histories[block], lane, material, p),
                               Number::load(b.volume + lane),
                               Number(0.));
        });
      });
      return sum(volume);
    }

    /** Share out the growth of a cell among the points that can take it. */
    template <typename Number>
    [[gnu::always_inline]] inline void
    share_out_growth(const StepContext    &step,
                     const unsigned int    cell,
                     const UpdateSettings &settings,
                     CellUpdate           &update)
    {
      const CellMoments &moments = step.moments[cell];
      update.has_loose_points    = false;
      update.loose_divergence    = update.mean_divergence;
      if (!moments.several_materials &&
          !step.materials[moments.material].has_loosest_state)
        return;
      const double loose = loose_volume<Number>(step, cell);
      if (loose == 0.)
        return;
      update.has_loose_points = true;
      const double all = step.points.filled_volume[cell], firm = all - loose;
      if (!settings.mean_volume_change || !(update.mean_divergence > 0.) ||
          firm < least_firm_share * all)
        return;
      update.loose_divergence = 0.;
      update.mean_divergence *= all / firm;
    }

    /** Give points in their loosest state the volume change that is theirs.
     * Returns whether there are any. */
    template <typename Law, typename Number>
    [[gnu::always_inline]] inline bool
    hold_loose_points(const BlockUpdate              &u,
                      const int                       lane,
                      const typename Law::Parameters &parameters,
                      StepOfStrain<Number>           &step)
    {
      const auto loose = in_loosest_state<Law, Number>(
        u.points, u.history, lane, u.material, parameters);
      if (!any(loose))
        return false;
      if (u.settings.mean_volume_change)
        take_volume_change(select(loose,
                                  Number(u.settings.time_step *
                                         u.cell.loose_divergence),
                                  step.volume_change),
                           u.cell,
                           step);
      return true;
    }
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
