// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Hypoplastic sand of von Wolffersdorff (1996): a rate equation without a yield
// surface, in which strength, dilatancy and stiffness follow from the effective
// stress T and the void ratio e. With D the strain increment,
//
//   dT = f_b f_e / tr(S S) [F^2 D + a^2 S tr(S D) + f_d a F (S + S*) |D|],
//   S = T / tr T,   S* = S - 1/3,
//   a = sqrt(3) (3 - sin phi_c) / (2 sqrt(2) sin phi_c),
//   F = sqrt(t^2/8 + (2 - t^2) / (2 + sqrt(2) t cos 3theta)) - t / (2 sqrt 2),
//   t = sqrt(3) |S*|,   cos 3theta = -sqrt(6) tr(S* S* S*) / |S*|^3,
//   f_d = ((e - e_d) / (e_c - e_d))^alpha,   f_e = (e_c / e)^beta,
//   f_b = h_s/n (e_i0/e_c0)^beta (1 + e_i)/e_i (3p/h_s)^(1-n)
//         / [3 + a^2 - a sqrt(3) ((e_i0 - e_d0) / (e_c0 - e_d0))^alpha],
//   e_i / e_i0 = e_c / e_c0 = e_d / e_d0 = exp(-(3p/h_s)^n)   (Bauer 1996),
//
// p = -tr T / 3. F is the stress criterion of Matsuoka & Nakai. What bounds the
// law where it has no meaning:
//
// - T = sigma - p_t I with p_t = "Smallest mean stress": a small apparent
//   cohesion p_t tan(phi), with which soil at a free surface keeps a stiffness.
//   Where p falls below p_t the soil has parted, and sigma is set to 0 there.
// - No principal value of S is less than 1/50; the deviator is reduced to that.
// - e below e_d has f_d = 0.
// - e above e_i(p) has no state: grains in so loose a packing do not bear p.
// The
//   stress is reduced to that with e_i(p) = e, and is 0 from e_i(p_t) on, where
//   the soil has a gap.
//
// References:
//   P.-A. von Wolffersdorff (1996), A hypoplastic relation for granular
//     materials with a predefined limit state surface. Mech. Cohes.-Frict.
//     Mater. 1, 251-271. doi:10.1002/(SICI)1099-1484(199607)1:3<251::AID-CFM13>
//     3.0.CO;2-3
//   E. Bauer (1996), Calibration of a comprehensive hypoplastic model for
//     granular materials. Soils Found. 36(1), 13-26.
//     doi:10.3208/sandf.36.13
//   G. Gudehus (1996), A comprehensive constitutive equation for granular
//     materials. Soils Found. 36(1), 1-12. doi:10.3208/sandf.36.1
//   I. Herle, G. Gudehus (1999), Determination of parameters of a hypoplastic
//     constitutive model from properties of grain assemblies. Mech. Cohes.-
//     Frict. Mater. 4, 461-486. (The defaults are their Karlsruhe sand.)
#ifndef caisson_mpm_kernels_hypoplasticity_h
#define caisson_mpm_kernels_hypoplasticity_h

