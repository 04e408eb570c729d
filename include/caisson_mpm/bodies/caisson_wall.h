// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the wall of a caisson has above its tip: another thickness from some
// height on, and rings inside.
#ifndef caisson_mpm_bodies_caisson_wall_h
#define caisson_mpm_bodies_caisson_wall_h

#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/base/time_table.h>
#include <caisson_mpm/bodies/body_shape.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

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
    declare(Section &caisson)
    {
      const dealii::Patterns::Double positive(1e-9);
      caisson.add_parameter(
        "Wall steps",
        steps_text,
        "m : m",
        "Pairs height : thickness, separated by commas and from below, give "
        "the thickness of a caisson's wall above this height over the tip; "
        "below the first one it is Wall thickness.",
        dealii::Patterns::List(dealii::Patterns::List(positive, 2, 2, ":"),
                               0,
                               20));
      add_choice(
        caisson,
        "Flush face",
        flush,
        {{"outer", Flush::outer}, {"inner", Flush::inner}},
        "",
        "The face of a caisson's wall that stays plane at the wall steps.");
      caisson.add_parameter(
        "Rings",
        rings_text,
        "m : m : m",
        "Triples place : width : height, separated by commas and from below, "
        "give the rings inside the wall of a caisson: the height of the lower "
        "face over the tip, the width towards the axis and the height of the "
        "ring.",
        dealii::Patterns::List(dealii::Patterns::List(positive, 3, 3, ":"),
                               0,
                               20));
    }

    /** Take the entries, with this thickness at the tip. */
    void
    read(const double thickness)
    {
      at_tip = thickness;
      listed = parse_time_table(steps_text);
      steps.clear();
      for (const auto &step : listed)
        if (step.second != (steps.empty() ? thickness : steps.back().second))
          steps.push_back(step);
      rings.clear();
      for (const std::string &text :
           dealii::Utilities::split_string_list(rings_text))
        {
          const auto x = dealii::Utilities::string_to_double(
            dealii::Utilities::split_string_list(text, ":"));
          rings.push_back({x[0], x[1], x[2]});
        }
    }

    /** Throw BadInput where steps and rings contradict each other or the wall
     * @p plain without them, on which they lie from @p tip_height to
     * @p length. */
    void
    check(const BodyPart &plain,
          const double    tip_height,
          const double    length) const
    {
      check_steps(plain, tip_height, length);
      for (unsigned int i = 0; i < rings.size(); ++i)
        check_ring(i, plain, tip_height, length);
    }

    bool
    has_steps() const
    {
      return !steps.empty();
    }

    /** Whether faces above the tip look down. */
    bool
    has_ledges() const
    {
      double below = at_tip;
      for (const auto &step : steps)
        {
          if (step.second > below)
            return true;
          below = step.second;
        }
      return !rings.empty();
    }

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
    part(const unsigned int i, const BodyPart &plain) const
    {
      return i <= steps.size() ? piece(i, plain) :
                                 ring(rings[i - steps.size() - 1], plain);
    }

    /** Return the piece of the wall at the top. */
    BodyPart
    uppermost(const BodyPart &plain) const
    {
      return piece(steps.size(), plain);
    }

    /** Add the lengths, with their names in run.json. */
    void
    add_dimensions(NamedNumbers &dimensions) const
    {
      const auto add = [&dimensions](const std::string &what,
                                     const std::size_t  number,
                                     const std::string &length,
                                     const double       value) {
        dimensions.emplace_back(what + "_" + to_text(number) + "_" + length +
                                  "_m",
                                value);
      };
      for (std::size_t i = 0; i < steps.size(); ++i)
        {
          add("wall_step", i + 1, "above_tip", steps[i].first);
          add("wall_step", i + 1, "thickness", steps[i].second);
        }
      for (std::size_t i = 0; i < rings.size(); ++i)
        {
          add("ring", i + 1, "above_tip", rings[i].place);
          add("ring", i + 1, "width", rings[i].width);
          add("ring", i + 1, "height", rings[i].height);
        }
    }

  private:
    static constexpr double near = 1e-6; // m

    static std::string
    meters(const double x)
    {
      return to_text(x) + " m";
    }

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
    piece(const unsigned int i, const BodyPart &plain) const
    {
      BodyPart result = plain;
      if (i > 0)
        {
          const auto &[height, thickness] = steps[i - 1];
          result.bottom                   = plain.bottom + height;
          if (flush == Flush::outer)
            result.left = plain.right - thickness;
          else
            result.right = plain.left + thickness;
        }
      if (i < steps.size())
        result.top = plain.bottom + steps[i].first;
      return result;
    }

    BodyPart
    ring(const Ring &r, const BodyPart &plain) const
    {
      unsigned int behind = 0;
      while (behind < steps.size() && steps[behind].first <= r.place)
        ++behind;
      const double wall = piece(behind, plain).left;
      return {wall - r.width,
              wall,
              plain.bottom + r.place,
              plain.bottom + r.place + r.height};
    }

    void
    check_steps(const BodyPart &plain,
                const double    low,
                const double    high) const
    {
      for (std::size_t i = 0; i < listed.size(); ++i)
        {
          const auto &[height, thickness] = listed[i];
          if (i > 0 && height <= listed[i - 1].first)
            throw BadInput("Rigid body/Wall steps: " + meters(height) +
                           " follows " + meters(listed[i - 1].first) +
                           ". List the steps from below.");
          if (height < low + near || height > high - near)
            throw BadInput("Rigid body/Wall steps: " + meters(height) +
                           " must lie between the tip, " + meters(low) +
                           " high, and the lid or the end of the wall at " +
                           meters(high) + ".");
          if (flush == Flush::outer && thickness >= plain.right)
            throw BadInput("Rigid body/Wall steps: a thickness of " +
                           meters(thickness) +
                           " leaves no soil plug within the "
                           "outer radius of " +
                           meters(plain.right) + ". Reduce it.");
        }
    }

    void
    check_ring(const unsigned int i,
               const BodyPart    &plain,
               const double       low,
               const double       high) const
    {
      const Ring       &own = rings[i];
      const double      top = own.place + own.height;
      const std::string entry =
        "Rigid body/Rings: the ring at " + meters(own.place);
      if (i > 0 && own.place <= rings[i - 1].place + rings[i - 1].height)
        throw BadInput(entry + " touches the one before it. List rings from "
                               "below, with a distance between them.");
      if (own.place < low + near || top > high - near)
        throw BadInput(entry + " must lie between the tip, " + meters(low) +
                       " high, and the lid or the end of the wall at " +
                       meters(high) + ".");
      if (ring(own, plain).left <= 0.)
        throw BadInput(entry + " is " + meters(own.width) +
                       " wide and leaves no opening. Reduce its width.");
      for (const auto &step : steps)
        if (step.first >= own.place && step.first <= top)
          throw BadInput(entry + " lies across the wall step at " +
                         meters(step.first) + ". Move one of them.");
    }

    std::string                            steps_text, rings_text;
    Flush                                  flush = Flush::outer;
    std::vector<std::pair<double, double>> listed, steps; // height, thickness
    std::vector<Ring>                      rings;
    double                                 at_tip = 0.; // thickness
  };
} // namespace CaissonMPM

#endif
