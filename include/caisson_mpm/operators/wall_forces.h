// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The forces of the soil along the inner and the outer wall of a body.
#ifndef caisson_mpm_operators_wall_forces_h
#define caisson_mpm_operators_wall_forces_h

#include <caisson_mpm/base/run_totals.h>
#include <caisson_mpm/domain/material_points.h>
#include <caisson_mpm/operators/contact.h>

#include <array>
#include <vector>

namespace CaissonMPM
{
  /** One wall at one height, for the whole circumference. */
  struct WallPart
  {
    double  area = 0.;     // of the wall that belongs to the nodes, m2
    Vector2 impulse;       // on the body since the last record, N s
    double  friction = 0.; // mean tangent of the friction angle
    double  adhesion = 0.; // mean, Pa
    double  pore_pressure; // excess in the cells at the wall, Pa; nan: none
    double  pressure_in_stress; // of soil whose total stress is shown, Pa
  };

  /** Both walls at one height. */
  struct WallRow
  {
    double                  height; // at the start of the travel, m
    std::array<WallPart, 2> walls;  // inner and outer
  };

  /**
   * Sums what the contact does at the walls, by the height of the nodes. The
   * body is rigid and the mesh moves with it: a node stays where it is on the
   * wall. The sums are the terms of the forces on the walls in history.csv, so
   * that they add up to these.
   */
  class WallForces
  {
  public:
    /** Find the rows of nodes, of all ranks; the mesh is at the start of the
     * travel. Their number stays when the parts of the ranks change.
     * Collective. */
    void
    initialize(const BackgroundGrid &grid, const Contact &contact);

    /** Register the impulses, after initialize(). */
    void
    register_totals(RunTotals &totals);

    /** Add the last step, of this rank's nodes. */
    void
    add_step(const Contact &contact);

    /** Forget the impulses. */
    void
    clear();

    /** Return the rows with the impulses, which the first rank has of all ranks
     * after RunTotals::bring_to_first_rank(), and with what the walls are like
     * now. @p total names the materials whose total stress is shown.
     * [n_materials] Collective. */
    std::vector<WallRow>
    rows(const BackgroundGrid    &grid,
         const Contact           &contact,
         const MaterialPoints    &points,
         const std::vector<bool> &total) const;

    /** Return the area of the tip, seen from below. Units: m2. Collective. */
    static double
    area_of_tip(const BackgroundGrid &grid, const Contact &contact);

  private:
    static bool
    is_wall(const Surface surface)
    {
      return surface == inner_wall || surface == outer_wall;
    }
    static unsigned int
    number_of(const Surface surface)
    {
      return surface == inner_wall ? 0 : 1;
    }

    std::vector<double>                 heights;     // of the rows, from below
    std::vector<std::array<Vector2, 2>> impulses;    // [n_rows]
    std::vector<int>                    row_of_node; // -1: not at a wall
  };
} // namespace CaissonMPM

#endif
