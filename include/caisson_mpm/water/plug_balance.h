// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Where the heave of the plug comes from: the soil that came in, and the growth
// of what is there.
#ifndef caisson_mpm_water_plug_balance_h
#define caisson_mpm_water_plug_balance_h

#include <caisson_mpm/base/named_numbers.h>
#include <caisson_mpm/base/run_totals.h>
#include <caisson_mpm/bodies/rigid_body.h>
#include <caisson_mpm/domain/material_points.h>

namespace CaissonMPM
{
  /**
   * The control volume is the cylinder within the inner radius of the caisson,
   * from the bottom of the mesh, through which no soil passes, to the mudline
   * of the plug. Soil passes only through its side beneath the tip. So
   *
   *   heave of the mudline * area = inflow + dilation,
   *
   * where the inflow is the change of the sum of the initial volumes of the
   * points inside, which is that of their mass, and the dilation the change of
   * the sum of present minus initial volumes. The mudline is found from the
   * tops of the highest points and not from volumes: the difference of both
   * sides is an error of the mudline, or of the volumes, which may leave gaps
   * or overlap.
   *
   * Beneath the tip, a point counts with the share of its width that is inside.
   * Whole points would make the inflow jump by a row of points at a time: in
   * prm/jack_coarse.prm, by a quarter of it after half a meter.
   */
  class PlugBalance
  {
  public:
    /** All must outlive this object. */
    PlugBalance(const BackgroundGrid &grid,
                const MaterialPoints &points,
                const RigidBody      &body);

    /** Remember the soil inside. Collective. */
    void
    start();

    /** Return the columns for a mudline that has risen by this volume since the
     * start; all names and zeros before start(). Collective. Units: m3. */
    NamedNumbers
    columns(const double heave_volume) const;

    void
    register_totals(RunTotals &totals);

  private:
    /** The soil inside. */
    struct Soil
    {
      double initial = 0., present = 0.; // volume, m3
    };

    Soil
    find_soil() const;

    const BackgroundGrid &grid;
    const MaterialPoints &points;
    const RigidBody      &body;
    bool                  has_started = false;
    Soil                  soil_at_start;
  };
} // namespace CaissonMPM

#endif
