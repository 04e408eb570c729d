// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the wall of a caisson has above its tip: another thickness from some
// height on, and rings inside.
#ifndef caisson_mpm_bodies_caisson_wall_h
#define caisson_mpm_bodies_caisson_wall_h

#include <caisson_mpm/bodies/body_shape.h>

#include <string>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  /**
   * Steps and rings, by their height above the lowest point of the tip. The
   * wall without them is a rectangle that the caisson gives. A step that does
   * not change the thickness is none. Not collective.
   */
  class CaissonWall
  {
  public:
    /** Declare the entries in the section of the caisson. */
    void
    declare(Section &caisson);

    /** Take the entries, with this thickness at the tip. */
    void
    read(const double thickness);

    /** Throw BadInput where steps and rings contradict each other or the wall
     * @p plain without them, on which they lie from @p tip_height to
     * @p length. */
    void
    check(const BodyPart &plain,
          const double    tip_height,
          const double    length) const;

    bool
    has_steps() const
    {
      return !steps.empty();
    }

    /** Whether faces above the tip look down. */
    bool
    has_ledges() const;

    unsigned int
    n_parts() const
    {
      return 1 + steps.size() + rings.size();
    }

    bool
    is_ring(const unsigned int i) const
    {
      return i > steps.size();
    }

    /** Return the pieces of the wall from below, and then the rings. */
    BodyPart
    part(const unsigned int i, const BodyPart &plain) const;

    /** Return the piece of the wall at the top. */
    BodyPart
    uppermost(const BodyPart &plain) const
    {
      return piece(steps.size(), plain);
    }

    /** Add the lengths, with their names in run.json. */
    void
    add_dimensions(NamedNumbers &dimensions) const;

  private:
    enum class Flush
    {
      outer,
      inner
    };
    /** Units: m. */
    struct Ring
    {
      double place, width, height; // place: of the lower face above the tip
    };

    BodyPart
    piece(const unsigned int i, const BodyPart &plain) const;
    BodyPart
    ring(const Ring &r, const BodyPart &plain) const;
    void
    check_steps(const BodyPart &plain,
                const double    low,
                const double    high) const;
    void
    check_ring(const unsigned int i,
               const BodyPart    &plain,
               const double       low,
               const double       high) const;

    std::string                            steps_text, rings_text;
    Flush                                  flush = Flush::outer;
    std::vector<std::pair<double, double>> listed, steps; // height, thickness
    std::vector<Ring>                      rings;
    double                                 at_tip = 0.; // thickness
  };
} // namespace CaissonMPM

#endif
