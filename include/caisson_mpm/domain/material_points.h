// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The material points of the soil.
#ifndef caisson_mpm_domain_material_points_h
#define caisson_mpm_domain_material_points_h

#include <caisson_mpm/base/run_totals.h>
#include <caisson_mpm/domain/background_grid.h>
#include <caisson_mpm/domain/material_point.h>
#include <caisson_mpm/domain/point_exchange.h>
#include <caisson_mpm/kernels/layout.h>

#include <deal.II/particles/particle_handler.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  /** Whether points of a size are to be split where another is wanted. */
  inline bool
  is_too_large(const double size, const double wanted)
  {
    constexpr double too_large = 1.05;
    return size > too_large * wanted;
  }

  /** Whether points of a size are to be merged where another is wanted. Those
   * without a size are not. Halves of the wanted size become one again, which
   * is then not too large. */
  inline bool
  is_too_small(const double size, const double wanted)
  {
    constexpr double too_small = .51;
    return size > 0. && size < too_small * wanted;
  }

  /**
   * Bounds of the sizes of the points in a cell, in one direction. They may be
   * wider than necessary, since points also leave.
   */
  class SizeRange
  {
  public:
    void
    include(const double size)
    {
      largest = std::max(largest, size);
      if (size > 0.)
        smallest = std::min(smallest, size);
    }

    /** Whether no point can be too large or too small. */
    bool
    suits(const double wanted) const
    {
      return !is_too_large(largest, wanted) && !is_too_small(smallest, wanted);
    }

  private:
    double smallest = std::numeric_limits<double>::max(), largest = 0.;
  };

  /**
   * All material points of the soil.
   *
   * They lie in blocks of eight per cell and material (kernels/blocks.h), which
   * only this class and the kernels follow; others see one point at a time as a
   * MaterialPoint. A ParticleHandler holds the blocks: each is a particle of
   * the cell, as MatrixFree makes batches of cells, and its slot in the
   * PropertyPool is the number of the block. A point that leaves its cell is
   * copied into a block of the next one.
   *
   * Invariants: the blocks of a cell come in the order of its particles, those
   * of one material together, and of these all but the last are full; every
   * point lies in the cell that owns its block, up to round-off, and on the
   * rank that owns this cell; cells of the body hold none. The blocks of a cell
   * may lie anywhere in the memory; now and then they are put in the order of
   * the cells.
   */
  class MaterialPoints
  {
  public:
    using ParticleHandler = dealii::Particles::ParticleHandler<2>;

    explicit MaterialPoints(BackgroundGrid &grid);

    /** Forget all points, and make room for as many as the cells of this rank
     * will hold. @p n_in_cell [n_global_cells] */
    void
    reset(const std::vector<unsigned int> &n_in_cell);

    /** Let each point keep so many numbers of a user's law; before there are
     * points. @p user_materials: which materials have such a law. */
    void
    keep_user_state(const unsigned int       n,
                    const std::vector<bool> &user_materials);

    /** Return the number of numbers that a point keeps of a user's law. */
    unsigned int
    n_user_state() const
    {
      return n_user_state_;
    }

    /** Add a point to a cell of this rank in which it lies; settle() must
     * follow. */
    void
    add(const unsigned int cell, const MaterialPoint &point);

    /** Make the points complete after add(): until then neither view() nor
     * relocate() may be called. Collective. */
    void
    settle();

    /** Forget what is kept of the cells from step to step: it is summed from
     * the points again, in their order, and the padding of blocks repeats
     * them. */
    void
    rebuild_sums();

    /** Return the number of points of this rank. */
    unsigned int
    n_points() const
    {
      return n_points_;
    }

    /** Return what the kernels work on. Valid until points are added, moved to
     * other cells, split or merged. */
    Kernels::PointsView
    view();

    /** Return the blocks as particles for the tools of deal.II. Each has a
     * number of its own and lies at the mean place of its points; its
     * properties are the BlockHeader, and then the points. Collective. Valid as
     * view(), until the points move. */
    const ParticleHandler &
    particles();

    /** Return the cells of this rank that have points. Valid as view(). */
    const std::vector<unsigned int> &
    cells_with_points() const;

    /** Call action(material) for the materials of a cell of this rank, some of
     * them several times. */
    template <typename Action>
    void
    for_each_material(const unsigned int cell, const Action &action) const
    {
      for_each_block(cell, [&](const int b) {
        action(static_cast<unsigned int>(headers[b].material));
      });
    }

    /** Return what the update of the points returns in a step, with room for
     * all points that leave their cells. */
    Kernels::UpdateResult &
    update_result();

    /**
     * Bring the points listed in update_result() to the cells that they are in
     * now, and to the ranks that own these. A point that would enter the body
     * is held back at its surface. Throws RunFailure for a point that left the
     * mesh or is not finite. Collective.
     */
    void
    relocate();

    /**
     * Return what the cells of this rank cost in a step, by their global
     * number; 0 for all others. [n_global_cells]
     */
    std::vector<unsigned int>
    cell_costs() const;

    /** Let the points travel with their cells when these change their ranks in
     * BackgroundGrid::repartition(); unpack_after_repartition() must follow.
     * Collective. */
    void
    prepare_for_repartition();

    /** Take the points of the cells that this rank owns now. Collective. */
    void
    unpack_after_repartition();

    /** Register the counts of what this rank did with points. */
    void
    register_totals(RunTotals &totals);

    /** Gives the size that points are to have in a cell, in r and z. Units:
     * m. */
    using WantedSize =
      std::function<std::array<double, 2>(const unsigned int cell)>;

    /**
     * Split the points that are more than 1.05 times as large as wanted in
     * their cell, and merge those below 0.51 times that size with a neighbor.
     * Both keep mass, momentum, volume, the integral of stress over it, and the
     * center of mass. Halves keep the number of the point, and a pair takes the
     * smaller one. Collective.
     */
    void
    adapt(const WantedSize &wanted);

    /** Gives the logarithmic strain in r and z, since the last adaptation, at a
     * place in a cell. */
    using Stretch =
      std::function<std::array<double, 2>(const unsigned int      cell,
                                          const dealii::Point<2> &place)>;

    /** Let the sizes of the points follow their stretch, from 0.3 to twice what
     * is wanted: a point that cannot be split or merged waits. */
    void
    stretch(const Stretch &stretch_at, const WantedSize &wanted);

    /** Set the pore pressure of all points to pressure(cell, position), in Pa.
     */
    template <typename Function>
    void
    set_pore_pressure(const Function &pressure)
    {
      for (const unsigned int cell : active_cells)
        for_each_lane(cell, [&](const int b, const int lane) {
          histories[b].pore_pressure[lane] =
            pressure(cell,
                     dealii::Point<2>(blocks[b].r[lane], blocks[b].z[lane]));
        });
    }

    /** Give all points of a cell the same ratio of volume to initial volume,
     * that of their sums, and write it to @p ratio [n_cells]; 1 where there is
     * no point. Volumes stay, and so does the sum of the initial ones. */
    void
    level_volume_ratio(std::vector<double> &ratio);

    /** Call action(position, velocity, mass, material, cell) for every point:
     * less work than for_each(). */
    template <typename Action>
    void
    for_each_motion(const Action &action) const
    {
      for (const unsigned int cell : active_cells)
        for_each_lane(cell, [&](const int b, const int lane) {
          const Kernels::PointBlock &p = blocks[b];
          action(dealii::Point<2>(p.r[lane], p.z[lane]),
                 dealii::Tensor<1, 2>({p.velocity_r[lane], p.velocity_z[lane]}),
                 p.mass[lane],
                 static_cast<unsigned int>(headers[b].material),
                 cell);
        });
    }

    /** Return the volume of the points in a cell of this rank over their
     * initial one. There must be points in it. */
    double
    volume_ratio_in(const unsigned int cell) const;

    /** Return the volume of the points in a cell of this rank. Units: m3 per
     * radian. */
    double
    filled_volume_in(const unsigned int cell) const
    {
      return filled_volume[cell];
    }

    /** Call action(const MaterialPoint &) for every point of a cell of this
     * rank. */
    template <typename Action>
    void
    for_each_in(const unsigned int cell, const Action &action) const
    {
      for_each_lane(cell,
                    [&](const int b, const int lane) { action(get(b, lane)); });
    }

    /** Call action(const MaterialPoint &, cell) for every point of this rank.
     */
    template <typename Action>
    void
    for_each(const Action &action) const
    {
      for (const unsigned int cell : active_cells)
        for_each_lane(cell, [&](const int b, const int lane) {
          action(get(b, lane), cell);
        });
    }

  private:
    // points to come whose blocks are asked for: the memory takes that long
    static constexpr unsigned int steps_ahead = 3;

    /** Where the properties of a block begin. Its first number fills a cache
     * line, as large arrays begin 16 bytes behind one (main.cc). */
    struct Place
    {
      enum : int
      {
        header     = 0,
        block      = 6,
        history    = block + sizeof(Kernels::PointBlock) / sizeof(double),
        user_state = history + sizeof(Kernels::PointHistory) / sizeof(double)
      };
    };

    // with a cell in or near which it lies
    using PlacedPoint = std::pair<unsigned int, MaterialPoint>;

    /** Call action(block) for every block of a cell. */
    template <typename Action>
    void
    for_each_block(const unsigned int cell, const Action &action) const
    {
      for (int b = first_block[cell]; b >= 0; b = next_block[b])
        action(b);
    }

    /** Call action(block, lane) for every point of a cell. */
    template <typename Action>
    void
    for_each_lane(const unsigned int cell, const Action &action) const
    {
      for_each_block(cell, [&](const int b) {
        for (int lane = 0; lane < headers[b].count; ++lane)
          action(b, lane);
      });
    }

    /** Take out @p n points, listed in the order of their blocks. */
    std::vector<PlacedPoint>
    take_out(const Kernels::LeavingPoint *places, const unsigned int n);

    /** Add a point, while the points may be settled. */
    void
    insert(const unsigned int cell, const MaterialPoint &point);
    /** The numbers of a point that a user's law keeps. */
    double *
    user_state_of(const int block, const int lane) const
    {
      return &user_state[block] + lane * n_user_state_;
    }
    MaterialPoint
    get(const int block, const int lane) const;
    void
    set(const int block, const int lane, const MaterialPoint &point);
    void
    copy_lane(const int from,
              const int from_lane,
              const int to,
              const int lane);
    /** Make lanes of a block padding: they repeat lane 0. */
    void
    pad(const int block, const int begin, const int end);
    /** Return the block of a cell that takes more points of a material, or -1
     * if it has none of it. */
    int
    last_block(const unsigned int cell, const double material) const;
    /** Ask for a block that is soon needed; -1: none. */
    void
    prefetch(const int block) const;
    /** Add an empty block of a material to a cell behind the block @p after; -1:
     * as the first one. */
    int
    new_block(const unsigned int cell,
              const int          after,
              const unsigned int material);
    void
    remove_block(const unsigned int cell, int block);
    void
    swap_blocks(const int a, const int b);
    /** List the blocks of a cell as its particles in the handler. */
    void
    list_blocks(const unsigned int cell);
    /** Return a handler with room for so many blocks. */
    std::unique_ptr<ParticleHandler>
    make_handler(const unsigned long n_blocks);
    /** Find the blocks in the memory of the handler. */
    void
    find_blocks();
    /** Ask for pages of 2 MiB for the blocks that a handler with one of them
     * has room for; only a hint. */
    void
    use_large_pages(const ParticleHandler &handler) const;
    void
    remove(const unsigned int cell, const int block, const int lane);
    std::vector<PlacedPoint>
    take_out_of_size(const unsigned int           cell,
                     const std::array<double, 2> &wanted);
    void
    split(const std::array<double, 2> &wanted,
          std::vector<PlacedPoint>    &points);
    void
    merge(const std::array<double, 2> &wanted,
          std::vector<PlacedPoint>    &points);
    void
    bring_to_cells(std::vector<PlacedPoint> &moving);
    unsigned int
    walk(unsigned int cell, const dealii::Point<2> &position) const;
    bool
    is_in_soil(const unsigned int cell, const dealii::Point<2> &position) const;
    unsigned int
    find_cell(unsigned int cell, MaterialPoint &point);

    /** Throw RunFailure where a point has come too far from its last cell. */
    void
    check_speed(const unsigned int cell, const MaterialPoint &point) const;
    /** Begin with room for so many blocks. */
    void
    clear_blocks(const unsigned long n_blocks);
    /** Forget the lists of the blocks, and what is kept of the cells. */
    void
    clear_lists();
    /** Begin the sums of all cells with nothing. */
    void
    clear_sums();
    void
    include_in_sums(const unsigned int cell, const MaterialPoint &point);
    [[noreturn]] void
    report_lost(const MaterialPoint &point) const;

    /** Stop a point that has been thrown off a free surface, and beyond the
     * side of the mesh at @p face; @p coordinate is that in its cell. */
    void
    stop_at_side(const double       coordinate,
                 const unsigned int face,
                 MaterialPoint     &point);
    void
    assert_settled() const;
    void
    collect_active_cells();
    void
    put_blocks_in_order();

    BackgroundGrid                      &grid;
    PointExchange                        point_exchange;
    std::unique_ptr<ParticleHandler>     handler;        // of the blocks
    unsigned int                         n_reserved = 0; // blocks
    Kernels::Rows<Kernels::PointBlock>   blocks;
    Kernels::Rows<Kernels::PointHistory> histories;
    Kernels::Rows<Kernels::BlockHeader>  headers;
    Kernels::Rows<double> user_state; // [block_size][n_user_state]
    unsigned int          n_user_state_ = 0;
    std::vector<bool>     user_materials; // [n_materials]
    // The order of the particles in their cells, for the kernels: only
    // list_blocks() writes it. [n_cells] and [n_blocks], -1: none. For a ghost
    // cell the first block is only a flag and leads to none: 0 = its owner has
    // points there, -1 = none
    std::vector<int>          first_block, next_block;
    std::vector<unsigned int> active_cells;
    std::vector<double>       filled_volume; // [n_cells]
    // [n_cells], in r and z
    std::vector<std::array<SizeRange, 2>> sizes;
    // [n_cells], whether points came or went: whatever adds or removes a point
    // sets it, and the kernels then sum the moments of the cell again
    std::vector<unsigned char> changed;
    // [n_cells], what else makes a cell expensive: blocks that yielded in the
    // last step, and points taken out of it since this number of relocations
    std::vector<unsigned short>        n_yielding;
    std::vector<unsigned int>          n_moved;
    unsigned int                       first_relocation     = 0;
    unsigned int                       n_relocations        = 0;
    bool                               active_cells_changed = true;
    bool                               is_settled           = false;
    std::vector<Kernels::LeavingPoint> leaving_storage;
    Kernels::UpdateResult              update_result_ = {};
    unsigned int                       n_points_      = 0;
    // how often this rank held a point back at the body's surface, split one,
    // and merged two
    unsigned long n_held_back = 0, n_thrown_off = 0, n_split = 0, n_merged = 0;
  };
} // namespace CaissonMPM

#endif
