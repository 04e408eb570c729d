// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/domain/point_fields.h>

#include <algorithm>

namespace CaissonMPM
{
  static_assert(sizeof(MaterialPoint) == (n_point_fields + 1) * sizeof(double) +
                                           sizeof(std::vector<double>),
                "a MaterialPoint holds its fields and its material");

  void
  append_numbers(const MaterialPoint &point, std::vector<double> &list)
  {
    list.push_back(point.material);
    for_each_value(point, [&](const PointField &, const double value) {
      list.push_back(value);
    });
    list.insert(list.end(), point.user_state.begin(), point.user_state.end());
  }

  MaterialPoint
  point_of_numbers(const double *numbers, const unsigned int n_user_state)
  {
    MaterialPoint point;
    // a damaged file may contain anything
    const double material = *numbers++;
    point.material        = material >= 0. && material < 4294967296. ?
                              static_cast<unsigned int>(material) :
                              0u;
    for_each_value(point, [&](const PointField &, double &value) {
      value = *numbers++;
    });
    point.user_state.assign(numbers, numbers + n_user_state);
    return point;
  }

  MaterialPoint
  half_of(const MaterialPoint &point,
          const unsigned int   direction,
          const double         side)
  {
    MaterialPoint half  = point;
    const double  shift = .25 * side * point.size[direction];
    half.position[direction] += shift;
    half.initial_position[direction] += shift;
    half.size[direction] *= .5;
    for_each_value(half, [](const PointField &field, double &value) {
      if (field.merge == Merge::sum)
        value *= .5;
    });
    return half;
  }

  MaterialPoint
  one_of(const MaterialPoint &a,
         const MaterialPoint &b,
         const unsigned int   direction)
  {
    const double by_mass   = b.mass / (a.mass + b.mass),
                 by_volume = b.volume / (a.volume + b.volume);
    MaterialPoint result   = a;
    for_each_field(
      [&](const PointField &field, const auto &, const auto &in_point) {
        double      &x = in_point(result);
        const double y = in_point(b);
        switch (field.merge)
          {
            case Merge::sum:
              x += y;
              break;
            case Merge::by_mass:
              x += by_mass * (y - x);
              break;
            case Merge::by_volume:
              x += by_volume * (y - x);
              break;
            case Merge::smallest:
              x = std::min(x, y);
              break;
          }
      });
    for (std::size_t i = 0; i < result.user_state.size(); ++i)
      result.user_state[i] += by_mass * (b.user_state[i] - a.user_state[i]);
    result.size[direction] = a.size[direction] + b.size[direction];
    return result;
  }
} // namespace CaissonMPM
