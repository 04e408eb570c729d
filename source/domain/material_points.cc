// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/intervals.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/domain/material_points.h>
#include <caisson_mpm/domain/point_fields.h>
#include <caisson_mpm/kernels/layout.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

namespace CaissonMPM
{
  using namespace dealii;
  using namespace Kernels;

  MaterialPoints::MaterialPoints(BackgroundGrid &grid)
    : grid(grid)
  {}

  // ------------------------------------------------------------ one point

  MaterialPoint
  MaterialPoints::get(const int block, const int lane) const
  {
    MaterialPoint p;
    p.material = static_cast<unsigned int>(headers[block].material);
    for_each_field(
      [&](const PointField &, const auto &in_block, const auto &in_point) {
        in_point(p) = in_block(blocks[block], histories[block])[lane];
      });
    if (n_user_state_ > 0)
      p.user_state.assign(user_state_of(block, lane),
                          user_state_of(block, lane) + n_user_state_);
    return p;
  }

  void
  MaterialPoints::set(const int block, const int lane, const MaterialPoint &p)
  {
    for_each_field(
      [&](const PointField &, const auto &in_block, const auto &in_point) {
        in_block(blocks[block], histories[block])[lane] = in_point(p);
      });
    AssertDimension(p.user_state.size(), n_user_state_);
    std::copy(p.user_state.begin(),
              p.user_state.end(),
              user_state_of(block, lane));
  }

  // ------------------------------------------------------------ blocks

  namespace
  {
    /** Block is a PointBlock or a PointHistory: an array of fields. */
    template <typename Block>
    void
    copy_fields(const Block &from,
                const int    from_lane,
                Block       &to,
                const int    lane)
    {
      using Field = double[block_size];
      for (unsigned int i = 0; i < sizeof(Block) / sizeof(Field); ++i)
        reinterpret_cast<Field *>(&to)[i][lane] =
          reinterpret_cast<const Field *>(&from)[i][from_lane];
    }
  } // namespace

  void
  MaterialPoints::copy_lane(const int from,
                            const int from_lane,
                            const int to,
                            const int lane)
  {
    copy_fields(blocks[from], from_lane, blocks[to], lane);
    copy_fields(histories[from], from_lane, histories[to], lane);
    std::copy_n(user_state_of(from, from_lane),
                n_user_state_,
                user_state_of(to, lane));
  }

  void
  MaterialPoints::pad(const int block, const int begin, const int end)
  {
    for (int lane = begin; lane < end; ++lane)
      {
        copy_lane(block, 0, block, lane);
        blocks[block].mass[lane]   = 0.;
        blocks[block].volume[lane] = 0.;
      }
  }

  int
  MaterialPoints::last_block(const unsigned int cell,
                             const double       material) const
  {
    int result = -1;
    for_each_block(cell, [&](const int b) {
      if (headers[b].material == material)
        result = b;
    });
    return result;
  }

  void
  MaterialPoints::prefetch(const int block) const
  {
    if (block < 0)
      return;
    __builtin_prefetch(&headers[block]);
    for (int i = Place::block; i < Place::user_state; i += block_size)
      __builtin_prefetch(blocks[block].r + i - Place::block);
  }

  int
  MaterialPoints::new_block(const unsigned int cell,
                            const int          after,
                            const unsigned int material)
  {
    const auto &pool = handler->get_property_pool();
    if (pool.n_registered_slots() == n_reserved)
      {
        // by a quarter: a million points take gigabytes
        n_reserved += n_reserved / 4 + 64;
        handler->reserve(n_reserved);
      }
    const auto &iterator = grid.cell_iterator(cell);
    // particles() gives it a place and a number
    const int added =
      handler->insert_particle(Point<2>(), Point<2>(), 0, iterator)
        ->get_local_index();
    find_blocks();
    if (next_block.empty()) // before memory is touched
      use_large_pages(*handler);
    if (next_block.size() < pool.n_slots())
      next_block.resize(pool.n_slots());
    headers[added] = {double(material), 0.};
    list_blocks(cell);
    // the handler has appended it
    const int result = after >= 0 ? next_block[after] : first_block[cell];
    for (int b = result; b != added; b = next_block[b])
      swap_blocks(b, added);
    return result;
  }

  void
  MaterialPoints::remove_block(const unsigned int cell, int block)
  {
    // the handler would put the last block in its place
    for (; next_block[block] >= 0; block = next_block[block])
      swap_blocks(block, next_block[block]);
    const auto &iterator = grid.cell_iterator(cell);
    handler->remove_particle(
      std::next(handler->particles_in_cell(iterator).begin(),
                handler->n_particles_in_cell(iterator) - 1));
    list_blocks(cell);
  }

