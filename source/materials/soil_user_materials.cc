// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the soil knows of the laws that the user has written.
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/materials/soil.h>

#include <algorithm>

namespace CaissonMPM
{
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
