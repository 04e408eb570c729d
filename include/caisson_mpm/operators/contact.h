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
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/contact_corners.h>

#include <array>
#include <vector>

namespace CaissonMPM
{
  /** A vector for each surface of the body, for the whole circumference (per
   * meter in plane strain): forces in N, impulses in N s. */
  using SurfaceForces = std::array<Vector2, n_surfaces>;

  /** What the contact did in one step, at the nodes that this rank owns. */
  struct ContactResult
  {
    SurfaceForces impulse    = {}; // on the body; units: N s
    double        work       = 0.; // of the body on the soil; units: J
    double        inflow     = 0.; // of soil into the body; units: m3
    unsigned int  n_touching = 0, n_sticking = 0; // the second of the first
  };

  /**
   * The contact nodes and what they do in a step. No list of contact nodes is
   * given: they are the nodes of the body's surface to which soil has brought
   * mass. The grid moves with the body, so that normals never change, nor do
   * areas (but for an expanding cylinder, which has no adhesion).
   *
   * Every rank treats all nodes that it knows. It knows the whole surroundings
   * of those at cells that it owns; what it finds at the others is not used.
   * Results are of the nodes that it owns: sum them over ranks. Not collective.
   */
  class Contact
  {
  public:
    /** Collect the surface nodes of the body from the grid's rigid cells. */
    void
    initialize(const BackgroundGrid &grid, const BodySurface &body);

    /** Give the faces another strength than that of the body's entries, for
     * instance that of the soil beside them. */
    void
    set_strength(const FaceStrengthOf &strength_at);

    /** Find the share of the area of each node that soil covers, on which
     * adhesion acts in this step, from the mean share @p filled [n_nodes] of
     * the soil cells at the node. Adhesion above the soil would push the few
     * points there out of the mesh. */
    void
    cover(const double *filled);

    bool
    empty() const
    {
      return faces.empty() && inner_nodes.empty();
    }

    /**
     * Correct the new nodal velocities @p v for the body's velocity. A node
     * without soil has no @p mass [n_nodes].
     */
    ContactResult
    apply(const Vector2             &body_velocity,
          const double               dt,
          const std::vector<double> &mass,
          Kernels::NodalVector      *v);

    /** Let the lid touch soil only at nodes of cells that are filled to
     * @p touching: without this, it does so as soon as soil has entered the cell
     * beneath it. @p filled [n_cells] is the share of each cell below the
     * mudline. */
    void
    open_lid(const std::vector<double> &filled, const double touching);

    /** The impulse on the body and the mass that it moves, for a body that
     * keeps its velocity; for the whole circumference. Units: N s, kg. */
    struct Response
    {
      Vector2 impulse, mass;

      /** Return both along a direction. */
      std::vector<double>
      along(const Vector2 &direction) const
      {
        double moved = 0.;
        for (unsigned int d = 0; d < 2; ++d)
          moved += mass[d] * direction[d] * direction[d];
        return {impulse * direction, moved};
      }
    };

    /** Return what apply() would do to a body that has the velocity
     * @p body_velocity, and the mass of the soil that would move with it in r
     * and z, at nodes that stick to it or are pressed by it. @p sums and the
     * new velocities @p v [n_nodes] are those before apply(); the corners have
     * been accelerated. */
    Response
    respond(const Vector2              &body_velocity,
            const double                dt,
            const Kernels::NodalSums   *sums,
            const std::vector<double>  &mass,
            const Kernels::NodalVector *v);

    /** The corners of the body at which each face has a velocity of its own. */
    ContactCorners &
    corners()
    {
      return corners_;
    }
    const ContactCorners &
    corners() const
    {
      return corners_;
    }

    /**
     * Constrain another velocity field by the contact of the last apply():
     * the normal part at sliding nodes, all of it at sticking ones is that of
     * @p body_velocity.
     */
    void
    constrain(const Vector2 &body_velocity, Kernels::NodalVector *v) const;

    /**
     * The same for a field of which the soil gains the momentum @p share times
     * m_I v_I: the body bears what the soil does not gain. @p result is that of
     * the last apply().
     */
    void
    constrain(const Vector2            &body_velocity,
              const Kernels::NodalSums *sums,
              const double              share,
              Kernels::NodalVector     *v,
              ContactResult            &result);

