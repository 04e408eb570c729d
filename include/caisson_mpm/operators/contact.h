// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Contact between soil and rigid body at the nodes of the grid.
//
// Bardenhagen et al. (2001), CMES 2, 509-522: with the relative velocity
// w = v - V of soil and body and the outward normal n of the body, a node with
// w.n < 0 is in contact. Its normal part is taken away, and the tangential part
// as far as friction allows:
//   |change of w_t| <= mu |w.n| + a A dt / m   (adhesion a on the area A).
// The force on the soil is m dw / dt; the body bears its opposite.
#ifndef caisson_mpm_operators_contact_h
#define caisson_mpm_operators_contact_h

#include <caisson_mpm/base/conventions.h>
#include <caisson_mpm/bodies/body_surface.h>
#include <caisson_mpm/domain/background_grid.h>

#include <array>
#include <vector>

namespace CaissonMPM
{
  /** Forces on the body by surface, whole circumference. Units: N. */
  using SurfaceForces = std::array<Vector2, n_surfaces>;

  /**
   * The contact nodes and what they do in a step. They are found on their own:
   * nodes of the body's surface to which soil has brought mass. The grid moves
   * with the body, so that normals never change, nor do areas (but for an
   * expanding cylinder, which has no adhesion).
   *
   * Every rank treats all nodes that it knows. It knows the whole surroundings
   * of those at cells that it owns; what it finds at the others is not used.
   * What is summed are the nodes that it owns. Not collective.
   */
  class Contact
  {
  public:
    /** Collect the surface nodes of the body from the grid's rigid cells. The
     * impulses stay. */
    void
    initialize(const BackgroundGrid &grid, const BodySurface &body);

    bool
    empty() const
    {
      return nodes.empty() && inner_nodes.empty();
    }

    /**
     * Correct the new nodal velocities @p v for the body's velocity, and add
     * the impulse on the body to impulse(). @p mass [n_nodes] is the mass that
     * accelerates; a node without soil has mass 0.
     * Returns the work that the body does on the soil, of the nodes of this
     * rank. Units: J.
     */
    double
    apply(const Vector2             &body_velocity,
          const double               dt,
          const std::vector<double> &mass,
          Kernels::NodalVector      *v);

    /**
     * Hold another velocity field to the contact found by the last apply():
     * the normal part at sliding nodes, all of it at sticking ones is that of
     * @p body_velocity.
     */
    void
    constrain(const Vector2 &body_velocity, Kernels::NodalVector *v) const;

    /**
     * The heat of friction of the last apply(): the work of the body less the
     * work of the contact forces on the nodes, whose mean velocity in the step
     * is @p mean_velocity, of the nodes of this rank. Units: J.
     */
    double
    friction_heat(const Kernels::NodalVector *mean_velocity) const;

    /** The body's velocity in the last apply(). */
    const Vector2 &
    body_velocity() const
    {
      return velocity;
    }

    /** Whether the node belongs to the body. */
    bool
    is_contact_node(const unsigned int node) const
    {
      return on_body[node];
    }

    /** The impulse on the body since the last reset, per surface, of the nodes
     * of this rank. Units: N s, whole circumference (per metre in plane
     * strain). */
    const SurfaceForces &
    impulse() const
    {
      return impulses;
    }
    void
    reset_impulse(const SurfaceForces &start = SurfaceForces());

    /** Nodes of this rank in contact, and of them those that stick, in the last
     * step. */
    unsigned int n_touching = 0, n_sticking = 0;

  private:
    struct Node
    {
      unsigned int           node;
      Surface                surface;
      unsigned int           n_normals; // of different direction: 1 or 2
      std::array<Vector2, 2> normal;
      Vector2                mean_normal;
      bool                   concave; // between lid and wall
      double                 friction;
      double                 adhesion; // a A, N per radian
    };
    enum class State : unsigned char
    {
      apart,
      sliding,
      sticking
    };
    struct Result
    {
      State   state   = State::apart;
      Vector2 normal  = Vector2();
      Vector2 impulse = Vector2(); // on the body, N s per radian
    };

    Result
    find_contact(const Node &node, const Vector2 &w) const;

    std::vector<Node>          nodes;
    std::vector<unsigned int>  inner_nodes; // inside the body
    std::vector<Result>        results;
    std::vector<bool>          on_body;
    BodySurface::CornerNormals corner_normals =
      BodySurface::CornerNormals::average;
    Vector2       velocity;
    SurfaceForces impulses;
    double        circumference = 2. * pi;
    unsigned int  n_owned_nodes = 0;
  };
} // namespace CaissonMPM

#endif