#include <caisson_mpm/kernels/material_law.h>
#include <caisson_mpm/kernels/simd_math.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /**
     * The equations of hypoplastic sand: rate-type, without a yield surface,
     * with the void ratio as state. See the head of the file.
     */
    struct Hypoplasticity : MaterialLaw
    {
      static constexpr bool uses_void_ratio = true, stiffness_varies = true,
                            is_packed = true, has_loosest_state = true,
                            knows_what_it_bears = true;

      struct Parameters : LawNumbers
      {
        double hardness, n, e_d0, e_c0, e_i0, alpha, beta;

        /** p_t. Units: Pa. */
        double shift;

        /** Of the intergranular strain: R, m_R, m_T, beta_r, chi, and |h| / R
         * at the start. */
        double range, reversed, turned, evolution, decay, start;

        double sin_phi, a;

        /** What of f_b depends on neither stress nor e_i. Units: Pa. */
        double stiffness;

        /** Whether both powers of |h| / R are computed by roots. */
        bool by_roots;

        /** Up to the pressure dense_pressure, e_i is at least dense. Most
         * soil has less of both, and needs no closer look. Units: Pa. */
        static constexpr double dense_pressure = 1e6;
        double                  dense;

        void
        derive()
        {
          densest = e_d0;
          loosest = e_c0;
          sin_phi = __builtin_sin(friction_angle * radians_per_degree);
          a       = __builtin_sqrt(3.) * (3. - sin_phi) /
              (2. * __builtin_sqrt(2.) * sin_phi);
          stiffness =
            hardness / n * __builtin_pow(e_i0, beta) / denominator(*this);
          dense    = loosest_void_ratio(Lanes<1>(dense_pressure), *this)[0];
          by_roots = has_quarter_power(evolution) && has_quarter_power(decay);
        }
      };

      static constexpr LawEntry<Parameters> entries[] = {
        {&Parameters::friction_angle, Entries::critical_friction_angle},
        {&Parameters::hardness,
         {"Granulate hardness",
          "Pa",
          "The granulate hardness of hypoplastic sand is h_s of Bauer's law "
          "of compression.",
          5.8e9,
          1e5,
          no_limit}},
        {&Parameters::n,
         {"Compression exponent",
          "",
          "The compression exponent of hypoplastic sand is n of Bauer's law "
          "of compression.",
          0.28,
          0.05,
          0.95}},
        {&Parameters::e_d0,
         {"Densest void ratio",
          "",
          "The smallest void ratio of hypoplastic sand at zero pressure is "
          "e_d0.",
          0.53,
          0.01,
          10.}},
        {&Parameters::e_c0,
         {"Critical void ratio",
          "",
          "The void ratio of hypoplastic sand in the critical state at zero "
          "pressure is e_c0.",
          0.84,
          0.01,
          10.}},
        {&Parameters::e_i0,
         {"Loosest void ratio",
          "",
          "The largest void ratio of hypoplastic sand at zero pressure is "
          "e_i0.",
          1.,
          0.01,
          10.}},
        {&Parameters::alpha,
         {"Density exponent of strength",
          "",
          "The exponent alpha sets the peak strength of dense hypoplastic "
          "sand.",
          0.13,
          0.,
          1.}},
        {&Parameters::beta,
         {"Density exponent of stiffness",
          "",
          "The exponent beta sets the stiffness of dense hypoplastic sand.",
          1.05,
          0.,
          10.}},
        {&Parameters::shift,
         {"Smallest mean stress",
          "Pa",
          "Hypoplastic sand behaves as if its mean effective stress were "
          "larger by this, p_t, and parts under a larger tension.",
          100.,
          1.,
          1e5}},
        {&Parameters::range,
         {"Elastic range of strain",
          "",
          "The intergranular strain has the length R at most; sand is "
          "nearly elastic for strains that are small beside it.",
          1e-4,
          1e-7,
          1e-2}},
        {&Parameters::reversed,
         {"Stiffness factor of reversals",
          "",
          "The stiffness after a reversal of the strain, and of sand at "
          "rest, is m_R times that of the linear part of the law.",
          5.,
          1.,
          100.}},
        {&Parameters::turned,
         {"Stiffness factor of turns",
          "",
          "The stiffness after a turn of the strain path by 90 degrees is "
          "m_T times that of the linear part of the law.",
          2.,
          1.,
          100.}},
        {&Parameters::evolution,
         {"Evolution exponent",
          "",
          "The intergranular strain approaches its largest length with the "
          "exponent beta_r.",
          0.5,
          0.01,
          10.}},
        {&Parameters::decay,
         {"Stiffness decay exponent",
          "",
          "The additional stiffness decays with the power chi of the "
          "intergranular strain.",
          6.,
          0.1,
          100.}},
        {&Parameters::start,
         {"Intergranular strain at the start",
          "",
          "At the start the intergranular strain is this share of R, in "
          "vertical compression: 0 for sand long at rest, 1 for sand just "
          "laid down.",
          0.,
          0.,
          1.}}};

      static bool
      check(const Parameters &p, const LawContext &context, LawMessage &message)
      {
        const double e_d = p.e_d0, e_c = p.e_c0, e_i = p.e_i0;
        if (p.turned > p.reversed)
          return message.refuse("Stiffness factor of turns = %g exceeds "
                                "Stiffness factor of reversals = %g. Lower it.",
                                p.turned,
                                p.reversed);
        if (!(e_d < e_c && e_c < e_i))
          return message.refuse(
            "Densest void ratio = %g, Critical void ratio = %g and Loosest "
            "void ratio = %g must grow in this order. Correct them.",
            e_d,
            e_c,
            e_i);
        if (context.void_ratio < e_d || context.void_ratio > e_i)
          return message.refuse(
            "Porosity = %g, a void ratio of %g, lies outside Densest void "
            "ratio = %g to Loosest void ratio = %g (porosities %g to %g). "
            "Change one of them.",
            context.void_ratio / (1. + context.void_ratio),
            context.void_ratio,
            e_d,
            e_i,
            e_d / (1. + e_d),
            e_i / (1. + e_i));
        const double loosest =
          loosest_void_ratio(Lanes<1>(context.mean_stress + p.shift), p)[0];
        if (context.void_ratio > loosest)
          return message.refuse(
            "Porosity = %g, a void ratio of %g, is looser "
            "than the loosest state, %g, at the mean stress "
            "%g Pa. Lower it, or check Granulate hardness.",
            context.void_ratio / (1. + context.void_ratio),
            context.void_ratio,
            loosest,
            context.mean_stress);
        if (!(denominator(p) > 0.))
          return message.refuse("Density exponent of strength = %g leaves the "
                                "loosest sand without stiffness. Lower it.",
                                p.alpha);
        return true;
      }

      /** Up to the limit stress of its density, where the stress no longer
       * changes: f_d |L^-1 : N| = 1. */
      template <typename Number>
      static bool
      bears(const StressState<Number> &sigma,
            const Number               void_ratio,
            const Parameters          &p)
      {
        const Factors<Number> f =
          factors(shifted(sigma, -p.shift), void_ratio, p);
        const StressState<Number> &s = f.s;
        // L^-1 : N = a / F (s + dev s - share s)
        const double third = 1. / 3., F = f.F[0], ss = product(s, s)[0],
                     share =
                       p.a * p.a * (2. * ss - third) / (F * F + p.a * p.a * ss);
        const auto on_s = [&](const Number component, const double shift) {
          return (2. - share) * component - Number(shift);
        };
        const StressState<Number> b{on_s(s.rr, third),
                                    on_s(s.zz, third),
                                    on_s(s.tt, third),
                                    on_s(s.rz, 0.)};
        return f.f_d[0] * p.a * __builtin_sqrt(product(b, b)[0]) < F;
      }

      /** e_i at the pressure -tr T / 3. */
      template <typename Number>
      [[gnu::always_inline]] static inline Number
      loosest_void_ratio(const Number pressure, const Parameters &p)
      {
        return p.e_i0 * exp(-pow(pressure * (3. / p.hardness), p.n));
      }

      template <typename Number>
      [[gnu::always_inline]] static inline Number
      loosest_void_ratio(const StressState<Number> &sigma, const Parameters &p)
      {
        return loosest_void_ratio(shifted_pressure(sigma, p), p);
      }

      template <typename Number>
      [[gnu::always_inline]] static inline typename Number::Mask
      is_loosest(const StressState<Number> &sigma,
                 const Number               volume,
                 const Number               volume_of_solids,
                 const Parameters          &p)
      {
        const Number pressure = shifted_pressure(sigma, p),
                     room     = Number(at_loosest) * volume_of_solids;
        const auto may_be =
          may_be_loosest(pressure, volume, Number(1. + p.dense) * room, p);
        if (!any(may_be))
          return may_be;
        return volume > room * (1. + loosest_void_ratio(pressure, p));
      }

      /** A stress with another mean: less p_t, it is the one with which the
       * equations are evaluated. */
      template <typename Number>
      [[gnu::always_inline]] static inline StressState<Number>
      shifted(const StressState<Number> &sigma, const double by)
      {
        return {sigma.rr + by, sigma.zz + by, sigma.tt + by, sigma.rz};
      }

      /** The pressure of a shifted stress, at least p_t. */
      template <typename Number>
      [[gnu::always_inline]] static inline Number
      shifted_pressure(const StressState<Number> &sigma, const Parameters &p)
      {
        return p.shift + max(Kernels::pressure(sigma), Number(0.));
      }

      /** Where soil may be in its loosest state, which is not below @p dense up
       * to dense_pressure. */
      template <typename Number>
      [[gnu::always_inline]] static inline typename Number::Mask
      may_be_loosest(const Number      pressure,
                     const Number      looseness,
                     const Number      dense,
                     const Parameters &p)
      {
        return (looseness > dense) | (pressure > Number(p.dense_pressure));
      }

      /**
       * A bound of the stiffness rho c^2 of plane waves: for directions n
       * and m, m.(dT/dD : m n).n is at most f_b f_e / tr(S S) (F^2 + a^2 s^2
       * + f_d a F |2 s - 1/3|) with s the principal value of S that makes it
       * largest. The intergranular strain makes the first two terms up to
       * m_R times as large, and turns the strain, so that s is |S| there.
       */
      template <typename Number>
      [[gnu::always_inline]] static inline Number
      p_wave_modulus(const StressState<Number> &stress,
                     const Number               void_ratio,
                     const Parameters          &p)
      {
        StressState<Number> T = shifted(stress, -p.shift);
        hold_in_bounds(T, p);
        const Factors<Number> f    = factors(T, void_ratio, p);
        const Number          half = .5 * (f.s.rr - f.s.zz);
        const Number          s =
          max(.5 * (f.s.rr + f.s.zz) + sqrt(half * half + f.s.rz * f.s.rz),
              f.s.tt);
        const Number linear =
          p.reversed * (f.F * f.F + p.a * p.a * product(f.s, f.s));
        return f.scale * (linear + f.f_d * p.a * f.F * (2. * s - 1. / 3.));
      }

      /** What the rate takes from stress and void ratio. */
      template <typename Number>
      struct Factors
      {
        StressState<Number> s; // S = T / tr T
        Number              scale, F, f_d;
      };

      static double
      denominator(const Parameters &p)
      {
        return 3. + p.a * p.a -
               p.a * __builtin_sqrt(3.) *
                 __builtin_pow((p.e_i0 - p.e_d0) / (p.e_c0 - p.e_d0), p.alpha);
      }

      template <typename Number>
      [[gnu::always_inline]] static inline Number
      product(const StressState<Number> &a, const StressState<Number> &b)
      {
        return a.rr * b.rr + a.zz * b.zz + a.tt * b.tt + 2. * (a.rz * b.rz);
      }

      template <typename Number>
      [[gnu::always_inline]] static inline StressState<Number>
      sum(const StressState<Number> &a,
          const Number               factor,
          const StressState<Number> &b)
      {
        return {a.rr + factor * b.rr,
                a.zz + factor * b.zz,
                a.tt + factor * b.tt,
                a.rz + factor * b.rz};
      }

      /** @p T is the shifted stress, in bounds. */
      template <typename Number>
      [[gnu::always_inline]] static inline Factors<Number>
      factors(const StressState<Number> &T,
              const Number               void_ratio,
              const Parameters          &p)
      {
        const Number    third(1. / 3.);
        const Number    trace = T.rr + T.zz + T.tt;
        Factors<Number> f;
        f.s = scaled(Number(1.) / trace, T);

        // F with cos 3theta = -3 sqrt(6) det(S*) / |S*|^3 put in
        const Number x = f.s.rr - third, y = f.s.zz - third, z = f.s.tt - third,
                     w      = f.s.rz;
        const Number square = max(x * x + y * y + z * z + 2. * (w * w), //
                                  Number(1e-30)),
                     det    = z * (x * y - w * w);
        // one division for both quotients
        const Number tr_SS = third + square, divisor = 2. * square - 18. * det,
                     inverse = Number(1.) / (tr_SS * divisor);
        const Number radicand =
          .375 * square + (2. - 3. * square) * square * tr_SS * inverse;
        f.F = sqrt(max(radicand, Number(0.))) - sqrt(.375 * square);

        // pressure: e_i0 / e_i = exp((3p/h_s)^n), and e at zero pressure
        const Number log_pressure = log2(-trace * (1. / p.hardness));
        const Number growth =
          exp2(1.4426950408889634 * exp2(p.n * log_pressure));
        const Number e =
          max(min(void_ratio * growth, Number(p.e_i0)), Number(.5 * p.e_d0));
        // density
        const Number excess = (e - p.e_d0) * (1. / (p.e_c0 - p.e_d0));
        f.f_d               = select(excess > Number(0.),
                       pow(max(excess, Number(1e-30)), p.alpha),
                       Number(0.));
        f.scale             = p.stiffness * (1. + growth * (1. / p.e_i0)) *
                  exp2((1. - p.n) * log_pressure - p.beta * log2(e)) *
                  (divisor * inverse);
        return f;
      }

      /** Bring a shifted stress into the bounds of the file's head. */
      template <typename Number>
      [[gnu::always_inline]] static inline void
      hold_in_bounds(StressState<Number> &T, const Parameters &parameters)
      {
        const Number mean   = (1. / 3.) * (T.rr + T.zz + T.tt);
        const Number center = .5 * (T.rr + T.zz), half = .5 * (T.rr - T.zz);
        const Number square = half * half + T.rz * T.rz;
        const auto   parted = !(mean < Number(-parameters.shift));
        // what most stresses are: no principal value above the bound
        const Number bound = (3. / 50.) * mean, room = bound - center;
        if (!any(parted | (T.tt > bound) |
                 (square >= room * max(room, Number(0.)))))
          return;
        // how far the least compressive value stands above the mean
        const Number excess  = max(center + sqrt(square), T.tt) - mean;
        const Number allowed = bound - mean;
        const Number share   = select(excess > allowed,
                                    allowed / max(excess, Number(1e-30)),
                                    Number(1.));
        const auto   held    = [&](const Number component) {
          return select(parted,
                        Number(-parameters.shift),
                        mean + share * (component - mean));
        };
        T.rr = held(T.rr);
        T.zz = held(T.zz);
        T.tt = held(T.tt);
        T.rz = select(parted, Number(0.), share * T.rz);
      }

      /** Reduce a shifted stress in bounds to what soil of a void ratio can
       * bear. */
      template <typename Number>
      [[gnu::always_inline]] static inline void
      hold_below_loosest(StressState<Number> &T,
                         const Number         void_ratio,
                         const Parameters    &p)
      {
        const Number pressure = Kernels::pressure(T);
        if (!any(may_be_loosest(pressure, void_ratio, Number(p.dense), p)))
          return;
        const Number largest =
          (p.hardness / 3.) *
          pow(max(log(p.e_i0 / max(void_ratio, Number(.5 * p.e_d0))),
                  Number(1e-30)),
              1. / p.n);
        const auto   parted = !(largest > Number(p.shift));
        const Number share  = min(largest / pressure, Number(1.));
        const auto   held   = [&](const Number component) {
          return select(parted, Number(-p.shift), share * component);
        };
        T.rr = held(T.rr);
        T.zz = held(T.zz);
        T.tt = held(T.tt);
        T.rz = select(parted, Number(0.), share * T.rz);
      }

      /** The increment of a shifted stress in bounds for all of @p D. */
      template <typename Number>
      [[gnu::always_inline]] static inline StressState<Number>
      stress_increment(const StressState<Number> &T,
                       const Number               void_ratio,
                       const StressState<Number> &D,
                       const Number               length,
                       const Parameters          &p)
      {
        const Factors<Number> f    = factors(T, void_ratio, p);
        const Number          on_D = f.scale * f.F * f.F;
        const Number          on_s = f.scale * (p.a * p.a) * product(f.s, D);
        const Number          on_length = f.scale * f.f_d * p.a * f.F * length;
        // S + S* = 2 S - 1/3
        const Number along = on_s + 2. * on_length;
        const Number less  = (1. / 3.) * on_length;
        return {on_D * D.rr + along * f.s.rr - less,
                on_D * D.zz + along * f.s.zz - less,
                on_D * D.tt + along * f.s.tt - less,
                on_D * D.rz + along * f.s.rz};
      }
    };

  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
