// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What can be read at a material point, by name: for frames, checks and
// observations.
#ifndef caisson_mpm_output_point_quantities_h
#define caisson_mpm_output_point_quantities_h

#include <caisson_mpm/domain/point_fields.h>

#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /** Throws BadInput with @p place where @p name is not among the names,
   * listing them and the nearest ones. */
  void
  check_known(const std::string              &name,
              const std::vector<std::string> &known,
              const std::string              &place,
              const std::string              &kind);

  /** The keys of a map. */
  template <typename Value>
  std::vector<std::string>
  names_of(const std::map<std::string, Value> &entries)
  {
    std::vector<std::string> names;
    for (const auto &entry : entries)
      names.push_back(entry.first);
    return names;
  }

  /** How a quantity follows from a material point. */
  class PointQuantity
  {
  public:
    using Function = std::function<double(const MaterialPoint &)>;
    PointQuantity(const Function &function = {})
      : function(function)
    {}
    /** The state variable of a user material, counted from 0; not a number at a
     * point whose law does not keep it. */
    static PointQuantity
    state_variable(const unsigned int i);
    double
    operator()(const MaterialPoint &p) const
    {
      return function(p);
    }
    /** Whether the point lacks it: a state variable that its law does not keep.
     */
    bool
    is_missing(const MaterialPoint &p) const
    {
      return is_state && std::isnan(function(p));
    }

  private:
    Function function;
    bool     is_state = false; // of a user material
  };

  /** A quantity with its name, unit and meaning, as a field has them. */
  struct NamedQuantity
  {
    PointField    about;
    PointQuantity value;
  };

  /** Return a name with a unit as the columns of history.csv have it:
   * "stress_zz_Pa", "velocity_m_s"; the name alone of what has no unit. */
  std::string
  with_unit(const std::string &name, const std::string &unit);

  /** Return all quantities: the fields of a point (kernels/point_fields.h), and
   * what follows from them. SI units; stresses are positive in tension. */
  const std::vector<NamedQuantity> &
  all_point_quantities();

  /** Return the same by name, also by the names of earlier versions. */
  const std::map<std::string, PointQuantity> &
  point_quantities();

  /** Return the quantity of this name, among them "statev_3". Throws BadInput
   * where there is none; @p place begins the message. */
  PointQuantity
  point_quantity(const std::string &name, const std::string &place);

  /** Return their names with the meaning of those that need one, for the text
   * of a parameter. */
  std::string
  point_quantities_text();
} // namespace CaissonMPM

#endif
