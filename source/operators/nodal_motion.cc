// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/operators/nodal_motion.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  using namespace dealii;
  using Kernels::NodalVector;

  NodalMotion::NodalMotion()
    : ParameterAcceptor("/Method")
  {
    add_parameter("Velocity transfer",
                  transfer_scheme,
                  "How points take their velocity from the nodes. Units: none.",
                  prm,
                  Patterns::Selection("XPIC|PIC|FLIP|blend"));
    add_parameter("XPIC order",
                  xpic_order,
                  "Order of XPIC, alone and in the blend; 1 is PIC. Units: "
                  "none.",
                  prm,
                  Patterns::Integer(1, 10));
    add_parameter("FLIP fraction",
                  flip_fraction,
                  "Share of FLIP in the blend, the rest is XPIC. Units: none.",
                  prm,
                  Patterns::Double(0., 1.));
    add_parameter("Stress update",
                  stress_scheme,
                  "MUSL: strain from the velocities that the updated points "
                  "bring back to the nodes; USL: from the new nodal "
                  "velocities. Units: none.",
                  prm,
                  Patterns::Selection("MUSL|USL"));
    add_parameter("Integration",
                  integration,
                  "Of the internal force: at Gauss points in full cells and at "
                  "material points in the others, or at material points in all "
                  "cells. Units: none.",
                  prm,
                  Patterns::Selection("Gauss in full cells|material points"));
    add_parameter("Full cell fraction",
                  full_fraction,
                  "A cell at a free surface is full if its points fill this "
                  "share of its volume. Units: none.",
                  prm,
                  Patterns::Double(0.1, 2.));
    add_parameter(
      "Full cell fraction inside",
      full_fraction_inside,
      "A cell whose neighbors all have points is full if its points "
      "fill this share of its volume. Units: none.",
      prm,
      Patterns::Double(0.1, 2.));
    add_parameter("Pressure in full cells",
                  pressure,
                  "Fit the mean stress of a full cell's points by an affine "
                  "function, as the deviator, or by its mean. Units: none.",
                  prm,
                  Patterns::Selection("affine|mean"));
    add_parameter("Mean volume change",
                  mean_volume,
                  "Strain the points of a cell with its mean volume change "
                  "(B-bar), against locking. Units: none.");
    add_parameter("Stress filter",
                  stress_filter,
                  "Share of the misfit between a point's stress and the affine "
                  "fit of its cell that a step removes, in full cells. It "
                  "changes no nodal force. Units: none.",
                  prm,
                  Patterns::Double(0., 1.));
    add_parameter("Mass floor",
                  floor_on,
                  "Raise the mass that accelerates at nodes with little mass "
                  "to what the time step needs. Units: none.");
    add_parameter("Local damping",
                  damping,
                  "Share of the out-of-balance force that is taken against the "
                  "velocity, except at the body. Units: none.",
                  prm,
                  Patterns::Double(0., 0.95));
    add_parameter("Velocity limiter",
                  limiter_on,
                  "Cut the velocity of points in cells next to the body to k H "
                  "/ dt, H the cell's shortest side. Units: none.");
    add_parameter("Limiter factor",
                  limiter_factor,
                  "k of the velocity limiter. Units: none.",
                  prm,
                  Patterns::Double(0.01, 1.));
  }

  void
  NodalMotion::check_parameters() const
  {
    if (full_fraction_inside > full_fraction)
      throw BadInput("Method/Full cell fraction inside = " +
                     std::to_string(full_fraction_inside) +
                     " exceeds Method/Full cell fraction = " +
                     std::to_string(full_fraction) + ". Reduce it.");
    if (stress_scheme == "USL" && transfer_scheme == "FLIP" && damping == 0. &&
        !floor_on)
      throw BadInput("Method/Stress update = USL with Velocity transfer = FLIP "
                     "needs Mass floor = true or Local damping: it is unstable "
                     "at nodes with little mass.");
  }

  void
  NodalMotion::initialize(const BackgroundGrid &grid)
  {
    grid.reinit(sums, sizeof(Kernels::NodalSums) / sizeof(double));
    for (NodalData *v : {&old_velocity,
                         &new_velocity,
                         &transfer_velocity,
                         &strain_velocity,
                         &work[0],
                         &work[1]})
      grid.reinit(*v, 2);
    mass.assign(grid.n_nodes(), 0.);
    n_owned_nodes = grid.n_owned_nodes();
    circumference = grid.circumference();
  }

  namespace
  {
    NodalVector *
    data(NodalData &v)
    {
      return reinterpret_cast<NodalVector *>(v.begin());
    }

    const NodalVector *
    data(const NodalData &v)
    {
      return reinterpret_cast<const NodalVector *>(v.begin());
    }
  } // namespace

  void
  NodalMotion::collect(const Kernels::KernelTable           &kernels,
                       MaterialPoints                       &points,
                       const BackgroundGrid                 &grid,
                       const std::vector<Kernels::Material> &materials,
                       const Loads                          &loads,
                       const double                          time)
  {
    sums = 0.;
    sums.zero_out_ghost_values();
    const auto  view  = points.view();
    auto *const nodes = reinterpret_cast<Kernels::NodalSums *>(sums.begin());
    moments.resize(grid.n_cells());
    surrounding_pressure = loads.surrounding_pressure(time);
    kernels.points_to_grid(view,
                           grid.view(),
                           materials.data(),
                           integration_settings(surrounding_pressure),
                           nodes,
                           moments.data());
    loads.find_body_force(points, grid, time, mass.size(), load);
    for (unsigned int k = 0; k < load.size(); ++k)
      nodes[k / 2].force[k % 2] += load[k];
    sums.compress(VectorOperation::add);
    sums.update_ghost_values();
  }

  namespace
  {
    double
    sign(const double x)
    {
      return x > 0. ? 1. : x < 0. ? -1. : 0.;
    }
  } // namespace

  void
  NodalMotion::accelerate(const double dt, const Contact &contact)
  {
    const auto *node     = reinterpret_cast<Kernels::NodalSums *>(sums.begin());
    NodalVector *const v = data(old_velocity), *const u = data(new_velocity);
    added_mass        = 0.;
    double     sum    = 0.;
    const bool damped = damping > 0.;
    for (unsigned int i = 0; i < mass.size(); ++i, ++node)
      {
        if (node->mass <= 0.)
          {
            mass[i] = 0.;
            v[i] = u[i] = NodalVector();
            continue;
          }
        mass[i] = std::max(node->mass, .25 * dt * dt * node->stiffness);
        if (i < n_owned_nodes)
          added_mass += mass[i] - node->mass;
        const double share =
          damped && !contact.is_contact_node(i) ? damping : 0.;
        for (unsigned int d = 0; d < 2; ++d)
          {
            v[i].value[d]      = node->momentum[d] / node->mass;
            const double force = node->force[d] - share *
                                                    std::abs(node->force[d]) *
                                                    sign(v[i].value[d]);
            u[i].value[d] = v[i].value[d] + dt * force / mass[i];
            sum += u[i].value[d];
          }
      }
    is_finite = std::isfinite(sum);
  }

  void
  NodalMotion::constrain(const double        dt,
                         const Vector2      &body_velocity,
                         BoundaryConditions &boundary_conditions,
                         Contact            &contact)
  {
    work_of_body = 0.;
    if (!contact.empty())
      work_of_body = contact.apply(body_velocity, dt, mass, data(new_velocity));
    work_of_prescribed = boundary_conditions.apply(mass, data(new_velocity));
  }

  template <typename Constrain>
  void
  NodalMotion::round_trip(const Kernels::KernelTable &kernels,
                          const Kernels::PointsView  &points,
                          const Kernels::GridView    &grid,
                          const NodalData            &from,
                          NodalData                  &to,
                          const Constrain            &constrain)
  {
    to = 0.;
    to.zero_out_ghost_values();
    kernels.apply_mass(points, grid, moments.data(), data(from), data(to));
    to.compress(VectorOperation::add);
    to.update_ghost_values();
    const auto *node     = reinterpret_cast<Kernels::NodalSums *>(sums.begin());
    NodalVector *const v = data(to);
    for (unsigned int i = 0; i < mass.size(); ++i)
      if (node[i].mass > 0.)
        for (unsigned int d = 0; d < 2; ++d)
          v[i].value[d] /= node[i].mass;
    constrain(v);
  }

  namespace
  {
    /** Hold a velocity field to what holds the new one. */
    void
    hold_to(const Contact            &contact,
            const BoundaryConditions &boundary_conditions,
            NodalVector              *v)
    {
      if (!contact.empty())
        contact.constrain(contact.body_velocity(), v);
      boundary_conditions.constrain(v);
    }
  } // namespace

  void
  NodalMotion::prepare_transfer(const Kernels::KernelTable &kernels,
                                const Kernels::PointsView  &points,
                                const Kernels::GridView    &grid,
                                const BoundaryConditions   &boundary_conditions,
                                const Contact              &contact)
  {
    const auto hold = [&](NodalVector *v) {
      hold_to(contact, boundary_conditions, v);
    };
    const auto hold_difference = [&](NodalVector *v) {
      if (!contact.empty())
        contact.constrain(Vector2(), v);
      boundary_conditions.constrain_difference(v);
    };
    const std::size_t n   = 2 * mass.size();
    const double     *old = old_velocity.begin(), *v = new_velocity.begin();
    double *const     transfer = transfer_velocity.begin();
    const double      keep     = keep_velocity();

    // the part that is added to keep * V_p
    for (std::size_t i = 0; i < n; ++i)
      transfer[i] = v[i] - keep * old[i];
    if (filter_order() > 1)
      {
        std::copy_n(old, n, work[0].begin());
        hold(data(work[0]));
        for (unsigned int k = 1; k < filter_order(); ++k)
          {
            // from the second round on the field is a difference
            round_trip(
              kernels, points, grid, work[0], work[1], [&](NodalVector *u) {
                k == 1 ? hold(u) : hold_difference(u);
              });
            for (std::size_t i = 0; i < n; ++i)
              {
                // (I - A)^k v; differences of held fields stay held
                work[0].begin()[i] -= work[1].begin()[i];
                transfer[i] += (1. - keep) * work[0].begin()[i];
              }
          }
      }
    if (stress_scheme == "USL")
      return;
    round_trip(kernels,
               points,
               grid,
               transfer_velocity,
               strain_velocity,
               [](NodalVector *) {});
    double *const strain = strain_velocity.begin();
    for (std::size_t i = 0; i < n; ++i)
      strain[i] += keep * old[i];
    hold(data(strain_velocity));
  }

  NodalWork
  NodalMotion::work_of_step(const double              dt,
                            const BoundaryConditions &boundary_conditions,
                            const Contact            &contact)
  {
    // the old velocity held to what holds the new one
    NodalData &held = work[0];
    std::copy_n(old_velocity.begin(), 2 * mass.size(), held.begin());
    hold_to(contact, boundary_conditions, data(held));

    NodalWork   result;
    const auto *node = reinterpret_cast<Kernels::NodalSums *>(sums.begin());
    const double *const v0 = old_velocity.begin(), *h = held.begin(),
                        *v = new_velocity.begin(), *s = fields().strain->value;
    const bool damped = damping > 0.;
    for (unsigned int i = 0; i < n_owned_nodes; ++i, ++node)
      for (unsigned int d = 0; d < 2; ++d)
        {
          const unsigned int k = 2 * i + d;
          const double       f = dt * node->force[d], mean = .5 * (h[k] + v[k]);
          result.forces += f * .5 * (h[k] + s[k]);
          result.floor +=
            (mass[i] - std::max(0., node->mass)) * (v[k] - v0[k]) * mean;
          if (damped && !contact.is_contact_node(i))
            result.damping += damping * std::abs(f) * sign(v0[k]) * mean;
        }
    // the load is what this rank's points bring, to all of their nodes
    for (unsigned int k = 0; k < load.size(); ++k)
      result.load += dt * load[k] * .5 * (h[k] + s[k]);
    for (unsigned int k = 0; k < 2 * mass.size(); ++k)
      held.begin()[k] = .5 * (h[k] + v[k]);
    for (double *sum :
         {&result.forces, &result.load, &result.floor, &result.damping})
      *sum *= circumference;
    result.body       = work_of_body;
    result.prescribed = work_of_prescribed;
    if (!contact.empty())
      result.friction = contact.friction_heat(data(held));
    return result;
  }

  Kernels::NodalFields
  NodalMotion::fields() const
  {
    return {data(new_velocity),
            data(transfer_velocity),
            data(stress_scheme == "USL" ? new_velocity : strain_velocity)};
  }

  unsigned int
  NodalMotion::filter_order() const
  {
    return transfer_scheme == "XPIC" || transfer_scheme == "blend" ?
             xpic_order :
             1;
  }

  double
  NodalMotion::keep_velocity() const
  {
    return transfer_scheme == "FLIP"  ? 1. :
           transfer_scheme == "blend" ? flip_fraction :
                                        0.;
  }

  Kernels::IntegrationSettings
  NodalMotion::integration_settings(const double pressure_around) const
  {
    const bool at_points = integration == "material points";
    return {at_points ? 1e300 : full_fraction,
            at_points ? 1e300 : full_fraction_inside,
            floor_on,
            pressure == "mean",
            pressure_around};
  }

  Kernels::UpdateSettings
  NodalMotion::update_settings(const double dt) const
  {
    return {dt,
            keep_velocity(),
            mean_volume,
            limiter_on ? limiter_factor : 0.,
            stress_filter,
            surrounding_pressure};
  }

  std::string
  NodalMotion::description() const
  {
    const std::string xpic = "XPIC(" + std::to_string(xpic_order) + ")";
    return stress_scheme + ", " +
           (transfer_scheme == "XPIC"  ? xpic :
            transfer_scheme == "blend" ? "FLIP and " + xpic :
                                         transfer_scheme) +
           ", " + integration;
  }

  std::vector<std::string>
  NodalMotion::known_limits() const
  {
    std::vector<std::string> limits;
    if (integration == "material points")
      limits.push_back("Method/Integration = material points makes noise where "
                       "points cross cells; it has been seen to halve the tip "
                       "force of a caisson: see doc/limitations.md");
    if (transfer_scheme == "PIC")
      limits.push_back("Method/Velocity transfer = PIC is viscous: a pulse "
                       "loses a third of its energy over 20 of its lengths: "
                       "see doc/limitations.md");
    return limits;
  }
} // namespace CaissonMPM
