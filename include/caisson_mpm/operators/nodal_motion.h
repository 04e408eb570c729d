// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The equation of motion at the nodes, and the nodal fields from which the
// material points are updated.
//
// With v = p / m the velocity that the points bring, v+ the new one, and
// A = S+ S the round trip from nodes to points and back (S interpolates, S+ is
// the mass-weighted average; A = M / m with the consistent mass matrix M):
//   FLIP       V_p <- V_p + S (v+ - v)
//   PIC        V_p <- S v+
//   XPIC(n)    V_p <- S (v+ + sum_{k=1}^{n-1} (I - A)^k v)
//   blend      V_p <- a FLIP + (1 - a) XPIC(n)
// (Sulsky et al. 1994; Hammerquist & Nairn 2017, doi:10.1016/j.cma.2017.01.035).
// MUSL strains the points with the velocity that they bring back to the nodes,
// S+ V_p; as A is known per cell, no second pass over the points is needed.
// USL strains them with v+.
//
// The velocities of the sums of XPIC and MUSL are held to the boundary
// conditions and to the contact found for v+: the transfer must not undo them.
#ifndef caisson_mpm_operators_nodal_motion_h
#define caisson_mpm_operators_nodal_motion_h

#include <caisson_mpm/domain/background_grid.h>
#include <caisson_mpm/domain/material_points.h>
#include <caisson_mpm/kernels/dispatch.h>
#include <caisson_mpm/operators/boundary_conditions.h>
#include <caisson_mpm/operators/contact.h>
#include <caisson_mpm/operators/loads.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * Works of one step at the nodes, on the whole circumference (per metre in
   * plane strain). Units: J.
   */
  struct NodalWork
  {
    double forces     = 0.; // of all forces on the nodes, before damping
    double load       = 0.; // of the body force of Loads, contained in forces
    double body       = 0.; // of the rigid body on the soil
    double prescribed = 0.; // of the nodes with a prescribed velocity
    double friction   = 0.; // heat at the body's surface
    double damping    = 0.; // taken by local damping
    double floor      = 0.; // taken by the mass that the floor adds
  };

  /**
   * Nodal sums and velocities of one step. The functions are called in the
   * order in which they stand here. Collective over MPI: what the points of all
   * ranks bring to a node is summed, and from then on every rank works on all
   * nodes that it knows.
   */
  class NodalMotion : public dealii::ParameterAcceptor
  {
  public:
    NodalMotion();

    void
    check_parameters() const;

    void
    initialize(const BackgroundGrid &grid);

    /** Sum mass, momentum and force of the points, the loads at @p time
     * included. */
    void
    collect(const Kernels::KernelTable           &kernels,
            MaterialPoints                       &points,
            const BackgroundGrid                 &grid,
            const std::vector<Kernels::Material> &materials,
            const Loads                          &loads,
            const double                          time);

    /** v = p / m, and v+ = v + dt f / m. Small masses are raised first. */
    void
    accelerate(const double dt, const Contact &contact);

    /** Contact on v+, then the boundary conditions. */
    void
    constrain(const double        dt,
              const Vector2      &body_velocity,
              BoundaryConditions &boundary_conditions,
              Contact            &contact);

    /** The fields that update the points. */
    void
    prepare_transfer(const Kernels::KernelTable &kernels,
                     const Kernels::PointsView  &points,
                     const Kernels::GridView    &grid,
                     const BoundaryConditions   &boundary_conditions,
                     const Contact              &contact);

    /** The works of this step, of the nodes of this rank. */
    NodalWork
    work_of_step(const double              dt,
                 const BoundaryConditions &boundary_conditions,
                 const Contact            &contact);

    Kernels::NodalFields
    fields() const;

    /** [n_cells], as collect() left them. */
    Kernels::CellMoments *
    cell_moments()
    {
      return moments.data();
    }

    /** With a surrounding pressure [Pa]. */
    Kernels::IntegrationSettings
    integration_settings(const double pressure_around) const;

    Kernels::UpdateSettings
    update_settings(const double dt) const;

    /** Mass that the floor added in the last step at the nodes of this rank, in
     * the units of the scaled mass. Units: kg per radian. */
    double added_mass = 0.;

    /** Whether all nodal velocities of the last step are finite. */
    bool is_finite = true;

    const NodalData &
    velocity() const
    {
      return new_velocity;
    }

    std::string
    description() const;

    /** Warnings where the choices are known to fail in jacked scenes. */
    std::vector<std::string>
    known_limits() const;

  private:
    /** Share of a point's own velocity that it keeps (FLIP: 1). */
    double
    keep_velocity() const;

    /** Order of XPIC in what it does not keep; 1: PIC. */
    unsigned int
    filter_order() const;

    template <typename Constrain>
    void
    round_trip(const Kernels::KernelTable &kernels,
               const Kernels::PointsView  &points,
               const Kernels::GridView    &grid,
               const NodalData            &from,
               NodalData                  &to,
               const Constrain            &constrain);

    std::string  transfer_scheme      = "blend";
    std::string  stress_scheme        = "MUSL";
    std::string  integration          = "Gauss in full cells";
    std::string  pressure             = "affine";
    unsigned int xpic_order           = 2;
    double       flip_fraction        = 0.95;
    double       full_fraction        = 0.9;
    double       full_fraction_inside = 0.5;
    bool         mean_volume          = true;
    double       stress_filter        = 0.01;
    bool         floor_on             = true;
    double       damping              = 0.;
    double       surrounding_pressure = 0.; // of this step
    bool         limiter_on           = true;
    double       limiter_factor       = 0.75;

    std::vector<double> load; // nodal body force of Loads, or empty

    unsigned int n_owned_nodes = 0;
    double       circumference = 2. * pi;
    double       work_of_body = 0., work_of_prescribed = 0.; // in this step
    std::vector<double>               mass;                  // that accelerates
    std::vector<Kernels::CellMoments> moments;
    NodalData sums, old_velocity, new_velocity, transfer_velocity,
      strain_velocity, work[2];
  };
} // namespace CaissonMPM

#endif
