// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The fields of a material point one by one, for code that treats all alike:
// kernels/point_fields.h lists them.
#ifndef caisson_mpm_domain_point_fields_h
#define caisson_mpm_domain_point_fields_h

#include <caisson_mpm/domain/material_point.h>
#include <caisson_mpm/kernels/layout.h>

#include <string>
#include <vector>

namespace CaissonMPM
{
  /** How a value of a point follows from those of two that become one. */
  enum class Merge
  {
    sum,
    by_mass,
    by_volume,
    smallest
  };

  /** Whether frames show a field. */
  enum class InFrames : bool
  {
    not_drawn,
    drawn
  };

  /** What is known of a field: one number of a point. */
  struct PointField
  {
    /** The vector or tensor that it is a component of, or its own name. */
    const char *owner;
    /** The component: "r", "zz", "0"; empty if it is none. */
    const char *component;
    const char *unit;
    Merge       merge;
    InFrames    in_frames;
    /** What it means, where the name does not say it. */
    const char *text;

    std::string
    name() const
    {
      return *component == 0 ? owner : owner + std::string("_") + component;
    }
  };

  namespace ComponentNames
  {
    constexpr const char *vector[]   = {"r", "z"};
    constexpr const char *tensor[]   = {"rr", "zz", "tt", "rz"};
    constexpr const char *numbered[] = {"0", "1", "2", "3", "4", "5", "6", "7"};
  } // namespace ComponentNames

  /**
   * Call action(field, in_block, in_point) for every field of a point.
   * in_block(block, history) is a reference to the eight values of a block,
   * in_point(point) one to the value of a point; both are const where their
   * arguments are.
   */
  template <typename Action>
  void
  for_each_field(const Action &action)
  {
#define CAISSON_CALL(owner, component, unit, merge, in_frames, text, place)   \
  action(                                                                   \
    PointField{                                                             \
      #owner, component, unit, Merge::merge, InFrames::in_frames, text},    \
    [=](auto &block, auto &history) -> auto & {                             \
      (void)history;                                                        \
      (void)block;                                                          \
      return CAISSON_BLOCK.place;                                           \
    },
#define CAISSON_PART(name, owner, i, unit, merge, in_frames, text)        \
  CAISSON_CALL(                                                           \
    owner, ComponentNames::vector[i], unit, merge, in_frames, text, name) \
  [](auto &point) -> auto &                                               \
  {                                                                       \
    return point.owner[i];                                                \
  });
#define CAISSON_LIST(name, n, names, unit, merge, in_frames, text)           \
  for (unsigned int i = 0; i < n; ++i)                                       \
    CAISSON_CALL(                                                            \
      name, ComponentNames::names[i], unit, merge, in_frames, text, name[i]) \
  [i](auto &point) -> auto &                                                 \
  {                                                                          \
    return point.name[i];                                                    \
  });
#define CAISSON_FIELD(name, unit, merge, in_frames, text)    \
  CAISSON_CALL(name, "", unit, merge, in_frames, text, name) \
  [](auto &point) -> auto &                                  \
  {                                                          \
    return point.name;                                       \
  });

#define CAISSON_BLOCK block
    CAISSON_BLOCK_FIELDS(CAISSON_PART, CAISSON_LIST, CAISSON_FIELD)
#undef CAISSON_BLOCK
#define CAISSON_BLOCK history
    CAISSON_HISTORY_FIELDS(CAISSON_PART, CAISSON_LIST, CAISSON_FIELD)
#undef CAISSON_BLOCK
#undef CAISSON_FIELD
#undef CAISSON_LIST
#undef CAISSON_PART
#undef CAISSON_CALL
  }

  /** Call action(field, value) for every field of a point. */
  template <typename Point, typename Action>
  void
  for_each_value(Point &point, const Action &action)
  {
    for_each_field(
      [&](const PointField &field, const auto &, const auto &in_point) {
        action(field, in_point(point));
      });
  }

  /** The number of fields: all doubles of the blocks. */
  constexpr unsigned int n_point_fields =
    (sizeof(Kernels::PointBlock) + sizeof(Kernels::PointHistory)) /
    sizeof(double[Kernels::block_size]);

  /** Append all numbers of a point to a list: its material, its fields, and
   * what a user's law keeps. */
  void
  append_numbers(const MaterialPoint &point, std::vector<double> &list);

  /** The number of numbers of a point, of which a user's law keeps some. */
  constexpr unsigned int
  n_numbers(const unsigned int n_user_state)
  {
    return 1 + n_point_fields + n_user_state;
  }

  /** The point of these numbers, in the order of append_numbers(). */
  MaterialPoint
  point_of_numbers(const double *numbers, const unsigned int n_user_state);

  /** Return one half of a point, from its middle to one side of it: -1 for the
   * lower and 1 for the upper half in the direction r or z. */
  MaterialPoint
  half_of(const MaterialPoint &point,
          const unsigned int   direction,
          const double         side);

  /** Return the one point that two points make that lie side by side in a
   * direction. */
  MaterialPoint
  one_of(const MaterialPoint &a,
         const MaterialPoint &b,
         const unsigned int   direction);
} // namespace CaissonMPM

#endif
