// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Water that flows steadily under the suction beneath the lid of a caisson, and
// suction in soil that lets no water through.
//
// There the water presses less on the surface of the plug, by the suction s: a
// traction that lifts the plug. With any field p that is -s on this surface and
// 0 on the mudline outside, Gauss's theorem makes the traction a body force
// -grad p and an isotropic stress -p. Clay whose strength depends on no mean
// stress, and whose volume does not change, feels only the body force. So the
// field may be chosen: it is -s in the plug, down to the tip, and harmonic
// below, as if water seeped through soil that is far more permeable in the
// plug. With this choice the plug keeps its contact with the wall, and bears no
// tension beyond p, although the suction takes its total stress. The field is
// no pore pressure: files have it in the stress, which is then the total one
// less the hydrostatic pressure.
//
// In layers of sand and clay the same is done for clay as long as the tip is in
// clay: the flow in the sand does not depend on the field in the clay.
#ifndef caisson_mpm_water_steady_seepage_h
#define caisson_mpm_water_steady_seepage_h

#include <caisson_mpm/water/flowing_water.h>
#include <caisson_mpm/water/seepage.h>

#include <string>
#include <vector>

namespace CaissonMPM
{
  /** The flow is steady at each time: the field is computed again when the body
   * or the mudline has moved, and the suction scales it in every step. Where
   * Water/Level has no flow, the only volume that the pump takes is that of the
   * lid and of the heave of the plug. */
  class SteadySeepage : public FlowingWater
  {
  public:
    explicit SteadySeepage(const WaterScene &scene);

    void
    check_parameters() const override;
    void
    begin_step(const double              dt,
               const BoundaryConditions &conditions,
               Contact                  &contact) override;
    const double *
    volume_rates(const Kernels::NodalVector *velocity,
                 const std::vector<Kernels::CornerView> &) override
    {
      find_plug_rate(velocity);
      return nullptr;
    }
    std::vector<GridField>
    fields() override;
    void
    continue_after(const std::string &level,
                   const NamedFields &fields) override;

    /** The name of the share of the suction at the nodes among the fields. */
    static const std::string name_of_field;

    /** The numbers of a record, also of the suction in undrained water. */
    NamedNumbers
    present_columns() const override
    {
      return FlowingWater::present_columns();
    }

  private:
    const NodalData &
    outflow() override
    {
      return seepage.residual();
    }
    std::pair<const NodalData *, double>
    field_at_nodes() override
    {
      return {&seepage.field(), -suction()};
    }
    void
    reinit() override;
    std::vector<const Section *>
    used_groups() const override;
    /** Find how permeable the soil in the cells is to the field. */
    void
    find_permeability();
    WaterFlow
    flow() const override;
    void
    prepare_columns() override;
    /** Whether the field of an earlier step still serves. Collective. */
    bool
    still_serves();
    void
    solve();
    bool
    tip_is_in_clay() const;
    /** Whether a cell is beneath the lid and above the tip. */
    bool
    is_in_plug(const unsigned int cell) const;
    /** Let the suction reach all nodes of the plug that only clay has around
     * them: where the tip has left the clay, the field then falls at the lower
     * side of the clay, where the water of the sand lifts it. Collective. */
    void
    fill_clay_of_plug();

    const bool flows; // according to Water/Level
    Seepage    seepage;
    bool       is_of_overpressure = false; // the field that was solved for
    double     travel_at_solve    = 0.;
    // of plug, open and unknown nodes; m3/s over the suction in m of water
    double flow_out = 0., flow_in = 0.;
  };
} // namespace CaissonMPM

#endif
