// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the models have in common in which the pore water flows.
#ifndef caisson_mpm_water_flowing_water_h
#define caisson_mpm_water_flowing_water_h

#include <caisson_mpm/domain/material_points.h>
#include <caisson_mpm/materials/soil.h>
#include <caisson_mpm/water/cell_integrals.h>
#include <caisson_mpm/water/lid_compartment.h>
#include <caisson_mpm/water/pore_water.h>
#include <caisson_mpm/water/pressure_projection.h>

#include <boost/signals2/connection.hpp>

#include <memory>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /** What the soil in the cells is to water that flows through it: means over
   * the points of each cell; a gap has the soil of its depth at the
   * start. Flow along layers adds up, flow across them shares its gradient. */
  struct PermeabilityField
  {
    /** Compute the means, with all permeabilities @p faster than the soil's.
     * Not collective. */
    void
    compute(const BackgroundGrid &grid,
            const MaterialPoints &points,
            const Soil           &soil,
            const double          faster);

    /** Return the permeability of the cells, 0 where water does not flow in a
     * time that counts. [n_cells], m/s */
    std::vector<Conductance>
    of_flow() const;

    std::vector<Conductance>     permeability; // [n_cells], m/s
    std::vector<unsigned char>   is_clay;    // [n_cells], undrained by strength
    std::vector<WaterProperties> properties; // [n_cells]
  };

  /** Knows where the soil ends and how permeable it is, and owns the
   * compartment beneath the lid of a caisson. A derived class computes the
   * flow. */
  class FlowingWater : public PoreWater
  {
  public:
    void
    check_parameters() const override;
    double
    load_on_body() const override
    {
      return (lid ? lid->load() : 0.) - flow().tip_force;
    }
    double
    resistance_to_body() const override
    {
      return flow().tip_force - (lid && lid->is_sealed() ? lid->load() : 0.);
    }
    double
    end_step(const double time,
             const double dt,
             const double force_on_body,
             const double travel) override;
    std::string
    reason_to_end() const override;
    void
    write_pressure_to_points() override;
    NamedNumbers
    columns() override;
    std::vector<std::string>
    take_warnings() override;
    WaterReport
    report(const std::vector<Kernels::Material> &materials) const override;
    void
    continue_after(const std::string &level,
                   const NamedFields &fields) override;

    /** Return the excess pressure at the nodes. [n_nodes], Pa */
    const std::vector<double> &
    nodal_pressure();

    /** Return the excess pressure at a place in a cell, after
     * nodal_pressure(). Units: m; Pa. */
    double
    pressure_at(const unsigned int cell, const dealii::Point<2> &place) const;

    /** Return the share of each cell below the mudline. [n_cells] */
    const std::vector<double> &
    filled() const
    {
      return soil_columns.filled();
    }

    /** The suction beneath the lid, 0 without one. Units: Pa. */
    double
    suction() const
    {
      return lid ? lid->suction() : 0.;
    }

  protected:
    explicit FlowingWater(const WaterScene &scene);

    /** Prepare for the cells and nodes of this rank. */
    virtual void
    reinit();

    /** Return the flow now. */
    virtual WaterFlow
    flow() const = 0;

    /** Return the water that leaves the soil at the nodes over the scale of the
     * flow. [n_nodes], m3/s per radian */
    virtual const NodalData &
    outflow() = 0;

    /** Return a field at the nodes, and what makes it the pressure. Pa */
    virtual std::pair<const NodalData *, double>
    field_at_nodes() = 0;

    /** Compute what a record needs besides. Collective. */
    virtual void
    prepare_columns()
    {}

    /** Return the numbers of a record with the present @p soil_columns. */
    virtual NamedNumbers
    columns_with(const SoilColumns &soil_columns) const;

    NamedNumbers
    present_columns() const override
    {
      return columns_with(soil_columns);
    }

    /** Find the mudline, and where it touches the lid. Collective. */
    void
    find_mudline();

    /** Find the rate at which the surface of the plug rises with the new
     * nodal velocities, for a lid that is sealed. Collective. */
    void
    find_plug_rate(const Kernels::NodalVector *velocity);

    /** Register the flow that has been computed, also as the first one. */
    void
    finish_flow();

    SoilColumns                     soil_columns;
    PermeabilityField               soil_in_cells;
    TipIntegral                     tip;
    std::unique_ptr<LidCompartment> lid;                      // of a caisson
    bool                            is_solved        = false; // since reinit()
    bool                            has_started      = false;
    unsigned int                    steps_since_look = 0;
    double                          time             = 0.; // s
    double                          plug_rate        = 0.; // m3/s

  private:
    boost::signals2::scoped_connection before_change, after_change;
    NamedFields                        kept;     // while the parts change
    std::vector<double>                pressure; // [n_nodes], Pa
  };
} // namespace CaissonMPM

#endif
