// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The motion of a rigid body along the direction of its shape.
#ifndef caisson_mpm_bodies_body_motion_h
#define caisson_mpm_bodies_body_motion_h

#include <caisson_mpm/base/run_totals.h>
#include <caisson_mpm/base/section.h>

#include <optional>
#include <string>
#include <utility>

namespace CaissonMPM
{
  /** What a motion depends on. */
  struct MotionTraits
  {
    bool follows_loads  = false; // so that the body can come to rest
    bool needs_force    = false; // on the body, summed over the ranks
    bool needs_response = false; // of the soil, which is known late in a step
  };

  /**
   * Where the body is and how fast it moves. A motion is a state, which each
   * step advances: its future is not known to anyone else. Only a motion that
   * is prescribed knows when the body will be where.
   *
   * A motion is one class in one file; it declares its own entries and has one
   * line in the list of rigid_body.cc. It is the same on all ranks; not
   * collective.
   */
  class BodyMotion : public Alternative
  {
  public:
    BodyMotion(const std::string  &name,
               const std::string  &description,
               const MotionTraits &traits = {})
      : Alternative("/Rigid body", Influence::motion, name, description)
      , traits(traits)
    {}

    const MotionTraits traits;

    /** What the soil does to the body in a step, as far as that depends on the
     * velocity of the body in this step alone. */
    struct Response
    {
      double force = 0.; // if the body kept its velocity, as in advance(); N
      double mass  = 0.; // of the soil that it would accelerate; kg
    };

    /** What the owner of the body sets before a step. */
    struct Surroundings
    {
      /** What presses the body in the direction of a positive travel besides
       * the soil: its submerged weight, and the suction. Units: N. */
      double load = 0.;
      /** Of the body. Units: kg. */
      double   mass = 0.;
      Response response; // where it is needed
    };

    Surroundings surroundings;

    /** How a motion begins: at rest where nothing has moved the body before, or
     * as another motion has left it. */
    struct InitialMotion
    {
      double travel   = 0.; // m
      double velocity = 0.; // m/s
      double load     = 0.; // that the soil bears, as in Surroundings; N
    };

    /** Let the motion begin like this; before the future is asked for, and
     * before start(). */
    virtual void
    begin_at(const InitialMotion &start)
    {
      start_ = start;
    }

    /** Return how the motion begins. */
    const InitialMotion &
    beginning() const
    {
      return start_;
    }

    /** Go to the beginning, at time 0. */
    virtual void
    start()
    {
      time_          = 0.;
      travel_        = start_.travel;
      mean_velocity_ = velocity_ = start_.velocity;
    }

    /** Return how fast the body moves when nothing hinders it. Units: m/s. */
    virtual double
    usual_velocity() const
    {
      return 0.;
    }

    /** Return the largest velocity that the motion allows itself, over that of
     * compression waves in the soil; no value where it is free. */
    virtual std::optional<double>
    largest_mach_number() const
    {
      return {};
    }

    /** Let the whole motion take place this many times more slowly; before the
     * future is asked for, and before start(). */
    virtual void
    slow_down(const double /*factor*/)
    {}

    /** Return the travel at which a body that its loads move came to rest
     * first, and no value before that. Units: m. */
    virtual std::optional<double>
    travel_at_rest() const
    {
      return {};
    }

    /**
     * Advance by one step. @p force is that of the soil on the body in the
     * previous step, in the direction of a positive travel, on the whole
     * circumference (per metre in plane strain); 0 where it is not needed.
     * Units: s, N.
     */
    void
    advance(const double dt, const double force)
    {
      const double before = travel_;
      move(dt, force);
      time_ += dt;
      mean_velocity_ = (travel_ - before) / dt;
    }

    /** How far the body has moved. Units: m. */
    double
    travel() const
    {
      return travel_;
    }

    /** The velocity at the present time. Units: m/s. */
    double
    velocity() const
    {
      return velocity_;
    }

    /** The velocity of the whole last step, with which body and mesh move
     * alike. Units: m/s. */
    double
    mean_velocity() const
    {
      return mean_velocity_;
    }

    /** Return the first time at which the travel is @p travel: infinity if that
     * never happens, and no value where the motion cannot know it. Units: s. */
    virtual std::optional<double>
    time_of_travel(const double /*travel*/) const
    {
      return {};
    }

    /** Return the smallest and the largest travel until @p time, where the
     * motion can know it. Units: m. */
    virtual std::optional<std::pair<double, double>>
    travel_range(const double /*time*/) const
    {
      return {};
    }

    /** Register the state. A motion that has more of it than travel and
     * velocity adds the rest. */
    virtual void
    register_totals(RunTotals &totals)
    {
      totals.keep("motion_time", time_);
      totals.keep("motion_travel", travel_);
      totals.keep("motion_velocity", velocity_);
      totals.keep("travel_at_start", start_.travel);
      totals.keep("velocity_at_start", start_.velocity);
      totals.keep("load_at_start", start_.load);
    }

  protected:
    /** Set travel_ and velocity_ to those at the end of the step; time_ is the
     * time at its beginning. */
    virtual void
    move(const double dt, const double force) = 0;

    double time_ = 0., travel_ = 0., velocity_ = 0., mean_velocity_ = 0.;

  private:
    InitialMotion start_;
  };
} // namespace CaissonMPM

#endif
