// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A law that the user has written, which is called point by point.
//
// The law finds the stress turned with the soil by the whole turn of the step,
// and the strain increment by half of it: for a law without axes of its own
// this is the same, up to round-off, as update_stress.h. The turn itself is
// handed over for tensors among the law's variables.
#ifndef caisson_mpm_kernels_user_material_h
#define caisson_mpm_kernels_user_material_h

#include <caisson_mpm/kernels/material_law.h>
#include <caisson_mpm/kernels/user_point.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      /** The law "user material". See the head of the file; it has no update()
       * for lanes: user_points.h. */
      struct UserMaterial
      {
        static constexpr const char *name           = "user material";
        static constexpr LawEntry    entries[]      = {Entries::friction_angle};
        static constexpr int         friction_entry = 0, n_state = 0;
        static constexpr bool        uses_void_ratio  = false;
        static constexpr bool        stiffness_varies = true;
        static constexpr bool        is_external      = true;

        struct Parameters
        {
          double  sine;    // of the friction angle
          double  modulus; // lambda + 2 mu at the start, Pa
          UserLaw update;
          void   *law;
        };

        /** The rest is known when the library has been loaded. */
        static Parameters
        make(const double *values)
        {
          const LawValues<UserMaterial> value{values};
          return {__builtin_sin(value("Friction angle") * radians_per_degree),
                  0.,
                  nullptr,
                  nullptr};
        }

        static bool
        check(const double * /*values*/, const LawContext &, LawMessage &)
        {
          return true;
        }

        /** 1 - sin(phi) (Jaky 1948). */
        static double
        earth_pressure_at_rest(const Parameters &p)
        {
          return 1. - p.sine;
        }

        /** That of the start: UserState has those of the points. */
        template <typename Number>
        [[gnu::always_inline]] static inline Number
        p_wave_modulus(const StressState<Number> & /*stress*/,
                       const Number /*void_ratio*/,
                       const Parameters &p)
        {
          return Number(p.modulus);
        }
      };

      template <>
      struct LawSlot<11>
      {
        using type = UserMaterial;
      };

      /** Law::is_external; chosen for the argument 0. */
      template <typename Law>
      constexpr auto
      is_external(int) -> decltype(Law::is_external)
      {
        return Law::is_external;
      }

      template <typename Law>
      constexpr bool
      is_external(long)
      {
        return false;
      }
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
