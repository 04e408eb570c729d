// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A motion that is prescribed as a velocity over time.
#ifndef caisson_mpm_bodies_prescribed_motion_h
#define caisson_mpm_bodies_prescribed_motion_h

#include <caisson_mpm/bodies/body_motion.h>

#include <utility>
#include <vector>

namespace CaissonMPM
{
  /** The velocity is piecewise linear in time; the travel is its exact
   * integral. Any force is ignored. Where the motion is slowed down, the times
   * of the table grow by the factor by which its velocities fall, so that the
   * body passes the same places. */
  class PrescribedMotion : public BodyMotion
  {
  public:
    PrescribedMotion();

    /** Return the velocity of the entries, before it is slowed down. */
    double
    usual_velocity() const override;

    std::optional<double>
    largest_mach_number() const override
    {
      return mach_number;
    }

    void
    slow_down(const double factor) override;

    void
    check_parameters() const override;

    void
    name_unused_entries(ParameterOrigins &origins) const override;

    void
    begin_at(const InitialMotion &start) override;

    void
    start() override;

    std::optional<double>
    time_of_travel(const double travel) const override;

    std::optional<std::pair<double, double>>
    travel_range(const double time) const override;

    /** Return the velocity at any time. Units: m/s. */
    double
    velocity_at(const double time) const;

    /** Return the travel at any time, with that at the beginning. Units: m. */
    double
    travel_at(const double time) const;

  protected:
    void
    move(const double dt, const double force) override;

  private:
    void
    fill_table();
    /** The times up to @p end between which the travel is monotone. */
    std::vector<double>
    turning_times(const double end) const;

    double                constant_velocity = 0.1;
    double                ramp_time         = 0.;
    std::string           table_text;
    std::optional<double> mach_number;
    double                slowness = 1.; // by which the table is slowed down

    /** (t, v), linear in between, constant at both ends. */
    std::vector<std::pair<double, double>> velocity_table = {{0., 0.1}};
  };
} // namespace CaissonMPM

#endif
