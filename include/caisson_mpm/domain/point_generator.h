// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Material points of the undisturbed soil: a lattice in every cell.
#ifndef caisson_mpm_domain_point_generator_h
#define caisson_mpm_domain_point_generator_h

#include <caisson_mpm/base/parameter_origins.h>
#include <caisson_mpm/base/section.h>
#include <caisson_mpm/bodies/body_shape.h>
#include <caisson_mpm/domain/material_points.h>
#include <caisson_mpm/materials/soil.h>

#include <algorithm>

namespace CaissonMPM
{
  /**
   * Fills the soil's cells with material points.
   *
   * Each cell is cut into n_r x n_z parts; a point takes the exact volume and
   * the centroid of its part, so that the nodal masses are those of the
   * continuum. n_r is the number per direction of the cell's zone (path, near,
   * far). n_z is as many times larger as the cell is higher than the lowest
   * cell that its soil will meet while the mesh moves: a coarser spacing would
   * leave cells without points, and the soil would crack there. With Random
   * positions a point lies elsewhere in its part, always at the same place for
   * the same seed.
   */
  class PointGenerator : public Section
  {
  public:
    PointGenerator();

    /** Throw BadInput where the entries contradict each other. */
    void
    check_parameters() const;

    /** Report which entries the other choices leave without effect. */
    void
    name_unused_entries(ParameterOrigins &origins) const override;

    /**
     * Create all points, with the soil's initial stress. Those that @p points
     * has are forgotten. Throws BadInput where there would be none, or too
     * many. Collective.
     */
    void
    generate(const BackgroundGrid &grid,
             const BodyShape      &body,
             const Soil           &soil,
             MaterialPoints       &points) const;

    /**
     * Return the size that points are to have in a cell of the current mesh, in
     * r and z, where splits_and_merges(): the cell's over the number per
     * direction. Units: m.
     */
    std::array<double, 2>
    wanted_size(const Kernels::CellGeometry &g,
                const BodyShape             &body,
                const double                 travel) const;

    bool
    splits_and_merges() const
    {
      return adaptive;
    }

    /** Return with how many points a run would begin if they were split and
     * merged. */
    double
    n_points_that_split(const GridLines &lines, const BodyShape &body) const;

    unsigned int
    points_per_direction_in_path() const
    {
      return per_direction[static_cast<unsigned int>(PointZone::path)];
    }

    unsigned int
    least_points_per_direction() const
    {
      return *std::min_element(per_direction.begin(), per_direction.end());
    }

  private:
    /** Where a cell is, in the order of per_direction. */
    enum class PointZone : unsigned int
    {
      path,
      near,
      far
    };

    void
    declare_numbers();
    void
    declare_region();
    PointZone
    zone_of(const Kernels::CellGeometry &g,
            const BodyShape             &body,
            const double                 travel) const;
    unsigned int
    points_per_direction(const Kernels::CellGeometry &g,
                         const BodyShape             &body,
                         const double                 travel) const;
    // of the parts of a cell, in r and z; 0 without soil
    using Parts = std::array<unsigned int, 2>;
    Parts
    number_of_parts(const GridLines &lines,
                    const BodyShape &body,
                    const GlobalCell cell,
                    const bool       splits) const;
    std::vector<Parts> // [n_global_cells]
    number_of_parts(const GridLines &lines, const BodyShape &body) const;
    /** Throw BadInput where these are too many, by zone. */
    void
    check_number(const std::array<double, 3> &n_points) const;
    /** Return the part of a cell that soil fills; without height where none
     * does. */
    Kernels::CellGeometry
    soil_of(const GridLines &lines, const GlobalCell cell) const;
    bool
    is_in_region(const dealii::Point<2> &place,
                 const Expression       &further) const;
    Expression
    parse_region() const;

    std::array<unsigned int, 3> per_direction  = {{4, 3, 2}};
    unsigned int                largest_number = 10000000;

    double       path_margin   = 0.1;
    double       near_distance = 1.;
    double       region_left = 0., region_right = 1e30;
    double       region_bottom = -1e30, region_top = 0.;
    std::string  region;
    double       randomness = 0.;
    unsigned int seed       = 1;
    bool         adaptive   = false;
  };
} // namespace CaissonMPM

#endif
