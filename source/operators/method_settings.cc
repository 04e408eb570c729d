// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/operators/method_settings.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    const Choices<StressUpdate>           stress_updates = {{"auto",
                                                             StressUpdate::automatic},
                                                            {"MUSL", StressUpdate::musl},
                                                            {"USL", StressUpdate::usl}};
    const Choices<Kernels::PressureSlope> pressure_fits  = {
       {"auto", Kernels::PressureSlope::by_dilation},
       {"affine", Kernels::PressureSlope::acts},
       {"mean", Kernels::PressureSlope::ignored}};
  } // namespace

  MethodSettings::MethodSettings()
    : Section("/Method")
  {
    declare_transfer();
    declare_integration();
    declare_stability();
  }

  void
  MethodSettings::declare_transfer()
  {
    add_parameter("XPIC order",
                  xpic_order,
                  "",
                  "XPIC has this order; order 1 is PIC.",
                  Patterns::Integer(1, 10));
    add_word_or_number(
      *this,
      "FLIP fraction",
      flip_fraction,
      "auto",
      {},
      "",
      "Points take this share of their velocity from FLIP in a step with a "
      "Courant number of 0.8, and the rest from XPIC; in shorter steps the "
      "share of XPIC is smaller, in proportion. 1 is FLIP, and 0 is XPIC. With "
      "auto it is 0.99 where all layers are Mohr-Coulomb soil, the water is "
      "neither undrained nor coupled, and no loads move the body. Elsewhere it "
      "is 0.95.",
      Patterns::Double(0., 1.));
    add_choice(
      *this,
      "Stress update",
      stress_update,
      stress_updates,
      "",
      "MUSL strains the points with the velocities that the updated points "
      "bring back to the nodes, and USL with the new nodal velocities; auto is "
      "USL with an inertia tolerance, and else MUSL.");
  }

  void
  MethodSettings::declare_integration()
  {
    add_parameter(
      "Full cell fraction",
      full_fraction,
      "",
      "The internal force of a cell at a free surface is integrated at Gauss "
      "points only if its material points fill this share of its volume; with "
      "0.05 less, it is integrated at these points only. Inside the soil a share "
      "of 0.4 is enough. 2 is at material points everywhere.",
      Patterns::Double(0.1, never_full));
    add_choice(
      *this,
      "Pressure in full cells",
      pressure_fit,
      pressure_fits,
      "",
      "The mean stress of the points of a full cell is fitted by an affine "
      "function, as the deviator always is, or by its mean; auto changes to "
      "the mean where soil that gains volume in shear has dilated by 0.5 to 2 "
      "%.");
    add_parameter(
      "Mean volume change",
      mean_volume,
      "",
      "The points of a cell are strained with its mean volume change (B-bar), "
      "which prevents locking.");
    add_parameter(
      "Stress filter",
      stress_filter,
      "",
      "In full cells a step with a Courant number of 0.8 removes this share of "
      "the misfit between the stress of a point and the affine fit of its "
      "cell, which changes no nodal force; shorter steps remove less, in "
      "proportion.",
      Patterns::Double(0., 1.));
  }

  void
  MethodSettings::declare_stability()
  {
    add_parameter(
      "Mass floor",
      minimum_nodal_mass,
      "",
      "Nodes below the minimum nodal mass that the time step needs respond as "
      "if they had it, and their neighbors take the rest of the impulse.");
    add_parameter(
      "Local damping",
      damping,
      "",
      "This share of the out-of-balance force of a node acts against its "
      "velocity, except at the body.",
      Patterns::Double(0., 0.95))
      .influence = Influence::motion;
    add_word_or_number(
      *this,
      "Limiter factor",
      limiter_factor,
      "none",
      {},
      "",
      "The velocity of points in cells next to the body is limited to k H / "
      "dt, with this factor k, the shortest side H of the cell and the step dt "
      "at a Courant number of 0.8; none does not limit it.",
      Patterns::Double(0.01, 1.));
  }

  void
  MethodSettings::choose_stress_update(const bool scales_selectively)
  {
    if (stress_update == StressUpdate::automatic)
      stress_update =
        scales_selectively ? StressUpdate::usl : StressUpdate::musl;
    if (scales_selectively && uses_musl())
      throw BadInput("Method/Stress update = MUSL is unstable with "
                     "Time/Inertia tolerance. Set it to auto, or the tolerance "
                     "to none.");
  }

  void
  MethodSettings::check_parameters() const
  {
    if (!uses_musl() && flip_fraction == 1. && damping == 0. &&
        !minimum_nodal_mass)
      throw BadInput("Method/Stress update = USL with Method/FLIP fraction = 1 "
                     "needs Mass floor = true or Local damping: it is unstable "
                     "at nodes with little mass.");
  }

  void
  MethodSettings::name_unused_entries(ParameterOrigins &origins) const
  {
    if (flip_fraction == 1.)
      origins.add_unused({"Method/XPIC order"}, "Method/FLIP fraction is 1");
    if (integrates_at_points())
      origins.add_unused({"Method/Pressure in full cells",
                          "Method/Stress filter"},
                         "no cell is full with Method/Full cell fraction = 2");
  }

  double
  MethodSettings::keep_velocity(const StepSize &step) const
  {
    return std::pow(flip_fraction.value_or(flip_fraction_of_scene),
                    step.n_reference_steps());
  }

  Kernels::IntegrationSettings
  MethodSettings::integration() const
  {
    constexpr double inside = .4;
    return {full_fraction,
            integrates_at_points() ? full_fraction :
                                     std::min(full_fraction, inside),
            minimum_nodal_mass,
            pressure_fit};
  }

  Kernels::UpdateSettings
  MethodSettings::update(const StepSize &step) const
  {
    const double n = step.n_reference_steps();
    return {step.seconds,
            keep_velocity(step),
            mean_volume,
            limiter_factor.value_or(0.) * n,
            1. - std::pow(1. - stress_filter, n)};
  }

  std::string
  MethodSettings::description() const
  {
    const std::string xpic = "XPIC(" + to_text(xpic_order) + ")";
    return name_of(stress_updates, stress_update) + ", " +
           (flip_fraction == 1. ? "FLIP" :
            flip_fraction != 0. ? "FLIP and " + xpic :
            xpic_order == 1     ? "PIC" :
                                  xpic) +
           ", " +
           (integrates_at_points() ? "material points" : "Gauss in full cells");
  }

  std::vector<std::string>
  MethodSettings::known_limits() const
  {
    std::vector<std::string> limits;
    if (integrates_at_points())
      limits.push_back("Method/Full cell fraction = 2 causes noise "
                       "where points cross cells; it was found to halve the "
                       "tip force of a caisson: see doc/limitations.md");
    if (flip_fraction == 0. && xpic_order == 1)
      limits.push_back(
        "Method/XPIC order = 1 is PIC, which is viscous: a pulse "
        "loses a third of its energy over 20 of its lengths: "
        "see doc/limitations.md");
    return limits;
  }
} // namespace CaissonMPM
