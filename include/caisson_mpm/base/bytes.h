// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Lists as bytes, for messages between ranks of the same program.
#ifndef caisson_mpm_base_bytes_h
#define caisson_mpm_base_bytes_h

#include <cstring>
#include <type_traits>
#include <vector>

namespace CaissonMPM
{
  template <typename T>
  std::vector<char>
  to_bytes(const std::vector<T> &list)
  {
    static_assert(std::is_trivially_copyable<T>::value, "sent as bytes");
    const char *const begin = reinterpret_cast<const char *>(list.data());
    return std::vector<char>(begin, begin + list.size() * sizeof(T));
  }

  /** Append what to_bytes() gave to @p list. */
  template <typename T>
  void
  append_bytes(std::vector<T> &list, const std::vector<char> &bytes)
  {
    static_assert(std::is_trivially_copyable<T>::value, "sent as bytes");
    const std::size_t n = list.size();
    list.resize(n + bytes.size() / sizeof(T));
    if (!bytes.empty())
      std::memcpy(list.data() + n, bytes.data(), bytes.size());
  }
} // namespace CaissonMPM

#endif
