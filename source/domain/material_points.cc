// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/domain/material_points.h>

#include <sys/mman.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <sstream>

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
    const PointBlock   &b = blocks[block];
    const PointHistory &h = histories[block];
    MaterialPoint       p;
    p.position    = Point<2>(b.r[lane], b.z[lane]);
    p.velocity[0] = b.velocity_r[lane];
    p.velocity[1] = b.velocity_z[lane];
    for (unsigned int c = 0; c < 4; ++c)
      p.stress[c] = b.stress[c][lane];
    p.mass               = b.mass[lane];
    p.volume             = b.volume[lane];
    p.plastic_deviatoric = b.plastic_deviatoric[lane];
    p.plastic_volumetric = b.plastic_volumetric[lane];
    for (int i = 0; i < n_state_variables; ++i)
      p.state[i] = h.state[i][lane];
    p.initial_position = Point<2>(h.initial_r[lane], h.initial_z[lane]);
    p.initial_volume   = h.initial_volume[lane];
    p.id               = h.id[lane];
    p.size[0]          = h.size_r[lane];
    p.size[1]          = h.size_z[lane];
    p.material         = headers[block].material;
    return p;
  }

  void
  MaterialPoints::set(const int block, const int lane, const MaterialPoint &p)
  {
    PointBlock   &b    = blocks[block];
    PointHistory &h    = histories[block];
    b.r[lane]          = p.position[0];
    b.z[lane]          = p.position[1];
    b.velocity_r[lane] = p.velocity[0];
    b.velocity_z[lane] = p.velocity[1];
    for (unsigned int c = 0; c < 4; ++c)
      b.stress[c][lane] = p.stress[c];
    b.mass[lane]               = p.mass;
    b.volume[lane]             = p.volume;
    b.plastic_deviatoric[lane] = p.plastic_deviatoric;
    b.plastic_volumetric[lane] = p.plastic_volumetric;
    for (int i = 0; i < n_state_variables; ++i)
      h.state[i][lane] = p.state[i];
    h.initial_r[lane]      = p.initial_position[0];
    h.initial_z[lane]      = p.initial_position[1];
    h.initial_volume[lane] = p.initial_volume;
    h.id[lane]             = p.id;
    h.size_r[lane]         = p.size[0];
    h.size_z[lane]         = p.size[1];
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
  }

  void
  MaterialPoints::pad(const int block)
  {
    for (int lane = headers[block].count; lane < block_size; ++lane)
      {
        copy_lane(block, 0, block, lane);
        blocks[block].mass[lane]   = 0.;
        blocks[block].volume[lane] = 0.;
      }
  }

  int
  MaterialPoints::new_block(const unsigned int cell,
                            const int          after,
                            const short        material)
  {
    if (free_blocks.empty())
      {
        if (blocks.size() == blocks.capacity())
          {
            // by a quarter: a million points take gigabytes
            reserve(blocks.size() + blocks.size() / 4 + 64);
          }
        free_blocks.push_back(blocks.size());
        blocks.emplace_back();
        histories.emplace_back();
        headers.push_back({-1, 0, 0});
      }
    const int block = free_blocks.back();
    free_blocks.pop_back();
    int &link      = after >= 0 ? headers[after].next : first_block[cell];
    headers[block] = {link, 0, material};
    link           = block;
    return block;
  }

  void
  MaterialPoints::add(const unsigned int cell, const MaterialPoint &point)
  {
    filled_volume[cell] += point.volume;
    changed[cell]        = true;
    const short material = point.material;
    // the last block of this material, or the last block of the cell
    int block = -1, last = -1;
    for (int b = first_block[cell]; b >= 0; b = headers[b].next)
      {
        last = b;
        if (headers[b].material == material)
          block = b;
      }
    active_cells_changed |= last < 0;
    if (block < 0 || headers[block].count == block_size)
      block = new_block(cell, block >= 0 ? block : last, material);
    set(block, headers[block].count++, point);
    pad(block);
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
    int last = block, before = -1;
    for (int b = first_block[cell], previous = -1; b >= 0;
         previous = b, b = headers[b].next)
      if (headers[b].material == headers[block].material)
        {
          last   = b;
          before = previous;
        }
    const int last_lane = --headers[last].count;
    if (last != block || last_lane != lane)
      {
        copy_lane(last, last_lane, block, lane);
        pad(block);
      }
    if (headers[last].count == 0)
      {
        (before >= 0 ? headers[before].next : first_block[cell]) =
          headers[last].next;
        free_blocks.push_back(last);
        active_cells_changed |= first_block[cell] < 0;
      }
    else
      pad(last);
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

  namespace
  {
    /** Ask for pages of 2 MiB inside the storage; only a hint. */
    template <typename Block>
    void
    use_large_pages(std::vector<Block> &storage)
    {
#ifdef MADV_HUGEPAGE
      constexpr std::uintptr_t page = 1u << 21;
      const auto begin = reinterpret_cast<std::uintptr_t>(storage.data()),
                 end   = begin + storage.capacity() * sizeof(Block),
                 first = (begin + page - 1) / page * page,
                 last  = end / page * page;
      if (first < last)
        madvise(reinterpret_cast<void *>(first), last - first, MADV_HUGEPAGE);
#endif
    }

    /** Bring storage[source[i]] to i, for a permutation. */
    template <typename Block>
    void
    permute(std::vector<Block> &storage, std::vector<int> source)
    {
      // cycle by cycle, with room for one
      for (unsigned int start = 0; start < storage.size(); ++start)
        {
          if (source[start] == static_cast<int>(start))
            continue;
          const Block  first = storage[start];
          unsigned int i     = start;
          for (unsigned int next = source[i]; next != start; next = source[i])
            {
              storage[i] = storage[next];
              source[i]  = i;
              i          = next;
            }
          storage[i] = first;
          source[i]  = i;
        }
    }
  } // namespace

  void
  MaterialPoints::reserve(const unsigned long n_blocks)
  {
    blocks.reserve(n_blocks);
    histories.reserve(n_blocks);
    headers.reserve(n_blocks);
    use_large_pages(blocks);
    use_large_pages(histories);
  }

  void
  MaterialPoints::put_blocks_in_order()
  {
    if (active_cells_changed)
      collect_active_cells();
    // block i is to be the one that is now source[i]
    std::vector<int> source;
    source.reserve(blocks.size());
    for (const unsigned int cell : active_cells)
      {
        int block         = first_block[cell];
        first_block[cell] = source.size();
        for (; block >= 0; block = headers[block].next)
          source.push_back(block);
      }
    const unsigned int       n = source.size();
    std::vector<BlockHeader> ordered(n);
    for (unsigned int i = 0; i < n; ++i)
      {
        ordered[i] = headers[source[i]];
        if (ordered[i].next >= 0)
          ordered[i].next = i + 1;
      }
    std::copy(ordered.begin(), ordered.end(), headers.begin());
    // the free blocks are the rest
    std::vector<bool> used(blocks.size(), false);
    for (const int block : source)
      used[block] = true;
    for (unsigned int block = 0; block < blocks.size(); ++block)
      if (!used[block])
        source.push_back(block);
    free_blocks.clear();
    for (unsigned int i = blocks.size(); i-- > n;)
      free_blocks.push_back(i);
    permute(blocks, source);
    permute(histories, source);
  }

  PointsView
  MaterialPoints::view()
  {
    if (active_cells_changed)
      collect_active_cells();
    return {blocks.data(),
            histories.data(),
            headers.data(),
            first_block.data(),
            active_cells.data(),
            static_cast<unsigned int>(active_cells.size()),
            filled_volume.data(),
            changed.data()};
  }

  // ------------------------------------------------------------ relocation

  LeavingPoints &
  MaterialPoints::leaving()
  {
    if (leaving_storage.size() < n_points_)
      leaving_storage.resize(n_points_);
    leaving_view.points   = leaving_storage.data();
    leaving_view.capacity = leaving_storage.size();
    return leaving_view;
  }

  void
  MaterialPoints::relocate()
  {
    // the kernel lists points in the order of their blocks
    auto moving = take_out(leaving_view.points, leaving_view.n);
    bring_to_cells(moving);
    if (++n_relocations % 200 == 0)
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
        const LeavingPoint &p = places[i];
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
      {
        cell = find_cell(cell, point);
        if (grid.is_owned(cell))
          add(cell, point);
        else
          abroad[grid.owner_of(cell)].push_back(
            {grid.global_number(cell), point});
      }
    if (grid.n_ranks() > 1)
      {
        for (const TravelingPoint &p : point_exchange.exchange(abroad))
          add(grid.local_number(p.cell), p.point);
        point_exchange.update_occupied(first_block);
      }
    if (active_cells_changed)
      collect_active_cells();
  }

  std::vector<unsigned int>
  MaterialPoints::cell_costs() const
  {
    std::vector<unsigned int> costs(grid.n_global_cells(), 0);
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      if (grid.is_owned(cell))
        {
          unsigned int &cost = costs[index_of(grid.global_number(cell))];
          cost               = 1;
          for (int b = first_block[cell]; b >= 0; b = headers[b].next)
            cost += 2;
        }
    return costs;
  }

  std::vector<TravelingPoint>
  MaterialPoints::take_all()
  {
    std::vector<TravelingPoint> result;
    result.reserve(n_points_);
    for_each([&](const MaterialPoint &point, const unsigned int cell) {
      result.push_back({grid.global_number(cell), point});
    });
    clear_blocks();
    return result;
  }

  void
  MaterialPoints::redistribute(const std::vector<TravelingPoint> &traveling)
  {
    clear_blocks();
    for (const TravelingPoint &p : send_to_owners(grid, traveling))
      add(grid.local_number(p.cell), p.point);
    settle();
  }

  // ------------------------------------------------------------ splitting

  namespace
  {
    constexpr double too_large = 1.05, too_small = .45; // times the wanted size

    bool
    is_too_large(const double size, const double wanted)
    {
      return size > too_large * wanted;
    }

    bool
    is_too_small(const double size, const double wanted)
    {
      return size > 0. && size < too_small * wanted;
    }

    /** Half of the point, from the middle to one side of it. */
    MaterialPoint
    half_of(const MaterialPoint &point,
            const unsigned int   direction,
            const double         side) // -1 or 1
    {
      MaterialPoint half  = point;
      const double  shift = .25 * side * point.size[direction];
      half.position[direction] += shift;
      half.initial_position[direction] += shift;
      half.mass *= .5;
      half.volume *= .5;
      half.initial_volume *= .5;
      half.size[direction] *= .5;
      return half;
    }

    /** Whether two points lie side by side in a direction. */
    bool
    are_neighbors(const MaterialPoint &a,
                  const MaterialPoint &b,
                  const unsigned int   direction)
    {
      const unsigned int across = 1 - direction;
      const auto         distance =
                   std::abs(a.position[direction] - b.position[direction]),
                 aside = std::abs(a.position[across] - b.position[across]);
      return a.material == b.material &&
             distance < .75 * (a.size[direction] + b.size[direction]) &&
             aside < .375 * (a.size[across] + b.size[across]);
    }

    /** Make one point of two that lie side by side in a direction. */
    MaterialPoint
    one_of(const MaterialPoint &a,
           const MaterialPoint &b,
           const unsigned int   direction)
    {
      MaterialPoint result   = a;
      result.mass            = a.mass + b.mass;
      result.volume          = a.volume + b.volume;
      const double by_mass   = b.mass / result.mass,
                   by_volume = b.volume / result.volume;
      const auto mix = [](double &x, const double y, const double share) {
        x += share * (y - x);
      };
      for (unsigned int d = 0; d < 2; ++d)
        {
          mix(result.position[d], b.position[d], by_mass);
          mix(result.initial_position[d], b.initial_position[d], by_mass);
          mix(result.velocity[d], b.velocity[d], by_mass);
          mix(result.size[d], b.size[d], by_mass);
        }
      for (unsigned int c = 0; c < 4; ++c)
        mix(result.stress[c], b.stress[c], by_volume);
      mix(result.plastic_deviatoric, b.plastic_deviatoric, by_mass);
      mix(result.plastic_volumetric, b.plastic_volumetric, by_mass);
      for (int i = 0; i < n_state_variables; ++i)
        mix(result.state[i], b.state[i], by_mass);
      result.initial_volume += b.initial_volume;
      result.size[direction] = a.size[direction] + b.size[direction];
      result.id              = std::min(a.id, b.id);
      return result;
    }
  } // namespace

  std::vector<MaterialPoints::PlacedPoint>
  MaterialPoints::take_out_of_size(const unsigned int           cell,
                                   const std::array<double, 2> &wanted)
  {
    std::vector<LeavingPoint> places;
    for_each_lane(cell, [&](const int b, const int lane) {
      const double size[2] = {histories[b].size_r[lane],
                              histories[b].size_z[lane]};
      bool         is_out  = false;
      for (unsigned int d = 0; d < 2; ++d)
        is_out |=
          is_too_large(size[d], wanted[d]) || is_too_small(size[d], wanted[d]);
      if (is_out)
        places.push_back({cell, b, lane});
    });
    return take_out(places.data(), places.size());
  }

  void
  MaterialPoints::split(const std::array<double, 2> &wanted,
                        std::vector<PlacedPoint>    &points)
  {
    for (unsigned int d = 0; d < 2; ++d)
      for (unsigned int i = 0; i < points.size(); ++i)
        {
          const unsigned int  cell  = points[i].first;
          const MaterialPoint whole = points[i].second;
          if (!is_too_large(whole.size[d], wanted[d]))
            continue;
          const MaterialPoint lower = half_of(whole, d, -1.),
                              upper = half_of(whole, d, 1.);
          // beside the body or the end of the mesh it waits
          if (!is_in_soil(cell, lower.position) ||
              !is_in_soil(cell, upper.position))
            continue;
          points[i].second = lower;
          points.emplace_back(cell, upper);
          ++n_split;
        }
  }

  void
  MaterialPoints::merge(const std::array<double, 2> &wanted,
                        std::vector<PlacedPoint>    &points)
  {
    for (unsigned int d = 0; d < 2; ++d)
      for (unsigned int i = 0; i < points.size(); ++i)
        for (unsigned int j = i + 1; j < points.size(); ++j)
          {
            MaterialPoint &a = points[i].second, &b = points[j].second;
            if (!is_too_small(a.size[d], wanted[d]))
              break;
            if (!is_too_small(b.size[d], wanted[d]) || !are_neighbors(a, b, d))
              continue;
            a = one_of(a, b, d);
            points.erase(points.begin() + j);
            ++n_merged;
          }
  }

  void
  MaterialPoints::register_totals(RunTotals &totals)
  {
    totals.count("held_back_count", n_held_back);
    totals.count("points_split", n_split);
    totals.count("points_merged", n_merged);
  }

  void
  MaterialPoints::adapt(const WantedSize &wanted)
  {
    std::vector<PlacedPoint> moving;
    for (const unsigned int cell : active_cells)
      {
        const auto size   = wanted(cell);
        auto       points = take_out_of_size(cell, size);
        merge(size, points);
        split(size, points);
        moving.insert(moving.end(), points.begin(), points.end());
      }
    bring_to_cells(moving);
  }

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
        int next = -1;
        for (const int face : faces_to_cross(grid, cell, position))
          if (face >= 0 && next < 0)
            {
              const int neighbor = grid.neighbor(cell, face);
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
          else if (neighbor >= 0 || coordinate < -tolerance ||
                   coordinate > 1. + tolerance || !grid.at_side(cell, face))
            report_lost(point);
          coordinate = std::clamp(coordinate, margin, 1. - margin);
        }
    point.position = to_position(grid.geometry(cell), x);
    return cell;
  }

  void
  MaterialPoints::report_lost(const MaterialPoint &p) const
  {
    std::ostringstream s;
    const bool         finite =
      std::isfinite(p.position[0]) && std::isfinite(p.position[1]);
    s << "material point " << static_cast<long>(p.id)
      << (finite ? " left the mesh" : " is no longer finite")
      << ": it began at r = " << p.initial_position[0]
      << " m, z = " << p.initial_position[1] << " m, and is at ("
      << p.position[0] << ", " << p.position[1] << ") m with velocity ("
      << p.velocity[0] << ", " << p.velocity[1] << ") m/s and mean stress "
      << (p.stress[0] + p.stress[1] + p.stress[2]) / 3.
      << " Pa. Likely causes: a time step too large (reduce Time/Courant "
         "number), a mesh that ends where soil flows (raise Grid/Top, or make "
         "the side a roller), or soil without strength at a free surface (add "
         "some cohesion).";
    throw RunFailure(s.str());
  }

  // ------------------------------------------------------------ all points

  void
  MaterialPoints::clear_blocks()
  {
    blocks.clear();
    histories.clear();
    headers.clear();
    free_blocks.clear();
    first_block.assign(grid.n_cells(), -1);
    filled_volume.assign(grid.n_cells(), 0.);
    changed.assign(grid.n_cells(), true);
    n_points_            = 0;
    active_cells_changed = true;
  }

  void
  MaterialPoints::reset(const std::vector<unsigned int> &n_in_cell)
  {
    clear_blocks();
    unsigned long n_blocks = 0;
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      if (grid.is_owned(cell))
        n_blocks +=
          (n_in_cell[index_of(grid.global_number(cell))] + block_size - 1) /
          block_size;
    reserve(n_blocks + n_blocks / 16);
  }

  void
  MaterialPoints::settle()
  {
    collect_active_cells();
    if (grid.n_ranks() == 1)
      return;
    point_exchange.set_up(grid);
    point_exchange.update_occupied(first_block);
  }
} // namespace CaissonMPM
