// SPDX-License-Identifier: LGPL-2.1-or-later
//
// From the points of each cell to its nodes.
//
// Equations (per radian; kappa = 1 axisymmetric, 0 plane strain; Sulsky, Chen
// & Schreyer 1994, doi:10.1016/0045-7825(94)90112-0):
//   m_I = sum m_p N_I,  p_I = sum m_p v_p N_I,
//   f_I = sum m_p b N_I - int (sigma . grad N_I + e_r kappa sigma_tt N_I/r) dV.
// The integral runs over 2 x 2 Gauss points in full cells, with the stress
// reconstructed from the MPs by an affine least-squares fit in (r, z), which is
// exact for a K0 state, and over the MPs in nearly empty ones. Cells in between
// take a mixture of both (cell_sums.h).
#ifndef caisson_mpm_kernels_points_to_grid_h
#define caisson_mpm_kernels_points_to_grid_h

#include <caisson_mpm/kernels/cell_pressure.h>
#include <caisson_mpm/kernels/laws.h>
#include <caisson_mpm/kernels/layout.h>

namespace CaissonMPM::Kernels
{
  inline namespace CAISSON_KERNEL_ISA
  {
    /** What cells add to their corners, one cell in each lane. */
    template <typename Number>
    struct CellContribution
    {
      Number mass[4], momentum[2][4], force[2][4], stiffness[4];

      [[gnu::always_inline]] inline CellContribution(
        const LaneSums<Number, 17> &sums,
        const Number               *body_force,
        const Number                inertia)
      {
        moments_to_corners(sums.sum, mass);
        for (int c = 0; c < 2; ++c)
          {
            moments_to_corners(sums.sum + PointSums<Number>::momentum + 4 * c,
                               momentum[c]);
            for (int i = 0; i < 4; ++i)
              {
                force[c][i] = mass[i] * body_force[c];
                momentum[c][i] *= inertia;
              }
          }
        for (Number &m : mass)
          m *= inertia;
      }

      [[gnu::always_inline]] inline void
      add_forces(const LaneSums<Number, 16> &sums)
      {
        Number corner[4];
        moments_to_corners(sums.sum, corner);
        for (int i = 0; i < 4; ++i)
          force[0][i] -= corner[i];
        for (int c = 0; c < 2; ++c)
          {
            gradient_moments_to_corners(sums.sum + 4 + 4 * c, corner);
            for (int i = 0; i < 4; ++i)
              force[c][i] -= corner[i];
          }
        for (int i = 0; i < 4; ++i)
          stiffness[i] = sums.sum[ForceSums<Number>::stiffness + i];
      }

      [[gnu::always_inline]] inline void
      scatter(const CellGroup<Number> &group,
              const CellNodes         *nodes_of,
              NodalSums               *nodes) const
      {
        constexpr int width = Number::width, n_sums = 8;
        static_assert(sizeof(NodalSums) == n_sums * sizeof(double));
        for (int k = 0; k < 4; ++k)
          {
            // in the order of NodalSums
            const Number all[n_sums] = {mass[k],
                                        momentum[0][k],
                                        momentum[1][k],
                                        force[0][k],
                                        force[1][k],
                                        stiffness[k],
                                        Number(0.),
                                        Number(0.)};
            for (int j = 0; j < n_sums; j += width)
              {
                Number of_cell[width];
                transpose(all + j, of_cell);
                for (int i = 0; i < group.n; ++i)
                  {
                    double *const node =
                      &nodes[nodes_of[group.cell[i]].node[k]].mass + j;
                    (Number::load(node) + of_cell[i]).store(node);
                  }
              }
          }
      }
    };

    /**
     * The bound of sum_J |K_IJ| of full cells, from the gradients at the
     * center: sharp for lumped mass on a regular grid, where the floor that
     * follows from it is below the mass for any Courant number below one.
     */
    template <typename Number>
    [[gnu::always_inline]] inline void
    find_full_stiffness(const CellMap<Number> &map,
                        const double           axisymmetric,
                        const Number           modulus,
                        Number                *stiffness)
    {
      const Number inverse_height = Number(1.) / map.mean_height();
      const Number slope          = map.rise();
      const Number hoop =
        Number(.25 * axisymmetric) / (map.left + Number(.5) * map.width);
      Number total(0.);
      for (int i = 0; i < 4; ++i)
        {
          const Number half_r(i % 2 ? .5 : -.5), half_z(i / 2 ? .5 : -.5);
          const Number g_r = (half_r - half_z * slope) * map.inverse_width,
                       g_z = half_z * inverse_height;
          stiffness[i]     = sqrt(g_r * g_r + g_z * g_z + hoop * hoop);
          total += stiffness[i];
        }
      const Number scale = modulus * map.volume(axisymmetric) * total;
      for (int i = 0; i < 4; ++i)
        stiffness[i] *= scale;
    }

    /** Add to the stiffness bound of cells that are filled in part what the
     * water in them has beyond its stiffness at the points: its pressure acts
     * with the gradients of the whole cell (cell_pressure.h), also on nodes
     * that the points hardly reach. */
    template <typename Number>
    [[gnu::always_inline]] inline void
    add_stiffness_of_water(const StepContext       &step,
                           const CellGroup<Number> &group,
                           const CellMap<Number>   &map,
                           LaneSums<Number, 16>    &internal)
    {
      if (!step.integration.has_minimum_nodal_mass)
        return;
      Number stiffness[4];
      find_full_stiffness(map,
                          step.grid.axisymmetric,
                          group.lanes([&](const unsigned int c) {
                            // the water is the same in all materials
                            return (acting_share(step, c) -
                                    step.moments[c].full) *
                                   step.materials[0].water_modulus;
                          }),
                          stiffness);
      for (int i = 0; i < 4; ++i)
        internal.sum[ForceSums<Number>::stiffness + i] += stiffness[i];
    }

    /** The internal force of full cells, from the fitted stress. */
    template <typename Number>
    [[gnu::always_inline]] inline void
    integrate_full_cells(const CellMap<Number> &map,
                         const double           axisymmetric,
                         const Number          *fit,
                         ForceSums<Number>     &forces)
    {
      forces.clear();
      const Number inverse_mean_height = Number(1.) / map.mean_height();
      for (int i = 0; i < GaussPoint<Number>::n; ++i)
        {
          const GaussPoint<Number> gauss(map, axisymmetric, i);
          const Number z = map.bottom + map.bottom_slope * gauss.point.xi +
                           gauss.point.height * gauss.point.eta;
          const Number x = gauss.point.xi - Number(.5),
                       y = (z - map.center_z()) * inverse_mean_height;
          forces.add(gauss.point,
                     map.inverse_width,
                     gauss.inverse_r,
                     gauss.volume,
                     StressState<Number>{evaluate_fit(fit, x, y),
                                         evaluate_fit(fit + 3, x, y),
                                         evaluate_fit(fit + 6, x, y),
                                         evaluate_fit(fit + 9, x, y)});
        }
    }

    /** In a cell of several materials, add what the body force of each
     * differs from that of the first, which the whole cell has been given. */
    template <typename Number>
    void
    add_other_body_forces(const StepContext &step,
                          const unsigned int cell,
                          NodalSums         *nodes)
    {
      const PointsView     &points    = step.points;
      const GridView       &grid      = step.grid;
      const Material *const materials = step.materials;
      const CellMap<>       map(grid.geometry[cell]);
      const int             first     = points.first_block[cell];
      const Material       &reference = materials[points.material(first)];
      for_each_block(points, cell, [&](const int block) CAISSON_LAMBDA {
        const PointBlock &b   = points.blocks[block];
        const Material   &own = materials[points.material(block)];
        PointSums<Number> sums;
        sums.clear();
        for (int lane = 0; lane < block_size; lane += Number::width)
          sums.add(map.at_position(Number::load(b.r + lane),
                                   Number::load(b.z + lane)),
                   Number::load(b.mass + lane),
                   Number(0.),
                   Number(0.));
        double moments[4], corner[4];
        for (int i = 0; i < 4; ++i)
          moments[i] = sum(sums.sum[i]);
        moments_to_corners(moments, corner);
        for (int c = 0; c < 2; ++c)
          for (int i = 0; i < 4; ++i)
            nodes[grid.nodes[cell].node[i]].force[c] +=
              corner[i] * (own.body_force[c] - reference.body_force[c]);
      });
    }

    /** The largest modulus among the materials of a cell. */
    [[gnu::always_inline]] inline double
    largest_modulus(const StepContext &step, const unsigned int cell)
    {
      const PointsView     &points    = step.points;
      const Material *const materials = step.materials;
      const CellMoments    &moments   = step.moments[cell];
      double                result = materials[moments.material].p_wave_modulus;
      if (moments.several_materials)
        for_each_block(points, cell, [&](const int block) CAISSON_LAMBDA {
          const double own = materials[points.material(block)].p_wave_modulus;
          result           = own > result ? own : result;
        });
      return result;
    }

    /** The volume of the soil of a cell at the start, if all of it gains
     * volume in shear; else 0. */
    [[gnu::always_inline]] inline double
    volume_of_gaining_soil(const StepContext &step, const unsigned int cell)
    {
      const CellMoments &moments  = step.moments[cell];
      const Material    &material = step.materials[moments.material];
      if (material.volume_in_shear != VolumeInShear::gained)
        return 0.;
      if (!moments.several_materials)
        return moments.mass[0] / material.initial_density;
      const PointsView &points = step.points;
      double            result = 0.;
      bool              all    = true;
      for_each_block(points, cell, [&](const int block) CAISSON_LAMBDA {
        const Material &own = step.materials[points.material(block)];
        all &= own.volume_in_shear == VolumeInShear::gained;
        double mass = 0.; // padding has none
        for (int lane = 0; lane < block_size; ++lane)
          mass += points.blocks[block].mass[lane];
        result += mass / own.initial_density;
      });
      return all ? result : 0.;
    }

    /**
     * The share of the slope of the mean stress that acts on the nodes of a
     * cell. B-bar gives all points of a cell the same change of volume. Where
     * soil dilates in shear, those that shear more gain pressure, and no
     * strain takes it away again. The mean stress that is conjugate to B-bar
     * is the mean over the cell. Soil that has not dilated keeps its slope,
     * and its equilibrium with the weight.
     */
    [[gnu::always_inline]] inline double
    pressure_slope(const StepContext &step, const unsigned int cell)
    {
      switch (step.integration.pressure_slope)
        {
          case PressureSlope::acts:
            return 1.;
          case PressureSlope::ignored:
            return 0.;
          default:
            {
              const double initial = volume_of_gaining_soil(step, cell);
              if (initial == 0.)
                return 1.;
              const double dilation =
                step.points.filled_volume[cell] / initial - 1.;
              return 1. - ramp(dilation, .005, .02);
            }
        }
    }

    /**
     * The largest change of the trace of the stress over a cell, in r (d = 0)
     * or z, that acts on its nodes. At a convex corner of the body the change
     * of volume varies so much within a cell that a slope of the mean stress,
     * which B-bar leaves without a strain that answers, makes energy. There
     * no more than the weight can cause acts: in an initial state with K0 up
     * to 4 that is all of it. That holds for soil whose volume shear does not
     * change: with two cells across a tip in dense hypoplastic sand, the mean
     * makes the tip too stiff by two thirds.
     */
    [[gnu::always_inline]] inline double
    largest_change_of_trace(const StepContext &step,
                            const unsigned int cell,
                            const int          d)
    {
      const Material &material = step.materials[step.moments[cell].material];
      if (material.volume_in_shear != VolumeInShear::kept ||
          !(material.is_frictionless ||
            step.grid.flags[cell] & at_corner_of_body))
        return unlimited;
      const CellGeometry &g = step.grid.geometry[cell];
      const double        size =
        d == 0 ? g.width : .5 * (g.height_left + g.height_right);
      const double weight = material.initial_density * material.body_force[d];
      return 9. * size * (weight < 0. ? -weight : weight);
    }

    /** Both of them for the cells of a group. */
    template <typename Number>
    [[gnu::always_inline]] inline KeptPressureSlope<Number>
    kept_pressure_slope(const StepContext &step, const CellGroup<Number> &group)
    {
      const auto largest = [&](const int d) CAISSON_LAMBDA {
        return group.lanes([&](const unsigned int c) {
          return largest_change_of_trace(step, c, d);
        });
      };
      return {group.lanes(
                [&](const unsigned int c) { return pressure_slope(step, c); }),
              {largest(0), largest(1)}};
    }

    /** ForceSums of the cells of a group that are integrated at their points,
     * wholly or in part. @p rows: the internal sums of the cells. */
    template <typename Number>
    [[gnu::always_inline]] inline LaneSums<Number, 16>
    sums_at_points(const StepContext       &step,
                   const CellGroup<Number> &group,
                   double *const           *rows)
    {
      constexpr int        width = Number::width;
      double               mixed[width][16];
      const double        *sums[width];
      LaneSums<Number, 16> result;
      for (int i = 0; i < width; ++i)
        {
          const double full = step.moments[group.cell[i]].full;
          sums[i]           = rows[i];
          if (full > 0. && full < 1.)
            {
              sum_forces<Number>(step, group.cell[i], mixed[i]);
              sums[i] = mixed[i];
            }
        }
      result.load_lanes(sums);
      return result;
    }

    /**
     * Replace the sums over the points in @p internal, which are those in
     * @p rows, by the moments of the divergence of the stress: over Gauss
     * points in full cells, and mixed where cells are partly filled. The
     * coefficients of the fit go to @p rows, where the stress filter finds
     * them when the points are updated.
     */
    template <typename Number>
    [[gnu::always_inline]] inline void
    integrate_stress(const StepContext          &step,
                     const CellGroup<Number>    &group,
                     const CellMap<Number>      &map,
                     const LaneSums<Number, 17> &sums,
                     double *const              *rows,
                     LaneSums<Number, 16>       &internal)
    {
      // Lanes hold all kinds of cells. Nothing branches on a lane: all are
      // computed as if they were full, and take what is theirs.
      const Number full =
        group.lanes([&](const unsigned int c) { return step.moments[c].full; });
      if (!any(full > Number(0.)))
        return;
      LaneSums<Number, 16> at_points = internal;
      if (any(full < Number(1.)))
        at_points = sums_at_points(step, group, rows);

      // sigma(x, y) = c0 + c1 x + c2 y, by least squares over the points
      LaneSums<Number, 16> fit;
      fit.clear();
      const KeptPressureSlope<Number> slope = kept_pressure_slope(step, group);
      const auto find_fit = [&](const Number &bounded) CAISSON_LAMBDA {
        fit_stress(map,
                   step.grid.axisymmetric,
                   sums.sum,
                   internal.sum,
                   slope,
                   bounded,
                   fit.sum);
      };
      // The stress filter takes the fit as it is: a reduced one would change
      // the stress of soil in equilibrium.
      find_fit(Number(0.));
      fit.store_lanes(group.n, rows);
      find_fit(group.lanes(
        [&](const unsigned int c) { return step.moments[c].bounded; }));

      // int (sigma . grad N_I + e_r kappa sigma_tt N_I / r) dV
      ForceSums<Number> forces;
      integrate_full_cells(map, step.grid.axisymmetric, fit.sum, forces);

      // the bound of sum_J |K_IJ|, for the mass floor
      if (step.integration.has_minimum_nodal_mass)
        find_full_stiffness(map,
                            step.grid.axisymmetric,
                            group.lanes([&](const unsigned int c) {
                              return largest_modulus(step, c);
                            }),
                            forces.sum + forces.stiffness);
      for (int k = 0; k < forces.size; ++k)
        internal.sum[k] =
          full * forces.sum[k] + (Number(1.) - full) * at_points.sum[k];
    }

    /** See KernelTable. Lanes are cells, but for sums over points. */
    template <typename Number>
    void
    points_to_grid(const StepContext &step, NodalSums *nodes)
    {
      constexpr int width = Number::width;
      for (unsigned int begin = 0; begin < step.points.n_active_cells;
           begin += width)
        {
          const CellGroup<Number> group(step.points, begin);
          const CellMap<Number>   map = group.map(step.grid.geometry);

          // 1. Sums over the points. Most are left from grid_to_points, which
          //    made them while the points were in the cache; cells that
          //    points entered or left are summed here.
          renew_moments(step, group, map);
          double *rows[width], *internal_rows[width];
          for (int i = 0; i < width; ++i)
            {
              rows[i]          = step.moments[group.cell[i]].mass;
              internal_rows[i] = step.moments[group.cell[i]].internal;
            }
          LaneSums<Number, 17> sums;
          LaneSums<Number, 16> internal;
          sums.load_lanes(rows);
          internal.load_lanes(internal_rows);

          // 2. m_I = sum m_p N_I, p_I = sum m_p v_p N_I, and the weight
          //    sum m_p b N_I with the body force of the first material: all
          //    follow from moments, as N_I is bilinear in (xi, eta).
          const Number body_force[2] = {
            group.lanes([&](const unsigned int c) {
              return step.materials[step.moments[c].material].body_force[0];
            }),
            group.lanes([&](const unsigned int c) {
              return step.materials[step.moments[c].material].body_force[1];
            })};
          CellContribution<Number> contribution(
            sums, body_force, group.lanes([&](const unsigned int c) {
              return inertia_in(step, c);
            }));

          // 3. f_I -= int (sigma . grad N_I + e_r kappa sigma_tt N_I/r) dV,
          //    over Gauss points and points.
          integrate_stress(step, group, map, sums, internal_rows, internal);
          if (step.pore_pressure != nullptr)
            {
              add_cell_pressure(step, group, map, internal);
              add_stiffness_of_water(step, group, map, internal);
            }
          contribution.add_forces(internal);

          // 4. Add to the nodes, cell by cell, because cells share nodes.
          contribution.scatter(group, step.grid.nodes, nodes);
          for (int i = 0; i < group.n; ++i)
            {
              if (step.moments[group.cell[i]].several_materials)
                add_other_body_forces<Number>(step, group.cell[i], nodes);
              if (step.pore_pressure != nullptr)
                add_pressure_of_body(step, group.cell[i], nodes);
            }
        }
    }
  } // namespace CAISSON_KERNEL_ISA
} // namespace CaissonMPM::Kernels

#endif
