// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/declared_entries.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/materials/like_layer.h>

#include <deal.II/base/parameter_acceptor.h>

#include <algorithm>

namespace CaissonMPM
{
  namespace
  {
    const std::string like = "Like layer";

    std::string
    section_of(const unsigned int layer)
    {
      return "Soil/Layer " + to_text(layer);
    }

    /** Return the entries that say the same as @p name in another way, and the
     * entry itself. */
    std::vector<std::string>
    alternatives_to(const std::string &name)
    {
      const std::vector<std::vector<std::string>> groups = {
        {"Porosity", "Void ratio", "Relative density"},
        {"Solid density", "Dry density"},
        {"K0", "Overconsolidation ratio"}};
      for (const auto &group : groups)
        if (std::find(group.begin(), group.end(), name) != group.end())
          return group;
      return {name};
    }

    /** Return the number of the layer that this one is like, 0 without one. */
    unsigned int
    number_of_model(const unsigned int layer)
    {
      const EntryRecord &entry = *find_entry(section_of(layer) + "/" + like);
      const std::string  value = entry.value();
      if (value == "none")
        return 0;
      const unsigned int model = std::stoul(value);
      if (model >= layer)
        throw BadInput(entry.path + " = " + value +
                       " is not the number of a layer above. Set one, or "
                       "none.");
      return model;
    }
  } // namespace

  void
  fill_like_layers(ParameterOrigins &origins)
  {
    auto &prm = dealii::ParameterAcceptor::prm;
    for (unsigned int layer = 1;
         prm.subsection_path_exists({"Soil", "Layer " + to_text(layer)});
         ++layer)
      {
        const unsigned int model = number_of_model(layer);
        if (model == 0)
          continue;
        const std::string own = section_of(layer) + "/",
                          its = section_of(model) + "/";
        // before any entry is taken over
        const ParameterOrigins before = origins;
        for (const EntryRecord &entry : declared_entries())
          {
            if (entry.path.compare(0, its.size(), its) != 0 ||
                !before.is_set(entry.path) || entry.name == "Top depth" ||
                entry.name == like)
              continue;
            const auto same = alternatives_to(entry.name);
            if (std::any_of(same.begin(), same.end(), [&](const auto &name) {
                  return before.is_set(own + name);
                }))
              continue;
            const std::string value = entry.value(); // not in a subsection
            prm.enter_subsection("Soil");
            prm.enter_subsection("Layer " + to_text(layer));
            prm.set(entry.name, value);
            prm.leave_subsection();
            prm.leave_subsection();
            origins.record(own + entry.name,
                           own + like + " = " + to_text(model),
                           true,
                           false,
                           before.directory_of(entry.path));
          }
      }
  }
} // namespace CaissonMPM
