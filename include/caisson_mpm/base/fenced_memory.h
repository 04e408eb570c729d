// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Memory for code that somebody else has written, with a fence behind it.
#ifndef caisson_mpm_base_fenced_memory_h
#define caisson_mpm_base_fenced_memory_h

#include <cstddef>

namespace CaissonMPM
{
  /** What others may do with memory. */
  enum class Access
  {
    read_only,
    read_and_write
  };

  /**
   * Memory that ends where a fence begins: whoever reads or writes behind it is
   * stopped by SIGSEGV (guarded_call.h), and so is who writes to what is for
   * reading only. Before it there are numbers that are not finite. The program
   * and the others see the same memory, at different addresses where they may
   * only read. Access costs nothing.
   *
   * Throws std::bad_alloc where there is not enough memory.
   */
  class FencedMemory
  {
  public:
    /** Zeros. @p n_bytes is a multiple of 8; addresses are one, too. */
    FencedMemory(const std::size_t n_bytes, const Access access);
    ~FencedMemory();

    FencedMemory(const FencedMemory &) = delete;
    FencedMemory &
    operator=(const FencedMemory &) = delete;

    /** The memory, for the program. */
    template <typename T>
    T *
    own() const
    {
      return reinterpret_cast<T *>(own_pages + n_before);
    }

    /** The same memory, for others. */
    template <typename T>
    T *
    lent() const
    {
      return reinterpret_cast<T *>(lent_pages + n_before);
    }

    /** Whether others were stopped behind the memory where they asked for this
     * address. */
    bool
    is_behind(const void *address) const
    {
      return distance_to(address) >= n_bytes && distance_to(address) < to_end;
    }

    /** The same for what lies in the memory. */
    bool
    is_inside(const void *address) const
    {
      return distance_to(address) < n_bytes;
    }

    /** From the begin of what is lent; huge for addresses before it. Units:
     * bytes. */
    std::size_t
    distance_to(const void *address) const
    {
      return static_cast<std::size_t>(static_cast<const char *>(address) -
                                      lent<char>());
    }

  private:
    std::size_t n_bytes, n_mapped, n_before, to_end;
    char       *own_pages, *lent_pages;
  };
} // namespace CaissonMPM

#endif
