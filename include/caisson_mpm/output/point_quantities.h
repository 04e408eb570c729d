// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What can be read at a material point, by name: for frames, checks and
// observations.
#ifndef caisson_mpm_output_point_quantities_h
#define caisson_mpm_output_point_quantities_h

#include <caisson_mpm/domain/point_fields.h>
#include <caisson_mpm/kernels/user_point.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /** How a quantity follows from a material point: a field of it, a function of
   * several, or a state variable of a user material. */
  class PointQuantity
  {
  public:
    using Function = double (*)(const MaterialPoint &);

    PointQuantity(const Function function = nullptr)
      : function(function)
    {}

    /** The field at this distance from the begin of a point. Units: bytes. */
    explicit PointQuantity(const std::size_t offset)
      : offset(offset)
    {}

    /** The state variable of a user material, counted from 0. */
    static PointQuantity
    state_variable(const unsigned int i)
    {
      PointQuantity result;
      result.in_user_state = Kernels::UserState::variables + i;
      return result;
    }

    double
    operator()(const MaterialPoint &p) const
    {
      if (in_user_state > 0)
        return in_user_state < p.user_state.size() ?
                 p.user_state[in_user_state] :
                 std::numeric_limits<double>::quiet_NaN();
      return function != nullptr ?
               function(p) :
               *reinterpret_cast<const double *>(
                 reinterpret_cast<const char *>(&p) + offset);
    }

    /** Whether the point lacks it: a state variable that its law does not keep.
     */
    bool
    is_missing(const MaterialPoint &p) const
    {
      return in_user_state > 0 && std::isnan((*this)(p));
    }

  private:
    Function    function      = nullptr;
    std::size_t offset        = 0;
    std::size_t in_user_state = 0; // 0: none
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
