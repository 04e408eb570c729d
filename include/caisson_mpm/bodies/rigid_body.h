// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The rigid body: its shape, its surface and its motion.
#ifndef caisson_mpm_bodies_rigid_body_h
#define caisson_mpm_bodies_rigid_body_h

#include <caisson_mpm/base/section.h>
#include <caisson_mpm/base/time_table.h>
#include <caisson_mpm/bodies/body_motion.h>
#include <caisson_mpm/bodies/body_shape.h>
#include <caisson_mpm/bodies/body_surface.h>
#include <caisson_mpm/materials/soil.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * Owns all shapes and motions that the program knows, so that their entries
   * are declared, and gives those that the entries Kind and Motion choose.
   * Without a body (Kind = none) the shape contains nothing and the motion
   * rests. Not collective.
   */
  class RigidBody : public Section
  {
  public:
    RigidBody();

    /** Throw BadInput where the entries contradict each other. */
    void
    check_parameters() const;

    /** Report which entries of the section have no effect. */
    void
    name_unused_entries(ParameterOrigins &origins) const override;

    BodyShape &
    shape()
    {
      return *shapes[chosen_shape];
    }
    const BodyShape &
    shape() const
    {
      return *shapes[chosen_shape];
    }

    BodyMotion &
    motion()
    {
      return *motions[shape().exists() ? chosen_motion : 0];
    }
    const BodyMotion &
    motion() const
    {
      return *motions[shape().exists() ? chosen_motion : 0];
    }

    const BodySurface &
    surface() const
    {
      return surface_;
    }

    /** The depth of the body's lowest point below the soil surface; of a
     * cylinder the growth of its radius. Units: m. */
    double
    penetration() const
    {
      return shape().initial_depth() + motion().travel();
    }

    /** The velocity of the whole last step. Units: m/s. */
    Vector2
    mean_velocity() const
    {
      return motion().mean_velocity() * shape().direction();
    }

    /** Find submerged_weight(), from the mass of the body's cells where the
     * entry is auto, and pass this mass to the motion. On the whole
     * circumference. Units: kg. */
    void
    compute_weight(const double mass, const Soil &soil);

    /** That mass, after compute_weight(). Units: kg. */
    double
    mass() const
    {
      return motion().surroundings.mass;
    }

    /** The weight of the body in water, or in air where the soil is dry, on the
     * whole circumference. Units: N. */
    double
    submerged_weight() const
    {
      return submerged_weight_;
    }

    /** Return the force of Force table, positive downward, which acts besides.
     * Units: s, N. */
    double
    applied_force(const double time) const;

    /** The density of the body's material. Units: kg/m3. */
    double density = 7850.;

  private:
    /** The first one is that of no body. */
    std::vector<std::unique_ptr<BodyShape>> shapes;
    /** The first one rests. */
    std::vector<std::unique_ptr<BodyMotion>> motions;
    BodySurface                              surface_;
    std::optional<double>                    weight; // or that of its cells
    std::string                              force_text;
    TimeTable                                force_table; // s, N
    double                                   submerged_weight_ = 0.;
    std::size_t chosen_shape = 0, chosen_motion = 1;
  };
} // namespace CaissonMPM

#endif
