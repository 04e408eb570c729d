// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What layers and soil know of the laws that the user has written.
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/kernels/laws.h>
#include <caisson_mpm/materials/soil.h>
#include <caisson_mpm/materials/umat_law.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    /** The entries that say how the UMAT wants to be called. */
    void
    declare_kind_of_umat(Section &owner, UmatSettings &umat)
    {
      owner.add_parameter(
        "Routine",
        umat.routine,
        "",
        "The name of the UMAT in its library; MODULE::NAME is a routine in a "
        "module of gfortran.",
        Patterns::Anything());
      owner.add_parameter(
        "Material name",
        umat.name,
        "",
        "A user material gets this name as CMNAME, in capitals; without it "
        "that of its section, as SOIL-LAYER-1.",
        Patterns::Anything());
      add_choice(
        owner,
        "Stress components",
        umat.n_components,
        {{"4", 4U}, {"6", 6U}},
        "",
        "A user material works on so many components (NTENS): 4 are 11, 22, "
        "33, 12, and 6 also 13, 23, which are 0, for a UMAT of three "
        "dimensions.");
      add_choice(
        owner,
        "Unit of stress",
        umat.unit,
        {{"Pa", 1.}, {"kPa", 1e3}, {"MPa", 1e6}},
        "",
        "A user material computes STRESS and DDSDDE in this unit. The program "
        "converts these two only, and not the Properties.");
    }
  } // namespace

  void
  SoilLayer::declare_user_material()
  {
    const std::size_t n_before = entries().size();
    add_parameter(
      "Library",
      umat_settings.library,
      "",
      "The shared library of a user material, a UMAT of Abaqus, has this path, "
      "relative to the file that sets this entry (with --set, to the scene's "
      "file).");
    declare_kind_of_umat(*this, umat_settings);
    add_entry(
      *this,
      "Properties",
      "",
      "those of the library",
      "The user material gets these numbers as PROPS, with commas between "
      "them; none gives it no number.",
      Patterns::Anything(),
      [this](const std::string &text) { properties_text = text; });
    add_parameter("State variables",
                  umat_settings.n_variables,
                  "",
                  "A user material keeps so many numbers STATEV of each point.",
                  Patterns::Integer(0, 1000));
    add_parameter(
      "State at the start",
      umat_settings.variables,
      "those of the library",
      "The first STATEV have these values at the start, and the others 0; a "
      "subroutine SDVINI in the library may change them for each point.",
      Patterns::List(Patterns::Double(), 0, 1000));
    add_choice(
      *this,
      "Volume in shear",
      soil.volume_in_shear,
      {{"by state", Kernels::VolumeInShear::by_state},
       {"kept", Kernels::VolumeInShear::kept},
       {"gained", Kernels::VolumeInShear::gained}},
      "",
      "Plastic shear of a user material changes the volume as the state says, "
      "not at all, or only makes it larger: this decides how a cell takes the "
      "pressure of its points.");
    user_entries.assign(entries().begin() + n_before, entries().end());
  }

  void
  SoilLayer::load_library(const ParameterOrigins &origins)
  {
    if (law != Kernels::UserMaterial::name)
      return;
    const std::string needs =
      section() + "/Law = " + law + " needs " + section();
    if (umat_settings.library.empty())
      throw BadInput(needs + "/Library. Set it to the path of the shared "
                             "library with the UMAT, relative to the file "
                             "that sets it.");
    if (properties_text.empty())
      throw BadInput(needs + "/Properties. Set it to the PROPS of the UMAT, "
                             "with commas between them, or to none.");
    if (properties_text != "none")
      try
        {
          umat_settings.properties = Utilities::string_to_double(
            Utilities::split_string_list(properties_text));
        }
      catch (const ExceptionBase &)
        {
          throw BadInput(section() + "/Properties = " + properties_text +
                         " is no list of numbers. Write numbers with commas "
                         "between them, or none.");
        }
    if (umat_settings.name.size() > UmatArgument::length_of_cmname)
      throw BadInput(section() + "/Material name = " + umat_settings.name +
                     " has more than " +
                     to_text(UmatArgument::length_of_cmname) +
                     " characters. Shorten it.");
    const std::size_t n = umat_settings.variables.size();
    if (n > umat_settings.n_variables)
      throw BadInput(
        section() + "/State at the start has " + to_text(n) + " numbers, but " +
        section() + "/State variables = " + to_text(umat_settings.n_variables) +
        ". Raise it, or remove numbers.");
    soil.umat =
      std::make_shared<UmatLaw>(umat_settings,
                                section(),
                                origins.directory_of(section() + "/Library"));
  }

  void
  Soil::load_libraries(const ParameterOrigins &origins)
  {
    for (unsigned int i = 0;
         i < std::min<std::size_t>(n_layers_, layers.size());
         ++i)
      layers[i]->load_library(origins);
  }

  std::string
  Soil::checksums_of_libraries() const
  {
    std::string lines;
    for (const auto &layer : layers)
      if (layer->umat() != nullptr)
        lines += layer->section() +
                 "/Library (checksum) = " + layer->umat()->checksum() + "\n";
    return lines;
  }

  std::vector<std::string>
  Soil::user_routines() const
  {
    std::vector<std::string> names;
    for (const auto &layer : layers)
      if (layer->umat() != nullptr)
        names.push_back(layer->umat()->name());
    return names;
  }

  unsigned int
  Soil::n_user_state() const
  {
    unsigned int n = 0;
    for (const auto &layer : layers)
      if (layer->umat() != nullptr)
        n = std::max(n, layer->umat()->n_state());
    return n;
  }

  std::vector<bool>
  Soil::user_materials() const
  {
    std::vector<bool> result;
    for (const SoilMaterial &m : materials)
      result.push_back(m.umat != nullptr);
    return result;
  }

  std::string
  Soil::cause_in_user_materials() const
  {
    std::string sections;
    for (const auto &layer : layers)
      if (layer->umat() != nullptr)
        {
          if (!layer->umat()->failure().empty())
            return ""; // the UMAT is the cause
          sections +=
            (sections.empty() ? "" : ", ") + layer->section() + "/Library";
        }
    return sections.empty() ? "" :
                              "\nA user material (" + sections +
                                ") may be the cause, too: the time step "
                                "follows from its DDSDDE, and its STRESS was "
                                "checked at small strains only.";
  }

  void
  Soil::begin_step(const double       time,
                   const double       step_size,
                   const unsigned int step) const
  {
    for (const auto &layer : layers)
      if (layer->umat() != nullptr)
        layer->umat()->begin_step(time, step_size, step);
  }

  void
  Soil::check_user_materials() const
  {
    for (const auto &layer : layers)
      if (layer->umat() != nullptr && !layer->umat()->failure().empty())
        throw RunFailure(layer->umat()->failure());
  }
} // namespace CaissonMPM
