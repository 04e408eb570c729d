// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A short text or number that distinguishes longer texts.
#ifndef caisson_mpm_base_fingerprint_h
#define caisson_mpm_base_fingerprint_h

#include <cstdint>
#include <string>

namespace CaissonMPM
{
  /**
   * The hash FNV-1a with 64 bits (Fowler, Noll and Vo) of a text that is added
   * piece by piece.
   *
   * @code
   * Fingerprint fingerprint;
   * fingerprint.add(line);
   * @endcode
   */
  class Fingerprint
  {
  public:
    /** Go on behind what has been added before. */
    void
    add(const std::string &text);

    /** 16 hexadecimal digits. */
    std::string
    digits() const;

    /** A whole number that a double holds exactly: the lowest 52 bits. */
    double
    number() const;

  private:
    std::uint64_t hash = 14695981039346656037u;
  };

  /** Return 16 hexadecimal digits that differ where @p text does. */
  std::string
  fingerprint_of(const std::string &text);
} // namespace CaissonMPM

#endif
