// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Hypoplastic sand (hypoplasticity.h) with the intergranular strain of Niemunis
// & Herle (1997), so that sand is stiff after a reversal of its strain and
// where it has hardly been strained; and its integration over a step. The
// defaults of its own entries are those of Niemunis & Herle for Hochstetten
// sand.
//
// At the start, h points to vertical compression and has a share of the length
// R: 0 for sand at rest for long, 1 right after it was laid down.
//
// The step is integrated by pairs of Euler and Heun of first and second order
// with substeps chosen lane by lane, so that the difference of both stays below
// a tolerance times |T| + 10 p_t (Sloan 1987); the void ratio grows with tr D.
// Where a step changes the stress by very little, Euler alone is enough. The
// rate is homogeneous in D: time steps have no meaning here.
//
// The law remembers the strain of the last steps: the intergranular strain h,
// with the sign of D and of the length R at most.
// With rho = |h|/R and h^ = h/|h|, the stress feels, in place of D and |D|,
//
//   E = [rho^chi m_T + (1 - rho^chi) m_R] D
//         + rho^chi (1 - m_T) (h^:D) h^,     l = rho^chi h^:D   if h^:D > 0,
//         + rho^chi (m_R - m_T) (h^:D) h^,   l = 0              otherwise,
//   dh = D - rho^beta_r (h^:D) h^            if h^:D > 0,   D   otherwise.
//
// Straight on, E tends to D and l to |D|: the law without a memory. After a
// reversal, and where h = 0, the sand is m_R times as stiff as its linear part
// alone, and next to elastic for strains that are small beside R. The error of
// a substep in h stays below 1/50 of R.
//
// There are no plastic strains. plastic_deviatoric and plastic_volumetric keep
// the accumulated sqrt(2/3 D*:D*) and tr D of the total strain.
//
// References:
//   A. Niemunis, I. Herle (1997), Hypoplastic model for cohesionless soils with
//     elastic strain range. Mech. Cohes.-Frict. Mater. 2, 279-299.
//   S.W. Sloan (1987), Substepping schemes for the numerical integration of
//     elastoplastic stress-strain relations. Int. J. Numer. Meth. Engng 24,
//     893-911. doi:10.1002/nme.1620240505
#ifndef caisson_mpm_kernels_hypoplastic_intergranular_h
#define caisson_mpm_kernels_hypoplastic_intergranular_h

