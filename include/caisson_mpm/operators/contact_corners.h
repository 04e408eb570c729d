// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The convex corners of the rigid body, where two of its faces meet at a node.
//
// One velocity at the node cannot slide along both faces. With any mean of both
// normals the interpolated velocity passes through one face and comes out of
// the other, and soil flows through the body. Here each soil cell that touches
// a face at the corner sees its own velocity of the node,
//   v_c = V + Q_c (v - V),   Q_c = t (e . ) / (t . e),
// along the face (t), with the same flow through the cell's other side at the
// node (normal e) as the cells beyond it. No soil passes the faces, and what
// leaves a cell enters the next one. With r vertical sides and level rows
//   face = row with the slope s:  Q (v_r, v_z) = (v_r, s v_r),
//   face = vertical side:         Q (v_r, v_z) = (0, v_z).
// Both components of v stay free. Their equation of motion is that of virtual
// power: with mass m_c, momentum p_c and force f_c of the cells at the node,
//   sum Q_c^T m_c Q_c dv/dt = sum Q_c^T f_c      (Q = I in cells without face),
// and what is missing to the plain balance is the force on the body. It is
// resolved along the normals of both faces, and bears friction along each. The
// velocity before the step follows likewise, from sum Q_c^T p_c. What the
// points of a cell have besides stays theirs, as anywhere with FLIP, and goes
// with the share of XPIC: taken away in every step, it would make the force on
// the body depend on the length of a step. A face is open, and its cell has Q =
// I, only while the body moves away from it.
#ifndef caisson_mpm_operators_contact_corners_h
#define caisson_mpm_operators_contact_corners_h

#include <caisson_mpm/bodies/body_surface.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/contact_face.h>
#include <caisson_mpm/operators/nodal_force.h>

