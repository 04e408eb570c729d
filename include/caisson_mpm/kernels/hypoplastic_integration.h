// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The integration of hypoplastic sand over a step.
//
// The step is integrated by pairs of Euler and Heun of first and second order
// with substeps chosen lane by lane, so that the difference of both stays below
// a tolerance times |T| + 10 p_t (Sloan 1987); the void ratio grows with tr D.
// Where a step changes the stress by very little, Euler alone is enough. The
// rate is homogeneous in D: time steps have no meaning here.
//
// There are no plastic strains. plastic_deviatoric and plastic_volumetric keep
// the accumulated sqrt(2/3 D*:D*) and tr D of the total strain.
//
// Reference:
//   S.W. Sloan (1987), Substepping schemes for the numerical integration of
//     elastoplastic stress-strain relations. Int. J. Numer. Meth. Engng 24,
//     893-911. doi:10.1002/nme.1620240505
#ifndef caisson_mpm_kernels_hypoplastic_integration_h
#define caisson_mpm_kernels_hypoplastic_integration_h

#include <caisson_mpm/kernels/hypoplasticity.h>

namespace CaissonMPM
{
  namespace Kernels
  {
    inline namespace CAISSON_KERNEL_ISA
    {
      /** The equations with their integration: what a law of hypoplastic sand
       * consists of. See the head of the file. */
      struct HypoplasticIntegration : Hypoplasticity
      {
        /** Of the substeps: relative error, smallest share of a step. */
        static constexpr double tolerance = 1e-3, smallest_substep = 1e-3;

        /** Relative change of stress up to which Euler alone is used. */
        static constexpr double small_change = 2e-4;

        template <typename Number>
        static CAISSON_INLINE void
        update(StressState<Number>           &sigma,
               const StrainIncrement<Number> &de,
               LawState<Number>              &law_state,
               const Parameters              &p)
        {
          using Mask = typename Number::Mask;
          const Number              one(1.), zero(0.);
          const StressState<Number> D{de.rr, de.zz, de.tt, de.rz};
          const Number              square = product(D, D);
          const Number              length = sqrt(square);
          const Number              trace  = D.rr + D.zz + D.tt;

          State<Number> state{{sigma.rr - p.shift,
                               sigma.zz - p.shift,
                               sigma.tt - p.shift,
                               sigma.rz},
                              law_state.void_ratio};
          hold_in_bounds(state.stress, p);

          // the share of the step that is done, and that of the next substep
          Number done(0.), share(1.);
          for (int n = 0; n < 2000; ++n)
            {
              const Substep<Number> substep =
                take_substep(state, D, length, share, p);
              const Mask running = done < one;
              // a NaN is accepted, and noticed elsewhere
              const Mask accepted =
                running & !((substep.error > Number(tolerance)) &
                            (share > Number(smallest_substep)));
              state = choose(accepted, substep.end, state);
              // an end that is missed by round-off only is reached
              done = select(accepted, done + share, done);
              done = select(done > Number(1. - 1e-12), one, done);
              if (!any(done < one))
                break;
              share = next_share(share, substep.error, done);
            }
          sigma = {state.stress.rr + p.shift,
                   state.stress.zz + p.shift,
                   state.stress.tt + p.shift,
                   state.stress.rz};
          law_state.plastic_deviatoric +=
            sqrt(max((2. / 3.) * (square - (1. / 3.) * trace * trace), zero));
          law_state.plastic_volumetric += trace;
        }

      private:
        /** Shifted stress and void ratio. */
        template <typename Number>
        struct State
        {
          StressState<Number> stress;
          Number              void_ratio;
        };

        /** The end of a substep and its relative error. */
        template <typename Number>
        struct Substep
        {
          State<Number> end;
          Number        error;
        };

        /** Take @p a where @p mask is set, else @p b. */
        template <typename Number>
        static CAISSON_INLINE State<Number>
                              choose(const typename Number::Mask &mask,
                                     const State<Number>         &a,
                                     const State<Number>         &b)
        {
          return {select(mask, a.stress, b.stress),
                  select(mask, a.void_ratio, b.void_ratio)};
        }

        /** The increments of shifted stress and void ratio for all of @p D. */
        template <typename Number>
        static CAISSON_INLINE State<Number>
                              rate(const State<Number>       &at,
                                   const StressState<Number> &D,
                                   const Number               length,
                                   const Parameters          &p)
        {
          return {stress_increment(at.stress, at.void_ratio, D, length, p),
                  (1. + at.void_ratio) * (D.rr + D.zz + D.tt)};
        }

        /** One substep of the share @p share of the step: Euler, or Heun in
         * lanes whose stress changes more. */
        template <typename Number>
        static CAISSON_INLINE Substep<Number>
                              take_substep(const State<Number>       &start,
                                           const StressState<Number> &D,
                                           const Number               length,
                                           const Number               share,
                                           const Parameters          &p)
        {
          // Euler: T + share dT(T)
          const State<Number> first = rate(start, D, length, p);
          State<Number>       euler{sum(start.stress, share, first.stress),
                              start.void_ratio + share * first.void_ratio};
          hold_in_bounds(euler.stress, p);
          const Number scale =
            sqrt(product(euler.stress, euler.stress)) + 10. * p.shift;
          const Number change =
            share * sqrt(product(first.stress, first.stress));
          const auto is_large = change > small_change * scale;

          Substep<Number> result{euler, Number(0.)};
          if (any(is_large))
            {
              // Heun: T + share (dT(T) + dT(Euler)) / 2; half the difference of
              // both rates is the error of Euler
              const State<Number>       second = rate(euler, D, length, p);
              const Number              half   = .5 * share;
              const StressState<Number> difference =
                sum(second.stress, Number(-1.), first.stress);
              State<Number> heun{
                sum(sum(start.stress, half, first.stress), half, second.stress),
                start.void_ratio +
                  half * (first.void_ratio + second.void_ratio)};
              hold_in_bounds(heun.stress, p);
              result.end = choose(is_large, heun, euler);
              result.error =
                select(is_large,
                       half * sqrt(product(difference, difference)) / scale,
                       Number(0.));
            }
          return result;
        }

        /** The share of the next substep: from the error of the last one, and
         * no more than is left. */
        template <typename Number>
        static CAISSON_INLINE Number
        next_share(const Number share, const Number error, const Number done)
        {
          const Number growth =
            max(min(.9 * sqrt(Number(tolerance) / max(error, Number(1e-12))),
                    Number(4.)),
                Number(.1));
          return min(max(share * growth, Number(smallest_substep)),
                     max(Number(1.) - done, Number(1e-12)));
        }
      };
    } // namespace CAISSON_KERNEL_ISA
  }   // namespace Kernels
} // namespace CaissonMPM

#endif
