// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The stress in the soil at the start, and whether its strength holds it.
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/materials/soil.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    /** The K0 from 1 on toward @p end that is held, a little within what is.
     */
    template <typename Held>
    double
    last_held(const Held &is_held, const double end)
    {
      constexpr double margin = 5e-4; // for the digits of a message
      double           held = 1., other = end;
      if (is_held(end))
        return end;
      for (int i = 0; i < 50; ++i)
        {
          const double middle              = .5 * (held + other);
          (is_held(middle) ? held : other) = middle;
        }
      return held + margin * (1. - held);
    }
  } // namespace

  void
  Soil::check_at_rest(const SoilLayer           &layer,
                      const std::vector<double> &depths) const
  {
    double      narrowest = std::numeric_limits<double>::infinity();
    std::string refusal;
    for (const double depth : depths)
      {
        const double       vertical = -initial_stress(Point<2>(0., -depth))[zz];
        const SoilMaterial m        = layer.material_at(depth,
                                                 std::max(vertical, 0.),
                                                 given_stress_ratio(depth));
        const Stress       at_rest  = stress_at_rest(m, depth, vertical);
        if (at_rest == Stress() || m.bears(at_rest))
          continue;
        if (stress_state != InitialStress::k0)
          throw BadInput(
            "Soil/Initial stress gives " + to_text(at_rest[rr], 4) + ", " +
            to_text(at_rest[zz], 4) + ", " + to_text(at_rest[tt], 4) + ", " +
            to_text(at_rest[rz], 4) + " Pa (rr, zz, tt, rz) at a depth of " +
            to_text(depth, 4) + " m, more than the strength of " + m.section() +
            " holds: the ground would move by itself. Correct the stress or "
            "the strength.");
        const auto holds = [&](const double k0) {
          return m.bears({{-k0 * vertical, -vertical, -k0 * vertical, 0.}});
        };
        const double least = last_held(holds, 0.), most = last_held(holds, 10.);
        if (most - least >= narrowest)
          continue;
        narrowest = most - least;
        refusal =
          m.section() + "/K0 = " + to_text(m.earth_pressure_at_rest, 4) +
          " at a depth of " + to_text(depth, 4) + " m: the strength of " +
          m.law_name() + " there, below " + to_text(vertical, 4) +
          " Pa, holds K0 from " + to_text(least, 4) + " to " +
          to_text(most, 4) + ", and the ground would move by itself. ";
      }
    if (refusal.empty())
      return;
    throw BadInput(refusal +
                   "Set K0 within this range, or correct the strength.");
  }

  Stress
  Soil::stress_at_rest(const SoilMaterial &m,
                       const double        depth,
                       const double        vertical_stress) const
  {
    if (stress_state != InitialStress::k0)
      return initial_stress(Point<2>(0., -depth));
    const double horizontal = m.earth_pressure_at_rest * vertical_stress;
    return {{-horizontal, -vertical_stress, -horizontal, 0.}};
  }

  std::optional<double>
  Soil::given_stress_ratio(const double depth) const
  {
    if (stress_state == InitialStress::k0)
      return {};
    const Stress s = initial_stress(Point<2>(0., -depth));
    if (s[zz] >= 0.)
      return {};
    return std::max(0., .5 * (s[rr] + s[tt]) / s[zz]);
  }

  double
  Soil::vertical_stress(const double depth, const double of_weight) const
  {
    switch (stress_state)
      {
        case InitialStress::k0:
          return of_weight;
        case InitialStress::none:
          return 0.;
        default:
          return std::max(0., -initial_stress(Point<2>(0., -depth))[zz]);
      }
  }

  Stress
  Soil::initial_stress(const Point<2> &place) const
  {
    const double z = place[vertical];
    if (stress_state == InitialStress::uniform)
      return uniform_stress;
    if (stress_state == InitialStress::expression)
      return stress_by_expression(place);
    if (stress_state == InitialStress::none || z >= 0.)
      return {{0., 0., 0., 0.}};
    double sigma_zz = 0.;
    for (unsigned int i = 0; i < n_materials() && -z > materials[i].top_depth;
         ++i)
      {
        const SoilMaterial &m = materials[i];
        const double        bottom =
          i + 1 < n_materials() ? std::min(-z, materials[i + 1].top_depth) : -z;
        sigma_zz -= (unit_weight(m) + m.added_weight) * (bottom - m.top_depth);
      }
    const double sigma_rr =
      materials[material_at(z)].earth_pressure_at_rest * sigma_zz;
    return {{sigma_rr, sigma_zz, sigma_rr, 0.}};
  }

  Stress
  Soil::stress_by_expression(const Point<2> &place) const
  {
    Stress result;
    for (unsigned int c = 0; c < 4; ++c)
      {
        result[c] = stress_expression[c](place, 0.);
        if (!std::isfinite(result[c]))
          throw BadInput("Soil/Stress expression is " + to_text(result[c]) +
                         " at r = " + to_text(place[radial]) +
                         " m, z = " + to_text(place[vertical]) +
                         " m. Write expressions that are finite where there "
                         "is soil.");
      }
    return result;
  }
} // namespace CaissonMPM
