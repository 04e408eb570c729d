// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a step, a record and a checkpoint see of the pore water, whichever model
// of it a scene has chosen.
#ifndef caisson_mpm_water_pore_water_h
#define caisson_mpm_water_pore_water_h

#include <caisson_mpm/base/named_numbers.h>
#include <caisson_mpm/base/run_totals.h>
#include <caisson_mpm/bodies/rigid_body.h>
#include <caisson_mpm/domain/grid_fields.h>
#include <caisson_mpm/domain/material_points.h>
#include <caisson_mpm/materials/soil.h>
#include <caisson_mpm/operators/boundary_conditions.h>
#include <caisson_mpm/operators/contact.h>
#include <caisson_mpm/operators/nodal_force.h>
#include <caisson_mpm/water/water_settings.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  class LidCompartment;

  /** What the water is in, and where it registers what it owns. References
   * only; all must outlive the water. */
  struct WaterScene
  {
    BackgroundGrid      &grid;
    MaterialPoints      &points;
    const Soil          &soil;
    const RigidBody     &body;
    const WaterSettings &settings;
    RunTotals           &totals;
    NodalForces         &forces;

    /** Whether the body is a caisson, which may have suction beneath its lid.
     */
    bool
    has_caisson() const
    {
      return body.shape().name == "caisson";
    }

    /** Whether there is suction beneath a lid where the level has none of
     * itself. */
    bool
    asks_for_suction() const
    {
      return has_caisson() &&
             settings.suction.control != SuctionSettings::Control::automatic;
    }
  };

  /** What other parts of the program must know of a model. */
  struct WaterTraits
  {
    bool has_excess_pressure = false;
    bool follows_clay        = false; // its pressure in undrained clay is known
    bool uses_permeability   = false;
    bool follows_soil        = false; // the pressure follows from its motion
    bool resists_body        = false; // so that resistance_to_body() counts
    // in each direction in the path of the body, without Split and merge
    unsigned int least_points = 1;
    double       bulk_modulus = 0.; // that resists changes of volume, Pa
    // beneath which there is suction, for which the force on the body is
    // needed; null without one
    const LidCompartment *lid = nullptr;
  };

  /** What a run prints of the water at its beginning. */
  struct WaterReport
  {
    std::vector<std::pair<std::string, std::string>> lines; // name, text
    std::vector<std::string>                         known_limits;
  };

  /**
   * The pore water of a scene, with the excess pressure beyond the hydrostatic
   * one. Submerged soil has its buoyant weight, so that nothing else of the
   * water acts on it.
   *
   * A derived class is one model. It is made once, by make_pore_water() when
   * all parameters are known, adds its numbers to the totals and its nodal
   * force to the forces, and follows the signals of the grid. The functions
   * here do nothing: a model overrides what it needs. Drained water, whose
   * excess pressure is zero, needs nothing. Whatever leaves a model is a
   * pressure in Pa. None of the functions is called for a single point.
   */
  class PoreWater
  {
  public:
    explicit PoreWater(const WaterScene &scene);
    virtual ~PoreWater() = default;

    PoreWater(const PoreWater &) = delete;
    PoreWater &
    operator=(const PoreWater &) = delete;

    /** Throw BadInput where the entries contradict each other, or the scene. */
    virtual void
    check_parameters() const
    {}

    /** Report which entries have no effect. */
    virtual void
    name_unused_entries(ParameterOrigins &origins) const;

    const WaterTraits &
    traits() const
    {
      return traits_;
    }

    // ---------------------------------------------------------- a step

    /** At the start of a step of this length, compute what is not known well
     * enough from earlier steps, and let the contact with a lid begin where the
     * soil touches it. Collective. Units: s. */
    virtual void
    begin_step(const double, const BoundaryConditions &, Contact &)
    {}

    /** Return what the water presses the body down with: suction beneath the
     * lid, and less pressure beneath the tip. Units: N. */
    virtual double
    load_on_body() const
    {
      return 0.;
    }

    /** Return the upward force of the water that belongs to the resistance of
     * the ground, as the effective force does: of the excess pressure on the
     * tip, and of the water beneath a sealed lid. The suction of a pump is none
     * of it. Units: N. */
    virtual double
    resistance_to_body() const
    {
      return 0.;
    }

    /** Return the pressure that the stress of each cell contains, for
     * Kernels::StepContext, or null. [n_cells], Pa */
    virtual const double *
    cell_pressure() const
    {
      return nullptr;
    }

    /** Return the rates of volume change [n_cells] that strain the soil, whose
     * nodes have this velocity in the end, or null where the velocity alone
     * says. Collective. 1/s */
    virtual const double *
    volume_rates(const Kernels::NodalVector *,
                 const std::vector<Kernels::CornerView> &)
    {
      return nullptr;
    }

    /**
     * Continue from a time by a step dt, with the force of the soil on the body
     * in it, in the direction of the travel, and the travel of the body. Return
     * the work at the tip that is not in that force. Units: s, N, m; J.
     */
    virtual double
    end_step(const double, const double, const double, const double)
    {
      return 0.;
    }

    /** Return why the run cannot continue, or an empty text. */
    virtual std::string
    reason_to_end() const
    {
      return "";
    }

    // ---------------------------------------------------------- records

    /**
     * Return whether files show the total stress of a material, less the
     * hydrostatic pressure: of clay with an undrained strength, whose law needs
     * no effective stress, unless the model computes the pressure in it.
     */
    bool
    shows_total_stress(const SoilMaterial &material) const
    {
      return material.has_undrained_strength() && !traits_.follows_clay;
    }

    /** Return of which materials files show the pressure of the points as a
     * part of their stress. [n_materials] */
    std::vector<bool>
    pressure_in_stress() const;

    /** Return whether files show an excess pressure. */
    bool
    shows_pressure() const;

    /** Give the points the pressure at their places. */
    virtual void
    write_pressure_to_points()
    {}

    /** Return the names of the numbers that water adds to a record. */
    std::vector<std::string>
    column_names() const;

    /** Return these numbers now; computes the flow where it is not known.
     * Collective. */
    virtual NamedNumbers
    columns()
    {
      return {};
    }

    /** Return new warnings, each once; after columns(). */
    virtual std::vector<std::string>
    take_warnings()
    {
      return {};
    }

    /** Return what a run prints of the water, with the materials of the layers.
     */
    virtual WaterReport
    report(const std::vector<Kernels::Material> &) const
    {
      return {};
    }

    // ---------------------------------------------------------- its state

    /** Return the fields from which the water continues: a checkpoint has them,
     * and they are kept when the parts of the ranks change. */
    virtual std::vector<GridField>
    fields()
    {
      return {};
    }

    /** Continue another run, with its Water/Level, its totals and the fields of
     * its checkpoint. Collective. */
    virtual void
    continue_after(const std::string &, const NamedFields &)
    {}

  protected:
    /** Return the groups of entries that the model uses, besides what follows
     * from its traits. */
    virtual std::vector<const Section *>
    used_groups() const
    {
      return {};
    }

    /** Return the numbers of a record as they are. */
    virtual NamedNumbers
    present_columns() const
    {
      return {};
    }

    /** Append a warning when a caisson is first pulled from soil whose water
     * cannot follow at once, while water flows freely beneath its lid. @p
     * advice: what to do, a clause. */
    void
    warn_of_open_lid(const double              suction,
                     const std::string        &advice,
                     std::vector<std::string> &warnings);

    /** Return " at a penetration of x m", or an empty text without a body. */
    std::string
    place_in_words() const;

    const WaterScene scene;
    WaterTraits      traits_;

  private:
    bool has_warned_of_open_lid = false;
  };

  /** Return whether a condition holds for the first time, and remember it. */
  bool
  holds_first(bool &has_held, const bool holds);

  /** Return the model that Water/Level chooses. */
  std::unique_ptr<PoreWater>
  make_pore_water(const WaterScene &scene);

  /** The smallest and the largest excess pore pressure of a record, and the
   * margin of the water where it is nearest to boiling: the absolute pressure
   * over that of vapor, at most that of the water on the mudline at rest. */
  class PressureExtremes
  {
  public:
    explicit PressureExtremes(const WaterScene &scene);

    /** Begin a record. */
    void
    begin();

    /** Include a pressure in the extremes. Units: Pa. */
    void
    include(const double pressure);

    /** Include a pressure at a place in the margin. Units: Pa, m. */
    void
    include_at(const double pressure, const double r, const double z);

    /** The same in the middle of a cell. */
    void
    include_in(const double pressure, const Kernels::CellGeometry &cell);

    /** Take the extremes of all ranks. Collective. */
    void
    end();

    NamedNumbers
    columns() const;

    /** Append a warning when the water would boil for the first time. @p place:
     * of the body, in words. Units: s. */
    void
    warn(const double              time,
         const std::string        &place,
         std::vector<std::string> &warnings);

  private:
    const WaterScene      scene;
    double                unit_weight = 0.; // of the water, N/m3
    double                at_rest     = 0.; // margin on the mudline, Pa
    double                smallest = 0., largest = 0.; // Pa
    std::array<double, 3> lowest     = {{0., 0., 0.}}; // margin, r, z; Pa, m
    bool                  has_warned = false;
  };
} // namespace CaissonMPM

#endif
