// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the results of a run say against it.
#ifndef caisson_mpm_simulation_run_review_h
#define caisson_mpm_simulation_run_review_h

#include <caisson_mpm/output/records.h>
#include <caisson_mpm/simulation/recorded_parts.h>

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * Looks at the records of a run for signs of a numerical fault: a tip force
   * that falls suddenly, a wall from which clay has come off, and work that
   * the transfer between points and nodes loses. On the rank that has the
   * records; not collective.
   */
  class RunReview
  {
  public:
    RunReview(const RecordedParts &parts, const Records &records);

    /** Return a warning for each fault that is seen. */
    std::vector<std::string>
    warnings() const;

    /** What a stretch of the way into the soil shows, as means. */
    struct Stretch
    {
      double                penetration = 0.;         // m
      double                tip         = 0.;         // N
      double                suction     = 0.;         // beneath the lid, Pa
      double                speed       = 0.;         // m/s
      std::array<double, 2> friction    = {{0., 0.}}; // inner, outer wall, N
    };

  private:
    /** A change over a short way, relative to what was there before. */
    struct Change
    {
      double share       = 0.;
      double penetration = 0.; // m
    };

    /** Return the largest change from one stretch to a later one, where no
     * layer begins or ends. */
    Change
    largest(const std::function<double(const Stretch &before,
                                       const Stretch &after)> &change) const;

    /** Whether the soil at the tip changes near a penetration. */
    bool
    is_at_interface(const double penetration) const;

    std::optional<std::string>
    fall_of_tip() const;
    std::optional<std::string>
    bare_wall(const unsigned int wall) const;
    std::optional<std::string>
    lost_work() const;

    /** Whether a layer has a tension cut-off, so that it may come off a wall.
     */
    bool
    has_cut_off() const;

    /** Return adhesion times area of a wall (0 inner, 1 outer) down to a depth
     * in m, for the whole circumference. Units: N. */
    double
    adhesion_down_to(const double depth, const unsigned int wall) const;

    const RecordedParts  parts;
    const double         width; // of the tip, m
    std::vector<Stretch> way;   // down, until the body is first pulled up
  };
} // namespace CaissonMPM

#endif
