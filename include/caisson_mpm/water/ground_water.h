// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The pore water of a scene: its pressure, what it does to body and soil, and
// what a designer asks of it.
#ifndef caisson_mpm_water_ground_water_h
#define caisson_mpm_water_ground_water_h

#include <caisson_mpm/base/expression.h>
#include <caisson_mpm/base/named_numbers.h>
#include <caisson_mpm/bodies/rest.h>
#include <caisson_mpm/bodies/rigid_body.h>
#include <caisson_mpm/kernels/forward.h>
#include <caisson_mpm/kernels/material.h>
#include <caisson_mpm/materials/soil.h>
#include <caisson_mpm/operators/boundary_conditions.h>
#include <caisson_mpm/water/plug_balance.h>
#include <caisson_mpm/water/plug_strength.h>
#include <caisson_mpm/water/pressure_projection.h>
#include <caisson_mpm/water/seepage.h>
#include <caisson_mpm/water/suction.h>
#include <caisson_mpm/water/undrained_pressure.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  /**
   * With Level = drained, water moves freely and its excess pressure is zero:
   * nothing here does or costs anything. With Level = undrained, it stays where
   * it is, and its pressure resists the change of volume of the soil. With
   * Level = seepage, the flow is
   * steady at each time: the field is found anew when the body or the mudline
   * has moved, and the suction scales it in every step. With Level = coupled,
   * the pressure is found in every step, from the motion of the soil.
   *
   * The excess pressure is that beyond the hydrostatic one. Submerged soil has
   * its buoyant weight, so that nothing else of the water acts on it.
   */
  class GroundWater : public dealii::ParameterAcceptor
  {
  public:
    /** All must outlive this object. */
    GroundWater(BackgroundGrid  &grid,
                MaterialPoints  &points,
                const Soil      &soil,
                const RigidBody &body);

    /** Throw BadInput where the entries contradict each other, or the scene. */
    void
    check_parameters() const;

    /** Tell which entries have no effect. */
    void
    name_unused_entries(ParameterOrigins &origins) const;

    /** Whether the water may have an excess pressure. */
    bool
    acts() const
    {
      return level != Level::drained;
    }

    /** Whether water flows. */
    bool
    flows() const
    {
      return level == Level::seepage || is_coupled();
    }

    /** Whether no water flows, so that its pressure resists the change of
     * volume. */
    bool
    is_undrained() const
    {
      return level == Level::undrained;
    }

    /** Whether the lid of a caisson is above water that flows. */
    bool
    has_suction() const
    {
      return flows() && has_lid();
    }

    /** The largest suction of the table, and that of the pump; 0 where there is
     * none. Units: Pa. */
    double
    largest_suction_of_table() const
    {
      return suction.largest_of_table();
    }
    double
    largest_suction_of_pump() const
    {
      return suction.largest_of_pump();
    }

    /** Whether the pressure follows from the motion of the soil. */
    bool
    is_coupled() const
    {
      return level == Level::coupled;
    }

    /** Whether the gradient of an excess pressure at the nodes acts now. */
    bool
    has_pressure() const
    {
      return is_coupled() || (flows() && suction.value() != 0.);
    }

    /** Add the bulk modulus of the water to undrained materials. */
    void
    stiffen(std::vector<Kernels::Material> &materials) const;

    /** Return the pressure of undrained soil in each cell, for
     * Kernels::StepContext; null unless the soil is undrained. [n_cells], Pa */
    const double *
    cell_pressure() const
    {
      return is_undrained() ? undrained.pressure().data() : nullptr;
    }

    /** Return the work of the undrained water at the tip on the soil, if the
     * body moves by @p travel. Units: m, J. */
    double
    work_at_tip(const double travel) const
    {
      return is_undrained() ? tip_integral * travel : 0.;
    }

    /** Set up what knows the nodes of this rank. Collective. */
    void
    initialize();

    /** Keep the fields at the nodes over the next initialize(), before the
     * parts of the mesh change, or the run begins anew. Collective. */
    void
    keep_field();

    /** Return the fields at the nodes for a checkpoint. Collective. */
    NamedNumbers
    field_state();

    /** Return to the fields of a checkpoint. */
    void
    resume_field(const NamedNumbers &state);

    /** Go on after another run, with its totals and from its checkpoint, in
     * which Water/Level was @p level. Collective. */
    void
    go_on_after(const std::string &level, const NamedNumbers &state);

    /** Give the points the pressure at their places. */
    void
    write_pressure_to_points();

    /** At the start of a step of length @p dt, find the flow where it is not
     * known well enough from an earlier one, or prepare to find the pressure.
     * Collective. Units: s. */
    void
    update(const double dt, const BoundaryConditions &conditions);

    /** Find the pressure of a coupled step from the velocity that the soil
     * would have with the force of the last one. Collective. See
     * PressureProjection::solve(). */
    void
    correct(const Kernels::NodalVector             *velocity,
            const std::vector<Kernels::CornerView> &corners);

    /** Return the rates of volume change [n_cells] that strain the soil of a
     * coupled step, whose nodes have this velocity in the end; null where the
     * water is not coupled. Collective. */
    const double *
    volume_rates(const Kernels::NodalVector             *velocity,
                 const std::vector<Kernels::CornerView> &corners);

    /** Continue to the end of a step. @p force_on_body is that of the soil in
     * this step, in the direction of the travel. Units: s, N. */
    void
    advance(const double time, const double dt, const double force_on_body);

    /** Return what the water presses the body down with: suction beneath the
     * lid, and less pressure beneath the tip. Units: N. */
    double
    load_on_body() const
    {
      return suction.value() * lid_area() - tip_force();
    }

    /** Return the excess pore pressure at the nodes. [n_nodes], Pa */
    const std::vector<double> &
    pressure();

    /** Return what the coupled pressure of a cell does to one of its corners.
     * N per radian */
    Vector2
    coupled_force_at(const unsigned int cell, const unsigned int corner) const
    {
      return projection.force_at(cell, corner);
    }

    /** Add the force of the coupled pressure to @p force [n_nodes]: within a
     * step before correct(), that of the last one. N per radian */
    void
    add_coupled_force(Kernels::NodalVector *force) const;

    /** Return the share of each cell below the mudline. [n_cells] */
    const std::vector<double> &
    filled() const
    {
      return mudline.filled();
    }

    /** Return the share of each cell below the mudline as it was last looked at
     * if the mesh has a lid with suction beneath it; null otherwise. [n_cells]
     */
    const std::vector<double> *
    filled_beneath_lid() const
    {
      return flows() && body.shape().has_lid() ? &filled_beneath_lid_ : nullptr;
    }

    /** Return the names of the numbers that water adds to a record. */
    std::vector<std::string>
    column_names() const;

    /** Return these numbers now; finds the flow where it is not known.
     * Collective. */
    NamedNumbers
    columns();

    /** Return what a design method needs besides the shape and the soil: the
     * weight of the body and the suction at which water boils. */
    NamedNumbers
    limits() const;

    /** How a layer drains while the body moves. */
    struct Drainage
    {
      double c_v     = 0.; // k (lambda + 2 mu) / gamma_w, m2/s
      double group   = 0.; // v D / c_v
      double inertia = 0.; // c_v over the wave speed and D, with mass scaling
    };

    /** Return it for each layer of a coupled run with a body; empty otherwise.
     * @p materials are those of the layers. */
    std::vector<Drainage>
    drainage(const std::vector<Kernels::Material> &materials) const;

    /** Return the same in words, for the beginning of a run. */
    std::vector<std::pair<std::string, std::string>>
    description(const std::vector<Kernels::Material> &materials) const;

    /** Return warnings of what is known to change the drainage. */
    std::vector<std::string>
    known_limits(const std::vector<Kernels::Material> &materials) const;

    /** Return warnings of what the water does to the plug, and of what it does
     * not do in this program, each once; after columns(). */
    std::vector<std::string>
    take_warnings();

    /** Return why the run cannot go on, or an empty text. */
    std::string
    reason_to_end() const;

    void
    register_totals(RunTotals &totals);

  private:
    enum class Level
    {
      drained,
      undrained,
      seepage,
      coupled
    };

    void
    declare_open_sides();
    /** The part of name_unused_entries() for Level = drained or undrained. */
    void
    name_unused_without_flow(ParameterOrigins &origins) const;
    /** Throws BadInput where the text cannot be parsed. */
    Expression
    bottom_expression() const;
    /** Call action(node, place in a list of all nodes of the lattice). */
    template <typename Action>
    void
    for_each_place(const Action &action) const;
    std::size_t
    n_places() const;
    /** A field that the water goes on from, and its name in a checkpoint. */
    struct KeptField
    {
      std::string name;
      NodalData  *field;
    };
    /** Return the numbers of a field in the state of a run. */
    std::vector<double>
    values_at_places(const NamedNumbers &state, const std::string &field) const;
    /** Begin coupled water with the pressures of steady seepage. */
    void
    begin_with_seepage(const NamedNumbers &state);
    std::vector<KeptField>
    kept_fields();
    /** Return the values [n_places()] on all ranks, NaN without a node. */
    std::vector<double>
    gather(const NodalData &field) const;
    void
    scatter(const std::vector<double> &values, NodalData &field) const;
    void
    solve();
    void
    set_up_step(const double dt, const BoundaryConditions &conditions);
    void
    find_properties();
    /** Find where the soil touches a lid of the mesh. Collective. */
    void
    look_at_lid(const Mudline &now);
    /** Return the integral over the tip, or the mantle of a cylinder, of
     * value(cell, corner) of the cells at it, and its area. Collective. */
    template <typename Function>
    std::array<double, 2>
    integrate_over_tip(const Function &value) const;
    void
    find_cells_at_tip();
    void
    find_undrained_pressure();
    bool
    has_lid() const;
    /** Whether the body is pulled from soil whose water cannot follow at once,
     * and no suction acts beneath the lid. */
    bool
    pulls_with_open_lid() const;
    /** Of its lower face over the original mudline. Units: m. */
    double
    height_of_lid() const;
    /** The area beneath the lid, 0 without one. Units: m2. */
    double
    lid_area() const;
    /** What the excess pressure presses the tip up with. Units: N. */
    double
    tip_force() const
    {
      return level == Level::seepage ? -suction.value() * tip_integral :
                                       tip_integral;
    }
    /** What the solution of seepage is to be multiplied with. */
    double
    flow_scale() const;
    const NodalData &
    outflow();
    unsigned int
    n_iterations() const
    {
      return is_coupled() ? projection.solver().n_iterations() :
                            seepage.solver().n_iterations();
    }
    void
    find_tip_integral();
    void
    find_flow();
    void
    find_exit_gradient();
    /** Whether the flow out of the plug nearly lifts its soil. */
    bool
    carries_soil() const;
    /** Append warnings of the plug. @p where: at which penetration. */
    void
    warn_of_plug(const std::string &where, std::vector<std::string> &warnings);
    SuctionLoad
    load_of_suction(const double force_on_body) const;
    /** The smallest and the largest pressure, 0 among them. Collective. */
    std::pair<double, double>
    extremes() const;
    /** How far the pore water is from boiling where it is nearest to it. */
    struct BoilingMargin
    {
      double value = 0.; // absolute pressure over that of vapor, Pa
      double r = 0., z = 0.;
    };
    /** Return it for a coupled or undrained run, at most that of the water on
     * the mudline at rest. Collective. */
    BoilingMargin
    find_boiling_margin() const;
    /** Return the columns with the present @p mudline. */
    NamedNumbers
    values(const Mudline &mudline) const;
    /** The part of values() for a caisson in water that flows. */
    NamedNumbers
    values_of_lid(const Mudline &mudline) const;
    /** How far the plug has risen, and how far the soil that the wall displaces
     * would make it rise. Units: m. */
    double
    heave(const Mudline &mudline) const;
    double
    heave_by_wall() const;

    BackgroundGrid  &grid;
    MaterialPoints  &points;
    const Soil      &soil;
    const RigidBody &body;

    Level                     level            = Level::drained;
    double                    renewal          = 0.25;
    double                    time_compression = 1.;
    double                    bulk_modulus     = 1e8; // Pa
    PressureSolver::OpenSides sides;
    std::string               bottom_text = "0";
    Expression                bottom_pressure; // Pa
    Suction                   suction;

    UndrainedPressure                undrained;
    Seepage                          seepage;
    PressureProjection               projection;
    Mudline                          mudline;
    PlugBalance                      plug_balance;
    PlugStrength                     plug_strength;
    std::vector<Conductance>         permeability;        // [n_cells], m/s
    std::vector<WaterProperties>     properties;          // [n_cells]
    std::vector<double>              pressure_;           // [n_nodes]
    std::vector<double>              filled_beneath_lid_; // [n_cells]
    std::vector<std::vector<double>> kept_values;         // of keep_field()
    std::vector<unsigned int>        cells_at_tip;        // of this rank
    // the integral over the tip of phi (m2) in seepage, else of the pressure
    // (N)
    double       tip_integral     = 0.;
    double       tip_area         = 0.; // looking down, m2
    double       touched_lid      = 0.; // share of its area
    double       travel_at_solve  = 0.;
    bool         is_solved        = false; // since the last initialize()
    unsigned int steps_since_look = 0;
    ExitGradient exit;
    // of the last record
    WithstoodGradients withstood;
    BoilingMargin      boiling_margin; // of the last record
    // of plug, open and unknown nodes, see outflow()
    double flow_out = 0., flow_in = 0., flow_remaining = 0.;
    // of the equations at unknown nodes, and the flow, all steps; m3
    double unbalanced = 0., through_surfaces = 0.;
    double step = 0., time = 0.;    // s
    double last_force_on_body = 0.; // N
    double time_of_suction    = 0.; // of its table, s
    double seepage_volume     = 0.; // through the plug, m3
    double plug_height        = 0.; // before the installation, m
    // the volume that body and plug had displaced when this run began, m3
    double     volume_at_start = 0.;
    RecentMean recent_heave; // of the plug, m
    bool       has_started          = false;
    bool       has_warned_of_piping = false, has_warned_of_lift = false,
         has_warned_of_open_lid = false, has_warned_of_boiling = false;
  };
} // namespace CaissonMPM

#endif