  void
  MaterialPoints::swap_blocks(const int a, const int b)
  {
    auto      &pool = handler->get_property_pool();
    const auto of_a = pool.get_properties(a), of_b = pool.get_properties(b);
    std::swap_ranges(of_a.begin(), of_a.end(), of_b.begin());
  }

  void
  MaterialPoints::list_blocks(const unsigned int cell)
  {
    int *link = &first_block[cell];
    for (const auto &particle :
         handler->particles_in_cell(grid.cell_iterator(cell)))
      {
        *link = particle.get_local_index();
        link  = &next_block[*link];
      }
    *link = -1;
  }

  void
  MaterialPoints::add(const unsigned int cell, const MaterialPoint &point)
  {
    is_settled = false;
    insert(cell, point);
  }

  void
  MaterialPoints::insert(const unsigned int cell, const MaterialPoint &point)
  {
    Assert(grid.is_owned(cell),
           ExcMessage("a point belongs to the rank that owns its cell"));
    changed[cell] = true;
    include_in_sums(cell, point);
    const unsigned int material = point.material;
    // the last block of this material, or the last block of the cell
    int block = -1, last = -1;
    for_each_block(cell, [&](const int b) {
      last = b;
      if (headers[b].material == material)
        block = b;
    });
    active_cells_changed |= last < 0;
    if (block < 0 || headers[block].count == block_size)
      block = new_block(cell, block >= 0 ? block : last, material);
    const int lane = static_cast<int>(headers[block].count++);
    set(block, lane, point);
    // An odd count begins a register, whatever the width of the kernels. They
    // have not moved the padding of the registers without points.
    if (lane % 2 == 0)
      pad(block, lane + 1, block_size);
    ++n_points_;
  }

  void
  MaterialPoints::remove(const unsigned int cell,
                         const int          block,
                         const int          lane)
  {
    filled_volume[cell] -= blocks[block].volume[lane];
    changed[cell] = true;
    // fill the gap with the last point of this material
    const int last      = last_block(cell, headers[block].material);
    const int last_lane = static_cast<int>(--headers[last].count);
    if (last != block || last_lane != lane)
      copy_lane(last, last_lane, block, lane);
    if (last_lane == 0)
      {
        remove_block(cell, last);
        active_cells_changed |= first_block[cell] < 0;
      }
    else // the padding repeats lane 0
      pad(last,
          last_lane,
          last == block && lane == 0 ? block_size : last_lane + 1);
    --n_points_;
  }

  void
  MaterialPoints::collect_active_cells()
  {
    active_cells.clear();
    for (unsigned int c = 0; c < first_block.size(); ++c)
      if (first_block[c] >= 0 && grid.is_owned(c))
        active_cells.push_back(c);
    active_cells_changed = false;
  }

  PointsView
  MaterialPoints::view()
  {
    assert_settled();
    return {blocks,
            histories,
            headers,
            next_block.data(),
            first_block.data(),
            active_cells.data(),
            static_cast<unsigned int>(active_cells.size()),
            filled_volume.data(),
            changed.data(),
            n_yielding.data(),
            user_state,
            static_cast<int>(n_user_state_)};
  }

  const std::vector<unsigned int> &
  MaterialPoints::cells_with_points() const
  {
    assert_settled();
    return active_cells;
  }

  void
  MaterialPoints::assert_settled() const
  {
    Assert(is_settled && !active_cells_changed,
           ExcMessage("settle() must follow add()"));
  }

  // ------------------------------------------------------------ relocation

  UpdateResult &
  MaterialPoints::update_result()
  {
    if (leaving_storage.size() < n_points_)
      leaving_storage.resize(n_points_);
    update_result_.leaving  = leaving_storage.data();
    update_result_.capacity = leaving_storage.size();
    return update_result_;
  }

  void
  MaterialPoints::relocate()
  {
    assert_settled();
    // the kernel lists points in the order of their blocks
    AssertThrow(update_result_.n_leaving <= update_result_.capacity,
                ExcInternalError());
    auto moving = take_out(update_result_.leaving, update_result_.n_leaving);
    bring_to_cells(moving);
    // blocks of neighboring cells drift apart in memory slowly
    if (++n_relocations % Intervals::ordering == 0)
      put_blocks_in_order();
  }

