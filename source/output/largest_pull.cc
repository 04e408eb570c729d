// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/output/largest_pull.h>

#include <algorithm>
#include <vector>

namespace CaissonMPM
{
  namespace
  {
    /** Records of a body that rises: from the one before it rises to the last
     * one, and the one with the largest pull. */
    struct WayUp
    {
      std::size_t begin = 0, end = 0, most = 0;
      double      pull = 0.; // a median about it, N

      /** By how much a column has grown up to the largest pull. */
      double
      growth(const std::vector<double> &values) const
      {
        return values[most] - values[begin];
      }
    };

    /** Each pull of a way up as the lower median over it and two records on
     * either side, one where there are few, as in cycles: a single jump does
     * not count. [n_records] */
    std::vector<double>
    medians(const std::vector<double> &pull,
            const std::size_t          begin,
            const std::size_t          end)
    {
      constexpr std::size_t few    = 25;
      const std::size_t     beside = end - begin < few ? 1 : 2;
      std::vector<double>   result = pull;
      for (std::size_t i = begin + 1; i <= end; ++i)
        {
          const std::size_t first = i > begin + beside ? i - beside : begin + 1,
                            last  = std::min(i + beside, end);
          std::vector<double> window(pull.begin() + first,
                                     pull.begin() + last + 1);
          const auto          middle = window.begin() + (window.size() - 1) / 2;
          std::nth_element(window.begin(), middle, window.end());
          result[i] = *middle;
        }
      return result;
    }

    /** Replace the pulls of each way up by their medians, and return the way
     * with the largest of them; nothing where nothing pulls. */
    std::optional<WayUp>
    way_of_largest(std::vector<double> &pull, const std::vector<double> &depth)
    {
      std::optional<WayUp> best;
      for (std::size_t begin = 0; begin + 1 < depth.size();)
        {
          std::size_t end = begin;
          while (end + 1 < depth.size() && depth[end + 1] < depth[end])
            ++end;
          pull = medians(pull, begin, end);
          for (std::size_t i = begin + 1; i <= end; ++i)
            if (pull[i] > (best ? best->pull : 0.))
              best = {begin, end, i, pull[i]};
          begin = std::max(end, begin + 1);
        }
      return best;
    }

    /** Whether friction is mobilized, and the pull does not increase: the body
     * has risen further by a fifth, or bore nearly as much before. */
    bool
    is_capacity(const WayUp               &way,
                const std::vector<double> &pull,
                const std::vector<double> &depth)
    {
      constexpr double rise_of_friction = 5e-3; // m, that mobilizes it
      constexpr double further = .2, before = .7, nearly = .93;
      const double     rise    = -way.growth(depth),
                   rise_to_end = depth[way.begin] - depth[way.end];
      if (rise_to_end < rise_of_friction)
        return false;
      if (rise_to_end - rise > std::max(further * rise, rise_of_friction))
        return true;
      double most_before = 0.;
      for (std::size_t i = way.begin + 1;
           depth[way.begin] - depth[i] <= before * rise;
           ++i)
        most_before = std::max(most_before, pull[i]);
      return rise >= rise_of_friction && most_before > nearly * way.pull;
    }

    /** How a caisson with a sealed lid fails, by what has filled the space
     * beneath it: volumes in m3. */
    std::string
    mechanism(const double plug,
              const double seepage,
              const double leak,
              const double expansion)
    {
      const double most = std::max({plug, seepage, leak, expansion});
      if (most == plug)
        return "reverse bearing: the plug rises with the caisson";
      return "partly drained: passive suction, and " +
             std::string(most == seepage ? "water flows in through the plug" :
                         most == leak    ? "water flows in through the leak" :
                                           "what is beneath the lid expands");
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
    const std::string   force = has("total_force_with_water_N") ?
                                  "total_force_with_water_N" :
                                  "total_force_N";
    std::vector<double> pull  = column(force);
    for (double &value : pull)
      value = -value;
    const auto depth = column("penetration_m");
    const auto way   = way_of_largest(pull, depth);
    if (!way)
      return {};
    const std::size_t most = way->most;
    LargestPull       result;
    result.rise        = -way->growth(depth);
    result.pull        = -column(force)[most];
    result.penetration = depth[most];
    result.water       = result.pull + column("total_force_N")[most];
    result.outer       = -column("outer_friction_N")[most];
    result.inner       = -column("inner_friction_N")[most];
    result.tip         = -column("tip_force_N")[most];
    result.is_capacity = CaissonMPM::is_capacity(*way, pull, depth);
    if (!has("lid_growth_m3"))
      return result;
    const auto volume = [&](const std::string &name) {
      return way->growth(column(name));
    };
    const double plug       = volume("plug_rise_m3");
    result.plug_follows     = plug / volume("lid_growth_m3");
    constexpr double little = .1;
    if (result.is_capacity)
      result.mechanism = column("lid_cavity_m3")[most] > 0. ?
                           "cavitation beneath the lid" :
                         result.water < little * result.pull ?
                           "drained: friction on both walls" :
                           mechanism(plug,
                                     volume("seepage_volume_m3"),
                                     volume("lid_leak_m3"),
                                     volume("lid_expansion_m3"));
    return result;
  }
} // namespace CaissonMPM
