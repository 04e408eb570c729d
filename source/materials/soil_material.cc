// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/kernels/laws.h>
#include <caisson_mpm/materials/soil_material.h>
#include <caisson_mpm/materials/umat_law.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  namespace
  {
    const Kernels::LawDescription &
    description(const int law)
    {
      return Kernels::law_table.law[law];
    }

    /** A number, if the law has it. */
    std::optional<double>
    known(const double number)
    {
      return std::isnan(number) ? std::optional<double>() : number;
    }

    /** A stress as the laws take that of one point. */
    Kernels::StressState<Kernels::Lanes<1>>
    one_lane(const Stress &stress)
    {
      return {stress[0], stress[1], stress[2], stress[3]};
    }

    /** Whether the strength of a law holds a stress. */
    template <typename Law, typename Parameters>
    bool
    is_borne(const Law         l,
             const Stress     &stress,
             const double      void_ratio,
             const Parameters &p)
    {
      using Number = Kernels::Lanes<1>;
      if constexpr (Law::knows_what_it_bears)
        return l.bears(one_lane(stress), Number(void_ratio), p);
      else if constexpr (!Law::is_external)
        {
          constexpr double             round_off = 1e-8;
          const Number                 none(0.);
          Kernels::StressState<Number> kept = one_lane(stress);
          Kernels::LawState<Number> state{none, none, Number(void_ratio), {}};
          l.update(kept,
                   Kernels::StrainIncrement<Number>{none, none, none, none},
                   state,
                   p);
          const double change[4] = {kept.rr[0] - stress[rr],
                                    kept.zz[0] - stress[zz],
                                    kept.tt[0] - stress[tt],
                                    kept.rz[0] - stress[rz]};
          double       moved = 0., size = 0.;
          for (unsigned int c = 0; c < 4; ++c)
            {
              moved = std::max(moved, std::abs(change[c]));
              size  = std::max(size, std::abs(stress[c]));
            }
          return moved <= round_off * size;
        }
      else
        return true;
    }
  } // namespace

  std::string
  SoilMaterial::section() const
  {
    return "Soil/Layer " + to_text(layer + 1);
  }

  void
  SoilMaterial::set_law_values(std::vector<double> values)
  {
    law_values                  = std::move(values);
    const Kernels::LawNumbers n = description(law).numbers(law_values.data());
    youngs_modulus              = known(n.youngs_modulus);
    poisson_ratio               = known(n.poisson_ratio);
    friction_angle              = known(n.friction_angle);
    dilatancy_angle             = n.dilatancy_angle;
    shear_strength              = known(n.shear_strength);
    tension_cutoff              = n.tension_cutoff;
    densest_void_ratio          = known(n.densest);
    loosest_void_ratio          = known(n.loosest);
  }

  void
  SoilMaterial::check(const double mean_stress) const
  {
    Kernels::Material material;
    set_law(material);
    Kernels::with_law(material, [&](const auto l, const auto &p) {
      Kernels::LawMessage message;
      if (!l.check(p,
                   {earth_pressure_at_rest, void_ratio(), mean_stress},
                   message))
        throw BadInput(section() + "/" + message.text);
    });
    if (stress_measure == Kernels::StressMeasure::kirchhoff && !youngs_modulus)
      throw BadInput(section() + "/Stress measure = Kirchhoff: the law " +
                     law_name() +
                     " has no elasticity of its own. Set it to Cauchy.");
  }

  bool
  SoilMaterial::bears(const Stress &stress) const
  {
    Kernels::Material material;
    set_law(material);
    bool result = true;
    Kernels::with_law(material, [&](const auto l, const auto &p) {
      result = is_borne(l, stress, void_ratio(), p);
    });
    return result;
  }

  std::optional<double>
  SoilMaterial::density_index() const
  {
    if (relative_density)
      return relative_density;
    if (!loosest_void_ratio || *densest_void_ratio >= *loosest_void_ratio)
      return {};
    return (*loosest_void_ratio - void_ratio()) /
           (*loosest_void_ratio - *densest_void_ratio);
  }

  std::string
  SoilMaterial::law_name() const
  {
    return description(law).name;
  }

  bool
  SoilMaterial::is_elastic_until_it_yields() const
  {
    return youngs_modulus && friction_angle;
  }

  double
  SoilMaterial::speed_of_failure() const
  {
    return std::exp(.5 * pi *
                    std::tan(dilatancy_angle * Kernels::radians_per_degree));
  }

  std::vector<std::tuple<std::string, std::string, double>>
  SoilMaterial::law_entries() const
  {
    std::vector<std::tuple<std::string, std::string, double>> result;
    for (int i = 0; i < description(law).n_entries; ++i)
      result.emplace_back(description(law).entry(i).name,
                          description(law).entry(i).unit,
                          law_values[i]);
    return result;
  }

  std::optional<double>
  SoilMaterial::law_value(const std::string &entry) const
  {
    for (const auto &[name, unit, value] : law_entries())
      if (name == entry)
        return value;
    return {};
  }

  bool
  SoilMaterial::has_undrained_strength() const
  {
    return shear_strength.value_or(0.) > 0. &&
           friction_angle.value_or(0.) == 0.;
  }

  double
  SoilMaterial::tension() const
  {
    const double cohesion = shear_strength.value_or(0.);
    if (cohesion <= 0.)
      return 0.;
    // at most that of the apex of the cone, c cot phi
    const double slope =
      std::tan(friction_angle.value_or(0.) * Kernels::radians_per_degree);
    return tension_cutoff * slope < cohesion ? tension_cutoff :
                                               cohesion / slope;
  }

  double
  SoilMaterial::earth_pressure_of_law() const
  {
    Kernels::Material material;
    set_law(material);
    double result = 0.;
    Kernels::with_law(material, [&](const auto l, const auto &p) {
      result = l.earth_pressure_at_rest(p);
    });
    return result;
  }

  std::string
  SoilMaterial::known_limit() const
  {
    if (umat && !umat->warning().empty())
      return section() + ": " + umat->warning();
    Kernels::Material material;
    set_law(material);
    const char *limit = nullptr;
    Kernels::with_law(material, [&](const auto l, const auto &p) {
      limit = l.warning(p);
    });
    return limit == nullptr ? "" : section() + ": " + limit;
  }

  bool
  SoilMaterial::stiffness_varies() const
  {
    return description(law).stiffness_varies;
  }

  double
  SoilMaterial::modulus_to_come(const double found) const
  {
    // what stress and density may add
    constexpr double margin = 1.25;
    const bool       is_constant =
      umat && !umat_stiffness.varies &&
      found <= (1. + 1e-6) * umat_stiffness.p_wave_modulus;
    return is_constant ? umat_stiffness.p_wave_modulus : margin * found;
  }

  double
  SoilMaterial::permeability_at(const double e) const
  {
    if (!loosening_conducts)
      return permeability;
    const auto carman = [](const double e) { return e * e * e / (1. + e); };
    // points that are pressed together may have lost all pores
    return permeability * carman(std::max(e, .1 * void_ratio())) /
           carman(void_ratio());
  }

  void
  SoilMaterial::set_law(Kernels::Material &material) const
  {
    description(law).set(material, law_values.data());
    material.initial_void_ratio = void_ratio();
    material.stress_measure     = stress_measure;
    if (!umat)
      return;
    auto &of_law = reinterpret_cast<Kernels::UserMaterial::Parameters &>(
      material.parameters);
    of_law.modulus           = umat_stiffness.p_wave_modulus;
    of_law.update            = &UmatLaw::call;
    of_law.law               = umat.get();
    material.volume_in_shear = volume_in_shear;
  }

  StateVariables
  SoilMaterial::start_of_state() const
  {
    Kernels::Material material;
    set_law(material);
    StateVariables result = {};
    Kernels::with_law(material, [&](const auto l, const auto &p) {
      l.start(p, result.data());
    });
    return result;
  }

  double
  p_wave_modulus(const Kernels::Material &material,
                 const Stress            &stress,
                 const double             void_ratio)
  {
    double result = material.water_modulus;
    Kernels::with_law(material, [&](const auto l, const auto &p) {
      result +=
        l.p_wave_modulus(one_lane(stress), Kernels::Lanes<1>(void_ratio), p)[0];
    });
    return result;
  }

  double
  void_ratio_of_soil(const Kernels::Material &material,
                     const Stress            &stress,
                     const double             void_ratio)
  {
    double result = void_ratio;
    Kernels::with_law(material, [&](const auto l, const auto &p) {
      if constexpr (decltype(l)::has_loosest_state)
        if (material.has_loosest_state)
          result =
            std::min(result, l.loosest_void_ratio(one_lane(stress), p)[0]);
    });
    return result;
  }
} // namespace CaissonMPM
