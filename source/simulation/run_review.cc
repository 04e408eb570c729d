// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/simulation/run_review.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  namespace
  {
    // A change counts if it takes less than this way, in widths of the tip, and
    // each stretch is this part of that way: single records scatter.
    constexpr double short_way = .5, parts_of_short_way = 8.;

    // Within so many widths of the start, or of an interface between layers,
    // forces change for a reason.
    constexpr double start_takes = 2., interface_takes = 8.;

    // Without a fault, falls are below 2 % of the tip force
    // (doc/limitations.md).
    constexpr double largest_fall = .05;

    // Clay that stays at the wall bears 0.93 of adhesion times area and more
    // from this depth on, in widths of the tip.
    constexpr double least_share_of_adhesion = .9, adhesion_from = 3.;

    // With 3 % lost, the tip force of prm/jack_coarse.prm is 6 % too large, and
    // with 6 to 18 % lost, 12 to 55 %. Waves of undrained water lose more,
    // which the force does not contain.
    constexpr double largest_lost_share = .03, largest_lost_undrained = .1;

    bool
    has_column(const Records &records, const std::string &name)
    {
      const auto names = records.names();
      return std::find(names.begin(), names.end(), name) != names.end();
    }

    /** Return a column, zeros where there is none. [n_records] */
    Series
    column(const Records &records, const std::string &name)
    {
      if (has_column(records, name))
        return records.series(name);
      Series none = records.series("penetration_m");
      std::fill(none.value.begin(), none.value.end(), 0.);
      return none;
    }

    bool
    have_same_speed(const RunReview::Stretch &a, const RunReview::Stretch &b)
    {
      constexpr double tolerance = .1;
      return std::abs(a.speed - b.speed) <= tolerance * a.speed;
    }

    /** Adds up what becomes the mean of a stretch. */
    class Mean
    {
    public:
      void
      add(const RunReview::Stretch &s)
      {
        sum.penetration += s.penetration;
        sum.tip += s.tip;
        for (unsigned int wall = 0; wall < 2; ++wall)
          sum.friction[wall] += s.friction[wall];
        sum.suction += s.suction;
        sum.speed += s.speed;
        ++n;
      }

      RunReview::Stretch
      value() const
      {
        return {sum.penetration / n,
                sum.tip / n,
                sum.suction / n,
                sum.speed / n,
                {{sum.friction[0] / n, sum.friction[1] / n}}};
      }

    private:
      RunReview::Stretch sum;
      double             n = 0.;
    };

    /** Return the way down, until the body is first pulled up, in stretches of
     * this length, or of the distance of the records, if that is larger. */
    std::vector<RunReview::Stretch>
    find_way(const Records &records, const double length)
    {
      const Series penetration = column(records, "penetration_m"),
                   tip         = column(records, "tip_force_N"),
                   suction     = column(records, "suction_Pa"),
                   inner       = column(records, "inner_friction_N"),
                   outer       = column(records, "outer_friction_N");
      std::vector<RunReview::Stretch> way;
      Mean                            mean;
      double                          deepest = 0., begin = 0.;
      // A record holds the mean since the one before.
      for (std::size_t i = 1; i < penetration.value.size(); ++i)
        {
          const double moved  = penetration.value[i] - penetration.value[i - 1],
                       passed = penetration.time[i] - penetration.time[i - 1],
                       middle = penetration.value[i] - .5 * moved;
          if (moved < 0.)
            break;
          if (moved == 0. || passed <= 0.)
            continue;
          if (deepest == 0.)
            begin = middle;
          else if (middle >= begin + length)
            {
              way.push_back(mean.value());
              mean  = Mean();
              begin = middle;
            }
          deepest = middle;
          mean.add({middle,
                    tip.value[i],
                    suction.value[i],
                    moved / passed,
                    {{inner.value[i], outer.value[i]}}});
        }
      if (deepest > 0.)
        way.push_back(mean.value());
      return way;
    }
  } // namespace

  std::optional<KineticShare>
  find_kinetic_share(const std::vector<double> &penetration,
                     const std::vector<double> &force,
                     const std::vector<double> &kinetic_energy,
                     const std::vector<double> &work,
                     const double               start)
  {
    constexpr double part = .1;
    if (penetration.empty())
      return {};
    const bool is_pulled    = penetration.back() < penetration.front();
    double     largest_work = 0.;
    for (const double w : work)
      largest_work = std::max(largest_work, std::abs(w));
    std::optional<KineticShare> result;
    bool                        has_decayed = false;
    for (std::size_t i = 0; i < penetration.size(); ++i)
      if (work[i] != 0. && (is_pulled ? force[i] < 0. && std::abs(work[i]) >
                                                           part * largest_work :
                                        penetration[i] >= start))
        {
          const double share =
            std::max(kinetic_energy[i], 0.) / std::abs(work[i]);
          if (!has_decayed || share > result->share)
            result = {share, penetration[i]};
          has_decayed |= share <= KineticShare::allowed;
        }
    return result;
  }

  std::optional<KineticShare>
  kinetic_share_of(const RecordedParts &parts, const Records &records)
  {
    const double width = parts.body.shape().width_of_tip();
    if (width == 0.)
      return {};
    std::vector<double>       work = column(records, "external_work_J").value;
    const std::vector<double> on_water = column(records, "water_work_J").value;
    for (std::size_t i = 0; i < work.size(); ++i)
      work[i] += on_water[i];
    const std::string with_water = "total_force_with_water_N";
    return find_kinetic_share(
      column(records, "penetration_m").value,
      column(records,
             has_column(records, with_water) ? with_water : "total_force_N")
        .value,
      column(records, "kinetic_energy_J").value,
      work,
      parts.body.shape().initial_depth() + start_takes * width);
  }

  RunReview::RunReview(const RecordedParts &parts, const Records &records)
    : parts(parts)
    , width(parts.body.shape().width_of_tip())
    , kinetic(kinetic_share_of(parts, records))
  {
    if (width > 0.)
      way = find_way(records, short_way * width / parts_of_short_way);
  }

  std::vector<std::string>
  RunReview::warnings() const
  {
    std::vector<std::string> result;
    for (const auto &warning :
         {fall_of_tip(), bare_wall(0), bare_wall(1), lost_work(), fast_soil()})
      if (warning)
        result.push_back(*warning);
    return result;
  }

  bool
  RunReview::is_at_interface(const double penetration) const
  {
    const auto heights = parts.soil.interfaces();
    return std::any_of(heights.begin(), heights.end(), [&](const double z) {
      return std::abs(penetration + z) <= interface_takes * width;
    });
  }

  RunReview::Change
  RunReview::largest(
    const std::function<double(const Stretch &, const Stretch &)> &change) const
  {
    Change       result;
    const double start =
      parts.body.shape().initial_depth() + start_takes * width;
    for (auto after = way.begin(); after != way.end(); ++after)
      if (after->penetration >= start && !is_at_interface(after->penetration))
        for (auto before = after; before != way.begin();)
          {
            --before;
            if (before->penetration <
                after->penetration - (1. + 1e-6) * short_way * width)
              break;
            const double share = change(*before, *after);
            if (share > result.share && have_same_speed(*before, *after))
              result = {share, after->penetration};
          }
    return result;
  }

  std::optional<std::string>
  RunReview::fall_of_tip() const
  {
    const Change fall =
      largest([](const Stretch &before, const Stretch &after) {
        // suction unloads the tip
        const bool pumps = before.suction > 0. || after.suction > 0.;
        return before.tip > 0. && !pumps ? 1. - after.tip / before.tip : 0.;
      });
    if (fall.share <= largest_fall)
      return {};
    return "the tip force falls by " + percent(fall.share, 2) +
           " within half of the width of the tip at a penetration of " +
           to_text(fall.penetration, 4) +
           " m, where no layer begins. Soil that is pushed aside steadily does "
           "not do that: the mesh or the points are too coarse there, and the "
           "curve is uncertain by as much. Set more Rigid body/Cells across "
           "the wall, or Material points/Split and merge = true, and compare: "
           "see doc/limitations.md, Snaps at the tip";
  }

  bool
  RunReview::has_cut_off() const
  {
    for (unsigned int i = 0; i < parts.soil.n_materials(); ++i)
      {
        const SoilMaterial         &m       = parts.soil.material(i);
        const std::optional<double> cut_off = m.law_value("Tension cut-off");
        if (cut_off && *cut_off > 0.)
          return true;
      }
    return false;
  }

  double
  RunReview::adhesion_down_to(const double depth, const unsigned int wall) const
  {
    const Soil        &soil    = parts.soil;
    const BodySurface &surface = parts.body.surface();
    const BodyShape   &shape   = parts.body.shape();
    double             sum     = 0.;
    for (unsigned int i = 0; i < soil.n_materials(); ++i)
      {
        const SoilMaterial &m = soil.material(i);
        const double        end =
          i + 1 < soil.n_materials() ? soil.material(i + 1).top_depth : depth;
        sum += m.wall_adhesion.value_or(
                 surface.adhesion[wall == 0 ? inner_wall : outer_wall]) *
               std::max(0., std::min(end, depth) - m.top_depth);
      }
    return 2. * pi * (wall == 0 ? shape.left() : shape.right()) * sum;
  }

  std::optional<std::string>
  RunReview::bare_wall(const unsigned int wall) const
  {
    if (!parts.grid.lines().axisymmetric() || !has_cut_off())
      return {};
    // the shape of the tip takes up to a width of the wall
    double borne = 0., due = 0.;
    for (const Stretch &s : way)
      if (s.penetration >= adhesion_from * width)
        {
          borne += s.friction[wall];
          due += adhesion_down_to(s.penetration - width, wall);
        }
    if (due <= 0. || borne >= least_share_of_adhesion * due)
      return {};
    return std::string("the friction on the ") +
           (wall == 0 ? "inner" : "outer") + " wall is " +
           percent(1. - borne / due, 2) +
           " below adhesion times area, in the mean over the way: the clay has "
           "come off part of the wall, where nothing presses it on, and "
           "adhesion acts only where it touches. Set Soil/Layer/Tension "
           "cut-off = 0, its default, if the clay stays at the wall, as "
           "saturated clay does until water enters the gap: see "
           "doc/limitations.md, I have clay";
  }

  std::optional<std::string>
  RunReview::fast_soil() const
  {
    if (!kinetic || kinetic->share <= KineticShare::allowed)
      return {};
    return "the kinetic energy of the soil is " + percent(kinetic->share, 2) +
           " of the work of the body at a penetration of " +
           to_text(kinetic->penetration, 4) + " m, more than " +
           percent(KineticShare::allowed, 2) +
           ": inertia is a part of the forces. Reduce Time/Inertia tolerance, "
           "Time/Mass scaling or Rigid body/Velocity, and compare: see "
           "doc/limitations.md, Start and velocity";
  }

  std::optional<std::string>
  RunReview::lost_work() const
  {
    const EnergyBalance &energy = parts.energy;
    // that of the force with water
    const double work    = energy.work_of_body + energy.work_on_water,
                 share   = energy.dissipation / work;
    const auto  &water   = parts.water->traits();
    const double allowed = water.follows_soil || water.bulk_modulus > 0. ?
                             largest_lost_undrained :
                             largest_lost_share;
    if (width == 0. || work <= 0. || share <= allowed)
      return {};
    return "the transfer between points and nodes has lost " +
           percent(share, 2) +
           " of the work of the body. The force contains it, and has been "
           "seen too large by two to five times as much. Reduce Time/Mass scaling or Rigid "
           "body/Velocity, set finer cells where the stiffness changes, or a "
           "larger Method/FLIP fraction, and compare: see doc/limitations.md, "
           "Energy";
  }
} // namespace CaissonMPM
