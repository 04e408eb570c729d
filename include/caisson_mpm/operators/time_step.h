// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The stable time step.
//
//   dt = C min over cells with points of 1 / (c sqrt(1/dr^2 + 1/dz^2)),
//   c = sqrt((lambda + 2 mu) / rho) of the layer where it is largest,
// C the Courant number, rho the inertia per volume, which contains the mass
// scaling. Where the stiffness depends on
// stress and void ratio, it is the largest of all points of a layer. Mass
// scaling enters inertia only: weight and friction are those of the real soil.
#ifndef caisson_mpm_operators_time_step_h
#define caisson_mpm_operators_time_step_h

#include <caisson_mpm/domain/background_grid.h>
#include <caisson_mpm/domain/material_points.h>
#include <caisson_mpm/kernels/material.h>
#include <caisson_mpm/materials/soil.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  class TimeStep : public dealii::ParameterAcceptor
  {
  public:
    TimeStep();

    /** Find the step at the start or after a restart. Throws BadInput where a
     * fixed step is not stable. Collective. */
    void
    initialize(const BackgroundGrid           &grid,
               MaterialPoints                 &points,
               const Soil                     &soil,
               std::vector<Kernels::Material> &materials);

    /**
     * Return the step of the current geometry. The limit is found again every
     * few steps only: the mesh moves slowly. So is the p-wave modulus of
     * @p materials whose stiffness varies, with a margin for the steps between.
     * Throws RunFailure where a fixed step is no longer stable. The same on all
     * ranks; collective.
     */
    double
    choose(const BackgroundGrid           &grid,
           const MaterialPoints           &points,
           const Soil                     &soil,
           std::vector<Kernels::Material> &materials);

    /** The step that was found last. Units: s. */
    double
    step_size() const
    {
      return fixed_step.value_or(courant * limit);
    }

    /** A step over the limit that the soil would have without its water, with
     * the limit that was found last. The water of undrained soil shortens the
     * steps; what acts in each step by a share would act more often, and damp
     * the same motion several times as much. */
    double
    courant_number_of_soil(const double step) const
    {
      return step / limit_of_soil;
    }

    /** The cell that limits the step, in words. */
    const std::string &
    reason() const
    {
      return limiting_cell;
    }

    /** The limit of each zone that has points, by its name. Units: s. */
    std::vector<std::pair<std::string, double>>
    zone_limits() const;

  private:
    void
    update_moduli(const MPI_Comm                  communicator,
                  const MaterialPoints           &points,
                  const Soil                     &soil,
                  std::vector<Kernels::Material> &materials);
    void
    update_limit(const BackgroundGrid                 &grid,
                 const MaterialPoints                 &points,
                 const Soil                           &soil,
                 const std::vector<Kernels::Material> &materials);

    /** Whether a fixed step exceeds the limit. */
    bool
    is_too_large() const
    {
      return fixed_step && *fixed_step > limit;
    }
    std::string
    text_of_too_large_step() const;

    double                courant = 0.5;
    std::optional<double> fixed_step;
    double                limit = 0., limit_of_soil = 0.; // s
    // of all ranks; infinite where a zone has no points
    std::array<double, GridLines::n_zones> limit_of_zone;
    unsigned int age = 0; // steps since the limit was found
    std::string  limiting_cell;
  };
} // namespace CaissonMPM

#endif
