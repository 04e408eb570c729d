// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The sizes of the material points of a cell, and what is too large or too
// small there.
#ifndef caisson_mpm_domain_size_range_h
#define caisson_mpm_domain_size_range_h

#include <algorithm>
#include <limits>

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
} // namespace CaissonMPM

#endif
