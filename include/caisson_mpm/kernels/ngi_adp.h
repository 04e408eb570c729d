// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Anisotropic undrained strength of clay: a simplification of NGI-ADP
// (Grimstad, Andresen & Jostad 2012). The clay has the shear strengths s_A in
// active (triaxial) compression along the vertical z, s_D in direct simple
// shear and s_P in passive extension. The vertical stays the axis of the
// anisotropy, however the soil turns.
//
// With h = (s_rr - s_zz) / 2, u = s_tt - (s_rr + s_zz) / 2, t = n s_rz and
// n = (s_A + s_P) / (2 s_D), Tresca's criterion holds for the deviator from a
// center that moves along the axis of K0 while the surface grows:
//
//   max(rho, (rho + |u - c|) / 2) <= kappa (s_A + s_P) / 2,
//   rho = sqrt((h - c)^2 + t^2),
//   c   = (1 - kappa) tau_0 + kappa (s_A - s_P) / 2,
//   kappa = 2 x / (1 + x^2),   x = sqrt(gamma_p / gamma_pf) <= 1.
//
// tau_0 is the shear stress at the start, that of K0; a stress at the start
// that is off this axis begins within a larger kappa. The plastic shear strain
// at failure, gamma_pf, follows from the shear strains at failure of the three
// tests, less their elastic parts: gamma_pf = D + a^2 (A - D) for a > 0 and
// D + a^2 (P - D) for a < 0, with a = (h - c + (u - c) / 3) over the left side
// of the criterion, between -1 and 1: 1 in active and -1 in passive shearing.
// x^2 grows with dgamma_p / gamma_pf, so that it never falls. In the active
// test tau = tau_0 + kappa (s_A - tau_0).
//
// The plastic strain is that of Koiter's rule in the space of (h, u, t); its
// shear component is that over n, where it is not associated unless n = 1. It
// changes no volume. The step is implicit: x is found by Newton's method with
// the center where it will be, and the return, to the nearest point of the
// surface in the energy of shear, is in closed form. The elasticity is linear
// with G = (G over s_A) s_A. Where a principal stress exceeds the tension
// cut-off, the stress returns as in mohr_coulomb_return.h.
//
// NGI-ADP itself rounds the corners of Tresca's criterion, interpolates
// gamma_pf by an ellipse, takes it at the present direction of shearing, and
// its plastic deviator is that from the center.
//
// Reference:
//   G. Grimstad, L. Andresen, H. P. Jostad (2012), NGI-ADP: Anisotropic shear
//     strength model for clay. Int. J. Numer. Anal. Meth. Geomech. 36,
//     483-497. doi:10.1002/nag.1016
#ifndef caisson_mpm_kernels_ngi_adp_h
#define caisson_mpm_kernels_ngi_adp_h