#include <caisson_mpm/kernels/hypoplasticity.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** The law "hypoplastic sand with intergranular strain". Its state is the
     * intergranular strain: rr, zz, tt, rz. See the head of the file. */
    struct HypoplasticIntergranular : Hypoplasticity
    {
      static constexpr const char *name =
        "hypoplastic sand with intergranular strain";
      static constexpr int  n_state           = 4;
      static constexpr bool state_is_a_tensor = true;

      static void
      start(const Parameters &p, double *variable)
      {
        variable[1] = -p.start * p.range;
      }

      /** Of the substeps: relative error, smallest share of a step. */
      static constexpr double tolerance = 1e-3, smallest_substep = 1e-3;

      /** Relative change of stress up to which Euler alone is used. */
      static constexpr double small_change = 2e-4;

      /** The same of the strain, over R; and the error of h, over R. */
      static constexpr double small_strain = 2e-2, error_of_memory = 2e-2;

      template <typename Number>
      [[gnu::always_inline]] static inline void
      update(StressState<Number>           &sigma,
             const StrainIncrement<Number> &D,
             LawState<Number>              &law_state,
             const Parameters              &p)
      {
        using Mask = typename Number::Mask;
        const Number one(1.), zero(0.);
        const Number square = product(D, D), trace = D.rr + D.zz + D.tt;

        State<Number> state = state_at_start(sigma, law_state, p);

        // the share of the step that is done, and that of the next substep
        Number done(0.), share(1.);
        for (int n = 0; n < 2000; ++n)
          {
            const Substep<Number> substep = take_substep(state, D, share, p);
            // nearly always one substep is enough for all lanes
            if (n == 0 && !any(substep.error > Number(tolerance)))
              {
                state = substep.end;
                break;
              }
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
        sigma                 = shifted(state.stress, p.shift);
        law_state.variable[0] = state.memory.rr;
        law_state.variable[1] = state.memory.zz;
        law_state.variable[2] = state.memory.tt;
        law_state.variable[3] = state.memory.rz;
        law_state.plastic_deviatoric +=
          sqrt(max((2. / 3.) * (square - (1. / 3.) * trace * trace), zero));
        law_state.plastic_volumetric += trace;
      }

    private:
      /** Shifted stress, void ratio and h. */
      template <typename Number>
      struct State
      {
        StressState<Number> stress;
        Number              void_ratio;
        StressState<Number> memory;
      };

      template <typename Number>
      [[gnu::always_inline]] static inline State<Number>
      state_at_start(const StressState<Number> &sigma,
                     const LawState<Number>    &law_state,
                     const Parameters          &p)
      {
        State<Number> state{shifted(sigma, -p.shift),
                            law_state.void_ratio,
                            {law_state.variable[0],
                             law_state.variable[1],
                             law_state.variable[2],
                             law_state.variable[3]}};
        hold_in_bounds(state, p);
        return state;
      }

      template <typename Number>
      [[gnu::always_inline]] static inline void
      hold_in_bounds(State<Number> &state, const Parameters &p)
      {
        Hypoplasticity::hold_in_bounds(state.stress, p);
        Hypoplasticity::hold_below_loosest(state.stress, state.void_ratio, p);
        const Number square = product(state.memory, state.memory),
                     largest(p.range * p.range);
        if (any(square > largest))
          state.memory =
            scaled(sqrt(largest / max(square, largest)), state.memory);
      }

      /** What the stress feels of a strain increment; and dh. */
      template <typename Number>
      struct MobilizedStrain
      {
        StressState<Number> D;
        Number              length;
        StressState<Number> memory;
      };

      template <typename Number>
      [[gnu::always_inline]] static inline MobilizedStrain<Number>
      mobilize(const StressState<Number> &h,
               const StressState<Number> &D,
               const Parameters          &p)
      {
        const Number square  = max(product(h, h), Number(1e-60)),
                     length  = sqrt(square);
        const Number rho     = min(length * (1. / p.range), Number(1.)),
                     along   = product(h, D);
        const auto   forward = along > Number(0.);
        const auto   share   = along / square; // along h
        const Number log_rho = p.by_roots ? Number(0.) : log2(rho);
        const auto   power   = [&](const double exponent) {
          return p.by_roots ? quarter_power(rho, exponent) :
                                  exp2(exponent * log_rho);
        };
        const Number kept = power(p.decay);
        const Number more =
          select(forward, Number(1. - p.turned), Number(p.reversed - p.turned));
        const Number all = p.reversed + kept * (p.turned - p.reversed);
        const Number lost =
          select(forward, power(p.evolution) * share, Number(0.));
        return {sum(scaled(all, D), kept * more * share, h),
                select(forward, kept * share * length, Number(0.)),
                sum(D, -lost, h)};
      }

      /** The end of a substep and its relative error. */
      template <typename Number>
      struct Substep
      {
        State<Number> end;
        Number        error;
      };

      /** Take @p a where @p mask is set, else @p b. */
      template <typename Number>
      [[gnu::always_inline]] static inline State<Number>
      choose(const typename Number::Mask &mask,
             const State<Number>         &a,
             const State<Number>         &b)
      {
        return {select(mask, a.stress, b.stress),
                select(mask, a.void_ratio, b.void_ratio),
                select(mask, a.memory, b.memory)};
      }

      /** The increments of a state for all of @p D. */
      template <typename Number>
      [[gnu::always_inline]] static inline State<Number>
      rate(const State<Number>       &at,
           const StressState<Number> &D,
           const Parameters          &p)
      {
        const MobilizedStrain<Number> mobilized = mobilize(at.memory, D, p);
        return {stress_increment(
                  at.stress, at.void_ratio, mobilized.D, mobilized.length, p),
                (1. + at.void_ratio) * (D.rr + D.zz + D.tt),
                mobilized.memory};
      }

      /** The state after the share @p share of an increment. */
      template <typename Number>
      [[gnu::always_inline]] static inline State<Number>
      advanced(const State<Number> &start,
               const Number         share,
               const State<Number> &increment)
      {
        return {sum(start.stress, share, increment.stress),
                start.void_ratio + share * increment.void_ratio,
                sum(start.memory, share, increment.memory)};
      }

      /** One substep of the share @p share of the step: Euler, or Heun in
       * lanes whose stress changes more. */
      template <typename Number>
      [[gnu::always_inline]] static inline Substep<Number>
      take_substep(const State<Number>       &start,
                   const StressState<Number> &D,
                   const Number               share,
                   const Parameters          &p)
      {
        // Euler: T + share dT(T)
        const State<Number> first = rate(start, D, p);
        State<Number>       euler = advanced(start, share, first);
        hold_in_bounds(euler, p);
        const Number scale =
          sqrt(product(euler.stress, euler.stress)) + 10. * p.shift;
        const Number shares = share * share, small = small_change * scale,
                     change = shares * product(first.stress, first.stress);
        const auto is_large =
          (change > small * small) |
          (shares * product(D, D) >
           Number(small_strain * small_strain * p.range * p.range));

        Substep<Number> result{euler, Number(0.)};
        if (any(is_large))
          {
            // Heun: T + share (dT(T) + dT(Euler)) / 2; half the difference of
            // both rates is the error of Euler
            const State<Number>       second     = rate(euler, D, p);
            const Number              half       = .5 * share;
            const StressState<Number> difference = sum(second.stress,
                                                       Number(-1.),
                                                       first.stress),
                                      other      = sum(second.memory,
                                                  Number(-1.),
                                                  first.memory);
            State<Number> heun =
              advanced(advanced(start, half, first), half, second);
            hold_in_bounds(heun, p);
            result.end = choose(is_large, heun, euler);
            const Number error =
              max(half * sqrt(product(difference, difference)) / scale,
                  half * sqrt(product(other, other)) *
                    (tolerance / (error_of_memory * p.range)));
            result.error = select(is_large, error, Number(0.));
          }
        return result;
      }

      /** The share of the next substep: from the error of the last one, and
       * no more than is left. */
      template <typename Number>
      [[gnu::always_inline]] static inline Number
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
} // namespace CaissonMPM::Kernels

#endif
