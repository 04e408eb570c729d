// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The points of a law that the user has written, one by one.
#ifndef caisson_mpm_kernels_user_points_h
#define caisson_mpm_kernels_user_points_h

#include <caisson_mpm/kernels/move_points.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** The numbers of a point that a user's law keeps. */
    [[gnu::always_inline]] inline double *
    user_state_of(const PointsView &points, const int block, const int lane)
    {
      return &points.user_state[block] + lane * points.n_user_state;
    }

    /** What the law takes and gives, in memory. */
    template <typename Number>
    struct UserLanes
    {
      alignas(64) double stress[4][Number::width];
      alignas(64) double strain[4][Number::width]; // turned; rz engineering
      alignas(64) double gradient[5][Number::width];
      alignas(64) double cosine[Number::width], sine[Number::width];

      [[gnu::always_inline]] inline UserLanes(
        const StressState<Number>     &turned,
        const StrainIncrement<Number> &strain_turned,
        const StressStep<Number>      &s)
      {
        turned.rr.store(stress[0]);
        turned.zz.store(stress[1]);
        turned.tt.store(stress[2]);
        turned.rz.store(stress[3]);
        strain_turned.rr.store(strain[0]);
        strain_turned.zz.store(strain[1]);
        strain_turned.tt.store(strain[2]);
        (strain_turned.rz + strain_turned.rz).store(strain[3]);
        const StrainIncrement<Number> &e = s.step.strain;
        e.rr.store(gradient[0]);
        (e.rz + s.step.spin).store(gradient[1]);
        (e.rz - s.step.spin).store(gradient[2]);
        e.zz.store(gradient[3]);
        e.tt.store(gradient[4]);
        (Number(1.) - s.half_turn.tangent * s.half_turn.sine).store(cosine);
        s.half_turn.sine.store(sine);
      }

      [[gnu::always_inline]] inline void
      fill(const int i, UserPoint &point) const
      {
        for (int k = 0; k < 4; ++k)
          {
            point.stress[k] = stress[k][i];
            point.strain[k] = strain[k][i];
          }
        for (int k = 0; k < 5; ++k)
          point.gradient[k] = gradient[k][i];
        point.cosine = cosine[i];
        point.sine   = sine[i];
      }
    };

    /** Set stress and volume of the points in the lanes from @p lane on to
     * those at the end of the step; @p count of them are no padding. Returns
     * work_per_volume(). */
    template <typename Number>
    [[gnu::always_inline]] inline Number
    update_user_points(const PointsView               &points,
                       const int                       block,
                       const int                       lane,
                       const int                       count,
                       const StressStep<Number>       &s,
                       const double                    cell_size,
                       const UserMaterial::Parameters &parameters)
    {
      PointBlock               &b      = points.blocks[block];
      const StressState<Number> old    = s.half_turn(s.old);
      StressStep<Number>        turned = s;
      turned.step.strain               = s.half_turn(s.step.strain);
      UserLanes<Number> lanes(old, turned.step.strain, s);
      for (int i = 0; i < Number::width && i < count; ++i)
        {
          UserPoint point;
          lanes.fill(i, point);
          point.place[0]  = b.r[lane + i];
          point.place[1]  = b.z[lane + i];
          point.cell_size = cell_size;
          point.id        = points.histories[block].id[lane + i];
          point.state     = user_state_of(points, block, lane + i);
          parameters.update(parameters.law, point);
          for (int k = 0; k < 4; ++k)
            lanes.stress[k][i] = point.stress[k];
        }
      const StressState<Number> stress = {Number::load(lanes.stress[0]),
                                          Number::load(lanes.stress[1]),
                                          Number::load(lanes.stress[2]),
                                          Number::load(lanes.stress[3])};
      store_stress(stress, b, lane);
      (Number::load(b.volume + lane) * (Number(1.) + s.step.volume_change))
        .store(b.volume + lane);
      return work_per_volume(old, stress, turned.step);
    }

    /** Update a block of a law that the user has written, and add its work to
     * the sums of its cell; returns the points outside the moved cell. */
    template <typename Number, typename Sums>
    [[gnu::noinline]] unsigned int
    update_user_block(const PointsView  &points,
                      const int          block,
                      const BlockUpdate &u,
                      unsigned int      &limited,
                      Sums              &sums)
    {
      PointBlock       &b    = u.points;
      const CellUpdate &cell = u.cell;
      const auto       &parameters =
        reinterpret_cast<const UserMaterial::Parameters &>(
          u.material.parameters);
      const double cell_size =
        __builtin_sqrt(cell.map.width * cell.map.mean_height());
      unsigned int outside = 0;
      limited              = 0;
      for (int lane = 0; lane < block_size; lane += Number::width)
        {
          Number r = Number::load(b.r + lane), z = Number::load(b.z + lane);
          const LocalPoint<Number> p    = cell.map.at_position(r, z);
          const Number             mass = Number::load(b.mass + lane),
                       volume           = Number::load(b.volume + lane);
          sums.add_work(
            p,
            mass,
            volume,
            update_user_points(points,
                               block,
                               lane,
                               u.count - lane,
                               begin_stress_step(b, lane, p, cell, u.settings),
                               cell_size,
                               parameters));
          sums.sum[4] += Number::load(b.volume + lane);
          limited |= move_points(b, lane, p, cell, u.settings, r, z) << lane;
          outside |= to_integer(!cell.moved.contains(r, z)) << lane;
        }
      return outside;
    }
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
