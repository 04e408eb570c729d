// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Water whose pressure follows from the motion of the soil in every step.
#ifndef caisson_mpm_water_coupled_water_h
#define caisson_mpm_water_coupled_water_h

#include <caisson_mpm/base/expression.h>
#include <caisson_mpm/water/flowing_water.h>
#include <caisson_mpm/water/pore_water.h>
#include <caisson_mpm/water/pressure_projection.h>

#include <string>
#include <vector>

namespace CaissonMPM
{
  /** Its nodal force is implicit: a step predicts the velocities with the
   * pressure of the last one, and the projection corrects them. */
  class CoupledWater : public FlowingWater
  {
  public:
    explicit CoupledWater(const WaterScene &scene);

    void
    check_parameters() const override;
    void
    name_unused_entries(ParameterOrigins &origins) const override;
    void
    begin_step(const double              dt,
               const BoundaryConditions &conditions,
               Contact                  &contact) override;
    const double *
    volume_rates(const Kernels::NodalVector             *velocity,
                 const std::vector<Kernels::CornerView> &corners) override
    {
      find_plug_rate(velocity);
      return projection.find_volume_rates(velocity, corners).data();
    }
    std::vector<std::string>
    take_warnings() override;
    WaterReport
    report(const std::vector<Kernels::Material> &materials) const override;
    std::vector<GridField>
    fields() override;
    void
    continue_after(const std::string &level,
                   const NamedFields &fields) override;

    /** Compute the pressure from the velocity that the soil would have with the
     * force of the last step. Collective. See PressureProjection::solve(). */
    void
    solve(const Kernels::NodalVector             *velocity,
          const std::vector<Kernels::CornerView> &corners,
          const std::vector<double>              &mass);

    const PressureProjection &
    pressure_projection() const
    {
      return projection;
    }

  private:
    std::vector<const Section *>
    used_groups() const override;
    void
    reinit() override;
    WaterFlow
    flow() const override;
    const NodalData &
    outflow() override
    {
      return projection.find_outflow();
    }
    std::pair<const NodalData *, double>
    field_at_nodes() override
    {
      return {&projection.find_nodal_pressure(), 1.};
    }
    void
    prepare_columns() override;
    NamedNumbers
    columns_with(const SoilColumns &soil_columns) const override;
    /** Throws BadInput where the text cannot be parsed. */
    Expression
    bottom_expression() const;
    /** Begin with the pressures of steady seepage at the nodes. */
    void
    begin_with_seepage(const std::vector<double> &share_of_suction);
    void
                       integrate_over_tip();
    Expression         bottom_pressure; // Pa
    PressureProjection projection;
    PressureExtremes   extremes; // of the last record
    double             step = 0.;
    // with the field that carries suction in clay by total stress
    bool begins_with_field = false;
    // of the equations at unknown nodes, and the flow, all steps; m3
    double unbalanced = 0., through_surfaces = 0.;
  };
} // namespace CaissonMPM

#endif
