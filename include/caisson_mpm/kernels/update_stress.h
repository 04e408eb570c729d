// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The stress of the points of a cell at the end of a step.
//
// With the velocity gradient L of the nodal field at the point, the strain
// increment is dt (L + L^T) / 2, with the mean volume change of the cell
// (B-bar, Hughes 1980, doi:10.1002/nme.1620150914), and the stress rate that of
// Jaumann with the spin dt (L - L^T) / 2 in the plane. The stress turns by half
// of the angle before the material law and by the other half after it, which is
// of second order in the angle.
#ifndef caisson_mpm_kernels_update_stress_h
#define caisson_mpm_kernels_update_stress_h

#include <caisson_mpm/kernels/laws.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/kernels/moments.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** Coefficients of both components of a nodal field, in one cell or in
     * one cell in each lane. */
    template <typename Real = double>
    struct CellField
    {
      Real r[4], z[4];

      CellField() = default;

      [[gnu::always_inline]] inline CellField(const NodalVector *field,
                                              const CellNodes   &cell)
      {
        using Pair = Lanes<2>; // both components of a node
        Pair corner[4], coefficient[4];
        for (int i = 0; i < 4; ++i)
          corner[i] = Pair::load(field[cell.node[i]].value);
        coefficients(corner, coefficient);
        for (int i = 0; i < 4; i += 2)
          {
            Pair component[2];
            transpose(coefficient + i, component);
            component[0].store(r + i);
            component[1].store(z + i);
          }
      }

      /** Go a share of the way to another field. */
      [[gnu::always_inline]] inline void
      approach(const CellField &other, const Real share)
      {
        for (int i = 0; i < 4; ++i)
          {
            r[i] += share * (other.r[i] - r[i]);
            z[i] += share * (other.z[i] - z[i]);
          }
      }
    };

    /** The velocity gradient at a point, L_tt included. */
    template <typename Number>
    struct VelocityGradient
    {
      Number rr, rz, zr, zz, tt;

      template <typename Real>
      [[gnu::always_inline]] inline VelocityGradient(
        const CellField<Real>    &v,
        const LocalPoint<Number> &p,
        const Real                inverse_width,
        const Number              inverse_r)
      {
        gradient(v.r, p, inverse_width, rr, rz);
        gradient(v.z, p, inverse_width, zr, zz);
        tt = evaluate(v.r, p) * inverse_r;
      }

      [[gnu::always_inline]] inline Number
      trace() const
      {
        return rr + zz + tt;
      }
    };

    /** The mean of div v over the volume of cells, by Gauss integration. */
    template <typename Number>
    [[gnu::always_inline]] inline Number
    mean_divergence(const CellMap<Number>   &map,
                    const double             axisymmetric,
                    const CellField<Number> &v)
    {
      Number change(0.), volume(0.);
      for (int i = 0; i < GaussPoint<Number>::n; ++i)
        {
          const GaussPoint<Number>       gauss(map, axisymmetric, i);
          const VelocityGradient<Number> L(v,
                                           gauss.point,
                                           map.inverse_width,
                                           gauss.inverse_r);
          change += gauss.volume * L.trace();
          volume += gauss.volume;
        }
      return change / volume;
    }

    /** What all points of a cell share. */
    struct CellUpdate
    {
      CellMap<>     map, moved;
      CellField<>   advection, transfer, strain;
      double        axisymmetric;
      double        mean_divergence;  // used where B-bar is on
      double        loose_divergence; // the same, kernels/loosest_state.h
      bool          has_loose_points;
      double        bubble[2];      // a, b of find_bubbles()
      double        speed_limit;    // 0: none
      const double *fit;            // of the stress filter; null: no filter
      double        filtered_share; // of the misfit, with a fit
      double        inverse_mean_height;
    };

    /** A block of points that is to be updated. */
    struct BlockUpdate
    {
      PointBlock           &points;
      PointHistory         &history;
      const Material       &material;
      const CellUpdate     &cell;
      const UpdateSettings &settings;
      int                   count;    // of points, besides padding
      int                   in_group; // the number of the cell
    };

    /** What a point feels of the velocity field in a step. */
    template <typename Number>
    struct StepOfStrain
    {
      StrainIncrement<Number> strain;
      Number                  volume_change; // of the volume, relative
      Number                  spin;          // in the plane, times dt
    };

    /** Give a strain another volume change. In plane strain the hoop
     * direction stays unstrained. */
    template <typename Number>
    [[gnu::always_inline]] inline void
    take_volume_change(const Number          change,
                       const CellUpdate     &cell,
                       StepOfStrain<Number> &step)
    {
      const Number third =
        (change - step.volume_change) * Number(1. / (2. + cell.axisymmetric));
      step.strain.rr += third;
      step.strain.zz += third;
      step.strain.tt += third * Number(cell.axisymmetric);
      step.volume_change = change;
    }

    /** The strain of points at @p p with the radius @p r. */
    template <typename Number>
    [[gnu::always_inline]] inline StepOfStrain<Number>
    find_strain(const LocalPoint<Number> &p,
                const Number              r,
                const CellUpdate         &cell,
                const UpdateSettings     &settings)
    {
      const Number                   dt(settings.time_step);
      const Number                   inverse_r = Number(cell.axisymmetric) / r;
      const VelocityGradient<Number> L(cell.strain,
                                       p,
                                       cell.map.inverse_width,
                                       inverse_r);
      StepOfStrain<Number>           step;
      step.strain        = {dt * L.rr,
                            dt * L.zz,
                            dt * L.tt,
                            dt * Number(.5) * (L.rz + L.zr)};
      step.volume_change = dt * L.trace();
      // B-bar: the points of a cell take its mean volume change, so that a
      // cell has one condition of incompressibility instead of four and does
      // not lock.
      if (settings.mean_volume_change)
        take_volume_change(Number(settings.time_step * cell.mean_divergence),
                           cell,
                           step);
      step.spin = dt * Number(.5) * (L.rz - L.zr);
      return step;
    }

    /**
     * sigma_p <- sigma_p + share (sigma_fit(x_p) - sigma_p). The nodes see
     * the affine fit only; what a stress has besides is answered by no force
     * and would grow. The fit of the filtered stresses is the same fit.
     */
    template <typename Number>
    [[gnu::always_inline]] inline void
    filter_stress(StressState<Number>      &stress,
                  const LocalPoint<Number> &p,
                  const Number              z,
                  const CellUpdate         &cell)
    {
      const Number share(cell.filtered_share);
      const Number x = p.xi - Number(.5),
                   y = (z - Number(cell.map.center_z())) *
                       Number(cell.inverse_mean_height);
      stress.rr += share * (evaluate_fit(cell.fit, x, y) - stress.rr);
      stress.zz += share * (evaluate_fit(cell.fit + 3, x, y) - stress.zz);
      stress.tt += share * (evaluate_fit(cell.fit + 6, x, y) - stress.tt);
      stress.rz += share * (evaluate_fit(cell.fit + 9, x, y) - stress.rz);
    }

    /**
     * Half of the turn of a step in the plane. The difference and the shear
     * of the stress form a vector that turns by twice the angle of the soil;
     * for half of the turn this is the spin w itself. Its cosine and sine
     * follow from tan(w/2) = w/2 + w^3/24 + ...: wherever this series is cut
     * off, the matrix is orthogonal, and no turn changes a principal stress
     * (Hughes & Winget 1980, doi:10.1002/nme.1620151210).
     */
    template <typename Number>
    class HalfTurn
    {
    public:
      HalfTurn() = default;

      [[gnu::always_inline]] inline HalfTurn(const Number spin)
      {
        tangent = spin * (Number(.5) + Number(1. / 24.) * spin * spin);
        // sin w = 2 t / (1 + t^2), 1 - cos w = t sin w
        sine = (tangent + tangent) / (Number(1.) + tangent * tangent);
      }

      [[gnu::always_inline]] inline StressState<Number>
      operator()(const StressState<Number> &s) const
      {
        const Number difference = Number(.5) * (s.rr - s.zz);
        const Number to_rr      = sine * (s.rz - tangent * difference);
        return {s.rr + to_rr,
                s.zz - to_rr,
                s.tt,
                s.rz - sine * (difference + tangent * s.rz)};
      }

      /** The turn with this tangent of half of its angle, and this sine. */
      [[gnu::always_inline]] inline HalfTurn(const Number tangent,
                                             const Number sine)
        : tangent(tangent)
        , sine(sine)
      {}

      Number tangent, sine;
    };

    /**
     * The work of the stress per volume in a step: dt times the mean of old
     * and new stress, both in the middle of the turn, with the strain rate,
     * on the mean of old and new volume.
     */
    template <typename Number>
    [[gnu::always_inline]] inline Number
    work_per_volume(const StressState<Number>  &old,
                    const StressState<Number>  &stress,
                    const StepOfStrain<Number> &step)
    {
      const StrainIncrement<Number> &strain = step.strain;
      const Number twice_power              = (old.rr + stress.rr) * strain.rr +
                                 (old.zz + stress.zz) * strain.zz +
                                 (old.tt + stress.tt) * strain.tt +
                                 Number(2.) * (old.rz + stress.rz) * strain.rz;
      return (Number(.5) + Number(.25) * step.volume_change) * twice_power;
    }

    /** A material and the parameters of its law. */
    template <typename Law>
    struct MaterialOf
    {
      double                          initial_void_ratio;
      StressMeasure                   stress_measure;
      const typename Law::Parameters &parameters;
    };

    /** Grains keep their volume: (1 + e) / (1 + e_0) = V / V_0. Empty lanes
     * have no number. */
    template <typename Number>
    [[gnu::always_inline]] inline Number
    void_ratio_of(const Number        volume,
                  const PointHistory &history,
                  const int           lane,
                  const double        initial_void_ratio)
    {
      return Number(1. + initial_void_ratio) *
               (volume / Number::load(history.initial_volume + lane)) -
             Number(1.);
    }

    /** What the law knows of the points besides stress and strain. */
    template <typename Law, typename Number>
    [[gnu::always_inline]] inline LawState<Number>
    load_state(const PointBlock   &b,
               const PointHistory &history,
               const int           lane,
               const Number        volume,
               const double        initial_void_ratio,
               const bool          uses_void_ratio)
    {
      LawState<Number> state;
      state.plastic_deviatoric = Number::load(b.plastic_deviatoric + lane);
      state.plastic_volumetric = Number::load(b.plastic_volumetric + lane);
      state.void_ratio =
        uses_void_ratio ?
          void_ratio_of(volume, history, lane, initial_void_ratio) :
          Number(0.);
      for (int i = 0; i < Law::n_state; ++i)
        state.variable[i] = Number::load(history.state[i] + lane);
      return state;
    }

    /** The inverse of load_state(), but for the void ratio. */
    template <typename Law, typename Number>
    [[gnu::always_inline]] inline void
    store_state(const LawState<Number> &state,
                PointBlock             &b,
                PointHistory           &history,
                const int               lane)
    {
      state.plastic_deviatoric.store(b.plastic_deviatoric + lane);
      state.plastic_volumetric.store(b.plastic_volumetric + lane);
      for (int i = 0; i < Law::n_state; ++i)
        state.variable[i].store(history.state[i] + lane);
    }

    /** Turn the state of a law by half of the turn of a step, if the state is
     * a tensor. */
    template <typename Law, typename Number>
    [[gnu::always_inline]] inline void
    turn_state(const HalfTurn<Number> &half_turn, LawState<Number> &state)
    {
      if constexpr (Law::state_is_a_tensor)
        {
          Number *const             v = state.variable;
          const StressState<Number> turned =
            half_turn(StressState<Number>{v[0], v[1], v[2], v[3]});
          v[0] = turned.rr;
          v[1] = turned.zz;
          v[2] = turned.tt;
          v[3] = turned.rz;
        }
    }

    template <typename Number>
    [[gnu::always_inline]] inline StressState<Number>
    load_stress(const PointBlock &b, const int lane)
    {
      return {Number::load(b.stress[0] + lane),
              Number::load(b.stress[1] + lane),
              Number::load(b.stress[2] + lane),
              Number::load(b.stress[3] + lane)};
    }

    template <typename Number>
    [[gnu::always_inline]] inline void
    store_stress(const StressState<Number> &s, PointBlock &b, const int lane)
    {
      s.rr.store(b.stress[0] + lane);
      s.zz.store(b.stress[1] + lane);
      s.tt.store(b.stress[2] + lane);
      s.rz.store(b.stress[3] + lane);
    }

    /** What comes before the law in a step. */
    template <typename Number>
    struct StressStep
    {
      StepOfStrain<Number> step;
      HalfTurn<Number>     half_turn;
      StressState<Number>  old; // in the middle of the turn
    };

    /** The step of the points in the lanes from @p lane on. */
    template <typename Number>
    [[gnu::always_inline]] inline StressStep<Number>
    begin_stress_step(const PointBlock         &b,
                      const int                 lane,
                      const LocalPoint<Number> &p,
                      const CellUpdate         &cell,
                      const UpdateSettings     &settings)
    {
      // 1. Strain increment dt (L + L^T) / 2 and spin from the nodal field.
      StressStep<Number> result;
      result.step = find_strain(p, Number::load(b.r + lane), cell, settings);

      // 2. In full cells, take off what the affine fit does not contain.
      StressState<Number> stress = load_stress<Number>(b, lane);
      if (cell.fit != nullptr)
        filter_stress(stress, p, Number::load(b.z + lane), cell);

      // 3. Turn the stress with the soil, to where it is in the middle of the
      //    step, so that the law sees strain only.
      result.half_turn = HalfTurn<Number>(result.step.spin);
      result.old       = result.half_turn(stress);
      return result;
    }

    /**
     * The law over a step, with the stress @p stress at its start. Where the
     * elasticity is one for the Kirchhoff stress tau = J sigma, with J the
     * volume over that at the start and dtau = C : de (Hencky's law where the
     * axes of strain stay), the new stress is (J sigma + C : de) / J'. The
     * law gets J sigma / J' and de / J', so that it yields where the Cauchy
     * stress does; its plastic strain is to be multiplied by J'.
     */
    template <typename Law, typename Number>
    [[gnu::always_inline]] inline void
    apply_law(StressState<Number>        &stress,
              const StepOfStrain<Number> &step,
              const Number                relative_volume,
              LawState<Number>           &state,
              const MaterialOf<Law>      &material)
    {
      StrainIncrement<Number> strain    = step.strain;
      const bool              kirchhoff = //
        material.stress_measure == StressMeasure::kirchhoff;
      const LawState<Number> before = state;
      const Number           growth = Number(1.) + step.volume_change,
                   after            = relative_volume * growth;
      if (kirchhoff)
        {
          stress = scaled(Number(1.) / growth, stress);
          strain = scaled(Number(1.) / after, strain);
        }
      Law::update(stress, strain, state, material.parameters);
      if (kirchhoff)
        scale_plastic_strain(after, before, state);
    }

    /** Set the points in the lanes from @p lane on to the end of the step,
     * where the law has given them a stress and a state in the middle of the
     * turn. Returns work_per_volume(). */
    template <typename Law, typename Number>
    [[gnu::always_inline]] inline Number
    end_stress_step(const StressStep<Number>  &s,
                    const StressState<Number> &stress,
                    LawState<Number>           state,
                    PointBlock                &b,
                    PointHistory              &history,
                    const int                  lane)
    {
      store_stress(s.half_turn(stress), b, lane);
      turn_state<Law>(s.half_turn, state);
      store_state<Law>(state, b, history, lane);
      // 5. V <- V (1 + dt div v)
      (Number::load(b.volume + lane) * (Number(1.) + s.step.volume_change))
        .store(b.volume + lane);
      return work_per_volume(s.old, stress, s.step);
    }

    /** The state of the points in the lanes from @p lane on in the middle of
     * the turn, as the law takes it. */
    template <typename Law, typename Number>
    [[gnu::always_inline]] inline LawState<Number>
    begin_law(const StressStep<Number>       &s,
              const PointBlock               &b,
              const PointHistory             &history,
              const int                       lane,
              const double                    initial_void_ratio,
              const typename Law::Parameters &parameters)
    {
      LawState<Number> state =
        load_state<Law>(b,
                        history,
                        lane,
                        Number::load(b.volume + lane),
                        initial_void_ratio,
                        Law::uses_void_ratio &&
                          Law::needs_void_ratio(parameters));
      turn_state<Law>(s.half_turn, state);
      return state;
    }

    /** Set the stress and the volume of the points in the lanes from @p lane
     * on to those at the end of the step. Returns work_per_volume(). */
    template <typename Law, typename Number>
    [[gnu::always_inline]] inline Number
    update_stress(PointBlock               &b,
                  PointHistory             &history,
                  const int                 lane,
                  const StressStep<Number> &s,
                  const MaterialOf<Law>    &material)
    {
      // 4. The law: sigma <- sigma + C : de, and its state variables.
      LawState<Number> state = begin_law<Law>(
        s, b, history, lane, material.initial_void_ratio, material.parameters);
      StressState<Number> stress = s.old;
      Number              relative_volume(1.);
      if (material.stress_measure == StressMeasure::kirchhoff)
        {
          const Number volume  = Number::load(b.volume + lane),
                       initial = Number::load(history.initial_volume + lane);
          // empty lanes have no volume
          relative_volume =
            select(volume > Number(0.), volume / initial, relative_volume);
        }
      apply_law<Law>(stress, s.step, relative_volume, state, material);
      return end_stress_step<Law>(s, stress, state, b, history, lane);
    }
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
