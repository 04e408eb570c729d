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
  /** The kinetic energy of the soil over the work of the body, where it is
   * largest. */
  struct KineticShare
  {
    double share       = 0.;
    double penetration = 0.; // m

    /** The largest share of a run whose forces are those of slow motion. */
    static constexpr double allowed = .01;
  };

  /**
   * Find it in the records of a run from the penetration @p start (m) on, once
   * the waves of the start have decayed: from the first record on that has no
   * more than is allowed, or in the last one if there is none. Of a body that
   * is pulled up, only the records with a pull count that have at least a tenth
   * of the largest work: soil springs up when the load on it goes. Nothing if
   * no record counts. All vectors: [n_records]; @p force on the soil, downward
   * (N); @p kinetic_energy and @p work (J).
   */
  std::optional<KineticShare>
  find_kinetic_share(const std::vector<double> &penetration,
                     const std::vector<double> &force,
                     const std::vector<double> &kinetic_energy,
                     const std::vector<double> &work,
                     const double               start);

  /** Find it in the records of a run, from two widths of the tip below the
   * start on; nothing without a body that has a tip. Not collective. */
  std::optional<KineticShare>
  kinetic_share_of(const RecordedParts &parts, const Records &records);

  /**
   * Looks at the records of a run for signs of a numerical fault: a tip force
   * that falls suddenly, a wall from which clay has come off, work that the
   * transfer between points and nodes loses, and soil that moves too fast. On
   * the rank that has the records; not collective.
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
    std::optional<std::string>
    fast_soil() const;

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
    const std::optional<KineticShare> kinetic;
  };
} // namespace CaissonMPM

#endif
