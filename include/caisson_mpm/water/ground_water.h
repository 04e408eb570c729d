// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The pore water of a scene: its pressure, what it does to body and soil, and
// what a designer asks of it.
#ifndef caisson_mpm_water_ground_water_h
#define caisson_mpm_water_ground_water_h

#include <caisson_mpm/base/named_numbers.h>
#include <caisson_mpm/bodies/rigid_body.h>
#include <caisson_mpm/materials/soil.h>
#include <caisson_mpm/water/mudline.h>
#include <caisson_mpm/water/seepage.h>
#include <caisson_mpm/water/suction.h>

#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * With Level = drained, water moves freely and its excess pressure is zero:
   * nothing here does or costs anything. With Level = seepage, the flow is
   * steady at each time: the field is found anew when the body or the mudline
   * has moved, and the suction scales it in every step.
   *
   * The excess pressure is that beyond the hydrostatic one. Submerged soil has
   * its buoyant weight, so that nothing else of the water acts on it.
   */
  class GroundWater : public dealii::ParameterAcceptor
  {
  public:
    /** All must outlive this object. */
    GroundWater(BackgroundGrid       &grid,
                const MaterialPoints &points,
                const Soil           &soil,
                const RigidBody      &body);

    /** Throw BadInput where the entries contradict each other, or the scene. */
    void
    check_parameters() const;

    /** Tell which entries have no effect. */
    void
    name_unused_entries(ParameterOrigins &origins) const;

    /** Whether water flows. */
    bool
    acts() const
    {
      return level != Level::drained;
    }

    /** Whether there is an excess pressure now. */
    bool
    has_pressure() const
    {
      return acts() && suction.value() != 0.;
    }

    /** Set up what knows the nodes of this rank. Collective. */
    void
    initialize();

    /** Find the flow at the start of a step, where it is not known well enough
     * from an earlier one. Collective. */
    void
    update();

    /** Continue to the end of a step. @p force_on_body is that of the soil in
     * this step, in the direction of the travel. Units: s, N. */
    void
    advance(const double time, const double dt, const double force_on_body);

    /** Return what the water presses the body down with: suction beneath the
     * lid, and less pressure beneath the tip. Units: N. */
    double
    load_on_body() const
    {
      return suction.value() * loaded_area();
    }

    /** Return the excess pore pressure at the nodes. [n_nodes], Pa */
    const std::vector<double> &
    pressure();

    /** Return the share of each cell below the mudline. [n_cells] */
    const std::vector<double> &
    filled() const
    {
      return mudline.filled();
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

    /** Return warnings of what the water does to the plug, each once; after
     * columns(). */
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
      seepage
    };

    void
    solve();
    void
    find_permeabilities();
    /** Find the share of the suction at the tip. */
    void
    find_tip();
    double
    lid_area() const;
    double
    critical_gradient() const;
    /** The area of the lid, and that of the tip as far as the suction has
     * reached it. Units: m2. */
    double
    loaded_area() const
    {
      return acts() ? lid_area() + tip_phi : 0.;
    }
    /** Return the columns with the present @p mudline. */
    NamedNumbers
    values(const Mudline &mudline) const;
    /** How far the plug has risen, and how far the soil that the wall displaces
     * would make it rise. Units: m. */
    double
    heave(const Mudline &mudline) const;
    double
    heave_by_wall() const;

    BackgroundGrid       &grid;
    const MaterialPoints &points;
    const Soil           &soil;
    const RigidBody      &body;

    Level             level   = Level::drained;
    double            renewal = 0.25;
    Seepage::FarSides sides;
    Suction           suction;

    Seepage                   seepage;
    Mudline                   mudline;
    std::vector<Permeability> permeability;  // [n_cells]
    std::vector<double>       pressure_;     // [n_nodes]
    double                    tip_area = 0.; // looking down, m2
    double                    tip_phi  = 0.; // integral of phi over it, m2
    double                    travel_at_solve  = 0.;
    bool                      is_solved        = false;
    unsigned int              steps_since_look = 0;
    Seepage::Flow             flow;
    Seepage::ExitGradient     exit;
    double                    time_of_suction = 0.; // of its table, s
    double                    seepage_volume  = 0.; // through the plug, m3
    double                    plug_height     = 0.; // at the start, m
    bool                      has_started     = false;
    bool has_warned_of_piping = false, has_warned_of_lift = false;
  };
} // namespace CaissonMPM

#endif
