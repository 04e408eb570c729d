// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Viscoplasticity of Duvaut and Lions over any law with a yield surface, so
// that shear bands have a width of their own.
//
// With the trial stress st and the stress s0 that the law returns it to,
//
//   s = s0 + (st - s0) T / (T + dt),   T = t R / G,
//
// R the radius of the largest of Mohr's circles of s0. In steady shearing at
// the rate g, the stress is outside the yield surface by G T g = R t g: the
// strength is 1 + t g times that of the law. T grows with the strength, so that
// this holds at any pressure, and where the law leaves no strength (at the
// apex, in tension) there is no overstress. The plastic strains are less by
// T/(T + dt).
//
// Reference: G. Duvaut, J.-L. Lions (1972), Les inequations en mecanique et en
// physique, Dunod; J.C. Simo, J.G. Kennedy, S. Govindjee (1988), Int. J. Numer.
// Meth. Engng 26, 2161-2185. doi:10.1002/nme.1620261003
#ifndef caisson_mpm_kernels_overstress_h
#define caisson_mpm_kernels_overstress_h

#include <caisson_mpm/kernels/material_law.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      /** The radius of the largest of Mohr's circles. */
      template <typename Number>
      [[gnu::always_inline]] inline Number
      largest_radius(const StressState<Number> &s)
      {
        const Number center = Number(.5) * (s.rr + s.zz),
                     half   = Number(.5) * (s.rr - s.zz),
                     radius = sqrt(half * half + s.rz * s.rz);
        return Number(.5) *
               (max(s.tt, center + radius) - min(s.tt, center - radius));
      }

      /**
       * Law::update() with an overstress. @p n_steps is the time t of the
       * file's head over the time step. What the law keeps besides its plastic
       * strains may not depend on what they become in the step.
       */
      template <typename Law, typename Number>
      [[gnu::always_inline]] inline void
      update_with_overstress(StressState<Number>            &sigma,
                             const StrainIncrement<Number>  &de,
                             LawState<Number>               &state,
                             const typename Law::Parameters &p,
                             const double                    n_steps)
      {
        StressState<Number> trial = sigma;
        add_elastic_increment(trial, de, p.lambda, p.mu);
        const Number deviatoric = state.plastic_deviatoric,
                     volumetric = state.plastic_volumetric;
        Law::update(sigma, de, state, p);

        const Number time = Number(n_steps / p.mu) *
                            largest_radius(sigma), // over the step
          share = time / (time + Number(1.));
        sigma.rr += share * (trial.rr - sigma.rr);
        sigma.zz += share * (trial.zz - sigma.zz);
        sigma.tt += share * (trial.tt - sigma.tt);
        sigma.rz += share * (trial.rz - sigma.rz);
        state.plastic_deviatoric -=
          share * (state.plastic_deviatoric - deviatoric);
        state.plastic_volumetric -=
          share * (state.plastic_volumetric - volumetric);
      }
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
