// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Blocks that may yield are deferred, and updated in pairs.
//
// The return to the yield surface is one long chain of operations, each of
// which waits for the one before, so that a processor with wide lanes idles.
// Two blocks at once take little longer than one. Most blocks are elastic, of
// another law or of dilatant soil, and never come here.
#ifndef caisson_mpm_kernels_deferred_blocks_h
#define caisson_mpm_kernels_deferred_blocks_h

#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/kernels/simd_twice.h>
#include <caisson_mpm/kernels/update_stress.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** Whether blocks of a law may be deferred. Narrow lanes keep the
     * processor busy without it. */
    template <typename Law, typename Number>
    constexpr bool
      may_be_deferred = __is_same(Law, MohrCoulomb) && Number::width
                                                         == block_size;

    /** A block whose stress and volume are still to be updated: what its
     * step needs besides the stress in the middle of the turn, which the
     * block has. */
    struct alignas(64) DeferredBlock
    {
      double strain[4][block_size], volume_change[block_size],
        tangent[block_size], sine[block_size];
      double          xi[block_size], eta[block_size]; // where it was
      PointBlock     *block;
      const Material *material;
      int             cell; // of its group
    };

    /** Those of a group of cells. Row i of @p Sums takes m q, m q xi, m q eta
     * and V q of the work q per volume, one cell in each column. */
    template <typename Number>
    class DeferredBlocks
    {
    public:
      using Sums = Number (*)[Number::width];

      /** The number of all blocks so far. */
      [[gnu::always_inline]] inline unsigned int
      total() const
      {
        return n_added;
      }

      [[gnu::always_inline]] inline bool
      is_full() const
      {
        return n == capacity;
      }

      /** Defer a block. */
      [[gnu::always_inline]] inline void
      add(PointBlock               &block,
          const StressStep<Number> &s,
          const LocalPoint<Number> &p,
          const Material           &material,
          const int                 cell)
      {
        DeferredBlock &w = blocks[n++];
        ++n_added;
        store_stress(s.old, block, 0);
        s.step.strain.rr.store(w.strain[0]);
        s.step.strain.zz.store(w.strain[1]);
        s.step.strain.tt.store(w.strain[2]);
        s.step.strain.rz.store(w.strain[3]);
        s.step.volume_change.store(w.volume_change);
        s.half_turn.tangent.store(w.tangent);
        s.half_turn.sine.store(w.sine);
        p.xi.store(w.xi);
        p.eta.store(w.eta);
        w.block    = &block;
        w.material = &material;
        w.cell     = cell;
      }

      /** Update all blocks; none is left. */
      [[gnu::always_inline]] inline void
      update(const Sums sums)
      {
        for (int i = 0; i < n;)
          {
            const bool two =
              i + 1 < n && blocks[i].material == blocks[i + 1].material;
            update_two<MohrCoulomb>(blocks[i], blocks[two ? i + 1 : i], sums);
            i += two ? 2 : 1;
          }
        n = 0;
      }

    private:
      static constexpr int capacity = 64;

      /** Both may be the same. */
      template <typename Law>
      [[gnu::always_inline]] static inline void
      update_two(const DeferredBlock &v,
                 const DeferredBlock &w,
                 const Sums           sums)
      {
        using Two         = Twice<Number>;
        PointBlock     &b = *v.block, &c = *w.block;
        StressStep<Two> s;
        s.old                = {Two::load(b.stress[0], c.stress[0]),
                                Two::load(b.stress[1], c.stress[1]),
                                Two::load(b.stress[2], c.stress[2]),
                                Two::load(b.stress[3], c.stress[3])};
        s.step.strain        = {Two::load(v.strain[0], w.strain[0]),
                                Two::load(v.strain[1], w.strain[1]),
                                Two::load(v.strain[2], w.strain[2]),
                                Two::load(v.strain[3], w.strain[3])};
        s.step.volume_change = Two::load(v.volume_change, w.volume_change);
        s.half_turn          = HalfTurn<Two>(Two::load(v.tangent, w.tangent),
                                    Two::load(v.sine, w.sine));

        LawState<Two> state;
        state.plastic_deviatoric =
          Two::load(b.plastic_deviatoric, c.plastic_deviatoric);
        state.plastic_volumetric =
          Two::load(b.plastic_volumetric, c.plastic_volumetric);
        StressState<Two> stress = s.old;
        Law::update_at_any_void_ratio(
          stress,
          s.step.strain,
          state,
          reinterpret_cast<const typename Law::Parameters &>(
            v.material->parameters));

        const Two work = work_per_volume(s.old, stress, s.step);
        add_work(v, work.a, sums);
        if (&v != &w)
          add_work(w, work.b, sums);
        const StressState<Two> turned = s.half_turn(stress);
        turned.rr.store(b.stress[0], c.stress[0]);
        turned.zz.store(b.stress[1], c.stress[1]);
        turned.tt.store(b.stress[2], c.stress[2]);
        turned.rz.store(b.stress[3], c.stress[3]);
        state.plastic_deviatoric.store(b.plastic_deviatoric,
                                       c.plastic_deviatoric);
        state.plastic_volumetric.store(b.plastic_volumetric,
                                       c.plastic_volumetric);
        (Two::load(b.volume, c.volume) * (Two(1.) + s.step.volume_change))
          .store(b.volume, c.volume);
      }

      /** Add the work per volume, with the old volume. */
      [[gnu::always_inline]] static inline void
      add_work(const DeferredBlock &w, const Number work, const Sums sums)
      {
        const Number q = Number::load(w.block->mass) * work;
        sums[0][w.cell] += q;
        sums[1][w.cell] += q * Number::load(w.xi);
        sums[2][w.cell] += q * Number::load(w.eta);
        sums[3][w.cell] += Number::load(w.block->volume) * work;
      }

      int           n       = 0;
      unsigned int  n_added = 0;
      DeferredBlock blocks[capacity];
    };
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
