// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The entries of section "Method": how points and nodes exchange velocity, how
// the internal force is integrated, and what keeps a step stable.
#ifndef caisson_mpm_operators_method_settings_h
#define caisson_mpm_operators_method_settings_h

#include <caisson_mpm/base/parameter_origins.h>
#include <caisson_mpm/base/section.h>
#include <caisson_mpm/kernels/layout.h>

#include <optional>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /** The length of a step. What acts in each step is stated for the Courant
   * number of reference, and acts in proportion in shorter ones: results do not
   * depend on the step. */
  struct StepSize
  {
    static constexpr double reference_courant = .8;

    double seconds;
    double courant; // over the stability limit of the soil without its water

    /** The number of steps of reference in this one. */
    double
    n_reference_steps() const
    {
      return courant / reference_courant;
    }
  };

  /** Which nodal velocities strain the points. */
  enum class StressUpdate
  {
    automatic, // usl with an inertia tolerance, else musl
    musl,      // those that the updated points bring back
    usl        // the new nodal velocities
  };

  /**
   * The choices of the method. Constant during a run; every rank has the same.
   */
  class MethodSettings : public Section
  {
  public:
    MethodSettings();

    /** Throws BadInput. */
    void
    check_parameters() const;

    /** Report which entries the other choices leave without effect. */
    void
    name_unused_entries(ParameterOrigins &origins) const override;

    /** Choose the velocities that strain the points. MUSL is unstable beside
     * cells whose inertia is lumped: where masses are scaled selectively, it is
     * no choice. Throws BadInput. */
    void
    choose_stress_update(const bool scales_selectively);

    /** Choose the share of FLIP where it is not set. As a rule the lost work of
     * the blend is the larger error. In a scene that @p vibrates it is the
     * vibrations: of hypoplastic sand, of water that follows the soil, of a
     * body that the soil carries. */
    void
    choose_flip_fraction(const bool vibrates)
    {
      flip_fraction_of_scene = vibrates ? 0.95 : 0.99;
    }

    /** The FLIP fraction of the scene; nothing with auto. */
    std::optional<double>
    given_flip_fraction() const
    {
      return flip_fraction;
    }

    /** Share of a point's own velocity that it keeps (FLIP: 1). */
    double
    keep_velocity(const StepSize &step) const;

    /** Order of XPIC in what it does not keep; 1: PIC. */
    unsigned int
    filter_order() const
    {
      return xpic_order;
    }

    bool
    uses_musl() const
    {
      return stress_update != StressUpdate::usl;
    }

    bool
    uses_mean_volume() const
    {
      return mean_volume;
    }

    /** Share of the out-of-balance force that damping takes. */
    double
    local_damping() const
    {
      return damping;
    }

    Kernels::IntegrationSettings
    integration() const;

    Kernels::UpdateSettings
    update(const StepSize &step) const;

    /** Return one line for the summary of a run. */
    std::string
    description() const;

    /** Return warnings where the choices are known to fail in scenes with a
     * body that is pushed. */
    std::vector<std::string>
    known_limits() const;

  private:
    void
    declare_transfer();
    void
    declare_integration();
    void
    declare_stability();

    /** Whether no cell takes Gauss points. */
    bool
    integrates_at_points() const
    {
      return full_fraction == never_full;
    }

    static constexpr double never_full = 2.; // fraction of a cell

    StressUpdate           stress_update = StressUpdate::automatic;
    Kernels::PressureSlope pressure_fit  = Kernels::PressureSlope::by_dilation;
    unsigned int           xpic_order    = 2;
    std::optional<double>  flip_fraction; // else by the scene
    double                 flip_fraction_of_scene = 0.95;
    double                 full_fraction          = 0.9;
    bool                   mean_volume            = true;
    double                 stress_filter          = 0.01;
    bool                   minimum_nodal_mass     = true;
    double                 damping                = 0.;
    std::optional<double>  limiter_factor         = 0.75;
  };
} // namespace CaissonMPM

#endif