  std::vector<MaterialPoints::PlacedPoint>
  MaterialPoints::take_out(const LeavingPoint *places, const unsigned int n)
  {
    // Going backward, the point that fills a gap is never one that is still to
    // be taken out.
    std::vector<PlacedPoint> result;
    result.reserve(n);
    for (unsigned int i = n; i-- > 0;)
      {
        if (i >= steps_ahead)
          {
            const LeavingPoint &later = places[i - steps_ahead];
            prefetch(later.block);
            prefetch(last_block(later.cell, headers[later.block].material));
          }
        const LeavingPoint &p = places[i];
        ++n_moved[p.cell];
        result.emplace_back(p.cell, get(p.block, p.lane));
        remove(p.cell, p.block, p.lane);
      }
    return result;
  }

  void
  MaterialPoints::bring_to_cells(std::vector<PlacedPoint> &moving)
  {
    std::map<unsigned int, std::vector<TravelingPoint>> abroad;
    for (auto &[cell, point] : moving)
      cell = find_cell(cell, point);
    for (unsigned int i = 0; i < moving.size(); ++i)
      {
        if (i + steps_ahead < moving.size())
          {
            const auto &[later_cell, later] = moving[i + steps_ahead];
            if (grid.is_owned(later_cell))
              prefetch(last_block(later_cell, later.material));
          }
        const auto &[cell, point] = moving[i];
        if (grid.is_owned(cell))
          insert(cell, point);
        else
          abroad[grid.owner_of(cell)].push_back(
            {grid.global_number(cell), point});
      }
    if (grid.n_ranks() > 1)
      {
        for (const TravelingPoint &p : point_exchange.exchange(abroad))
          insert(grid.local_number(p.cell), p.point);
        point_exchange.update_occupied(first_block);
      }
    if (active_cells_changed)
      collect_active_cells();
  }

  std::vector<unsigned int>
  MaterialPoints::cell_costs() const
  {
    // Measured, in nanoseconds of a processor with AVX-512. Times of this run
    // would differ in the next one, and its parts and last digits with them.
    constexpr double of_cell = 20., of_cell_with_points = 70., of_block = 40.,
                     of_yielding_block = 25., of_moving_point = 500.,
                     of_user_point = 100.;
    const double per_step = 1. / std::max(1u, n_relocations - first_relocation);
    const auto   is_of_user = [this](const Kernels::BlockHeader &block) {
      const auto m = static_cast<std::size_t>(block.material);
      return m < user_materials.size() && user_materials[m];
    };
    std::vector<unsigned int> costs(grid.n_global_cells(), 0);
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      if (grid.is_owned(cell))
        {
          double cost = of_cell +
                        (first_block[cell] >= 0 ? of_cell_with_points : 0.) +
                        of_yielding_block * n_yielding[cell] +
                        of_moving_point * per_step * n_moved[cell];
          for_each_block(cell, [&](const int b) {
            cost +=
              of_block +
              (is_of_user(headers[b]) ? of_user_point * headers[b].count : 0.);
          });
          costs[index_of(grid.global_number(cell))] =
            static_cast<unsigned int>(cost);
        }
    return costs;
  }

  void
  MaterialPoints::register_totals(RunTotals &totals)
  {
    totals.count("held_back_count", n_held_back);
    totals.count("thrown_off_count", n_thrown_off);
    totals.count("points_split", n_split);
    totals.count("points_merged", n_merged);
  }

  // ------------------------------------------------------------ places

  namespace
  {
    /** The face to cross in one direction, or -1 if none. */
    int
    face_to_cross(const double x, const unsigned int direction)
    {
      return x < 0. ? 2 * direction : x > 1. ? 2 * direction + 1 : -1;
    }

    std::array<int, 2>
    faces_to_cross(const BackgroundGrid &grid,
                   const unsigned int    cell,
                   const Point<2>       &position)
    {
      const Point<2> x = to_reference(grid.geometry(cell), position);
      return {{face_to_cross(x[0], 0), face_to_cross(x[1], 1)}};
    }
  } // namespace

  unsigned int
  MaterialPoints::walk(unsigned int cell, const Point<2> &position) const
  {
    for (unsigned int n_crossed = 0; n_crossed < 100; ++n_crossed)
      {
        int            next = -1;
        const Point<2> x    = to_reference(grid.geometry(cell), position);
        for (const unsigned int direction : {radial, vertical})
          {
            const int face = face_to_cross(x[direction], direction);
            if (face < 0 || next >= 0)
              continue;
            // the nearer one of two smaller cells
            const int neighbor =
              grid.neighbor(cell, face, x[1 - direction] > .5);
            if (neighbor >= 0 && !grid.is_rigid(neighbor))
              next = neighbor;
          }
        if (next < 0)
          break;
        cell = next;
      }
    return cell;
  }

