// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/kernels/laws.h>
#include <caisson_mpm/materials/soil_layer.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    using Kernels::LawDescription;

    std::string
    names_of_laws()
    {
      std::string names;
      for (const LawDescription &law : Kernels::law_table.law)
        names += (names.empty() ? "" : "|") + std::string(law.name);
      return names;
    }

    constexpr const char *minimum_void_ratio =
                           Kernels::Entries::minimum_void_ratio.name,
                         *maximum_void_ratio =
                           Kernels::Entries::maximum_void_ratio.name;

    /** The number of the law with this name. */
    int
    law_named(const std::string &name)
    {
      const auto &laws = Kernels::law_table.law;
      for (int i = 0; i < int(std::size(laws)); ++i)
        if (name == laws[i].name)
          return i;
      AssertThrow(false, ExcInternalError());
      return -1;
    }

    const LawDescription &
    description(const std::string &law)
    {
      return Kernels::law_table.law[law_named(law)];
    }

    bool
    has_entry(const std::string &law, const std::string &name)
    {
      for (int i = 0; i < description(law).n_entries; ++i)
        if (name == description(law).entry(i).name)
          return true;
      return false;
    }
  } // namespace

  SoilLayer::SoilLayer(const unsigned int index)
    : Section("/Soil/Layer " + to_text(index + 1))
    , porosity(soil.porosity, Patterns::Double(0., 0.95))
    , solid_density(soil.solid_density, Patterns::Double(1e-12))
    , permeability(soil.permeability, Patterns::Double(1e-20))
    , overconsolidation(1., Patterns::Double(1., 1e3))
    , sensitivity(1., Patterns::Double(1., 1e3))
  {
    soil.layer = index;
    add_parameter(
      "Top depth",
      soil.top_depth,
      "m",
      "The layer's upper boundary has this depth below the soil surface, which "
      "must be 0 for layer 1.",
      Patterns::Double(0.));
    // fill_like_layers() reads it
    add_entry(
      *this,
      "Like layer",
      "none",
      "",
      "The layer takes all entries that it does not set itself, but for Top "
      "depth, from the layer above of this number.",
      WordOrNumber("none", {}, Patterns::Integer(1)),
      [](const std::string &) {});
    add_parameter("Law",
                  law,
                  "",
                  "The constitutive law gives the stress in the layer.",
                  Patterns::Selection(names_of_laws()));
    for (const LawDescription &law : Kernels::law_table.law)
      for (int i = 0; i < law.n_entries; ++i)
        {
          const Kernels::Entry &e = law.entry(i);
          const auto [place, is_new] =
            values.try_emplace(e.name,
                               e.value,
                               Patterns::Double(e.smallest, e.largest));
          if (is_new)
            add_profile(*this, e.name, place->second, e.unit, e.text);
        }
    declare_density();
    declare_earth_pressure();
    declare_permeability();
    add_choice(
      *this,
      "Stress measure",
      soil.stress_measure,
      {{"Cauchy", Kernels::StressMeasure::cauchy},
       {"Kirchhoff", Kernels::StressMeasure::kirchhoff}},
      "",
      "The elastic law is formulated in this stress: with Kirchhoff, it is "
      "Hencky's law for the logarithmic strain since the start. Strength is "
      "always that of the Cauchy stress.");
    declare_user_material();
    declare_walls();
  }

  void
  SoilLayer::declare_walls()
  {
    add_word_or_profile(
      *this,
      "Friction angle of the walls",
      wall_friction_angle,
      "of the body",
      "degrees",
      "The angle of friction between the layer and the inner and outer wall of "
      "the body, instead of the body's own.",
      Patterns::Double(0., 89.));
    add_word_or_profile(
      *this,
      "Adhesion factor of the walls",
      adhesion_factor,
      "of the body",
      "",
      "The adhesion between the layer and the inner and outer wall of the body "
      "is this factor alpha times Cohesion (of NGI-ADP: the strength in direct "
      "simple shear) over Sensitivity, instead of the body's own.",
      Patterns::Double(0., 10.));
    add_profile(
      *this,
      "Sensitivity",
      sensitivity,
      "",
      "The strength of clay over that of the same clay after it has been "
      "remoulded, as at the walls.");
  }

  void
  SoilLayer::declare_density()
  {
    add_profile(
      *this,
      "Porosity",
      porosity,
      "",
      "The porosity is the share of the pores in the volume of the soil at the "
      "start.");
    add_profile(*this,
                "Solid density",
                solid_density,
                "kg/m3",
                "The solid density is that of the grains, without pores.");
    add_word_or_profile(
      *this,
      "Relative density",
      relative_density,
      "by porosity",
      "",
      "The relative density D gives the void ratio at the start as e_max - D "
      "(e_max - e_min), instead of Porosity.",
      Patterns::Double(-0.2, 1.3));
    add_word_or_profile(
      *this,
      "Void ratio",
      void_ratio,
      "by porosity",
      "",
      "The void ratio e at the start gives the porosity as e / (1 + e), "
      "instead of Porosity.",
      Patterns::Double(0., 19.));
    add_word_or_profile(
      *this,
      "Dry density",
      dry_density,
      "by solids",
      "kg/m3",
      "The dry density at the start is the mass of the grains over the volume "
      "of the soil, instead of Solid density.",
      Patterns::Double(1e-12));
  }

  void
  SoilLayer::declare_earth_pressure()
  {
    add_word_or_profile(
      *this,
      "K0",
      k0,
      "auto",
      "",
      "K0 is the ratio of the horizontal to the vertical effective stress at "
      "the start; auto takes the value of the layer's law: 1 - sin(phi), which "
      "is 1 where the friction angle is 0, or nu / (1 - nu) for a linear "
      "elastic law.",
      Patterns::Double(0., 10.),
      -1.);
    add_profile(
      *this,
      "Overconsolidation ratio",
      overconsolidation,
      "",
      "With K0 = auto, K0 is multiplied by this ratio to the power sin(phi) "
      "(Mayne and Kulhawy 1982). Where the friction angle is 0, set K0 "
      "itself.");
  }

  void
  SoilLayer::declare_permeability()
  {
    add_profile(*this,
                "Permeability",
                permeability,
                "m/s",
                "The permeability to water in the vertical, where water flows "
                "(Water/Level).")
      .influence = Influence::motion;
    add_parameter("Permeability ratio",
                  soil.anisotropy,
                  "",
                  "The horizontal permeability over the vertical one.",
                  Patterns::Double(1e-6, 1e6))
      .influence = Influence::motion;
    add_parameter(
      "Permeability by void ratio",
      soil.loosening_conducts,
      "",
      "The permeability follows the void ratio e as e3/(1 + e) "
      "(Kozeny-Carman); Permeability is that of the porosity at the start.")
      .influence = Influence::motion;
  }

  void
  SoilLayer::name_unused_entries(ParameterOrigins &origins) const
  {
    std::vector<std::string> unused;
    for (const auto &[name, value] : values)
      if (!has_entry(law, name) &&
          !(relative_density &&
            (name == minimum_void_ratio || name == maximum_void_ratio)))
        unused.push_back(section() + "/" + name);
    if (law != Kernels::UserMaterial::name)
      unused.insert(unused.end(), user_entries.begin(), user_entries.end());
    origins.add_unused(unused, section() + "/Law is " + law);
    if (!adhesion_factor)
      origins.add_unused({section() + "/Sensitivity"},
                         section() +
                           "/Adhesion factor of the walls is of the body");
    if (k0)
      origins.add_unused({section() + "/Overconsolidation ratio"},
                         section() + "/K0 is not auto");
    else if (!has_friction())
      origins.add_unused({section() + "/Overconsolidation ratio"},
                         section() + "/K0 = auto does not depend on it without "
                                     "a friction angle. Set K0");
    if (relative_density)
      origins.add_unused({section() + "/Porosity"},
                         section() + "/Relative density is set");
    if (void_ratio)
      origins.add_unused({section() + "/Porosity"},
                         section() + "/Void ratio is set");
    if (dry_density)
      origins.add_unused({section() + "/Solid density"},
                         section() + "/Dry density is set");
  }

  bool
  SoilLayer::has_friction() const
  {
    for (const char *const name :
         {Kernels::Entries::friction_angle.name,
          Kernels::Entries::critical_friction_angle.name})
      if (has_entry(law, name))
        return !values.at(name).is_constant() ||
               values.at(name).unchecked({}) > 0.;
    return false;
  }

  std::string
  SoilLayer::section() const
  {
    return soil.section();
  }

  std::vector<const Profile *>
  SoilLayer::profiles() const
  {
    std::vector<const Profile *> result = {&density_of_state(),
                                           dry_density ? dry_density.get() :
                                                         &solid_density,
                                           &permeability,
                                           k0 ? k0.get() : &overconsolidation};
    if (relative_density)
      for (const char *const name : {minimum_void_ratio, maximum_void_ratio})
        result.push_back(&values.at(name));
    if (wall_friction_angle)
      result.push_back(wall_friction_angle.get());
    if (adhesion_factor)
      {
        result.push_back(adhesion_factor.get());
        result.push_back(&sensitivity);
      }
    for (int i = 0; i < description(law).n_entries; ++i)
      result.push_back(&values.at(description(law).entry(i).name));
    return result;
  }

  const Profile &
  SoilLayer::density_of_state() const
  {
    return relative_density ? *relative_density :
           void_ratio       ? *void_ratio :
                              porosity;
  }

  bool
  SoilLayer::varies() const
  {
    const auto all = profiles();
    return std::any_of(all.begin(), all.end(), [](const Profile *p) {
      return !p->is_constant();
    });
  }

  double
  SoilLayer::change(const double top,
                    const double stress_at_top,
                    const double bottom,
                    const double stress_at_bottom) const
  {
    double result = 0.;
    for (const Profile *const p : profiles())
      {
        // of the mean stress the change counts only
        const double above = p->unchecked({top, stress_at_top, stress_at_top}),
                     below = p->unchecked(
                       {bottom, stress_at_bottom, stress_at_bottom}),
                     larger = std::max(std::abs(above), std::abs(below));
        if (!std::isfinite(above) || !std::isfinite(below))
          return std::numeric_limits<double>::infinity();
        if (larger > 0.)
          result = std::max(result, std::abs(above - below) / larger);
      }
    return result;
  }

  void
  SoilLayer::check_parameters() const
  {
    if (relative_density && void_ratio)
      throw BadInput(relative_density->name() + " and " + void_ratio->name() +
                     " both set how dense the layer is. Remove one of them.");
    for (const Profile *const p :
         {&density_of_state(),
          &solid_density,
          static_cast<const Profile *>(dry_density.get()),
          &values.at(minimum_void_ratio),
          &values.at(maximum_void_ratio)})
      if (p != nullptr && p->knows_stress())
        throw BadInput(p->name() +
                       " depends on s or p, the stress at the start, which "
                       "follows from it. Write it with the depth d alone.");
    for (const Profile *const p :
         {static_cast<const Profile *>(k0.get()), &overconsolidation})
      if (p != nullptr && p->depends_on("p"))
        throw BadInput(p->name() +
                       " depends on p, the mean stress at the start, which "
                       "follows from it. Write it with d and s.");
  }

  double
  SoilLayer::porosity_at(const PlaceInGround &place) const
  {
    if (void_ratio)
      return (*void_ratio)(place) / (1. + (*void_ratio)(place));
    if (!relative_density)
      return porosity(place);
    const double e_min = values.at(minimum_void_ratio)(place),
                 e_max = values.at(maximum_void_ratio)(place);
    if (e_min <= 0. || e_min >= e_max)
      throw BadInput(section() + "/Relative density needs " + section() +
                     "/Minimum void ratio = " + to_text(e_min) +
                     " above 0 and below Maximum void ratio = " +
                     to_text(e_max) + ". Set both.");
    const double e = e_max - (*relative_density)(place) * (e_max - e_min);
    if (e < 0.)
      throw BadInput(relative_density->name() + " gives a void ratio of " +
                     to_text(e, 3) + " at a depth of " +
                     to_text(place.depth, 4) + " m. Reduce it.");
    return e / (1. + e);
  }

  SoilMaterial
  SoilLayer::weight_at(const double depth) const
  {
    SoilMaterial result = soil;
    result.top_depth    = depth;
    result.porosity     = porosity_at({depth, 0., 0.});
    if (relative_density)
      result.relative_density = (*relative_density)({depth, 0., 0.});
    result.solid_density =
      dry_density ? (*dry_density)({depth, 0., 0.}) / (1. - result.porosity) :
                    solid_density({depth, 0., 0.});
    return result;
  }

  void
  SoilLayer::set_values(SoilMaterial &result, const PlaceInGround &place) const
  {
    result.law          = law_named(law);
    result.permeability = permeability(place);
    std::vector<double>   of_law;
    const LawDescription &description = Kernels::law_table.law[result.law];
    for (int i = 0; i < description.n_entries; ++i)
      of_law.push_back(values.at(description.entry(i).name)(place));
    result.set_law_values(of_law);
  }

  void
  SoilLayer::set_walls(SoilMaterial &result, const PlaceInGround &place) const
  {
    if (wall_friction_angle)
      result.wall_friction_angle = (*wall_friction_angle)(place);
    if (!adhesion_factor)
      return;
    const auto strength = result.shear_strength;
    if (!strength)
      throw BadInput(adhesion_factor->name() + ", but the law " + law +
                     " has no undrained strength. Set it to \"of the body\".");
    result.wall_adhesion =
      (*adhesion_factor)(place) * *strength / sensitivity(place);
  }

  double
  SoilLayer::earth_pressure_at(const SoilMaterial  &material,
                               const PlaceInGround &place) const
  {
    if (k0)
      return (*k0)(place);
    const double ratio  = overconsolidation(place);
    double       result = material.earth_pressure_of_law();
    if (ratio > 1.)
      result *=
        std::pow(ratio,
                 std::sin(material.friction_angle.value_or(0.) * pi / 180.));
    return result;
  }

  SoilMaterial
  SoilLayer::material_at(const double                depth,
                         const double                vertical_stress,
                         const std::optional<double> given_ratio) const
  {
    SoilMaterial  result = weight_at(depth);
    PlaceInGround place  = {depth, vertical_stress, vertical_stress};
    // K0 may depend on the law, whose numbers may depend on K0 by the mean
    // stress: the friction angle does so little that this is done once
    for (int i = 0; i < 2; ++i)
      {
        set_values(result, place);
        result.earth_pressure_at_rest =
          given_ratio ? *given_ratio : earth_pressure_at(result, place);
        place.mean_stress =
          vertical_stress * (1. + 2. * result.earth_pressure_at_rest) / 3.;
      }
    set_values(result, place);
    set_walls(result, place);
    try
      {
        result.check();
      }
    catch (const BadInput &error)
      {
        if (!varies())
          throw;
        throw BadInput(std::string(error.what()) +
                       " These are the values at a depth of " +
                       to_text(depth, 4) + " m" +
                       (given_ratio || k0 || overconsolidation.is_constant() ?
                          "" :
                          ", with " + overconsolidation.name()) +
                       ".");
      }
    return result;
  }
} // namespace CaissonMPM
