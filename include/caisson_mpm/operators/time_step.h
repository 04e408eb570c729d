// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The stable time step.
//
//   dt = C min over cells with points of 1 / (c sqrt(1/dr^2 + 1/dz^2)),
//   c = sqrt((lambda + 2 mu) / rho) of the layer where it is largest,
// C the Courant number, rho the inertia per volume, which contains the mass
// scaling, and at most what the transfer to the points allows in elongated
// cells and in soil that has grown (doc/theory.md, section 12). Where the
// stiffness depends on stress and void ratio, it is the largest of all points
// of a layer. Mass scaling enters inertia only: weight and friction are those
// of the real soil.
//
// With an inertia tolerance T, the cell that limits the step gets the scaling
//   s = T sigma / (rho v^2) >= 1
// and a larger cell less of it, at least 1. sigma is the initial vertical
// effective stress at the tip (Soil::stress_borne_above), or half of the
// strength there where no soil has friction, of which a part counts at the
// start; v the speed of the body. The factor makes the deformation of a cell
// heavy (SelectiveMass), and at the body and at the sides of the domain the
// mass and momentum that the points of a cell bring to its nodes: points keep
// mass and velocity when it changes.
#ifndef caisson_mpm_operators_time_step_h
#define caisson_mpm_operators_time_step_h

#include <caisson_mpm/base/intervals.h>
#include <caisson_mpm/base/run_totals.h>
#include <caisson_mpm/base/section.h>
#include <caisson_mpm/domain/background_grid.h>
#include <caisson_mpm/domain/material_points.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/materials/soil.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  class TimeStep : public Section
  {
  public:
    TimeStep();

    /** Whether the scaling follows from the inertia tolerance. */
    bool
    has_inertia_tolerance() const
    {
      return tolerance.has_value();
    }

    /** Let the tolerance refer to this: the initial stress at the tip over
     * density times the square of the speed of the body. It is asked for
     * whenever the limit is found, and is the same on all ranks. */
    void
    follow_tip(const std::function<double()> &stress_over_inertia)
    {
      stress_over_inertia_at_tip = stress_over_inertia;
    }

    /** Whether points are strained by the new velocities of the nodes (USL), or
     * by those that they bring back to the nodes (MUSL, the default). */
    void
    set_strain_from_new_velocities(const bool value)
    {
      strains_with_new_velocities = value;
    }

    /** The scaling of the smallest cells, found from the tolerance; else 1. */
    double
    inertia_at_tip() const
    {
      return inertia_at_tip_;
    }

    /** The least and the largest scaling of the smallest cells in the run. */
    std::pair<double, double>
    range_of_inertia() const
    {
      return {std::max(1., least_inertia), largest_inertia};
    }

    void
    register_totals(RunTotals &totals)
    {
      totals.keep("least_inertia", least_inertia);
      totals.keep("largest_inertia", largest_inertia);
    }

    /** The factor with which the points of each cell of this rank bring mass
     * and momentum to its nodes [n_cells], or null if all of them are 1. */
    const double *
    inertia_of_translation() const
    {
      return translation.empty() ? nullptr : translation.data();
    }

    /** The factor of the inertia of each cell's deformation, see
     * SelectiveMass. */
    const double *
    inertia_of_deformation() const
    {
      return inertia_.empty() ? nullptr : inertia_.data();
    }

    /** Find the step at the start or after a restart. Throws BadInput where a
     * fixed step is not stable. Collective. */
    void
    initialize(const Kernels::KernelTable     &kernels,
               const BackgroundGrid           &grid,
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
    choose(const Kernels::KernelTable     &kernels,
           const BackgroundGrid           &grid,
           MaterialPoints                 &points,
           const Soil                     &soil,
           std::vector<Kernels::Material> &materials);

    /** Find the factors of the inertia in the next step: the cells are other
     * ones. */
    void
    forget_cells()
    {
      if (tolerance)
        age = Intervals::time_step - 1;
    }

    /** Settings that were found to give wrong results, each as a sentence. */
    std::vector<std::string>
    known_limits() const;

    /** The step that was found last. Units: s. */
    double
    step_size() const
    {
      return fixed_step.value_or(courant * limit);
    }

    /** Return the scaling of the smallest cells with this stress over the
     * inertia at the tip. There must be a tolerance. */
    double
    inertia_for(const double stress_over_inertia) const;

    /** How much longer the step is once waves are so many times as fast, and
     * with a tolerance this is the stress over the inertia at the tip. */
    double
    growth_of_step(const double stress_over_inertia,
                   const double growth_of_speed) const;

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
    update_moduli(const Kernels::KernelTable     &kernels,
                  const MPI_Comm                  communicator,
                  MaterialPoints                 &points,
                  const Soil                     &soil,
                  std::vector<Kernels::Material> &materials);
    /** What the transfer makes of the square of the frequency of the shortest
     * wave of a row of cells, by material. */
    std::vector<double>
    narrowing_of(const std::vector<Kernels::Material> &materials) const;
    /** Find the scaling from the tolerance, and set the factors of all cells.
     * @p squares: of the wave speed of each material (m2/s2), @p narrowing:
     * what the transfer makes of them. Collective. */
    void
    update_inertia(const BackgroundGrid      &grid,
                   const MaterialPoints      &points,
                   const std::vector<double> &squares,
                   const std::vector<double> &narrowing);
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
    std::optional<double> fixed_step, tolerance;
    double                limit = 0., limit_of_soil = 0.; // s
    // of all ranks; infinite where a zone has no points
    std::array<double, GridLines::n_zones> limit_of_zone;
    bool                                   strains_with_new_velocities = false;
    int                     age = 0; // steps since the limit was found
    std::string             limiting_cell;
    std::function<double()> stress_over_inertia_at_tip;
    double                  inertia_at_tip_ = 1.;
    double                  least_inertia   = 0.; // 0: not yet found
    double                  largest_inertia = 1.;
    std::vector<double>     inertia_, translation; // of deformation; see there
    std::vector<double>     margin_of_modulus;     // of each material
  };
} // namespace CaissonMPM

#endif
