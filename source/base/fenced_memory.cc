// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/fenced_memory.h>

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <limits>
#include <new>

namespace CaissonMPM
{
  namespace
  {
    // others may be far off: an index of 100,000 beyond the end is stopped
    constexpr std::size_t fence = 1 << 20; // bytes

    char *
    mapped(void *const       address,
           const std::size_t n,
           const int         protection,
           const int         flags,
           const int         file)
    {
      void *const result = mmap(address, n, protection, flags, file, 0);
      if (result == MAP_FAILED)
        throw std::bad_alloc();
      return static_cast<char *>(result);
    }
  } // namespace

  FencedMemory::FencedMemory(const std::size_t n_bytes, const Access access)
    : n_bytes(n_bytes)
  {
    const std::size_t page  = sysconf(_SC_PAGESIZE);
    n_mapped                = (n_bytes / page + 1) * page;
    n_before                = n_mapped - n_bytes;
    to_end                  = n_bytes + fence;
    constexpr int both_ways = PROT_READ | PROT_WRITE;
    const int     file      = memfd_create("fenced", MFD_CLOEXEC);
    if (file < 0 || ftruncate(file, n_mapped) != 0)
      throw std::bad_alloc();
    lent_pages = mapped(nullptr,
                        n_mapped + fence,
                        PROT_NONE,
                        MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE,
                        -1);
    mapped(lent_pages,
           n_mapped,
           access == Access::read_only ? PROT_READ : both_ways,
           MAP_SHARED | MAP_FIXED,
           file);
    own_pages = access == Access::read_only ?
                  mapped(nullptr, n_mapped, both_ways, MAP_SHARED, file) :
                  lent_pages;
    close(file); // the pages stay
    std::fill_n(reinterpret_cast<double *>(own_pages),
                n_before / sizeof(double),
                std::numeric_limits<double>::quiet_NaN());
  }

  FencedMemory::~FencedMemory()
  {
    if (own_pages != lent_pages)
      munmap(own_pages, n_mapped);
    munmap(lent_pages, n_mapped + fence);
  }
} // namespace CaissonMPM
