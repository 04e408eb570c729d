// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/output/largest_pull.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace CaissonMPM
{
  namespace
  {
    /** How a caisson with a sealed lid fails, by what bears it and by how far
     * the plug has followed. */
    std::string
    mechanism(const double share_of_water,
              const double share_that_plug_follows,
              const bool   boils)
    {
      constexpr double little = .1, half = .5;
      if (boils)
        return "cavitation beneath the lid";
      if (share_of_water < little)
        return "drained: friction on both walls";
      if (share_that_plug_follows < half)
        return "partly drained: passive suction, and water flows in through the "
               "plug";
      return "reverse bearing: the plug rises with the caisson";
    }

    /** The record in which the median of the pull over this and two records on
     * either side is largest; nothing where nothing pulls. */
    std::optional<std::size_t>
    record_of_largest(const std::vector<double> &pull)
    {
      constexpr std::size_t      beside = 2;
      std::optional<std::size_t> best;
      for (std::size_t i = beside; i + beside < pull.size(); ++i)
        {
          std::array<std::size_t, 2 * beside + 1> window;
          std::iota(window.begin(), window.end(), i - beside);
          std::nth_element(window.begin(),
                           window.begin() + beside,
                           window.end(),
                           [&](const std::size_t a, const std::size_t b) {
                             return pull[a] < pull[b];
                           });
          if (pull[window[beside]] > (best ? pull[*best] : 0.))
            best = window[beside];
        }
      return best;
    }

    /** The records over which a body rises, of which one has the largest
     * pull. */
    struct WayUp
    {
      std::size_t begin, most, end; // the last one, too

      WayUp(const std::vector<double> &depth, const std::size_t most)
        : begin(most)
        , most(most)
        , end(most)
      {
        while (begin > 0 && depth[begin - 1] >= depth[begin])
          --begin;
        while (end + 1 < depth.size() && depth[end + 1] <= depth[end])
          ++end;
      }

      /** By how much a column has grown up to the largest pull. */
      double
      growth(const std::vector<double> &values) const
      {
        return values[most] - values[begin];
      }
    };

    bool
    is_capacity(const WayUp               &way,
                const std::vector<double> &pull,
                const std::vector<double> &depth)
    {
      constexpr double fallen = .98, last_fifth = .8, constant = .95;
      constexpr double rise_of_friction = 5e-3; // m, that mobilizes it
      const double     most = pull[way.most], rise = -way.growth(depth);
      if (*std::min_element(pull.begin() + way.most,
                            pull.begin() + way.end + 1) < fallen * most)
        return true;
      if (rise < rise_of_friction)
        return false;
      std::size_t i = way.begin;
      while (depth[way.begin] - depth[i] < last_fifth * rise)
        ++i;
      return pull[i] > constant * most;
    }
  } // namespace

  Json::Members
  LargestPull::json() const
  {
    Json::Members result = {{"pull_N", Json::number(pull)},
                            {"penetration_m", Json::number(penetration)},
                            {"rise_m", Json::number(rise)},
                            {"water_N", Json::number(water)},
                            {"outer_friction_N", Json::number(outer)},
                            {"inner_friction_N", Json::number(inner)},
                            {"tip_N", Json::number(tip)},
                            {"is_capacity", is_capacity ? "true" : "false"}};
    if (plug_follows)
      result.emplace_back("plug_follows", Json::number(*plug_follows));
    if (!mechanism.empty())
      result.emplace_back("mechanism", Json::text(mechanism));
    return result;
  }

  std::optional<LargestPull>
  largest_pull(const Records &records)
  {
    const auto names = records.names();
    const auto has   = [&](const std::string &name) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    const auto column = [&](const std::string &name) {
      return records.series(name).value;
    };
    const std::string   with_water = "total_force_with_water_N";
    std::vector<double> pull =
      column(has(with_water) ? with_water : "total_force_N");
    for (double &value : pull)
      value = -value;
    const auto most = record_of_largest(pull);
    if (!most)
      return {};
    const auto  depth = column("penetration_m");
    const WayUp way(depth, *most);
    LargestPull result;
    result.rise = -way.growth(depth);
    if (result.rise <= 0.)
      return {};
    result.pull        = pull[*most];
    result.penetration = depth[*most];
    result.water       = result.pull + column("total_force_N")[*most];
    result.outer       = -column("outer_friction_N")[*most];
    result.inner       = -column("inner_friction_N")[*most];
    result.tip         = -column("tip_force_N")[*most];
    result.is_capacity = CaissonMPM::is_capacity(way, pull, depth);
    if (!has("lid_growth_m3"))
      return result;
    result.plug_follows =
      way.growth(column("plug_rise_m3")) / way.growth(column("lid_growth_m3"));
    if (result.is_capacity)
      result.mechanism = mechanism(result.water / result.pull,
                                   *result.plug_follows,
                                   column("lid_cavity_m3")[*most] > 0.);
    return result;
  }
} // namespace CaissonMPM
