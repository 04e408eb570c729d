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

#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/kernels/material_law.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** The law "user material". See the head of the file; it has no update()
     * for lanes: user_points.h. */
    struct UserMaterial : MaterialLaw
    {
      static constexpr const char *name             = "user material";
      static constexpr bool        stiffness_varies = true, is_external = true;

      struct Parameters : LawNumbers
      {
        // known when the library has been loaded
        double  modulus = 0.; // lambda + 2 mu at the start, Pa
        UserLaw update  = nullptr;
        void   *law     = nullptr;

        void
        derive()
        {}
      };

      static constexpr LawEntry<Parameters> entries[] = {
        {&Parameters::friction_angle, Entries::friction_angle}};

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
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
