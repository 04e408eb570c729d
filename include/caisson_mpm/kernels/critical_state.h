// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Stress invariants of the laws with a critical state, and the slope M of the
// critical state line in the plane of the mean stress p and the deviator
// q = sqrt(3 J2). It depends on the Lode angle theta (Sheng, Sloan & Yu 2000),
// so that the critical state has the friction angle phi_c in triaxial
// compression and in extension:
//
//   M = M_c (2 a^4 / (1 + a^4 + (1 - a^4) sin 3 theta))^(1/4),
//   M_c = 6 s / (3 - s),  a = (3 - s) / (3 + s),  s = sin(phi_c),
//
// with sin 3 theta = -1 in compression.
//
// Reference:
//   D. Sheng, S. W. Sloan, H. S. Yu (2000), Aspects of finite element
//     implementation of critical state models. Comput. Mech. 26, 185-196.
#ifndef caisson_mpm_kernels_critical_state_h
#define caisson_mpm_kernels_critical_state_h

#include <caisson_mpm/kernels/material_law.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      /** The slope of the critical state line. */
      struct CriticalStateSlope
      {
        double M;    // of triaxial compression
        double a4;   // a^4 of the file's head
        double sine; // of phi_c

        /** @p phi_c in degrees. */
        static CriticalStateSlope
        make(const double phi_c)
        {
          const double sine = __builtin_sin(phi_c * radians_per_degree),
                       a    = (3. - sine) / (3. + sine);
          return {6. * sine / (3. - sine), a * a * a * a, sine};
        }
      };

      /** p, q and M^-2 of a stress. */
      template <typename Number>
      struct CriticalStateInvariants
      {
        Number p, q, inverse_M2;

        [[gnu::always_inline]] inline CriticalStateInvariants(
          const StressState<Number> &sigma,
          const CriticalStateSlope  &slope)
          : p(pressure(sigma))
        {
          const Number rr = sigma.rr + p, zz = sigma.zz + p, tt = sigma.tt + p,
                       rz2   = sigma.rz * sigma.rz,
                       J2    = Number(.5) * (rr * rr + zz * zz + tt * tt) + rz2,
                       J3    = tt * (rr * zz - rz2);
          q                  = sqrt(Number(3.) * J2);
          const Number cubed = max(Number(2.) * J2 * sqrt(J2), Number(1e-60));
          const Number sine =
            max(min(Number(5.196152422706632) * J3 / cubed, Number(1.)),
                Number(-1.));
          const double a4 = slope.a4;
          inverse_M2 =
            Number(1. / (slope.M * slope.M)) *
            sqrt(Number(.5 / a4) * (Number(1. + a4) + Number(1. - a4) * sine));
        }

        /** q / p over the slope M of the critical state at this Lode angle. */
        [[gnu::always_inline]] inline Number
        share() const
        {
          return q * sqrt(inverse_M2) / p;
        }

        /** The stress @p sigma, which has these invariants, with its deviator
         * times @p share and the mean stress @p p_new. */
        [[gnu::always_inline]] inline StressState<Number>
        changed(const StressState<Number> &sigma,
                const Number               share,
                const Number               p_new) const
        {
          const Number mean = share * p - p_new;
          return {share * sigma.rr + mean,
                  share * sigma.zz + mean,
                  share * sigma.tt + mean,
                  share * sigma.rz};
        }
      };
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
