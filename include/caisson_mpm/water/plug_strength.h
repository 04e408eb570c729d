// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What holds the soil of the plug against the water that flows up through it.
#ifndef caisson_mpm_water_plug_strength_h
#define caisson_mpm_water_plug_strength_h

#include <caisson_mpm/bodies/rigid_body.h>
#include <caisson_mpm/domain/background_grid.h>
#include <caisson_mpm/domain/material_points.h>
#include <caisson_mpm/materials/soil.h>
#include <caisson_mpm/water/mudline.h>

#include <vector>

namespace CaissonMPM
{
  /** Upward hydraulic gradients that the plug withstands. */
  struct WithstoodGradients
  {
    double surface  = 0.; // by its weight, of the soil at its surface
    double weight   = 0.; // of the block that is lifted first: by its weight,
    double strength = 0.; // and by its cohesion

    double
    of_block() const
    {
      return weight + strength;
    }
  };

  /**
   * Finds the block of the plug that water lifts first (Terzaghi's heave): one
   * beside the wall from the surface down to a depth h, as wide as half of the
   * embedment w. A gradient i pulls on it with i gamma_w h per area; its
   * buoyant weight holds it, the tension that the soil at its base bears, and
   * the cohesion on its side in the plug, i = (int gamma' dz + T(h) + 2/w int c
   * dz) / (gamma_w h), which is smallest for the block that matters. Friction
   * on the side and on the wall is left out of account. Layers are those of the
   * points, wherever they have come to.
   */
  class PlugStrength
  {
  public:
    /** All must outlive this object. */
    PlugStrength(const BackgroundGrid &grid,
                 const MaterialPoints &points,
                 const Soil           &soil,
                 const RigidBody      &body);

    /** Return the gradients below @p mudline; zeros where the plug has no
     * point. Collective. */
    WithstoodGradients
    find(const Mudline &mudline) const;

  private:
    /** Sums over the points of each slice of the depth, beside the wall. */
    struct Slices
    {
      explicit Slices(const unsigned int n);

      std::vector<double> volume;   // m3 per radian
      std::vector<double> weight;   // effective, N per radian
      std::vector<double> cohesion; // times the volume
      std::vector<double> tension;  // the least that the soil bears, Pa
    };

    /** Collective. */
    Slices
    slices_below(const double top, const double embedment) const;

    const BackgroundGrid &grid;
    const MaterialPoints &points;
    const Soil           &soil;
    const RigidBody      &body;
  };
} // namespace CaissonMPM

#endif