#include <caisson_mpm/kernels/mohr_coulomb_return.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** The law "NGI-ADP". See the head of the file. */
    struct NgiAdp : ElasticLaw
    {
      static constexpr const char *name                = "NGI-ADP";
      static constexpr int         n_state             = 2;
      static constexpr bool        knows_what_it_bears = true;

      struct Parameters : Elasticity
      {
        double active, direct_ratio, passive_ratio; // entries: s_A in Pa
        double active_failure, direct_failure, passive_failure; // entries
        double modulus_ratio;                                   // an entry

        MohrCoulombStrength<double> cutoff; // the tension cut-off alone
        double                      center; // (s_A - s_P) / 2
        double                      radius; // (s_A + s_P) / 2
        double                      shear_scale, inverse_scale; // n, 1 / n
        // strains at failure: A - s_A / G, n (D - s_D / G), P - s_P / G
        double active_strain, direct_strain, passive_strain;

        void
        derive()
        {
          const double A = active, D = A * direct_ratio, P = A * passive_ratio,
                       G = A * modulus_ratio, n = .5 * (A + P) / D;
          youngs_modulus = 2. * G * (1. + poisson_ratio);
          Elasticity::derive();
          shear_strength           = D;
          constexpr double no_cone = MohrCoulombStrength<double>::no_cutoff;
          cutoff                   = MohrCoulombStrength<double>::make(
            *this, 0., 1., 0., no_cone, tension_cutoff);
          center         = .5 * (A - P);
          radius         = .5 * (A + P);
          shear_scale    = n;
          inverse_scale  = 1. / n;
          active_strain  = active_failure - A / G;
          direct_strain  = n * (direct_failure - D / G);
          passive_strain = passive_failure - P / G;
        }
      };

      static constexpr LawEntry<Parameters> entries[] = {
        {&Parameters::active,
         {"Active strength",
          "Pa",
          "The undrained shear strength s_uA of clay in active compression "
          "along the vertical.",
          10e3,
          1e-3,
          no_limit}},
        {&Parameters::direct_ratio,
         {"Direct shear strength ratio",
          "",
          "The undrained shear strength of direct simple shear over the "
          "active one, s_uDSS / s_uA.",
          0.7,
          0.05,
          2.}},
        {&Parameters::passive_ratio,
         {"Passive strength ratio",
          "",
          "The undrained shear strength of passive extension over the active "
          "one, s_uP / s_uA.",
          0.5,
          0.05,
          1.}},
        {&Parameters::active_failure,
         {"Active failure strain",
          "",
          "The shear strain at failure in active compression, 3/2 of the "
          "axial strain.",
          0.02,
          1e-5,
          1.}},
        {&Parameters::direct_failure,
         {"Direct shear failure strain",
          "",
          "The shear strain at failure in direct simple shear.",
          0.04,
          1e-5,
          1.}},
        {&Parameters::passive_failure,
         {"Passive failure strain",
          "",
          "The shear strain at failure in passive extension, 3/2 of the "
          "axial strain.",
          0.06,
          1e-5,
          1.}},
        {&Parameters::modulus_ratio,
         {"Unloading shear modulus ratio",
          "",
          "The shear modulus G_ur of unloading and reloading over the active "
          "strength.",
          500.,
          1.,
          1e5}},
        {&Parameters::poisson_ratio, Entries::poisson_ratio},
        {&Parameters::tension_cutoff, Entries::tension_cutoff}};

      static bool
      check(const Parameters &p, const LawContext &context, LawMessage &message)
      {
        const double k = context.earth_pressure_at_rest,
                     tau_0 =
                       1.5 * context.mean_stress * (1. - k) / (1. + 2. * k),
                     off_center = tau_0 - p.center;
        // a stress beyond the strength is refused by bears()
        return (off_center < 0. ? -off_center : off_center) >= p.radius ||
               check_strains(p, tau_0, message);
      }

      /** Below the active and the passive strength. */
      template <typename Number>
      static bool
      bears(const StressState<Number> &sigma,
            const Number /*void_ratio*/,
            const Parameters &p)
      {
        return Centered<Number>(Shear<Number>(sigma, p), Number(p.center))
                 .tresca()[0] < p.radius;
      }

      static VolumeInShear
      volume_in_shear(const Parameters &)
      {
        return VolumeInShear::kept;
      }

      /** The default where it is a total stress at rest. */
      static double
      earth_pressure_at_rest(const Parameters &)
      {
        return 1.;
      }

      /** x; it is -1 until the first step finds tau_0. */
      static void
      start(const Parameters &, double *variable)
      {
        variable[0] = -1.;
      }

      template <typename Number>
      [[gnu::always_inline]] static inline void
      update(StressState<Number>           &sigma,
             const StrainIncrement<Number> &de,
             LawState<Number>              &state,
             const Parameters              &p)
      {
        if (any(state.variable[0] < Number(0.)))
          begin(sigma, state, p);
        add_elastic_increment(sigma, de, p.lambda, p.mu);
        const Shear<Number>    trial(sigma, p);
        Number                &x     = state.variable[0];
        const Number           tau_0 = state.variable[1];
        const Centered<Number> off(trial, center(mobilization(x), tau_0, p));
        const Number           f = off.tresca() - radius(mobilization(x), p);
        if (any(f > Number(0.)))
          {
            x                        = hardened(trial, off, x, tau_0, p);
            const Shear<Number> back = returned(trial, x, tau_0, p);
            state.plastic_deviatoric +=
              Number(.5 / p.mu) * distance(trial, back, p);
            sigma = back.stress(pressure(sigma), p);
          }
        cut_off(sigma, state, p);
      }

    private:
      /** h, u and t of the file's head. */
      template <typename Number>
      struct Shear
      {
        Number h, u, t;

        Shear() = default;

        [[gnu::always_inline]] inline Shear(const StressState<Number> &s,
                                            const Parameters          &p)
          : h(Number(.5) * (s.rr - s.zz))
          , u(s.tt - Number(.5) * (s.rr + s.zz))
          , t(Number(p.shear_scale) * s.rz)
        {}

        /** The stress with this mean pressure. */
        [[gnu::always_inline]] inline StressState<Number>
        stress(const Number pressure, const Parameters &p) const
        {
          const Number in_plane = -pressure - Number(1. / 3.) * u;
          return {in_plane + h,
                  in_plane - h,
                  in_plane + u,
                  Number(p.inverse_scale) * t};
        }
      };

      /** What a stress has from a center c. */
      template <typename Number>
      struct Centered
      {
        Number h, u, rho;

        [[gnu::always_inline]] inline Centered(const Shear<Number> &s,
                                               const Number         c)
          : h(s.h - c)
          , u(s.u - c)
          , rho(sqrt(h * h + s.t * s.t))
        {}

        /** The left side of the criterion. */
        [[gnu::always_inline]] inline Number
        tresca() const
        {
          return max(rho, Number(.5) * (rho + abs(u)));
        }

        /** Its derivative by c. */
        [[gnu::always_inline]] inline Number
        slope() const
        {
          const Number of_rho = h / max(rho, Number(1e-30)),
                       of_u   = select(u > Number(0.), Number(1.), Number(-1.));
          return -select(abs(u) > rho, Number(.5) * (of_rho + of_u), of_rho);
        }
      };

      /** kappa. */
      template <typename Number>
      [[gnu::always_inline]] static inline Number
      mobilization(const Number x)
      {
        return (x + x) / (Number(1.) + x * x);
      }

      template <typename Number>
      [[gnu::always_inline]] static inline Number
      center(const Number kappa, const Number tau_0, const Parameters &p)
      {
        return tau_0 + kappa * (Number(p.center) - tau_0);
      }

      template <typename Number>
      [[gnu::always_inline]] static inline Number
      radius(const Number kappa, const Parameters &p)
      {
        return kappa * Number(p.radius);
      }

      /** Take tau_0 and x from the stress at the start. */
      template <typename Number>
      [[gnu::always_inline]] static inline void
      begin(const StressState<Number> &sigma,
            LawState<Number>          &state,
            const Parameters          &p)
      {
        const Shear<Number> s(sigma, p);
        const auto          fresh = state.variable[0] < Number(0.);
        // the part along the axis of K0, within what the surface can hold
        const Number tau_0 = min(max(Number(.75) * s.h + Number(.25) * s.u,
                                     Number(p.center - .999 * p.radius)),
                                 Number(p.center + .999 * p.radius));
        const Number room  = Number(p.radius) - abs(Number(p.center) - tau_0);
        const Number kappa =
          min(Centered<Number>(s, tau_0).tresca() / room, Number(1.));
        const Number x =
          kappa /
          (Number(1.) + sqrt(max(Number(1.) - kappa * kappa, Number(0.))));
        state.variable[0] = select(fresh, x, state.variable[0]);
        state.variable[1] = select(fresh, tau_0, state.variable[1]);
      }

      /** gamma_pf in the direction of a stress. */
      template <typename Number>
      [[gnu::always_inline]] static inline Number
      failure_strain(const Centered<Number> &s,
                     const Number            tau_0,
                     const Parameters       &p)
      {
        const Number inverse_G(1. / p.mu), D(p.direct_strain),
          a = (s.h + Number(1. / 3.) * s.u) / max(s.tresca(), Number(1e-30)),
          share  = min(a * a, Number(1.)),
          far    = select(a > Number(0.),
                       Number(p.active_strain) + inverse_G * tau_0,
                       Number(p.passive_strain) - inverse_G * tau_0),
          result = D + share * (far - D);
        return max(result, Number(least_strain));
      }

      /** The x to which a trial stress hardens the soil. */
      template <typename Number>
      [[gnu::always_inline]] static inline Number
      hardened(const Shear<Number>    &trial,
               const Centered<Number> &off,
               const Number            x_old,
               const Number            tau_0,
               const Parameters       &p)
      {
        const Number H   = Number(p.mu) * failure_strain(off, tau_0, p),
                     way = Number(p.center) - tau_0;
        const Number tolerance(1e-10 * p.radius);
        Number       x = x_old;
        for (int i = 0; i < most_iterations; ++i)
          {
            const Number           kappa = mobilization(x);
            const Centered<Number> s(trial, center(kappa, tau_0, p));
            const Number           left =
              s.tresca() - radius(kappa, p) - H * (x * x - x_old * x_old);
            // beyond failure nothing hardens
            if (!any(((left > tolerance) & (x < Number(1.))) |
                     ((left < -tolerance) & (x > x_old))))
              break;
            const Number one(1.),
              below = one + x * x,
              rate  = Number(2.) * (one - x * x) / (below * below),
              fall  = rate * (Number(p.radius) - way * s.slope()) +
                     Number(2.) * H * x;
            x = min(max(x + left / max(fall, Number(1e-12 * p.radius)), x_old),
                    one);
          }
        return x;
      }

      /** The point of the surface of @p x nearest to a trial stress. */
      template <typename Number>
      [[gnu::always_inline]] static inline Shear<Number>
      returned(const Shear<Number> &trial,
               const Number         x,
               const Number         tau_0,
               const Parameters    &p)
      {
        const Number kappa = mobilization(x), c = center(kappa, tau_0, p),
                     r = radius(kappa, p);
        const Centered<Number> s(trial, c);
        const Number           size = abs(s.u),
                     beyond         = max(s.rho + size - (r + r), Number(0.)),
                     rho =
                       min(max(s.rho - Number(.25) * beyond, Number(0.)), r),
                     u     = min(size, r + r - rho),
                     share = rho / max(s.rho, Number(1e-30));
        Shear<Number> result;
        result.h = c + share * s.h;
        result.u = c + select(s.u > Number(0.), u, -u);
        result.t = share * trial.t;
        return result;
      }

      /** sqrt(2/3 s:s) of the deviator between two stresses. */
      template <typename Number>
      [[gnu::always_inline]] static inline Number
      distance(const Shear<Number> &a,
               const Shear<Number> &b,
               const Parameters    &p)
      {
        const Number h = a.h - b.h, u = a.u - b.u,
                     t = Number(p.inverse_scale) * (a.t - b.t);
        return sqrt(Number(4. / 3.) * (h * h + t * t) +
                    Number(4. / 9.) * u * u);
      }

      template <typename Number>
      [[gnu::always_inline]] static inline void
      cut_off(StressState<Number> &sigma,
              LawState<Number>    &state,
              const Parameters    &p)
      {
        const Number T(p.cutoff.tension_cutoff);
        const Number bound = Number(.5) * (sigma.rr + sigma.zz) +
                             abs(Number(.5) * (sigma.rr - sigma.zz)) +
                             abs(sigma.rz);
        if (!any(max(bound, sigma.tt) > T))
          return;
        const PrincipalFrame<Number>    frame(sigma);
        const PrincipalStresses<Number> s    = frame.principal_stresses();
        const auto                      torn = s.major > T;
        if (!any(torn))
          return;
        const Number before = pressure(sigma);
        sigma               = select(
          torn,
          frame.with_principal_stresses(
            MohrCoulombReturn<Number, MohrCoulombStrength<double>>::to_cutoff(
              s, p, p.cutoff)),
          sigma);
        state.plastic_volumetric +=
          Number(1. / p.bulk) * (pressure(sigma) - before);
      }

      /** Whether each strain at failure is more than its elastic part. */
      static bool
      check_strains(const Parameters &p,
                    const double      tau_0,
                    LawMessage       &message)
      {
        const double A = p.active, G = A * p.modulus_ratio;
        const struct
        {
          const char *entry;
          double      at_failure, elastic;
        } strains[] = {{"Active failure strain",
                        p.active_failure,
                        (A - tau_0) / G},
                       {"Direct shear failure strain",
                        p.direct_failure,
                        A * p.direct_ratio / G},
                       {"Passive failure strain",
                        p.passive_failure,
                        (A * p.passive_ratio + tau_0) / G}};
        for (const auto &strain : strains)
          if (strain.at_failure <= strain.elastic)
            return message.refuse(
              "%s = %g is not more than the elastic strain at failure, %g. "
              "Raise it, or Unloading shear modulus ratio.",
              strain.entry,
              strain.at_failure,
              strain.elastic);
        return true;
      }

      static constexpr int    most_iterations = 6;
      static constexpr double least_strain    = 1e-6;
    };
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
