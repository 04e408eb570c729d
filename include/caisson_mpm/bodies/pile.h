// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A closed pile on the axis with a flat base.
#ifndef caisson_mpm_bodies_pile_h
#define caisson_mpm_bodies_pile_h

#include <caisson_mpm/bodies/cone.h>

namespace CaissonMPM
{
  /** A cone without a point. */
  class Pile : public Cone
  {
  public:
    Pile()
      : Cone("pile", "a closed cylinder on the axis with a flat base", 180.)
    {}

    double
    tip_height() const override
    {
      return 0.;
    }
  };
} // namespace CaissonMPM

#endif