  bool
  MaterialPoints::is_in_soil(const unsigned int cell,
                             const Point<2>    &position) const
  {
    const auto faces = faces_to_cross(grid, walk(cell, position), position);
    return faces[0] < 0 && faces[1] < 0;
  }

  unsigned int
  MaterialPoints::find_cell(unsigned int cell, MaterialPoint &point)
  {
    // points may leave a side of the domain by round-off only
    constexpr double margin = 1e-10, tolerance = 1e-2;
    if (!std::isfinite(point.position[0]) || !std::isfinite(point.position[1]))
      report_lost(point);
    check_speed(cell, point);
    cell             = walk(cell, point.position);
    const auto faces = faces_to_cross(grid, cell, point.position);
    if (faces[0] < 0 && faces[1] < 0)
      return cell;
    Point<2> x = to_reference(grid.geometry(cell), point.position);
    for (const int face : faces)
      if (face >= 0)
        {
          double   &coordinate = x[face / 2];
          const int neighbor   = grid.neighbor(cell, face);
          if (neighbor >= 0 && grid.is_rigid(neighbor))
            ++n_held_back;
          else if (neighbor >= 0 || !grid.at_side(cell, face))
            report_lost(point);
          else if (coordinate < -tolerance || coordinate > 1. + tolerance)
            stop_at_side(coordinate, face, point);
          coordinate = std::clamp(coordinate, margin, 1. - margin);
        }
    point.position = to_position(grid.geometry(cell), x);
    return cell;
  }

  void
  MaterialPoints::stop_at_side(const double       coordinate,
                               const unsigned int face,
                               MaterialPoint     &point)
  {
    // A state that breaks throws points much farther, and many of them; soil
    // that flows out of the mesh comes in numbers, too.
    constexpr double    farthest = 1.; // cells beyond the side
    const unsigned long most     = std::max(10u, n_points_ / 1000);
    double             &velocity = point.velocity[face / 2];
    if (coordinate < -farthest || coordinate > 1. + farthest)
      report_lost(point);
    // a side that moves overtakes points that it has stopped
    if ((face % 2 == 0 ? -velocity : velocity) <= 0.)
      return;
    if (++n_thrown_off > most)
      report_lost(point);
    velocity = 0.;
  }

  // ------------------------------------------------------------ all points

  void
  MaterialPoints::clear_blocks(const unsigned long n_blocks)
  {
    handler = make_handler(n_blocks);
    next_block.clear();
    clear_lists();
  }

  void
  MaterialPoints::clear_lists()
  {
    first_block.assign(grid.n_cells(), -1);
    clear_sums();
    n_yielding.assign(grid.n_cells(), 0);
    n_moved.assign(grid.n_cells(), 0);
    first_relocation     = n_relocations;
    n_points_            = 0;
    active_cells_changed = true;
    is_settled           = false;
  }

  void
  MaterialPoints::keep_user_state(const unsigned int       n,
                                  const std::vector<bool> &user_materials)
  {
    AssertThrow(n_points_ == 0, ExcInternalError());
    n_user_state_        = n;
    this->user_materials = user_materials;
  }

  void
  MaterialPoints::reset(const std::vector<unsigned int> &n_in_cell)
  {
    unsigned long n_blocks = 0;
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      if (grid.is_owned(cell))
        n_blocks +=
          (n_in_cell[index_of(grid.global_number(cell))] + block_size - 1) /
          block_size;
    clear_blocks(n_blocks + n_blocks / 16);
  }

  void
  MaterialPoints::clear_sums()
  {
    filled_volume.assign(grid.n_cells(), 0.);
    changed.assign(grid.n_cells(), true);
    sizes.assign(grid.n_cells(), {});
  }

  void
  MaterialPoints::include_in_sums(const unsigned int   cell,
                                  const MaterialPoint &point)
  {
    filled_volume[cell] += point.volume;
    for (unsigned int d = 0; d < 2; ++d)
      sizes[cell][d].include(point.size[d]);
  }

  void
  MaterialPoints::settle()
  {
    collect_active_cells();
    is_settled = true;
    if (grid.n_ranks() == 1)
      return;
    point_exchange.set_up(grid);
    point_exchange.update_occupied(first_block);
  }
} // namespace CaissonMPM
