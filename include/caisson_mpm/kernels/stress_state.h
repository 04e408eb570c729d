// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Stress and strain increment of an axisymmetric state without twist, and what
// every constitutive law does with them: the elastic predictor, the principal
// stresses and the way back from them.
//
// Stresses are effective, in Pa, tension positive; the components are (rr, zz,
// tt, rz), where t is the hoop direction. The shear component of a strain
// increment is tensorial, (L_rz + L_zr) dt / 2, not the engineering strain.
// The hoop stress is always a principal stress; the other two lie in the
// meridional plane, center +- radius in terms of Mohr's circle.
#ifndef caisson_mpm_kernels_stress_state_h
#define caisson_mpm_kernels_stress_state_h

#include <caisson_mpm/kernels/simd.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** Cauchy stress, tension positive. Units: Pa. */
    template <typename Number>
    struct StressState
    {
      Number rr, zz, tt, rz;
    };

    /** Strain increment of one step; rz is tensorial. Units: none. */
    template <typename Number>
    using StrainIncrement = StressState<Number>;

    /** The mean pressure, compression positive. */
    template <typename Number>
    [[gnu::always_inline]] inline Number
    pressure(const StressState<Number> &s)
    {
      return Number(-1. / 3.) * (s.rr + s.zz + s.tt);
    }

    template <typename Number>
    [[gnu::always_inline]] inline StressState<Number>
    scaled(const Number factor, const StressState<Number> &a)
    {
      return {factor * a.rr, factor * a.zz, factor * a.tt, factor * a.rz};
    }

    /** Take the stress @p a where @p mask is set, else @p b. */
    template <typename Number>
    [[gnu::always_inline]] inline StressState<Number>
    select(const typename Number::Mask &mask,
           const StressState<Number>   &a,
           const StressState<Number>   &b)
    {
      return {select(mask, a.rr, b.rr),
              select(mask, a.zz, b.zz),
              select(mask, a.tt, b.tt),
              select(mask, a.rz, b.rz)};
    }

    /**
     * Add to @p sigma the stress that isotropic linear elasticity gives for
     * the increment @p de: lambda tr(de) I + 2 mu de.
     */
    template <typename Number>
    [[gnu::always_inline]] inline void
    add_elastic_increment(StressState<Number>           &sigma,
                          const StrainIncrement<Number> &de,
                          const double                   lambda,
                          const double                   mu)
    {
      const Number two_mu     = 2. * mu;
      const Number volumetric = lambda * (de.rr + de.zz + de.tt);
      sigma.rr += volumetric + two_mu * de.rr;
      sigma.zz += volumetric + two_mu * de.zz;
      sigma.tt += volumetric + two_mu * de.tt;
      sigma.rz += two_mu * de.rz;
    }

    /** Principal stresses, major >= middle >= minor, tension positive. */
    template <typename Number>
    struct PrincipalStresses
    {
      Number major, middle, minor;
    };

    /** Take the principal stresses @p a where @p mask is set, else @p b. */
    template <typename Number>
    [[gnu::always_inline]] inline PrincipalStresses<Number>
    select(const typename Number::Mask     &mask,
           const PrincipalStresses<Number> &a,
           const PrincipalStresses<Number> &b)
    {
      return {select(mask, a.major, b.major),
              select(mask, a.middle, b.middle),
              select(mask, a.minor, b.minor)};
    }

    /**
     * The spectral decomposition of one stress: its sorted principal values
     * and what is needed to put changed values back on the same axes.
     */
    template <typename Number>
    class PrincipalFrame
    {
    public:
      [[gnu::always_inline]] inline PrincipalFrame(
        const StressState<Number> &sigma)
      {
        half_difference     = 0.5 * (sigma.rr - sigma.zz);
        shear               = sigma.rz;
        radius              = sqrt(half_difference * half_difference + //
                      shear * shear);
        const Number center = 0.5 * (sigma.rr + sigma.zz);
        const Number upper = center + radius, lower = center - radius;
        hoop_is_major = sigma.tt > upper;
        hoop_is_minor = sigma.tt < lower;
        values.major  = max(sigma.tt, upper);
        values.middle = max(min(sigma.tt, upper), lower);
        values.minor  = min(sigma.tt, lower);
      }

      [[gnu::always_inline]] inline const PrincipalStresses<Number> &
      principal_stresses() const
      {
        return values;
      }

      /**
       * The stress with the principal values @p s on the axes of this frame.
       * The values keep the order of the directions they came from.
       * Where the radius vanishes the in-plane axes are arbitrary, and the
       * two in-plane values are taken as equal.
       */
      [[gnu::always_inline]] inline StressState<Number>
      with_principal_stresses(const PrincipalStresses<Number> &s) const
      {
        const Number upper  = select(hoop_is_major, s.middle, s.major);
        const Number lower  = select(hoop_is_minor, s.middle, s.minor);
        const Number hoop   = select(hoop_is_major,
                                   s.major,
                                   select(hoop_is_minor, s.minor, s.middle));
        const Number center = 0.5 * (upper + lower);
        const Number scale =
          0.5 * (upper - lower) / max(radius, Number(1e-150));
        return {center + scale * half_difference,
                center - scale * half_difference,
                hoop,
                scale * shear};
      }

    private:
      PrincipalStresses<Number> values;
      Number                    half_difference, shear, radius;
      typename Number::Mask     hoop_is_major, hoop_is_minor;
    };
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
