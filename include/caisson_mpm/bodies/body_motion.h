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
  /**
   * Where the body is and how fast it moves. A motion is a state, which each
   * step advances: its future is not known to anyone else. Only a motion that
   * is prescribed knows when the body will be where.
   *
   * A motion is one class in one file; it declares its own entries and has one
   * line in the list of rigid_body.cc. It is the same on all ranks; not
   * collective.
   */
  class BodyMotion : public Section
  {
  public:
    /** @p name is the value of the entry Motion that chooses this motion, and
     * @p description says in a few words what moves the body, for the text of
     * Motion. */
    BodyMotion(const std::string &name, const std::string &description)
      : Section("/Rigid body", Influence::motion)
      , name_(name)
      , description_(description)
    {}

    const std::string &
    name() const
    {
      return name_;
    }

    const std::string &
    description() const
    {
      return description_;
    }

    /** Throw BadInput where the entries of the chosen motion contradict each
     * other. */
    virtual void
    check_parameters() const
    {}

    /** How a motion begins: at rest where nothing has moved the body before, or
     * as another motion has left it. */
    struct InitialMotion
    {
      double travel   = 0.; // m
      double velocity = 0.; // m/s
      double load     = 0.; // that the soil bears, as in set_load(); N
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

    /** Set what presses the body in the direction of a positive travel besides
     * the soil: its submerged weight, and the suction. Units: N. */
    void
    set_load(const double load)
    {
      load_ = load;
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

    /** Set the mass of the body. Units: kg. */
    void
    set_mass(const double mass)
    {
      mass_ = mass;
    }

    /** What the soil does to the body in a step, as far as that depends on the
     * velocity of the body in this step alone. */
    struct Response
    {
      double force = 0.; // if the body kept its velocity, as in advance(); N
      double mass  = 0.; // of the soil that it would accelerate; kg
    };

    /** Whether advance() needs the response of the soil, which is known late in
     * a step. */
    virtual bool
    needs_response() const
    {
      return false;
    }

    /** Set the response of the soil in the coming step, where it is needed. */
    void
    set_response(const Response &response)
    {
      response_ = response;
    }

    /** Whether loads move the body, so that it can come to rest. */
    virtual bool
    follows_loads() const
    {
      return false;
    }

    /** Return the travel at which a body that its loads move came to rest
     * first, and no value before that. Units: m. */
    virtual std::optional<double>
    travel_at_rest() const
    {
      return {};
    }

    /** Whether advance() needs the force on the body, which must be summed over
     * the ranks. */
    virtual bool
    needs_force() const
    {
      return false;
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

    double
    load() const
    {
      return load_;
    }
    double
    mass() const
    {
      return mass_;
    }
    const Response &
    response() const
    {
      return response_;
    }

    double time_ = 0., travel_ = 0., velocity_ = 0., mean_velocity_ = 0.;

  private:
    const std::string name_, description_;
    double            load_ = 0., mass_ = 0.;
    Response          response_;
    InitialMotion     start_;
  };
} // namespace CaissonMPM

#endif
