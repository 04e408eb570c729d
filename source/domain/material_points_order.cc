// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Where the blocks of the points lie in memory, and what is kept of them.
#include <caisson_mpm/domain/material_points.h>

#include <sys/mman.h>

#include <cstdint>

namespace CaissonMPM
{
  using namespace Kernels;

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
    user_state.reserve(place_of_user_state(n_blocks, 0));
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
    if (n_user_state_ == 0)
      return;
    std::vector<double> state;
    state.reserve(user_state.capacity());
    for (const int block : source)
      state.insert(state.end(),
                   user_state.begin() + place_of_user_state(block, 0),
                   user_state.begin() + place_of_user_state(block + 1, 0));
    user_state.swap(state);
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
} // namespace CaissonMPM