#include <array>
#include <map>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  /** What one corner did in one step. */
  struct CornerReaction
  {
    // of both faces on the body, and by component what friction is in it, N s
    // per radian
    std::array<Vector2, 2> impulse;
    Vector2                friction;
  };

  /**
   * The convex corners that this rank knows, and their state. Every rank treats
   * all of them in the same way. initialize(), collect() and add_forces() are
   * collective over MPI, all other functions are not.
   */
  class ContactCorners
  {
  public:
    /** Set up for the corners among the @p faces. */
    void
    initialize(const BackgroundGrid           &grid,
               const std::vector<ContactFace> &faces);

    /** Set the strength of the faces, which are those of initialize(). */
    void
    set_strength(const std::vector<ContactFace> &faces,
                 const FaceStrengthOf           &strength_at);

    /** Return whether the node is one of the corners. */
    bool
    is_corner(const unsigned int node) const;

    /** Collect what the cells at the corners brought to them in this step, in
     * which points keep the share @p keep of their velocity, with what the
     * nodal @p forces add there. */
    void
    collect(const Kernels::KernelTable &kernels,
            const Kernels::StepContext &step,
            const double                keep,
            const NodalForces          &forces);

    /** Take the nodal @p forces that have been corrected in place of those of
     * collect() in this step. */
    void
    add_forces(const Kernels::StepContext &step, const NodalForces &forces);

    /** Replace the velocities @p v before and @p u after the step by those that
     * follow from virtual power, if the body has the given velocity. */
    void
    accelerate(const Vector2            &body_velocity,
               const double              dt,
               const Kernels::NodalSums *sums,
               Kernels::NodalVector     *v,
               Kernels::NodalVector     *u);

    /** Let friction act on @p u, and find the reactions. */
    void
    apply(const double              dt,
          const Kernels::NodalSums *sums,
          Kernels::NodalVector     *u);

    /** Return the impulse on the body that apply() would find, and the mass
     * that would move with the body in r and z: that of cells at closed faces,
     * but along them only if the corner sticks; of owned nodes. Units: N s and
     * kg, per radian. */
    std::pair<Vector2, Vector2>
    respond(const double                dt,
            const Kernels::NodalSums   *sums,
            const Kernels::NodalVector *u) const;

    /** Give what sticks to the body its velocity. */
    void
    constrain(const Vector2 &body_velocity, Kernels::NodalVector *v) const;

    /** Add to @p to what the product of the mass matrix with @p from lacks at
     * the corners. The field has this share of the body's velocity: 1 for a
     * velocity, 0 for a difference of velocities. */
    void
    correct_mass(const Kernels::StepContext &step,
                 const Kernels::NodalVector *from,
                 const double                share_of_body,
                 Kernels::NodalVector       *to) const;

    /** Finish the division of this product by the mass. */
    void
    divide_by_mass(const Kernels::NodalSums *sums,
                   const double              share_of_body,
                   Kernels::NodalVector     *v) const;

    /** The power of the forces in the cells at the corners, with the velocities
     * that they see, less that with @p v; of owned nodes. Units: W per radian.
     */
    double
    missing_power(const Kernels::NodalVector *v) const;

    /** The velocity with which a soil cell sees the node. */
    Vector2
    velocity_at_face(const unsigned int node,
                     const unsigned int soil_cell,
                     const Vector2     &v) const;

    /** How the cells see their corners, for the kernels. */
    const std::vector<Kernels::CornerView> &
    views() const
    {
      return views_;
    }

    /** Call action(node, surfaces, reaction) for the corners with soil. */
    template <typename Action>
    void
    for_each_reaction(const Action &action) const
    {
      for (const Corner &corner : corners)
        if (corner.has_soil)
          action(corner.node, corner.surface, corner.reaction);
    }

  private:
    /** A cell that touches a face at a corner. */
    struct Cell
    {
      unsigned int cell, corner; // of this rank, and the corner of the cell
      unsigned int index;        // among the cells of all ranks
      bool         is_owned;
      bool         closed = true, closed_next = true;
      unsigned int free; // the component of w = v - V that acts
      Vector2      q;    // along the face: Q w = w[free] q

      Vector2
      see(const Vector2 &w) const
      {
        return closed ? w[free] * q : w;
      }

      /** Q^T f. */
      Vector2
      back(const Vector2 &f) const
      {
        if (!closed)
          return f;
        Vector2 result;
        result[free] = q * f;
        return result;
      }
    };

    /** Both faces of a corner, and the cell at each. */
    struct Corner
    {
      unsigned int                node;
      bool                        has_soil = false;
      std::array<Cell, 2>         cells;
      std::array<Vector2, 2>      normal;
      std::array<Surface, 2>      surface;
      std::array<unsigned int, 2> face, end;    // among the faces; its node
      std::array<double, 2> friction, adhesion; // adhesion: a A, N per radian
      std::array<bool, 2>   sticks = {{false, false}}; // by component
      CornerReaction        reaction;
      Vector2               old; // the velocity before the step
    };

    /** What a cell brings to its corner. */
    struct Contribution
    {
      double  mass;
      Vector2 momentum, force;
    };

    void
    add_face(const BackgroundGrid &grid,
             const ContactFace    &face,
             const unsigned int    end,
             const unsigned int    i,
             Corner               &corner);
    void
    number_cells(const BackgroundGrid &grid);

    Contribution
    contribution(const Cell &cell) const;

    /** The cells of this rank that have soil and see a corner with Q, and how
     * they see each of their nodes: null as it is. A cell beneath a tip with
     * two cells across the wall has two corners. */
    std::map<unsigned int, std::array<const Cell *, 4>>
    closed_cells(const Kernels::StepContext &step) const;

    /** sum Q^T m Q, which is diagonal; 0 where a component acts on no cell. */
    Vector2
    mass_of(const Corner &corner, const double total) const;

    /** The mass that accelerates: a component in which few cells act needs more
     * than they have, as in MinimumNodalMass. */
    static double
    raised_mass(const double              mass,
                const double              dt,
                const Kernels::NodalSums &node);

    /** sum m Q w. */
    Vector2
    momentum_of(const Corner  &corner,
                const double   total,
                const Vector2 &w) const;

    /** The parts of an impulse on the body against both normals. */
    std::array<double, 2>
    resolve(const Corner &corner, const Vector2 &impulse) const;

    /** What friction leaves of the relative velocity @p x, if the faces are
     * pressed with these impulses. Sets friction and its part of the impulses.
     */
    Vector2
    slide(Corner                      &corner,
          const double                 dt,
          const Vector2               &inertia,
          const std::array<double, 2> &pressed,
          const Vector2               &x) const;

    /** Let friction act on the velocity @p x of a corner, and find its
     * reaction. */
    void
    apply_to_corner(Corner                   &corner,
                    const double              dt,
                    const Kernels::NodalSums &node,
                    Kernels::NodalVector     &u) const;

    void
    update_views();

    std::vector<Corner> corners;
    std::vector<double> of_points, sums_;     // contributions of all cells
    std::vector<Kernels::NodalSums>  of_cell; // memory of collect()
    std::vector<Kernels::CornerView> views_;
    Vector2                          velocity;           // of the body
    double                           keep          = 1.; // see collect()
    MPI_Comm                         communicator  = MPI_COMM_SELF;
    unsigned int                     n_owned_nodes = 0;
  };
} // namespace CaissonMPM

#endif
