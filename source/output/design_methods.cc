// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/output/design_methods.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <limits>

namespace CaissonMPM
{
  using namespace dealii;

  DesignMethods::DesignMethods()
    : Section("/Design methods")
  {
    add_range("K tan delta inside", inside, "inner");
    add_range("K tan delta outside", outside, "outer");
    add_parameter(
      "Plug permeability ratio",
      permeability_ratio,
      "Houlsby & Byrne's k_f, the permeability of the sand in the plug over "
      "that of the sand outside. A plug that suction has loosened has more "
      "than 1; the flow of the run follows from the soil instead. Units: none.",
      prm,
      Patterns::Double(.01, 100.));
    add_word_or_number(
      *this,
      "Load spread",
      load_spread,
      "none",
      {},
      "Houlsby & Byrne's m, the radius to which friction on the outer wall "
      "enhances the vertical stress in the soil, over that of the wall; none "
      "omits the stress enhancement on both walls. Units: none.",
      Patterns::Double(1.2, 10.));
  }

  void
  DesignMethods::add_range(const std::string &entry,
                           Range             &range,
                           const std::string &wall)
  {
    add_entry(*this,
              entry,
              to_text(range[0]) + ", " + to_text(range[1]),
              "Houlsby & Byrne's K tan(delta), the friction on the " + wall +
                " wall over the vertical stress beside it: both ends of a "
                "range, or one number. The method was fitted to dense sand "
                "with 0.45 to 0.8. A smooth wall has no friction. Units: none.",
              Patterns::List(Patterns::Double(0., 2.), 1, 2),
              [&range](const std::string &text) {
                const auto ends = Utilities::string_to_double(
                  Utilities::split_string_list(text));
                range = {{*std::min_element(ends.begin(), ends.end()),
                          *std::max_element(ends.begin(), ends.end())}};
              });
  }

  void
  DesignMethods::name_unused(ParameterOrigins &origins,
                             const bool        is_caisson,
                             const bool        has_suction) const
  {
    if (!is_caisson)
      origins.add_unused(entries(), "Rigid body/Kind is not caisson");
    else if (!has_suction)
      origins.add_unused({"Design methods/Plug permeability ratio"},
                         "the run has no suction");
  }

  Json::Members
  DesignMethods::members() const
  {
    const auto list = [](const Range &range) {
      return "[" + Json::number(range[0]) + ", " + Json::number(range[1]) + "]";
    };
    return {{"k_tan_delta_inside", list(inside)},
            {"k_tan_delta_outside", list(outside)},
            {"plug_permeability_ratio", Json::number(permeability_ratio)},
            {"load_spread",
             Json::number(load_spread.value_or(
               std::numeric_limits<double>::quiet_NaN()))}};
  }
} // namespace CaissonMPM
