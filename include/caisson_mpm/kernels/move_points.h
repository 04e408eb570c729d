// SPDX-License-Identifier: LGPL-2.1-or-later
//
// New velocity and place of points, from the fields of their cell:
//
//   V_p <- keep V_p + sum_I N_I(x_p) v_I^transfer,
//   x_p <- x_p + dt (sum_I N_I(x_p) v_I^advection + bubbles).
#ifndef caisson_mpm_kernels_move_points_h
#define caisson_mpm_kernels_move_points_h

#include <caisson_mpm/kernels/update_stress.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** Reduce a velocity above the limit to it; returns the lanes cut. */
    template <typename Number>
    [[gnu::always_inline]] inline unsigned int
    limit_speed(const double limit, Number &r, Number &z)
    {
      const Number speed = sqrt(r * r + z * z);
      const auto   fast  = speed > Number(limit);
      const Number scale = select(fast, Number(limit) / speed, Number(1.));
      r *= scale;
      z *= scale;
      return to_integer(fast);
    }

    /** New velocity and place of the points in the lanes from @p lane on;
     * returns the lanes whose velocity was cut. */
    template <typename Number>
    [[gnu::always_inline]] inline unsigned int
    move_points(PointBlock               &b,
                const int                 lane,
                const LocalPoint<Number> &p,
                const CellUpdate         &cell,
                const UpdateSettings     &settings,
                Number                   &r,
                Number                   &z)
    {
      // V_p <- keep V_p + S v_transfer;  x_p <- x_p + dt S v_advection
      const Number dt(settings.time_step), keep(settings.keep_velocity);
      Number       velocity_r =
        keep * Number::load(b.velocity_r + lane) + evaluate(cell.transfer.r, p);
      Number velocity_z =
        keep * Number::load(b.velocity_z + lane) + evaluate(cell.transfer.z, p);
      Number move_r = evaluate(cell.advection.r, p),
             move_z = evaluate(cell.advection.z, p);
      const Number one(1.),
        bubble_xi  = Number(cell.bubble[0]) * p.xi * (p.xi - one),
        bubble_eta = Number(cell.bubble[1]) * p.eta * (p.eta - one);
      move_r += Number(cell.map.width) * bubble_xi;
      move_z += p.height * (p.slope * bubble_xi + bubble_eta);
      // Beside the body a cell may be squeezed flat: |v| <= k H / dt keeps a
      // point from passing more than a share of it in a step.
      unsigned int limited = 0;
      if (cell.speed_limit > 0.)
        limited = limit_speed(cell.speed_limit, velocity_r, velocity_z) |
                  limit_speed(cell.speed_limit, move_r, move_z);
      velocity_r.store(b.velocity_r + lane);
      velocity_z.store(b.velocity_z + lane);
      r += dt * move_r;
      z += dt * move_z;
      r.store(b.r + lane);
      z.store(b.z + lane);
      return limited;
    }
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
