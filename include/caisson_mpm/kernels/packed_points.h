// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Points of laws that take long wait for each other, and their law is computed
// for all points of a group of cells.
//
// Many blocks are not full. The points wait in rows without gaps: each register
// is stored where the points of the last one end, so that the law finds full
// registers. It takes them in pairs (simd_twice.h).
#ifndef caisson_mpm_kernels_packed_points_h
#define caisson_mpm_kernels_packed_points_h

#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/kernels/simd_twice.h>
#include <caisson_mpm/kernels/update_stress.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** What a law takes and gives. */
    template <typename Number>
    struct LawPoints
    {
      StressState<Number>     stress;
      LawState<Number>        state;
      StrainIncrement<Number> strain;
    };

    /** Call action(column, number) for all that a law gives, and then, with
     * @p all, for what it takes besides. */
    template <typename Law, bool all, typename Number, typename Action>
    [[gnu::always_inline]] inline void
    for_each_column(LawPoints<Number> &p, const Action &action)
    {
      action(0, p.stress.rr);
      action(1, p.stress.zz);
      action(2, p.stress.tt);
      action(3, p.stress.rz);
      action(4, p.state.plastic_deviatoric);
      action(5, p.state.plastic_volumetric);
      for (int i = 0; i < Law::n_state; ++i)
        action(11 + i, p.state.variable[i]);
      if constexpr (all)
        {
          action(6, p.strain.rr);
          action(7, p.strain.zz);
          action(8, p.strain.tt);
          action(9, p.strain.rz);
          action(10, p.state.void_ratio);
        }
    }

    /** Points in the lanes of a register whose stress and volume are still to
     * be updated. */
    template <typename Number>
    struct WaitingPoints
    {
      StressStep<Number> s;
      Number             xi, eta; // where they were
      PointBlock        *block;
      PointHistory      *history;
      int                lane, count;
      int                cell; // of its group
    };

    /** Those of a group of cells. Row i of @p Sums takes m q, m q xi, m q eta,
     * and V q of the work q per volume, and the new volume, one cell in each
     * column. */
    template <typename Number>
    class PackedPoints
    {
    public:
      using Sums = Number (*)[Number::width];

      /** Make room for a block of a material: those that wait are of one. */
      [[gnu::always_inline]] inline void
      prepare(const Material &material_of_block, const Sums sums)
      {
        if (material != &material_of_block || n > capacity - block_size / width)
          update(sums);
        material = &material_of_block;
      }

      /** Defer the points in the lanes from @p lane on, @p count to the end of
       * their block. The law finds them in rows without gaps: each register
       * begins where the points of the last one end. */
      template <typename Law>
      [[gnu::always_inline]] inline void
      add(PointBlock                     &block,
          PointHistory                   &history,
          const int                       lane,
          const int                       count,
          const StressStep<Number>       &s,
          const LocalPoint<Number>       &p,
          const typename Law::Parameters &parameters,
          const int                       cell)
      {
        if (count <= 0) // a register without points
          return;
        const int         row = n_points;
        LawPoints<Number> of_law{
          s.old,
          begin_law<Law>(
            s, block, history, lane, material->initial_void_ratio, parameters),
          s.step.strain};
        for_each_column<Law, true>(of_law,
                                   [&](const int i, const Number value)
                                     CAISSON_LAMBDA {
                                       value.store(column[i] + row);
                                     });
        WaitingPoints<Number> &w = points[n++];
        w.s                      = s;
        w.xi                     = p.xi;
        w.eta                    = p.eta;
        w.block                  = &block;
        w.history                = &history;
        w.lane                   = lane;
        w.count                  = count < width ? count : width;
        w.cell                   = cell;
        n_points                 = row + w.count;
      }

      /** Update all points; none is left. */
      [[gnu::noinline]] void
      update(const Sums sums)
      {
        if (n == 0)
          return;
        with_law(*material, [&](auto law, const auto &p) CAISSON_LAMBDA {
          using Law = decltype(law);
          if constexpr (Law::is_packed)
            {
              fill_last_register<Law>();
              for (int i = 0; i < n_points; i += 2 * width)
                apply_law<Law>(i, i + width < n_points ? i + width : i, p);
              for (int i = 0, row = 0; i < n; row += points[i++].count)
                take<Law>(points[i], row, sums);
            }
        });
        n = n_points = 0;
      }

    private:
      static constexpr int width = Number::width, capacity = 64,
                           n_columns = 11 + n_state_variables;

      /** Repeat the last point in the rows of the last register that are
       * empty. */
      template <typename Law>
      [[gnu::always_inline]] inline void
      fill_last_register()
      {
        LawPoints<Number> p;
        for_each_column<Law, true>(
          p, [&](const int i, const Number) CAISSON_LAMBDA {
            Number(column[i][n_points - 1]).store(column[i] + n_points);
          });
      }

      /** The law in the rows from @p i on and in those from @p j on, which may
       * be the same. */
      template <typename Law>
      [[gnu::always_inline]] inline void
      apply_law(const int                       i,
                const int                       j,
                const typename Law::Parameters &parameters)
      {
        using Two = Twice<Number>;
        LawPoints<Two> p;
        for_each_column<Law, true>(p,
                                   [&](const int k, Two &value) CAISSON_LAMBDA {
                                     value =
                                       Two::load(column[k] + i, column[k] + j);
                                   });
        Law::update(p.stress, p.strain, p.state, parameters);
        for_each_column<Law, false>(p,
                                    [&](const int k,
                                        const Two value) CAISSON_LAMBDA {
                                      value.store(column[k] + i, column[k] + j);
                                    });
      }

      /** End the step of points with what the law gave from @p row on, and add
       * their work, with the old volume. */
      template <typename Law>
      [[gnu::always_inline]] inline void
      take(const WaitingPoints<Number> &w, const int row, const Sums sums)
      {
        LawPoints<Number> p;
        for_each_column<Law, false>(p,
                                    [&](const int i, Number &value)
                                      CAISSON_LAMBDA {
                                        value = Number::load(column[i] + row);
                                      });
        const Number volume = Number::load(w.block->volume + w.lane),
                     work   = end_stress_step<Law>(
                       w.s, p.stress, p.state, *w.block, *w.history, w.lane),
                     q = Number::load(w.block->mass + w.lane) * work;
        sums[0][w.cell] += q;
        sums[1][w.cell] += q * w.xi;
        sums[2][w.cell] += q * w.eta;
        sums[3][w.cell] += volume * work;
        sums[4][w.cell] += Number::load(w.block->volume + w.lane);
      }

      const Material       *material = nullptr;
      int                   n = 0, n_points = 0;
      WaitingPoints<Number> points[capacity];
      alignas(64) double column[n_columns][(capacity + 1) * width];
    };
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
