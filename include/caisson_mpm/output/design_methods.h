// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the design methods beside a run assume. The run does not depend on it.
#ifndef caisson_mpm_output_design_methods_h
#define caisson_mpm_output_design_methods_h

#include <caisson_mpm/base/parameter_origins.h>
#include <caisson_mpm/base/section.h>
#include <caisson_mpm/output/json.h>

#include <array>
#include <optional>
#include <string>

namespace CaissonMPM
{
  /**
   * The entries of Houlsby and Byrne (2005, doi:10.1680/geng.2005.158.3.135)
   * that no ground investigation gives. Pictures, design.csv and the report
   * take them from run.json. Not collective.
   */
  class DesignMethods : public Section
  {
  public:
    DesignMethods();

    /** Name the entries without effect: all for a body that is no caisson, and
     * that of the flow where there is no suction. */
    void
    name_unused(ParameterOrigins &origins,
                const bool        is_caisson,
                const bool        has_suction) const;

    /** Return the values as members of an object of run.json; no load spread is
     * null. */
    Json::Members
    members() const;

  private:
    using Range = std::array<double, 2>; // low, high

    /** Declare a range of K tan(delta); @p wall is for its text. */
    void
    add_range(const std::string &entry, Range &range, const std::string &wall);

    Range                 inside = {{.45, .8}}, outside = {{.45, .8}};
    double                permeability_ratio = 1.;
    std::optional<double> load_spread        = 1.5;
  };
} // namespace CaissonMPM

#endif
