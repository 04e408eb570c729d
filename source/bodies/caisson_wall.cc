// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/base/time_table.h>
#include <caisson_mpm/bodies/caisson_wall.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    constexpr double near = 1e-6; // m

    std::string
    meters(const double x)
    {
      return to_text(x) + " m";
    }
  } // namespace

  void
  CaissonWall::declare(Section &caisson)
  {
    const Patterns::Double positive(1e-9);
    caisson.add_parameter(
      "Wall steps",
      steps_text,
      "m : m",
      "Pairs height : thickness, separated by commas and from below, give the "
      "thickness of a caisson's wall above this height over the tip; below the "
      "first one it is Wall thickness.",
      Patterns::List(Patterns::List(positive, 2, 2, ":"), 0, 20));
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
      Patterns::List(Patterns::List(positive, 3, 3, ":"), 0, 20));
  }

  void
  CaissonWall::read(const double thickness)
  {
    at_tip = thickness;
    listed = parse_time_table(steps_text);
    steps.clear();
    for (const auto &step : listed)
      if (step.second != (steps.empty() ? thickness : steps.back().second))
        steps.push_back(step);
    rings.clear();
    for (const std::string &text : Utilities::split_string_list(rings_text))
      {
        const auto x =
          Utilities::string_to_double(Utilities::split_string_list(text, ":"));
        rings.push_back({x[0], x[1], x[2]});
      }
  }

  bool
  CaissonWall::has_ledges() const
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

  BodyPart
  CaissonWall::piece(const unsigned int i, const BodyPart &plain) const
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
  CaissonWall::ring(const Ring &r, const BodyPart &plain) const
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

  BodyPart
  CaissonWall::part(const unsigned int i, const BodyPart &plain) const
  {
    return i <= steps.size() ? piece(i, plain) :
                               ring(rings[i - steps.size() - 1], plain);
  }

  void
  CaissonWall::check(const BodyPart &plain,
                     const double    tip_height,
                     const double    length) const
  {
    check_steps(plain, tip_height, length);
    for (unsigned int i = 0; i < rings.size(); ++i)
      check_ring(i, plain, tip_height, length);
  }

  void
  CaissonWall::check_steps(const BodyPart &plain,
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
  CaissonWall::check_ring(const unsigned int i,
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

  void
  CaissonWall::add_dimensions(NamedNumbers &dimensions) const
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
} // namespace CaissonMPM
