// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/output/largest_pull.h>
#include <caisson_mpm/output/run_results.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace CaissonMPM
{
  namespace
  {
    constexpr double window = .2, interval = .5, rounding = 1e-9; // m

    /** The records that are deeper than all before them. */
    class WayDown
    {
    public:
      explicit WayDown(const Records &records)
        : records(records)
        , names(records.names())
      {
        const auto at = records.series("penetration_m").value;
        for (std::size_t i = 1; i < at.size(); ++i)
          if (at[i] > (depth.empty() ? at.front() : depth.back()))
            {
              depth.push_back(at[i]);
              rows.push_back(i);
            }
      }

      bool
      has(const std::string &name) const
      {
        return std::find(names.begin(), names.end(), name) != names.end();
      }

      /** A column. [n_rows] */
      std::vector<double>
      column(const std::string &name) const
      {
        const auto          all = records.series(name).value;
        std::vector<double> result;
        for (const std::size_t i : rows)
          result.push_back(all[i]);
        return result;
      }

      /** The mean about a depth, near the ends over as much as fits. */
      double
      mean(const std::vector<double> &values, const double at) const
      {
        const double half =
          std::min({.5 * window, at - depth.front(), depth.back() - at}) +
          rounding;
        double       sum = 0.;
        unsigned int n   = 0;
        for (std::size_t i = 0; i < depth.size(); ++i)
          if (std::abs(depth[i] - at) <= half)
            {
              sum += values[i];
              ++n;
            }
        return n > 0 ? sum / n : between(values, at);
      }

      /** Each half meter, and the end. */
      std::vector<double>
      round_depths() const
      {
        std::vector<double> result;
        for (double i = std::ceil(depth.front() / interval - rounding);
             i * interval <= depth.back() + rounding;
             ++i)
          result.push_back(i * interval);
        if (result.empty() || result.back() < depth.back() - 1e-3)
          result.push_back(depth.back());
        result.back() = std::min(result.back(), depth.back());
        return result;
      }

      std::vector<double> depth; // [n_rows], m

    private:
      double
      between(const std::vector<double> &values, const double at) const
      {
        const std::size_t i = std::clamp<std::size_t>(
          std::upper_bound(depth.begin(), depth.end(), at) - depth.begin(),
          1,
          depth.size() - 1);
        const double share = (at - depth[i - 1]) / (depth[i] - depth[i - 1]);
        return values[i - 1] +
               std::clamp(share, 0., 1.) * (values[i] - values[i - 1]);
      }

      const Records                 &records;
      const std::vector<std::string> names;
      std::vector<std::size_t>       rows;
    };

    std::vector<double>
    combined(const std::vector<double>                   &a,
             const std::vector<double>                   &b,
             const std::function<double(double, double)> &operation)
    {
      std::vector<double> result(a.size());
      std::transform(a.begin(), a.end(), b.begin(), result.begin(), operation);
      return result;
    }

    /** The larger exit gradient over the critical one. [n_rows] */
    std::vector<double>
    gradient_ratio(const WayDown &way)
    {
      const auto larger =
        combined(way.column("exit_gradient_wall"),
                 way.column("exit_gradient_axis"),
                 [](const double a, const double b) { return std::max(a, b); });
      return combined(larger,
                      way.column("critical_gradient"),
                      [](const double a, const double b) {
                        return b > 0. ? std::max(a, 0.) / b : 0.;
                      });
    }

    /** What is free below the lid. [n_rows], m */
    std::vector<double>
    room_below_lid(const WayDown &way, const double skirt_length)
    {
      return combined(way.depth,
                      way.column("plug_heave_m"),
                      [=](const double penetration, const double heave) {
                        return skirt_length - penetration - heave;
                      });
    }

    using Columns = std::vector<std::pair<std::string, std::vector<double>>>;

    Columns
    columns_of(const WayDown &way, const ResultLimits &limits)
    {
      Columns result;
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
        if (way.has(name))
          result.emplace_back(name, way.column(name));
      if (!way.has("required_suction_Pa"))
        return result;
      result.emplace_back("exit_gradient_over_critical", gradient_ratio(way));
      if (limits.skirt_length)
        result.emplace_back("room_below_lid_m",
                            room_below_lid(way, *limits.skirt_length));
      return result;
    }

    Json::Members
    at_depth(const WayDown  &way,
             const Columns  &columns,
             const ErrorBar &error_bar,
             const double    depth)
    {
      Json::Members result = {{"penetration_m", Json::number(depth)}};
      for (const auto &[name, values] : columns)
        {
          const double value = way.mean(values, depth);
          result.emplace_back(name, Json::number(value));
          for (const auto &[bound, number] :
               error_bar.bounds(name, depth, value))
            result.emplace_back(bound, Json::number(number));
        }
      return result;
    }

    /** The largest value of a column, and where. */
    std::string
    largest(const WayDown             &way,
            const std::string         &name,
            const std::vector<double> &values)
    {
      const auto most = std::max_element(values.begin(), values.end());
      return Json::flat_object(
        {{name, Json::number(*most)},
         {"penetration_m", Json::number(way.depth[most - values.begin()])}});
    }

    /** 1 less the largest ratio of a value to its limit, and where. */
    std::string
    margin(const WayDown &way, const std::vector<double> &ratios)
    {
      const auto most = std::max_element(ratios.begin(), ratios.end());
      return Json::flat_object(
        {{"least", Json::number(1. - *most)},
         {"penetration_m", Json::number(way.depth[most - ratios.begin()])}});
    }

    Json::Members
    margins(const WayDown &way, const ResultLimits &limits)
    {
      const auto required = way.column("required_suction_Pa");
      const auto ratio    = [](const double a, const double b) {
        return b > 0. ? std::max(a, 0.) / b : 1.;
      };
      Json::Members result = {
        {"piping", margin(way, gradient_ratio(way))},
        {"boiling",
         margin(
           way,
           combined(required, way.column("cavitation_suction_Pa"), ratio))}};
      if (limits.pump)
        result.emplace_back("pump",
                            margin(way,
                                   combined(required,
                                            std::vector<double>(required.size(),
                                                                *limits.pump),
                                            ratio)));
      if (limits.skirt_length)
        {
          const auto room = room_below_lid(way, *limits.skirt_length);
          result.emplace_back("room_below_lid_m",
                              Json::number(
                                *std::min_element(room.begin(), room.end())));
        }
      return result;
    }
  } // namespace

  std::optional<double>
  self_weight_penetration(const Records &records)
  {
    const auto names = records.names();
    if (std::find(names.begin(), names.end(), "required_suction_Pa") ==
        names.end())
      return {};
    const auto suction = records.series("suction_Pa").value,
               depth   = records.series("penetration_m").value;
    for (std::size_t i = suction.size() - 1; i > 0; --i)
      if (suction[i] <= 0.)
        return i + 1 < suction.size() ? std::optional<double>(depth[i]) :
                                        std::nullopt;
    return {};
  }

  namespace
  {
    Json::Members
    of_way_down(const WayDown      &way,
                const Records      &records,
                const ErrorBar     &error_bar,
                const ResultLimits &limits)
    {
      const Columns columns = columns_of(way, limits);
      std::string   rows;
      for (const double depth : way.round_depths())
        rows += (rows.empty() ? "\n      " : ",\n      ") +
                Json::flat_object(at_depth(way, columns, error_bar, depth));
      const std::string total = way.has("total_force_with_water_N") ?
                                  "total_force_with_water_N" :
                                  "total_force_N";
      Json::Members result = {{"penetration_m", Json::number(way.depth.back())},
                              {"largest_force",
                               largest(way, total, way.column(total))}};
      if (way.has("required_suction_Pa"))
        {
          if (const auto depth = self_weight_penetration(records))
            result.emplace_back("rest_penetration_m", Json::number(*depth));
          result.emplace_back("largest_suction",
                              largest(way,
                                      "required_suction_Pa",
                                      way.column("required_suction_Pa")));
          result.emplace_back("margins", Json::object(margins(way, limits), 4));
        }
      result.emplace_back("at_depths", "[" + rows + "\n    ]");
      return result;
    }
  } // namespace

  Json::Members
  run_results(const Records      &records,
              const ErrorBar     &error_bar,
              const ResultLimits &limits)
  {
    const WayDown way(records);
    Json::Members result;
    if (!way.has("total_force_N"))
      return result;
    if (way.depth.size() >= 2)
      result = of_way_down(way, records, error_bar, limits);
    if (const auto pull = largest_pull(records))
      result.emplace_back("largest_pull", Json::flat_object(pull->json()));
    return result;
  }
} // namespace CaissonMPM
