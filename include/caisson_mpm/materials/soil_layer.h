// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the user says of a horizontal layer of soil.
#ifndef caisson_mpm_materials_soil_layer_h
#define caisson_mpm_materials_soil_layer_h

#include <caisson_mpm/base/parameter_origins.h>
#include <caisson_mpm/materials/soil_material.h>

#include <deal.II/base/parameter_acceptor.h>

#include <map>
#include <optional>
#include <string>

namespace CaissonMPM
{
  /**
   * The entries of one layer. The section of layer k is "Soil/Layer k". It
   * declares the entries of all material laws (kernels/laws.h) and hands those
   * of the layer's own law on.
   */
  class SoilLayer : public dealii::ParameterAcceptor
  {
  public:
    /** @p index counts from 0. */
    explicit SoilLayer(const unsigned int index);

    /** Name the entries of laws other than the layer's own. */
    void
    name_unused_entries(ParameterOrigins &origins) const;

    /** "Soil/Layer k", with k from 1. */
    std::string
    section() const;

    /** Units: m. */
    double
    top_depth() const
    {
      return soil.top_depth;
    }

    /** Return the soil of the layer. */
    SoilMaterial
    material() const;

  private:
    void
    declare_internal_length();
    void
    declare_permeability();

    SoilMaterial          soil;
    std::string           law = "Mohr-Coulomb";
    std::optional<double> k0; // no value: the law's own

    /** The entries of all laws by name, in the units of the entries. */
    std::map<std::string, double> values;
  };
} // namespace CaissonMPM

#endif
