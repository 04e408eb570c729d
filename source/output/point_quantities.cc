// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/nearest_names.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/output/point_quantities.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  void
  check_known(const std::string              &name,
              const std::vector<std::string> &known,
              const std::string              &place,
              const std::string              &kind)
  {
    if (std::find(known.begin(), known.end(), name) != known.end())
      return;
    throw BadInput(place + "there is no " + kind + " \"" + name + "\", only " +
                   boost::algorithm::join(known, ", ") + "." +
                   did_you_mean(nearest_names(name, known)));
  }

  namespace
  {
    using P = const MaterialPoint &;

    double
    speed(P p)
    {
      return std::hypot(p.velocity[0], p.velocity[1]);
    }

    double
    mean_stress(P p)
    {
      return (p.stress[rr] + p.stress[zz] + p.stress[tt]) / 3.;
    }

    /** sqrt(3 J2): the difference of axial and radial stress in a triaxial
     * test. */
    double
    deviator(P p)
    {
      const double mean = mean_stress(p);
      double       j2   = p.stress[rz] * p.stress[rz];
      for (const unsigned int component : {rr, zz, tt})
        j2 += .5 * std::pow(p.stress[component] - mean, 2);
      return std::sqrt(3. * j2);
    }

    constexpr auto drawn = InFrames::drawn, not_drawn = InFrames::not_drawn;

    /** The field, whose values cannot be merged, and its function. */
    NamedQuantity
    derived(const char                    *owner,
            const char                    *component,
            const char                    *unit,
            const InFrames                 in_frames,
            const char                    *text,
            const PointQuantity::Function &function)
    {
      return {{owner, component, unit, Merge::by_mass, in_frames, text},
              function};
    }

    std::vector<NamedQuantity>
    quantities_of_fields()
    {
      std::vector<NamedQuantity> result;
      const MaterialPoint        any;
      for_each_value(any, [&](const PointField &field, const double &value) {
        const auto *const begin = reinterpret_cast<const char *>(&any);
        const std::size_t offset =
          reinterpret_cast<const char *>(&value) - begin;
        result.push_back({field, PointQuantity([offset](P p) {
                            return *reinterpret_cast<const double *>(
                              reinterpret_cast<const char *>(&p) + offset);
                          })});
      });
      return result;
    }

    const std::vector<NamedQuantity> derived_quantities = {
      derived("displacement",
              "r",
              "m",
              drawn,
              "",
              [](P p) { return p.position[0] - p.initial_position[0]; }),
      derived("displacement",
              "z",
              "m",
              drawn,
              "",
              [](P p) { return p.position[1] - p.initial_position[1]; }),
      derived("speed", "", "m/s", not_drawn, "", speed),
      derived("stress_ratio",
              "",
              "none",
              not_drawn,
              "rr over zz",
              [](P p) { return p.stress[rr] / p.stress[zz]; }),
      derived("mean_stress", "", "Pa", drawn, "tension positive", mean_stress),
      derived("deviator", "", "Pa", drawn, "sqrt(3 J2)", deviator),
      derived("volume_ratio",
              "",
              "none",
              not_drawn,
              "to the initial volume",
              [](P p) { return p.volume / p.initial_volume; }),
      derived("density",
              "",
              "kg/m3",
              not_drawn,
              "scaled",
              [](P p) { return p.mass / p.volume; }),
      derived("kinetic_energy",
              "",
              "J/m3",
              not_drawn,
              "per volume",
              [](P p) { return .5 * p.mass / p.volume * speed(p) * speed(p); }),
      derived("material",
              "",
              "none",
              drawn,
              "number from 0 of its layer, or of its part of a layer whose "
              "numbers change with depth",
              [](P p) { return double(p.material); })};
  } // namespace

  PointQuantity
  PointQuantity::state_variable(const unsigned int i)
  {
    const unsigned int place = Kernels::UserState::variables + i;
    PointQuantity      result([place](P p) {
      return place < p.user_state.size() ? p.user_state[place] : std::nan("");
    });
    result.is_state = true;
    return result;
  }

  std::string
  with_unit(const std::string &name, const std::string &unit)
  {
    if (unit == "none")
      return name;
    std::string result = name + "_" + unit;
    std::replace(result.begin() + name.size(), result.end(), '/', '_');
    return result;
  }

  const std::vector<NamedQuantity> &
  all_point_quantities()
  {
    static const std::vector<NamedQuantity> quantities = [] {
      auto all = quantities_of_fields();
      all.insert(all.end(),
                 derived_quantities.begin(),
                 derived_quantities.end());
      return all;
    }();
    return quantities;
  }

  const std::map<std::string, PointQuantity> &
  point_quantities()
  {
    static const std::map<std::string, PointQuantity> by_name = [] {
      std::map<std::string, PointQuantity> result;
      for (const NamedQuantity &quantity : all_point_quantities())
        result[quantity.about.name()] = quantity.value;
      // names of earlier versions
      result["plastic_strain"]        = result.at("plastic_deviatoric");
      result["plastic_volume_strain"] = result.at("plastic_volumetric");
      return result;
    }();
    return by_name;
  }

  PointQuantity
  point_quantity(const std::string &name, const std::string &place)
  {
    const std::string beginning = "statev_";
    if (name.compare(0, beginning.size(), beginning) == 0)
      {
        const std::string number = name.substr(beginning.size());
        if (!number.empty() && number.size() <= 4 && number[0] != '0' &&
            number.find_first_not_of("0123456789") == std::string::npos)
          return PointQuantity::state_variable(std::stoul(number) - 1);
      }
    check_known(name, names_of(point_quantities()), place, "quantity");
    return point_quantities().at(name);
  }

  std::string
  point_quantities_text()
  {
    std::string text;
    for (const NamedQuantity &quantity : all_point_quantities())
      {
        const PointField &about = quantity.about;
        const std::string unit = about.unit, meaning = about.text;
        text += (text.empty() ? "Quantities: " : ", ") + about.name() + " (" +
                (meaning.empty() ? "" : meaning + "; ") +
                (unit == "none" ? "no unit" : unit) + ")";
      }
    return text + ", statev_1 (and so on; STATEV of the user materials that "
                  "have so many; no unit).";
  }
} // namespace CaissonMPM
