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
    auto                     ordered = make_handler(headers.size());
    std::vector<BlockHeader> ordered_headers;
    for (const unsigned int cell : active_cells)
      {
        int block         = first_block[cell];
        first_block[cell] = ordered_headers.size();
        for (; block >= 0; block = headers[block].next)
          {
            auto &pool = handler->get_property_pool();
            ordered->insert_particle(pool.get_location(block),
                                     pool.get_reference_location(block),
                                     pool.get_id(block),
                                     grid.cell_iterator(cell),
                                     pool.get_properties(block));
            if (ordered_headers.empty()) // before memory is touched
              use_large_pages(*ordered);
            ordered_headers.push_back(headers[block]);
            if (headers[block].next >= 0)
              ordered_headers.back().next = ordered_headers.size();
          }
      }
    handler = std::move(ordered);
    headers.swap(ordered_headers);
    find_blocks();
  }

  void
  MaterialPoints::prepare_for_repartition()
  {
    // the blocks of a cell travel in the order that the handler has
    put_blocks_in_order();
    for (unsigned int block = 0; block < headers.size(); ++block)
      {
        double *const properties    = blocks[block].r - Place::block;
        properties[Place::material] = headers[block].material;
        properties[Place::count]    = headers[block].count;
      }
    handler->prepare_for_coarsening_and_refinement();
  }

  void
  MaterialPoints::unpack_after_repartition()
  {
    handler->unpack_after_coarsening_and_refinement();
    n_reserved = handler->get_property_pool().n_slots();
    headers.assign(n_reserved, {-1, 0, 0});
    find_blocks();
    clear_lists();
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      if (grid.is_owned(cell))
        {
          int *link = &first_block[cell];
          for (const auto &particle :
               handler->particles_in_cell(grid.cell_iterator(cell)))
            {
              const auto properties = particle.get_properties();
              *link                 = particle.get_local_index();
              headers[*link]        = {-1,
                                       static_cast<short>(properties[Place::count]),
                                       static_cast<short>(
                                  properties[Place::material])};
              n_points_ += headers[*link].count;
              link = &headers[*link].next;
            }
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
      for (int b = first_block[cell]; b >= 0; b = headers[b].next)
        pad(b, headers[b].count, block_size);
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
