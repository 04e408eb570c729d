// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Soil that no water leaves or enters: with the volume V of the points of a
// cell, V_0 at the start, and the bulk modulus K_w of the water over the
// porosity,
//   p = -K_w ln(V / V_0).
// The points change their volume with the mean divergence of their cell, and
// carry V / V_0 through the mesh. One value in each cell does not lock. Points
// of a cell that came from different cells differ in V / V_0, and no strain
// would level them: they share the mean. What suction adds is
// steady_seepage.h.
#ifndef caisson_mpm_water_undrained_water_h
#define caisson_mpm_water_undrained_water_h

#include <caisson_mpm/water/cell_integrals.h>
#include <caisson_mpm/water/pore_water.h>
#include <caisson_mpm/water/steady_seepage.h>

#include <boost/signals2/connection.hpp>

#include <memory>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /** The pressure acts within the stress of the cells; see Kernels. */
  class UndrainedWater : public PoreWater
  {
  public:
    explicit UndrainedWater(const WaterScene &scene);

    void
    check_parameters() const override;
    void
    begin_step(const double              dt,
               const BoundaryConditions &conditions,
               Contact                  &contact) override;
    double
    load_on_body() const override
    {
      return (suction ? suction->load_on_body() : 0.) - tip.value();
    }
    double
    resistance_to_body() const override
    {
      return (suction ? suction->resistance_to_body() : 0.) + tip.value();
    }
    const double *
    cell_pressure() const override
    {
      return pressure.data();
    }
    const double *
    volume_rates(const Kernels::NodalVector             *velocity,
                 const std::vector<Kernels::CornerView> &corners) override
    {
      return suction ? suction->volume_rates(velocity, corners) : nullptr;
    }
    double
    end_step(const double time,
             const double dt,
             const double force_on_body,
             const double travel) override;
    std::string
    reason_to_end() const override
    {
      return suction ? suction->reason_to_end() : "";
    }
    void
    write_pressure_to_points() override;
    NamedNumbers
    columns() override;
    std::vector<std::string>
    take_warnings() override;
    WaterReport
    report(const std::vector<Kernels::Material> &materials) const override;
    std::vector<GridField>
    fields() override
    {
      return suction ? suction->fields() : std::vector<GridField>();
    }
    void
    continue_after(const std::string &level,
                   const NamedFields &fields) override;

  private:
    std::vector<const Section *>
    used_groups() const override;
    NamedNumbers
    present_columns() const override;
    /** Prepare for the cells of this rank. */
    void
    reinit();
    void
    compute_pressure();

    std::unique_ptr<SteadySeepage>     suction;    // where there is any
    NamedNumbers                       of_suction; // of the last record
    boost::signals2::scoped_connection connection;
    std::vector<double> pressure;  // [n_cells], Pa; empty until it is computed
    TipIntegral         tip;       // N
    PressureExtremes    extremes;  // of the last record
    double              time = 0.; // s
  };
} // namespace CaissonMPM

#endif
