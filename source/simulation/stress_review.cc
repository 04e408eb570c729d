// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Which stresses soil can have: each entry in Pa that the user sets is compared
// with a range, so that numbers in kPa or MPa are noticed; and the stiffness of
// a layer with that of the layer above.
#include <caisson_mpm/base/declared_entries.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/simulation/scene_review.h>

#include <algorithm>
#include <limits>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    constexpr double any = std::numeric_limits<double>::infinity();

    /** What an entry can be. Where soil is under little stress, as in a model
     * test, the least value is the share of the weight above the depth of the
     * skirt, if that is smaller. */
    struct StressRange
    {
      const char *entry; // the beginning of its name
      const char *of;
      double      least, share, largest; // Pa, -, Pa
    };

    // a cohesion beside friction may be small, to help the numerics
    constexpr StressRange
      with_friction = {"", "the strength of a soil", 100., .01, 1e7},
      undrained     = {"", "the strength of a soil", 1e3, .1, 1e7};
    constexpr double least_angle = 10.; // degrees, of drained soil

    constexpr StressRange ranges[] = {
      {"Youngs modulus", "that of a soil", 1e5, 10., 1e11},
      {"Granulate hardness", "that of a soil", 1e7, any, 1e12},
      {"Reference stress", "that of a soil", 1e3, any, 1e12},
      {"Active strength", undrained.of, 1e3, .1, 1e7},
      {"Tension cut-off", "the tension that a soil bears", 250., .01, any},
      {"Smallest stress of strength", "that of a soil", 1e3, any, 1e8},
      {"Smallest stress of stiffness", "that of a soil", 10., any, 1e7},
      {"Surcharge", "a load on the soil", 1e3, .02, 1e7},
      {"Adhesion of", "the adhesion of a soil", 250., .01, 1e7},
      {"Bulk modulus", "that of water", 1e5, any, 1e12},
      {"Lid water modulus", "that of water", 1e5, any, 1e12},
      {"Bottom pressure", "a pressure of water", 100., .01, 1e8},
      {"Surrounding pressure", "a pressure of water", 100., .01, 1e8}};

    const std::string advice = ". Check the unit, Pa: 1 kPa is 1000 Pa, and "
                               "1 MPa is 1e6 Pa.";
  } // namespace

  void
  SceneReview::stresses()
  {
    for (const EntryRecord &entry : declared_entries())
      if (entry.unit == "Pa" && origins.is_set(entry.path))
        {
          const bool is_of_layer =
            entry.subsections.size() == 2 && entry.subsections[0] == "Soil";
          const auto soil =
            is_of_layer ? strongest(entry) : std::optional<unsigned int>();
          if (soil)
            stress(entry,
                   *parts.soil.material(*soil).law_value(entry.name),
                   parts.soil.material(*soil).friction_angle);
          else if (!is_of_layer)
            stress(entry, number_in(entry.value()).value_or(0.), {});
        }
    stress_at_start();
  }

  std::optional<unsigned int>
  SceneReview::strongest(const EntryRecord &entry) const
  {
    std::optional<unsigned int> found;
    const std::string           layer = "Soil/" + entry.subsections[1];
    const auto                  value = [&](const unsigned int i) {
      return parts.soil.material(i).law_value(entry.name);
    };
    for (unsigned int i = 0; i < parts.soil.n_materials(); ++i)
      if (parts.soil.material(i).section() == layer && value(i) &&
          (!found || *value(i) > *value(*found)))
        found = i;
    return found;
  }

  void
  SceneReview::stress(const EntryRecord           &entry,
                      const double                 value,
                      const std::optional<double> &friction_angle)
  {
    const auto *range = std::find_if(
      std::begin(ranges), std::end(ranges), [&](const StressRange &r) {
        return entry.name.compare(0, std::string(r.entry).size(), r.entry) == 0;
      });
    if (entry.name == "Cohesion")
      range =
        friction_angle.value_or(0.) < least_angle ? &undrained : &with_friction;
    if (range == std::end(ranges) || value <= 0.)
      return;
    const double least = std::min(range->least, range->share * weight_above());
    if (value < least)
      doubt(entry.path,
            value,
            "Pa",
            std::string("is not ") + range->of + ": is it in kPa or MPa? " +
              advice.substr(2));
    else if (value > range->largest)
      doubt(entry.path,
            value,
            "Pa",
            std::string("is not ") + range->of + advice);
  }

  void
  SceneReview::stress_at_start()
  {
    constexpr double part  = .01;
    const double     depth = depth_of_skirt();
    const double given = -parts.soil.initial_stress(Point<2>(0., -depth))[zz];
    for (const std::string entry :
         {"Soil/Uniform stress", "Soil/Stress expression"})
      if (origins.is_set(entry) && given > 0. && given < part * weight_above())
        origins.add_warning(entry + " is " + to_text(given, 4) +
                            " Pa in the vertical at " + to_text(depth, 4) +
                            " m, and the weight of the soil above is " +
                            to_text(weight_above(), 4) + " Pa" + advice);
  }

  void
  SceneReview::contrast_of_stiffness()
  {
    // with 200 runs came through the boundary, with 500 they became unstable;
    // with a uniform scaling these came through
    constexpr double      largest = 250.;
    std::optional<double> above;
    for (const unsigned int i : parts.soil.uppermost_materials())
      {
        const SoilMaterial &soil   = parts.soil.material(i);
        const auto          youngs = soil.youngs_modulus;
        const double        ratio =
          youngs && above ? std::max(*youngs / *above, *above / *youngs) : 1.;
        if (ratio > largest)
          doubt(soil.section() + ": Young's modulus",
                *youngs,
                "Pa",
                "differs from that of the layer above by a factor of " +
                  to_text(ratio, 3) +
                  ". With Time/Inertia tolerance, a run may become unstable at "
                  "such a boundary, and end there. Bring the two within a "
                  "factor of 200, or set Inertia tolerance = none and Mass "
                  "scaling = 25, which takes longer.");
        above = youngs;
      }
  }

  double
  SceneReview::depth_of_skirt() const
  {
    const BodyShape &shape = parts.body.shape();
    const double     way   = parts.grid.lines().total_travel() - shape.bottom();
    const double length = shape.expands() ? 0. : shape.top() - shape.bottom();
    return std::min(std::max(way, length), parts.grid.lines().depth());
  }

  double
  SceneReview::weight_above() const
  {
    const double depth = depth_of_skirt();
    double       sum   = 0.;
    for (unsigned int i = 0; i < parts.soil.n_materials(); ++i)
      {
        const SoilMaterial &soil   = parts.soil.material(i);
        const double        bottom = i + 1 < parts.soil.n_materials() ?
                                       parts.soil.material(i + 1).top_depth :
                                       depth;
        sum += std::max(std::min(bottom, depth) - soil.top_depth, 0.) *
               parts.soil.unit_weight(soil);
      }
    return sum;
  }
} // namespace CaissonMPM
