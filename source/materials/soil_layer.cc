// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/kernels/laws.h>
#include <caisson_mpm/materials/soil_layer.h>

#include <deal.II/base/patterns.h>

#include <iterator>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    using Kernels::LawDescription;
    using Kernels::LawEntry;

    /** Call action(law) for all laws. */
    template <typename Action>
    void
    for_each_law(const Action &action)
    {
      for (const LawDescription &law : Kernels::law_table.law)
        if (law.name != nullptr)
          action(law);
    }

    std::string
    names_of_laws()
    {
      std::string names;
      for_each_law([&](const LawDescription &law) {
        names += (names.empty() ? "" : "|") + std::string(law.name);
      });
      return names;
    }

    /** The number of the law with this name. */
    int
    law_named(const std::string &name)
    {
      const auto &laws = Kernels::law_table.law;
      for (int i = 0; i < int(std::size(laws)); ++i)
        if (laws[i].name != nullptr && name == laws[i].name)
          return i;
      AssertThrow(false, ExcInternalError());
      return -1;
    }
  } // namespace

  SoilLayer::SoilLayer(const unsigned int index)
    : ParameterAcceptor("/Soil/Layer " + to_text(index + 1))
  {
    soil.layer = index;
    add_parameter("Top depth",
                  soil.top_depth,
                  "The depth of the layer's upper boundary below the soil "
                  "surface must be 0 for layer 1. Units: m.",
                  prm,
                  Patterns::Double(0.));
    add_parameter("Law",
                  law,
                  "The constitutive law gives the stress in the layer. Units: "
                  "none.",
                  prm,
                  Patterns::Selection(names_of_laws()));
    for_each_law([this](const LawDescription &law) {
      for (int i = 0; i < law.n_entries; ++i)
        {
          const LawEntry &e = law.entries[i];
          if (values.count(e.name) > 0)
            continue;
          double &value = values[e.name] = e.value;
          add_parameter(e.name,
                        value,
                        e.text,
                        prm,
                        Patterns::Double(e.smallest, e.largest));
        }
    });
    add_parameter("Porosity",
                  soil.porosity,
                  "The porosity is the share of the pores in the volume of the "
                  "soil at the start. Units: none.",
                  prm,
                  Patterns::Double(0., 0.95));
    add_parameter("Solid density",
                  soil.solid_density,
                  "The solid density is that of the grains, without pores. "
                  "Units: kg/m3.",
                  prm,
                  Patterns::Double(1e-12));
    add_word_or_number(*this,
                       "K0",
                       k0,
                       "auto",
                       -1.,
                       "K0 is the ratio of the horizontal to the vertical "
                       "effective stress at the start; auto takes the value of "
                       "the layer's law, 1 - sin(phi) or, without a friction "
                       "angle, nu / (1 - nu). Units: none.",
                       Patterns::Double(0., 10.));
    declare_permeability();
    declare_internal_length();
  }

  void
  SoilLayer::declare_permeability()
  {
    add_parameter("Permeability",
                  soil.permeability,
                  "The permeability to water in the vertical, where water "
                  "flows (Water/Level). Units: m/s.",
                  prm,
                  Patterns::Double(1e-20));
    add_parameter("Permeability ratio",
                  soil.anisotropy,
                  "The horizontal permeability over the vertical one. Units: "
                  "none.",
                  prm,
                  Patterns::Double(1e-6, 1e6));
    add_parameter("Permeability by void ratio",
                  soil.loosening_conducts,
                  "The permeability follows the void ratio e as e3/(1 + e) "
                  "(Kozeny-Carman); Permeability is that of the porosity at "
                  "the start. Units: none.");
  }

  void
  SoilLayer::declare_internal_length()
  {
    add_parameter(
      "Internal length",
      soil.internal_length,
      "The strength of soil that shears grows by the share l g / v, "
      "where l is this length, g the rate of shear and v the "
      "internal velocity, so that a shear band is some of these "
      "lengths wide; 0 leaves its width to the mesh. Units: m.",
      prm,
      Patterns::Double(0.));
    add_parameter("Internal velocity",
                  soil.internal_velocity,
                  "The internal length is that of shear bands whose sides pass "
                  "each other at this velocity, which should be that of the "
                  "body. Units: m/s.",
                  prm,
                  Patterns::Double(1e-12));
  }

  void
  SoilLayer::name_unused_entries(ParameterOrigins &origins) const
  {
    const LawDescription &description = Kernels::law_table.law[law_named(law)];
    std::vector<std::string> unused;
    for (const auto &entry : values)
      {
        bool is_used = false;
        for (int i = 0; i < description.n_entries; ++i)
          is_used = is_used || entry.first == description.entries[i].name;
        if (!is_used)
          unused.push_back(section() + "/" + entry.first);
      }
    origins.add_unused(unused, section() + "/Law is " + law);
    if (soil.internal_length == 0.)
      origins.add_unused({section() + "/Internal velocity"},
                         section() + "/Internal length is 0");
  }

  std::string
  SoilLayer::section() const
  {
    return soil.section();
  }

  SoilMaterial
  SoilLayer::material() const
  {
    SoilMaterial result = soil;
    result.law          = law_named(law);
    result.law_values.clear();
    const LawDescription &description = Kernels::law_table.law[result.law];
    for (int i = 0; i < description.n_entries; ++i)
      result.law_values.push_back(values.at(description.entries[i].name));
    result.earth_pressure_at_rest = k0 ? *k0 : result.earth_pressure_of_law();
    return result;
  }
} // namespace CaissonMPM
