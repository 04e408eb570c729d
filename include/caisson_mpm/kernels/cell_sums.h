// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The sums over the points of one cell that become its CellMoments, and the
// decision how a cell is integrated.
//
// A full cell takes Gauss points, at which the stress is an affine function
// fitted to its points: its points are summed by FitSums. In a nearly empty
// cell the points themselves are the quadrature points: they are summed by
// ForceSums. In between both integrals are mixed, with a share that is a
// continuous function of how full the cell and its surroundings are. Moments of
// mass and momentum are the same for both.
#ifndef caisson_mpm_kernels_cell_sums_h
#define caisson_mpm_kernels_cell_sums_h

#include <caisson_mpm/kernels/for_each_block.h>
#include <caisson_mpm/kernels/moments.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** A cell whose points are summed. */
    struct CellToSum
    {
      CellMap<> map;
      double    axisymmetric;
      double    center_z, inverse_mean_height;
      bool      bound_stiffness; // IntegrationSettings::has_minimum_nodal_mass

      [[gnu::always_inline]] inline CellToSum(const CellGeometry &geometry,
                                              const double        axisymmetric,
                                              const bool bound_stiffness)
        : map(geometry)
        , axisymmetric(axisymmetric)
        , center_z(map.center_z())
        , inverse_mean_height(1. / map.mean_height())
        , bound_stiffness(bound_stiffness)
      {}
    };

    /** Some points of a block, one in each lane. */
    template <typename Number>
    struct LoadedPoints
    {
      Number              r, z, mass, volume;
      LocalPoint<Number>  local;
      StressState<Number> stress;

      [[gnu::always_inline]] inline LoadedPoints(const PointBlock &b,
                                                 const int         lane,
                                                 const CellMap<>  &map)
        : r(Number::load(b.r + lane))
        , z(Number::load(b.z + lane))
        , mass(Number::load(b.mass + lane))
        , volume(Number::load(b.volume + lane))
        , local(map.at_position(r, z))
        , stress{Number::load(b.stress[0] + lane),
                 Number::load(b.stress[1] + lane),
                 Number::load(b.stress[2] + lane),
                 Number::load(b.stress[3] + lane)}
      {}
    };

    /** Points of a full cell: their stress enters the affine fit. */
    template <typename Number>
    [[gnu::always_inline]] inline void
    add_stress(const CellToSum            &cell,
               const LoadedPoints<Number> &p,
               const double /*modulus*/,
               FitSums<Number> &sums)
    {
      const Number s[4] = {p.stress.rr, p.stress.zz, p.stress.tt, p.stress.rz};
      sums.add(p.local.xi - Number(.5),
               (p.z - Number(cell.center_z)) * Number(cell.inverse_mean_height),
               p.mass,
               s);
    }

    /** Points of a partly filled cell: each is a quadrature point with its
     * volume as weight. @p modulus: of the stiffness bound. */
    template <typename Number>
    [[gnu::always_inline]] inline void
    add_stress(const CellToSum            &cell,
               const LoadedPoints<Number> &p,
               const double                modulus,
               ForceSums<Number>          &sums)
    {
      const Number inverse_width(cell.map.inverse_width);
      const Number inverse_r = Number(cell.axisymmetric) / p.r;
      sums.add(p.local, inverse_width, inverse_r, p.volume, p.stress);
      if (cell.bound_stiffness)
        sums.add_stiffness(p.local,
                           inverse_width,
                           inverse_r,
                           p.volume * Number(modulus));
    }

    /** The sums over the points of a cell into its moments: FitSums, or
     * ForceSums for a cell that takes no Gauss points. */
    template <typename InternalSums, typename Number>
    [[gnu::always_inline]] inline void
    sum_points(const PointsView &points,
               const CellToSum  &cell,
               const Material   *materials,
               const int         first_block,
               CellMoments      &moments)
    {
      const int         material = points.material(first_block);
      bool              several  = false;
      int               block    = first_block;
      PointSums<Number> sums;
      InternalSums      internal;
      sums.clear();
      internal.clear();
      do // a cell with moments has points
        {
          const PointBlock &b = points.blocks[block];
          const int own = points.material(block), count = points.count(block);
          with_lanes<Number>(count, [&](auto n_lanes) CAISSON_LAMBDA {
            for (int lane = 0; lane < n_lanes; lane += Number::width)
              {
                const LoadedPoints<Number> p(b, lane, cell.map);
                // Padding has neither mass nor volume: it adds nothing.
                sums.add(p.local,
                         p.mass,
                         Number::load(b.velocity_r + lane),
                         Number::load(b.velocity_z + lane));
                add_stress(cell, p, materials[own].p_wave_modulus, internal);
              }
          });
          several |= own != material;
          block = points.next[block];
        }
      while (block >= 0);
      sums.store(moments.mass); // and the momentum behind it
      internal.store(moments.internal);
      moments.several_materials = several;
      moments.material          = material;
    }

    /** Sum the points of a cell as it is integrated. The cell has the given
     * @p geometry, which may be that of the next step. */
    template <typename Number>
    void
    sum_points(const StepContext  &step,
               const CellGeometry &geometry,
               const unsigned int  cell)
    {
      const CellToSum to_sum(geometry,
                             step.grid.axisymmetric,
                             step.integration.has_minimum_nodal_mass);
      CellMoments    &moments = step.moments[cell];
      const int       first   = step.points.first_block[cell];
      if (moments.full > 0.)
        sum_points<FitSums<Number>, Number>(
          step.points, to_sum, step.materials, first, moments);
      else
        sum_points<ForceSums<Number>, Number>(
          step.points, to_sum, step.materials, first, moments);
    }

    /** ForceSums of a cell that also takes Gauss points, into out[16]. */
    template <typename Number>
    void
    sum_forces(const StepContext &step, const unsigned int cell, double *out)
    {
      const CellToSum   to_sum(step.grid.geometry[cell],
                             step.grid.axisymmetric,
                             step.integration.has_minimum_nodal_mass);
      ForceSums<Number> sums;
      sums.clear();
      for_each_block(step.points, cell, [&](const int block) CAISSON_LAMBDA {
        for (int lane = 0; lane < block_size; lane += Number::width)
          add_stress(to_sum,
                     LoadedPoints<Number>(step.points.blocks[block],
                                          lane,
                                          to_sum.map),
                     step.materials[step.points.material(block)].p_wave_modulus,
                     sums);
      });
      sums.store(out);
    }

    /** The part of the way from @p a to @p b, where x is in between. */
    [[gnu::always_inline]] inline double
    ramp(const double x, const double a, const double b)
    {
      const double part = (x - a) / (b - a);
      return part > 1. ? 1. : part > 0. ? part : 0.;
    }

    /**
     * How much of a free surface a cell is: 1 where the cells around one of
     * its corners are filled by a half or less on average, as at a plane
     * surface, 0 where they are filled by three quarters or more. What is a
     * count of points in one cell is a mean over four of them there.
     */
    [[gnu::always_inline]] inline double
    find_surface(const StepContext &step, const unsigned int cell)
    {
      double around = 1.;
      for (const unsigned int node : step.grid.nodes[cell].node)
        {
          const double filled = step.filled_at_node[node];
          around              = filled < around ? filled : around;
        }
      return 1. - ramp(around, .5, .75);
    }

    /**
     * The share of the Gauss points in the integration of a cell. At a free
     * surface a cell that is not filled is one in truth. Inside the soil the
     * number of points in a cell scatters while the mesh moves, and a cell
     * with fewer of them is no less full.
     */
    [[gnu::always_inline]] inline double
    find_share_of_gauss_points(const IntegrationSettings &settings,
                               const double               at_surface,
                               const double               filled_fraction)
    {
      // at a surface the filling is a volume and no count
      const double width_of_ramp = .3 - .25 * at_surface;
      const double full =
        settings.full_inside +
        at_surface * (settings.full_at_surface - settings.full_inside);
      return ramp(filled_fraction, full - width_of_ramp, full);
    }

    /**
     * The share to which the fit of a cell is bounded where its points are
     * off center (see add_distance_of_centers()): 1 at a free surface, and in
     * cells that are full and yet have few points. Where soil has come apart,
     * the slopes would come and go with the points.
     */
    [[gnu::always_inline]] inline double
    find_bound_of_fit(const double at_surface, const double filled_fraction)
    {
      const double in_full_cell = ramp(filled_fraction, .8, 1.);
      return at_surface > in_full_cell ? at_surface : in_full_cell;
    }

    /** Renew the moments of the cells of a group where they are out of date:
     * where points came or went, or where the kind of sums changes. */
    template <typename Number>
    [[gnu::always_inline]] inline void
    renew_moments(const StepContext       &step,
                  const CellGroup<Number> &group,
                  const CellMap<Number>   &map)
    {
      const Number fraction = group.lanes([&](const unsigned int c) {
        return step.points.filled_volume[c];
      }) / map.volume(step.grid.axisymmetric);
      for (int i = 0; i < group.n; ++i)
        {
          const unsigned int cell       = group.cell[i];
          const double       at_surface = find_surface(step, cell);
          const double       full = find_share_of_gauss_points(step.integration,
                                                         at_surface,
                                                         fraction[i]);
          const bool same_kind = (full > 0.) == (step.moments[cell].full > 0.);
          step.moments[cell].full = full;
          step.moments[cell].bounded =
            find_bound_of_fit(at_surface, fraction[i]);
          if (!step.points.changed[cell] && same_kind)
            continue;
          sum_points<Number>(step, step.grid.geometry[cell], cell);
          step.points.changed[cell] = false;
        }
    }
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
