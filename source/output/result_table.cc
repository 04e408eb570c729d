// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/output/result_table.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace CaissonMPM
{
  namespace
  {
    constexpr double widest = .2, part = .25; // of a window: m, of the way
    constexpr double rounding = 1e-9;         // m

    /** The records of a way. */
    std::vector<std::size_t>
    rows_of_way(const std::vector<double>   &depth,
                const ResultTable::Direction direction)
    {
      const bool        down = direction == ResultTable::Direction::down;
      const std::size_t begin =
        down ? 0 : std::max_element(depth.begin(), depth.end()) - depth.begin();
      std::vector<std::size_t> rows;
      double                   last = depth.empty() ? 0. : depth[begin];
      for (std::size_t i = begin + 1; i < depth.size(); ++i)
        if (down ? depth[i] > last : depth[i] < last)
          {
            last = depth[i];
            rows.push_back(i);
          }
      return rows;
    }

    /** Where the straight line through neighboring records is at @p x. */
    double
    between(const std::vector<double> &position,
            const std::vector<double> &values,
            const double               x)
    {
      const std::size_t i = std::clamp<std::size_t>(
        std::upper_bound(position.begin(), position.end(), x) -
          position.begin(),
        1,
        position.size() - 1);
      const double share =
        (x - position[i - 1]) / (position[i] - position[i - 1]);
      return values[i - 1] +
             std::clamp(share, 0., 1.) * (values[i] - values[i - 1]);
    }
  } // namespace

  ResultTable::ResultTable(const Records      &records,
                           const Direction     direction,
                           const ResultLimits &limits)
    : sign(direction == Direction::down ? 1. : -1.)
  {
    const auto names   = records.names();
    const auto depth   = records.series("penetration_m").value;
    const auto rows    = rows_of_way(depth, direction);
    const auto of_rows = [&](const std::vector<double> &all) {
      std::vector<double> result;
      for (const std::size_t i : rows)
        result.push_back(all[i]);
      return result;
    };
    for (const double x : of_rows(depth))
      position.push_back(sign * x);
    for (const std::string name : {"tip_force_N",
                                   "inner_friction_N",
                                   "outer_friction_N",
                                   "total_force_N",
                                   "total_force_with_water_N",
                                   "suction_Pa",
                                   "required_suction_Pa",
                                   "cavitation_suction_Pa",
                                   "seepage_flow_m3_s",
                                   "plug_heave_m"})
      if (std::find(names.begin(), names.end(), name) != names.end())
        columns.emplace_back(name, of_rows(records.series(name).value));
    if (!has("required_suction_Pa"))
      return;
    add_lid(of_rows(records.series("exit_gradient_wall").value),
            of_rows(records.series("exit_gradient_axis").value),
            of_rows(records.series("critical_gradient").value),
            limits.skirt_length);
  }

  void
  ResultTable::add_lid(const std::vector<double>   &wall,
                       const std::vector<double>   &axis,
                       const std::vector<double>   &critical,
                       const std::optional<double> &skirt_length)
  {
    const std::vector<double> heave = values("plug_heave_m");
    std::vector<double>       ratio, room;
    for (std::size_t i = 0; i < heave.size(); ++i)
      {
        ratio.push_back(critical[i] > 0. ?
                          std::max({wall[i], axis[i], 0.}) / critical[i] :
                          0.);
        room.push_back(skirt_length.value_or(0.) - sign * position[i] -
                       heave[i]);
      }
    columns.emplace_back("exit_gradient_over_critical", ratio);
    if (skirt_length)
      columns.emplace_back("room_below_lid_m", room);
  }

  bool
  ResultTable::has(const std::string &name) const
  {
    return std::any_of(columns.begin(), columns.end(), [&](const auto &column) {
      return column.first == name;
    });
  }

  std::string
  ResultTable::total() const
  {
    const std::string with_water = "total_force_with_water_N";
    return has(with_water) ? with_water : "total_force_N";
  }

  const std::vector<double> &
  ResultTable::values(const std::string &name) const
  {
    const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const auto &column) {
        return column.first == name;
      });
    AssertThrow(found != columns.end(), dealii::ExcMessage("no " + name));
    return found->second;
  }

  double
  ResultTable::mean(const std::vector<double> &values, const double depth) const
  {
    const double front = position.front(), back = position.back(),
                 x      = std::clamp(sign * depth, front, back),
                 half   = .5 * std::min(widest, part * length()),
                 center = std::clamp(x, front + half, back - half);
    const auto edge     = [&](const double at) {
      return std::lower_bound(position.begin(), position.end(), at) -
             position.begin();
    };
    const std::size_t begin = edge(center - half - rounding),
                      end   = edge(center + half + rounding);
    if (end - begin < 3)
      return between(position, values, x);
    double mean_x = 0., mean = 0., xx = 0., xy = 0.;
    for (std::size_t i = begin; i < end; ++i)
      {
        mean_x += (position[i] - center) / (end - begin);
        mean += values[i] / (end - begin);
      }
    if (std::abs(x - center) < rounding)
      return mean;
    for (std::size_t i = begin; i < end; ++i)
      {
        const double dx = position[i] - center - mean_x;
        xx += dx * dx;
        xy += dx * values[i];
      }
    return mean + xy / xx * (x - center - mean_x);
  }

  NamedNumbers
  ResultTable::at(const double depth) const
  {
    NamedNumbers result;
    for (const auto &[name, values] : columns)
      result.emplace_back(name, mean(values, depth));
    return result;
  }

  std::vector<double>
  ResultTable::depths(const unsigned int most) const
  {
    const double        way  = length();
    double              step = .5; // m
    std::vector<double> result;
    if (way < 2. * step)
      step = std::pow(10., std::floor(std::log10(.5 * way)));
    while (way > most * step)
      step *= 2.;
    for (double i = std::floor(position.front() / step + 1e-6) + 1.;
         i * step <= position.back() + rounding;
         ++i)
      result.push_back(std::round(1e9 * sign * i * step) / 1e9);
    if (sign > 0. && (result.empty() || result.back() < end() - 2e-3 * step))
      result.push_back(end());
    return result;
  }

  double
  ResultTable::end() const
  {
    return sign * position.back();
  }

  ResultTable::Place
  ResultTable::largest(const std::vector<double> &values) const
  {
    std::vector<double> candidates = depths();
    for (const double x : position)
      candidates.push_back(sign * x);
    Place result{-std::numeric_limits<double>::infinity(), 0.};
    for (const double depth : candidates)
      if (const double value = mean(values, depth); value > result.value)
        result = {value, depth};
    return result;
  }
} // namespace CaissonMPM
