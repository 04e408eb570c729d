// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Where the blocks of the points lie: in the memory of the ParticleHandler, and
// on which rank; and what is said of a point that cannot be where it is.
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/domain/material_points.h>

#include <sys/mman.h>

#include <cmath>
#include <cstdint>
#include <sstream>

namespace CaissonMPM
{
  using namespace dealii;
  using namespace Kernels;

  void
  MaterialPoints::use_large_pages(const ParticleHandler &handler) const
  {
#ifdef MADV_HUGEPAGE
    auto                    &pool  = handler.get_property_pool();
    constexpr std::uintptr_t page  = 1u << 21;
    const auto               begin = reinterpret_cast<std::uintptr_t>(
                 pool.get_properties(0).data()),
               end = begin + std::uintptr_t(n_reserved) *
                               pool.n_properties_per_slot() * sizeof(double),
               first = (begin + page - 1) / page * page,
               last  = end / page * page;
    if (first < last)
      madvise(reinterpret_cast<void *>(first), last - first, MADV_HUGEPAGE);
#endif
  }

  std::unique_ptr<MaterialPoints::ParticleHandler>
  MaterialPoints::make_handler(const unsigned long n_blocks)
  {
    // rows of whole cache lines
    constexpr unsigned int line = 64 / sizeof(double);
    const unsigned int     n_properties =
      Place::user_state + block_size * n_user_state_;
    auto result = std::make_unique<ParticleHandler>(grid.triangulation(),
                                                    grid.mapping(),
                                                    (n_properties + line - 1) /
                                                      line * line);
    n_reserved  = n_blocks;
    result->reserve(n_reserved);
    return result;
  }

  void
  MaterialPoints::find_blocks()
  {
    auto &pool = handler->get_property_pool();
    if (pool.n_slots() == 0)
      return;
    double *const begin    = pool.get_properties(0).data();
    const long    distance = pool.n_properties_per_slot() * sizeof(double);
    const auto    at       = [&](const int place) { return begin + place; };
    headers    = {reinterpret_cast<BlockHeader *>(at(Place::header)), distance};
    blocks     = {reinterpret_cast<PointBlock *>(at(Place::block)), distance};
    histories  = {reinterpret_cast<PointHistory *>(at(Place::history)),
                  distance};
    user_state = {at(Place::user_state), distance};
  }

  void
  MaterialPoints::put_blocks_in_order()
  {
    if (active_cells_changed)
      collect_active_cells();
    // The sort of ParticleHandler would search for the cell of each particle.
    auto &pool    = handler->get_property_pool();
    auto  ordered = make_handler(pool.n_slots());
    for (const unsigned int cell : active_cells)
      for_each_block(cell, [&](const int block) {
        ordered->insert_particle(pool.get_location(block),
                                 pool.get_reference_location(block),
                                 pool.get_id(block),
                                 grid.cell_iterator(cell),
                                 pool.get_properties(block));
        if (ordered->get_property_pool().n_registered_slots() == 1)
          use_large_pages(*ordered); // before memory is touched
      });
    handler = std::move(ordered);
    find_blocks();
    for (const unsigned int cell : active_cells)
      list_blocks(cell);
  }

  const MaterialPoints::ParticleHandler &
  MaterialPoints::particles()
  {
    assert_settled();
    auto &pool = handler->get_property_pool();
    for (const unsigned int cell : active_cells)
      for_each_block(cell, [&](const int block) {
        Point<2> mean;
        for (int lane = 0; lane < headers[block].count; ++lane)
          mean += Point<2>(blocks[block].r[lane], blocks[block].z[lane]) /
                  headers[block].count;
        pool.set_location(block, mean);
        pool.set_reference_location(block,
                                    to_reference(grid.geometry(cell), mean));
        pool.set_id(block, block * grid.n_ranks() + grid.owner_of(cell));
      });
    handler->update_cached_numbers();
    return *handler;
  }

  void
  MaterialPoints::prepare_for_repartition()
  {
    handler->prepare_for_coarsening_and_refinement();
  }

  void
  MaterialPoints::unpack_after_repartition()
  {
    handler->unpack_after_coarsening_and_refinement();
    n_reserved = handler->get_property_pool().n_slots();
    next_block.resize(n_reserved);
    find_blocks();
    clear_lists();
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      if (grid.is_owned(cell))
        {
          list_blocks(cell);
          for_each_block(cell,
                         [&](const int b) { n_points_ += headers[b].count; });
        }
    rebuild_sums();
    settle();
  }

  void
  MaterialPoints::rebuild_sums()
  {
    if (active_cells_changed)
      collect_active_cells();
    clear_sums();
    for_each([this](const MaterialPoint &point, const unsigned int cell) {
      include_in_sums(cell, point);
    });
    // a law may compute a register in another way for the sake of its padding
    for (const unsigned int cell : active_cells)
      for_each_block(cell, [&](const int b) {
        pad(b, static_cast<int>(headers[b].count), block_size);
      });
  }

  // ------------------------------------------------------------ lost points

  namespace
  {
    std::string
    in_words(const MaterialPoint &p)
    {
      return "material point " + to_text(static_cast<long>(p.id)) +
             ", which began at r = " + to_text(p.initial_position[0], 6) +
             " m, z = " + to_text(p.initial_position[1], 6) + " m and is at (" +
             to_text(p.position[0], 6) + ", " + to_text(p.position[1], 6) +
             ") m,";
    }
  } // namespace

  void
  MaterialPoints::check_speed(const unsigned int   cell,
                              const MaterialPoint &point) const
  {
    // no wave passes more than a cell in a step
    constexpr double farthest = 1.; // cells beyond its own
    const Point<2>   x = to_reference(grid.geometry(cell), point.position);
    if (std::abs(x[0] - .5) <= .5 + farthest &&
        std::abs(x[1] - .5) <= .5 + farthest)
      return;
    const auto &g = grid.geometry(cell);
    throw RunFailure(
      in_words(point) +
      " has passed more than a cell in a step, with a velocity of (" +
      to_text(point.velocity[0], 4) + ", " + to_text(point.velocity[1], 4) +
      ") m/s, from the cell at r = " + to_text(g.left, 5) +
      " m, z = " + to_text(g.bottom_left, 5) + " m of the " +
      GridLines::name_of(grid.zone(cell)) +
      " zone. Soil cannot move so fast: the computation has become unstable "
      "there. Reduce Time/Courant number or Time/Inertia tolerance, and look "
      "for a layer that is much softer or stiffer than the one beside it.");
  }

  void
  MaterialPoints::report_lost(const MaterialPoint &p) const
  {
    std::ostringstream s;
    const bool         finite =
      std::isfinite(p.position[0]) && std::isfinite(p.position[1]);
    s << in_words(p) << (finite ? " left the mesh" : " is no longer finite")
      << " with velocity (" << p.velocity[0] << ", " << p.velocity[1]
      << ") m/s and mean stress "
      << (p.stress[0] + p.stress[1] + p.stress[2]) / 3.
      << " Pa. Likely causes: a time step too large (reduce Time/Courant "
         "number), a mesh that ends where soil flows (raise Grid/Top, or make "
         "the side a roller), soil without strength at a free surface (add some "
         "cohesion and Tension cut-off), or soil whose dilatancy angle is near "
         "its friction angle (set Method/Pressure in full cells = mean).";
    throw RunFailure(s.str());
  }
} // namespace CaissonMPM