    /**
     * The heat of friction of the last apply(): the work of the body less the
     * work of the contact forces on the nodes, whose mean velocity in the step
     * is @p mean_velocity, of the nodes of this rank. Units: J.
     */
    double
    friction_heat(const Kernels::NodalVector *mean_velocity) const;

    /** Call action(node, surface, impulse) for what the body has borne in the
     * last step, at the nodes that this rank owns: the terms of
     * ContactResult::impulse. Units: N s. */
    template <typename Action>
    void
    for_each_impulse(const Action &action) const
    {
      for (unsigned int i = 0; i < nodes.size(); ++i)
        if (results[i].state != State::apart && nodes[i].node < n_owned_nodes)
          action(nodes[i].node,
                 surface_of(nodes[i]),
                 circumference * results[i].impulse);
      corners_.for_each_reaction([&](const unsigned int            node,
                                     const std::array<Surface, 2> &surfaces,
                                     const CornerReaction         &reaction) {
        for (unsigned int i = 0; node < n_owned_nodes && i < 2; ++i)
          action(node, surfaces[i], circumference * reaction.impulse[i]);
      });
    }

    /** Call action(face, end, strength) for the two ends of each face, as far
     * as the force at that node counts to the surface of the face. */
    template <typename Action>
    void
    for_each_end(const Action &action) const
    {
      for (unsigned int f = 0; f < faces.size(); ++f)
        for (unsigned int i = 0; i < 2; ++i)
          if (const int k = nodes_of_faces[f][i];
              k < 0 || surface_of(nodes[k]) == faces[f].surface)
            action(faces[f], i, strengths[f]);
    }

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

  private:
    struct Node
    {
      unsigned int           node;
      Surface                surface;
      unsigned int           n_normals = 0; // of different direction: 1 or 2
      std::array<Vector2, 2> normal;
      Vector2                mean_normal;
      bool                   is_open  = false; // the soil is below the lid
      double                 friction = 0.;
      double                 adhesion = 0.; // a A, N per radian
      double                 covered  = 1.; // share of A
    };
    enum class State : unsigned char
    {
      apart,
      sliding,
      sticking
    };
    /** The result of contact at one node. */
    struct NodeResult
    {
      State   state   = State::apart;
      Vector2 normal  = Vector2();
      Vector2 impulse = Vector2(); // on the body, N s per radian
    };

    /** The surface that the force at a node counts to. */
    static Surface
    surface_of(const Node &node)
    {
      return node.is_open ? inner_wall : node.surface;
    }

    /** Return the state and the normal of a node with the relative velocity
     * @p w. */
    NodeResult
    compute_contact(const Node &node, const Vector2 &w) const;

    /** Return the same at a corner that has two normals. */
    NodeResult
    compute_contact_at_corner(const Node &node, const Vector2 &w) const;

    /** Change the velocity @p u of a node with the mass @p m. */
    NodeResult
    apply_to_node(const Node  &node,
                  const double dt,
                  const double m,
                  double      *u) const;

    /** Return the velocity @p u of surface node @p i, constrained as the last
     * apply() found. */
    Vector2
    constrained(const unsigned int i,
                const Vector2     &body_velocity,
                const double      *u) const;

    void
    collect_surface_nodes(const BackgroundGrid &grid);
    /** Add the reactions of the corners. */
    void
    add_corners(ContactResult &sums, Vector2 &total) const;
    /** The volume of soil that flows into the body through its faces. */
    double
    compute_inflow(const double                dt,
                   const std::vector<double>  &mass,
                   const Kernels::NodalVector *v) const;
    void
    compute_normals(const BackgroundGrid &grid, Node &node) const;
    void
    collect_inner_nodes(const BackgroundGrid &grid);

    std::vector<ContactFace>        faces;
    std::vector<FaceStrength>       strengths;      // of the faces
    std::vector<std::array<int, 2>> nodes_of_faces; // -1: one of corners_
    ContactCorners                  corners_;
    std::vector<Node>               nodes;       // but for corners_
    std::vector<unsigned int>       inner_nodes; // inside the body
    std::vector<NodeResult>         results; // of the nodes, in the last step
    std::vector<bool>               on_body;
    Vector2                         velocity;
    double                          circumference = 2. * pi;
    unsigned int                    n_owned_nodes = 0;
  };
} // namespace CaissonMPM

#endif
