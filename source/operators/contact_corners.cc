// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/kernels/cell_map.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/contact_corners.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  using namespace dealii;
  using Kernels::NodalSums;
  using Kernels::NodalVector;

  namespace
  {
    constexpr unsigned int n_sums = 5; // mass, momentum, force

    Vector2
    vector_of(const double *x)
    {
      Vector2 result;
      for (unsigned int d = 0; d < 2; ++d)
        result[d] = x[d];
      return result;
    }

    /** The consistent mass matrix of a cell, from its moments. */
    std::array<std::array<double, 4>, 4>
    mass_matrix(const Kernels::StepContext &step, const unsigned int cell)
    {
      const double *const m       = step.moments[cell].mass;
      const double        inertia = inertia_in(step, cell);
      // columns: the integrals of {1, xi, eta, xi eta} times each of them
      constexpr int table[4][4] = {{0, 1, 2, 3},
                                   {1, 4, 3, 6},
                                   {2, 3, 5, 7},
                                   {3, 6, 7, 8}};
      double shape[4][4]; // N_i = sum_a shape[i][a] {1, xi, eta, xi eta}_a
      for (unsigned int i = 0; i < 4; ++i)
        {
          double at_corners[4] = {};
          at_corners[i]        = 1.;
          Kernels::coefficients(at_corners, shape[i]);
        }
      std::array<std::array<double, 4>, 4> result = {};
      for (unsigned int i = 0; i < 4; ++i)
        for (unsigned int j = 0; j < 4; ++j)
          for (unsigned int a = 0; a < 4; ++a)
            for (unsigned int b = 0; b < 4; ++b)
              result[i][j] +=
                inertia * shape[i][a] * shape[j][b] * m[table[a][b]];
      return result;
    }
  } // namespace

  // ------------------------------------------------------------ set-up

  void
  ContactCorners::initialize(const BackgroundGrid           &grid,
                             const std::vector<ContactFace> &faces)
  {
    n_owned_nodes = grid.n_owned_nodes();
    of_cell.assign(grid.n_nodes(), NodalSums());
    corners.clear();
    // 1. count the rigid cells at each node: a node with three of them is a
    //    concave corner, which Contact treats
    std::vector<unsigned int> n_rigid(grid.n_nodes(), 0);
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      for (const unsigned int node : grid.cell_nodes(cell).node)
        n_rigid[node] += grid.is_rigid(cell);

    // 2. list the faces at each node
    std::map<unsigned int,
             std::vector<std::pair<const ContactFace *, unsigned int>>>
      faces_at;
    for (const ContactFace &face : faces)
      for (unsigned int i = 0; i < 2; ++i)
        faces_at[face.nodes[i]].emplace_back(&face, i);
    // 3. take the convex corners, with two faces of different directions; one
    //    on the axis has a single normal by symmetry, and Contact treats it
    for (const auto &entry : faces_at)
      {
        const unsigned int node    = entry.first;
        const auto        &own     = entry.second;
        const bool         on_axis = grid.lines().reaches_axis() &&
                             grid.is_at(node, BackgroundGrid::Side::axis);
        if (own.size() != 2 || n_rigid[node] == 3 || on_axis ||
            own[0].first->normal * own[1].first->normal > 1. - 1e-9)
          continue;
        Corner corner;
        corner.node = node;
        for (unsigned int i = 0; i < 2; ++i)
          {
            add_face(grid, *own[i].first, own[i].second, i, corner);
            corner.face[i] = own[i].first - faces.data();
          }
        corners.push_back(corner);
      }
    // 4. number their cells in the same way on all ranks, to sum over these
    number_cells(grid);
    update_views();
  }

  void
  ContactCorners::add_face(const BackgroundGrid &grid,
                           const ContactFace    &face,
                           const unsigned int    end,
                           const unsigned int    i,
                           Corner               &corner)
  {
    corner.normal[i]  = face.normal;
    corner.surface[i] = face.surface;
    corner.end[i]     = end;
    Cell &cell        = corner.cells[i];
    cell.cell         = face.soil_cell;
    cell.corner       = face.corners[end];
    cell.is_owned     = grid.is_owned(face.soil_cell);
    cell.free         = face.is_vertical ? vertical : radial;
    // along the face, with the free component 1
    cell.q[radial]   = -face.normal[vertical];
    cell.q[vertical] = face.normal[radial];
    cell.q /= cell.q[cell.free];
  }

  void
  ContactCorners::set_strength(const std::vector<ContactFace> &faces,
                               const FaceStrengthOf           &strength_at)
  {
    for (Corner &corner : corners)
      for (unsigned int i = 0; i < 2; ++i)
        {
          const ContactFace &face     = faces[corner.face[i]];
          const FaceStrength strength = strength_at(face);
          corner.friction[i]          = strength.friction;
          corner.adhesion[i] = strength.adhesion * face.areas[corner.end[i]];
        }
  }

  void
  ContactCorners::number_cells(const BackgroundGrid &grid)
  {
    const auto key = [&grid](const Cell &cell) {
      return 4ul * index_of(grid.global_number(cell.cell)) + cell.corner;
    };
    std::vector<unsigned long> own;
    for (const Corner &corner : corners)
      for (const Cell &cell : corner.cells)
        own.push_back(key(cell));
    std::vector<unsigned long> all;
    for (const auto &of_rank :
         Utilities::MPI::all_gather(grid.communicator(), own))
      all.insert(all.end(), of_rank.begin(), of_rank.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    for (Corner &corner : corners)
      for (Cell &cell : corner.cells)
        cell.index =
          std::lower_bound(all.begin(), all.end(), key(cell)) - all.begin();
    sums_.assign(n_sums * all.size(), 0.);
    of_points    = sums_;
    communicator = grid.communicator();
  }

  bool
  ContactCorners::is_corner(const unsigned int node) const
  {
    return std::any_of(corners.begin(), corners.end(), [&](const Corner &c) {
      return c.node == node;
    });
  }

  // ------------------------------------------------------------ one step

  void
  ContactCorners::collect(const Kernels::KernelTable &kernels,
                          const Kernels::StepContext &step,
                          const double                share_that_points_keep,
                          const NodalForces          &forces)
  {
    keep = share_that_points_keep;
    if (sums_.empty())
      return;
    // 1. faces open and close as the last step found, so that all fields of a
    //    step see the same faces
    for (Corner &corner : corners)
      for (Cell &cell : corner.cells)
        cell.closed = cell.closed_next;
    // 2. m_c, p_c and f_c: what each cell alone brings to its corner, of which
    //    the nodal sums contain only the total
    std::fill(of_points.begin(), of_points.end(), 0.);
    Kernels::StepContext alone  = step; // a step in which one cell has points
    alone.points.n_active_cells = 1;
    for (const Corner &corner : corners)
      for (const Cell &cell : corner.cells)
        if (cell.is_owned && step.points.first_block[cell.cell] >= 0)
          {
            for (const unsigned int node : step.grid.nodes[cell.cell].node)
              of_cell[node] = NodalSums();
            // its moments hold the fit now, and have to be summed again
            step.points.changed[cell.cell] = true;
            alone.points.active_cells      = &cell.cell;
            kernels.points_to_grid(alone, of_cell.data());
            const NodalSums &own = of_cell[corner.node];
            double *const    sum = &of_points[n_sums * cell.index];
            sum[0]               = own.mass;
            for (unsigned int d = 0; d < 2; ++d)
              {
                sum[1 + d] = own.momentum[d];
                sum[3 + d] = own.force[d];
              }
          }
    // 3. add the other nodal forces, and sum over ranks
    add_forces(step, forces);
  }

  void
  ContactCorners::add_forces(const Kernels::StepContext &step,
                             const NodalForces          &forces)
  {
    if (sums_.empty())
      return;
    sums_ = of_points;
    for (const Corner &corner : corners)
      for (const Cell &cell : corner.cells)
        if (cell.is_owned && step.points.first_block[cell.cell] >= 0)
          {
            Vector2 more;
            for (const auto &force : forces)
              if (force->is_active())
                more += force->at_corner(cell.cell, cell.corner);
            for (unsigned int d = 0; d < 2; ++d)
              sums_[n_sums * cell.index + 3 + d] += more[d];
          }
    Utilities::MPI::sum(sums_, communicator, sums_);
  }

  ContactCorners::Contribution
  ContactCorners::contribution(const Cell &cell) const
  {
    const double *const sum = &sums_[n_sums * cell.index];
    return {sum[0], vector_of(sum + 1), vector_of(sum + 3)};
  }

  Vector2
  ContactCorners::mass_of(const Corner &corner, const double total) const
  {
    double  plain = total;
    Vector2 mass;
    for (const Cell &cell : corner.cells)
      {
        const double own = contribution(cell).mass;
        plain -= own;
        for (unsigned int d = 0; d < 2; ++d)
          mass[d] += own * (!cell.closed   ? 1. :
                            d == cell.free ? cell.q * cell.q :
                                             0.);
      }
    for (unsigned int d = 0; d < 2; ++d)
      mass[d] = mass[d] + plain > 1e-9 * total ? mass[d] + plain : 0.;
    return mass;
  }

  Vector2
  ContactCorners::momentum_of(const Corner  &corner,
                              const double   total,
                              const Vector2 &w) const
  {
    double  plain = total;
    Vector2 momentum;
    for (const Cell &cell : corner.cells)
      {
        const double own = contribution(cell).mass;
        plain -= own;
        momentum += own * cell.see(w);
      }
    return momentum + plain * w;
  }

  void
  ContactCorners::accelerate(const Vector2   &body_velocity,
                             const double     dt,
                             const NodalSums *sums,
                             NodalVector     *v,
                             NodalVector     *u)
  {
    velocity = body_velocity;
    for (Corner &corner : corners)
      {
        const NodalSums &node = sums[corner.node];
        corner.has_soil       = node.mass > 0.;
        if (!corner.has_soil)
          continue;
        // 1. sum Q^T p and sum Q^T f, relative to the body: the nodal sums, in
        //    which the cells at faces take Q^T in the place of 1
        Vector2 momentum = vector_of(node.momentum) - node.mass * velocity,
                force    = vector_of(node.force);
        for (const Cell &cell : corner.cells)
          {
            const Contribution own      = contribution(cell);
            const Vector2      relative = own.momentum - own.mass * velocity;
            momentum += cell.back(relative) - relative;
            force += cell.back(own.force) - own.force;
          }
        // 2. w = (sum Q^T p) / (sum Q^T m Q), the velocity before the step, and
        //    w+ = w + dt (sum Q^T f) / M with the raised mass M; a component
        //    that acts on no cell moves with the body
        const Vector2 mass = mass_of(corner, node.mass);
        for (unsigned int d = 0; d < 2; ++d)
          {
            const double w = mass[d] > 0. ? momentum[d] / mass[d] : 0.;
            const double a =
              mass[d] > 0. ? force[d] / raised_mass(mass[d], dt, node) : 0.;
            corner.old[d]           = velocity[d] + w;
            v[corner.node].value[d] = corner.old[d];
            u[corner.node].value[d] = corner.old[d] + dt * a;
          }
      }
    update_views();
  }

  double
  ContactCorners::raised_mass(const double              mass,
                              const double              dt,
                              const Kernels::NodalSums &node)
  {
    return std::max(mass, .25 * dt * dt * node.stiffness);
  }

  std::array<double, 2>
  ContactCorners::resolve(const Corner &corner, const Vector2 &impulse) const
  {
    // impulse = - p_0 n_0 - p_1 n_1
    const Vector2 &a = corner.normal[0], &b = corner.normal[1];
    const double   det = a[0] * b[1] - a[1] * b[0];
    return {{-(impulse[0] * b[1] - impulse[1] * b[0]) / det,
             -(a[0] * impulse[1] - a[1] * impulse[0]) / det}};
  }

  void
  ContactCorners::apply(const double dt, const NodalSums *sums, NodalVector *u)
  {
    for (Corner &corner : corners)
      {
        corner.reaction = CornerReaction();
        if (corner.has_soil)
          apply_to_corner(corner, dt, sums[corner.node], u[corner.node]);
      }
  }

  void
  ContactCorners::apply_to_corner(Corner          &corner,
                                  const double     dt,
                                  const NodalSums &node,
                                  NodalVector     &u) const
  {
    const Vector2 w = corner.old - velocity, x = vector_of(u.value) - velocity;
    // 1. the mass of each component, raised to what the time step needs
    const Vector2 mass = mass_of(corner, node.mass);
    Vector2       inertia;
    for (unsigned int d = 0; d < 2; ++d)
      inertia[d] = mass[d] > 0. ? raised_mass(mass[d], dt, node) : 0.;
    // 2. the impulse of the plain balance: dt f, and the share that the points
    //    lose in a step of the momentum that w lacks, p - sum m Q w
    const Vector2 lost =
      (1. - keep) * (vector_of(node.momentum) - node.mass * velocity -
                     momentum_of(corner, node.mass, w));
    const Vector2 given = dt * vector_of(node.force) + lost;
    // 3. what the soil does not take when w changes by y acts on the body; its
    //    parts against both normals press the faces, which then bear friction
    const auto remainder = [&](Vector2 y) {
      for (unsigned int d = 0; d < 2; ++d)
        y[d] *= mass[d] > 0. ? inertia[d] / mass[d] : 0.;
      return given - momentum_of(corner, node.mass, y);
    };
    const Vector2 left =
      slide(corner, dt, inertia, resolve(corner, remainder(x - w)), x);
    // 4. with what friction has left of the velocity, and less its impulses,
    //    the remainder again is the normal impulse of each face
    Vector2 rest = remainder(left - w);
    for (unsigned int i = 0; i < 2; ++i)
      rest -= corner.reaction.impulse[i];
    const auto pressed = resolve(corner, rest);
    for (unsigned int i = 0; i < 2; ++i)
      {
        Cell &cell = corner.cells[i];
        corner.reaction.impulse[i] -= pressed[i] * corner.normal[i];
        // 5. A face that advances or slides stays closed: whether soil presses
        // on it changes from step to step, and what comes off for a step
        // and back again loses energy and gets into the body.
        cell.closed_next =
          velocity * corner.normal[i] >= 0. ||
          (cell.closed ? pressed[i] > 0. : left * corner.normal[i] < 0.);
      }
    for (unsigned int d = 0; d < 2; ++d)
      u.value[d] = velocity[d] + left[d];
  }

  std::pair<Vector2, Vector2>
  ContactCorners::respond(const double       dt,
                          const NodalSums   *sums,
                          const NodalVector *u) const
  {
    Vector2 impulse, mass;
    for (const Corner &own : corners)
      {
        if (!own.has_soil || own.node >= n_owned_nodes)
          continue;
        Corner      corner = own; // it stays as it is
        NodalVector moved  = u[own.node];
        corner.reaction    = CornerReaction();
        apply_to_corner(corner, dt, sums[own.node], moved);
        impulse += corner.reaction.impulse[0] + corner.reaction.impulse[1];
        for (unsigned int d = 0; d < 2; ++d)
          if (corner.sticks[d])
            mass[d] += sums[own.node].mass;
          else
            for (const Cell &cell : corner.cells)
              mass[d] +=
                cell.closed && d != cell.free ? contribution(cell).mass : 0.;
      }
    return {impulse, mass};
  }

  Vector2
  ContactCorners::slide(Corner                      &corner,
                        const double                 dt,
                        const Vector2               &inertia,
                        const std::array<double, 2> &pressed,
                        const Vector2               &x) const
  {
    // 1. the largest impulse of friction along the face, mu p + a A dt, as the
    //    impulse on the component that acts: with |Q w| = |q| w, |q| times it
    std::array<double, 2> bearable = {{0., 0.}}; // by face
    Vector2               of_component;
    for (unsigned int i = 0; i < 2; ++i)
      if (corner.cells[i].closed)
        {
          const Cell &cell = corner.cells[i];
          bearable[i]      = (corner.friction[i] * std::max(pressed[i], 0.) +
                         corner.adhesion[i] * dt) *
                        cell.q.norm();
          of_component[cell.free] += bearable[i];
        }
    // 2. friction acts against each component, and at most stops it; with some
    //    to spare the component sticks
    Vector2 left = x;
    for (unsigned int d = 0; d < 2; ++d)
      {
        const double borne =
          std::min(of_component[d], inertia[d] * std::abs(x[d]));
        corner.sticks[d] =
          inertia[d] <= 0. || (of_component[d] > 0. && borne < of_component[d]);
        if (borne > 0.)
          {
            corner.reaction.friction[d] = std::copysign(borne, x[d]);
            left[d]                     = corner.sticks[d] ?
                                            0. :
                                            x[d] - corner.reaction.friction[d] / inertia[d];
          }
      }
    // 3. the impulse along each face, in proportion to what it bears; divided
    //    by q.q, so that its product with q is its part of the friction
    for (unsigned int i = 0; i < 2; ++i)
      if (bearable[i] > 0.)
        {
          const Cell  &cell = corner.cells[i];
          const double share =
            bearable[i] / of_component[cell.free] / (cell.q * cell.q);
          corner.reaction.impulse[i] =
            share * corner.reaction.friction[cell.free] * cell.q;
        }
    return left;
  }

  void
  ContactCorners::constrain(const Vector2 &body_velocity, NodalVector *v) const
  {
    for (const Corner &corner : corners)
      for (unsigned int d = 0; corner.has_soil && d < 2; ++d)
        if (corner.sticks[d])
          v[corner.node].value[d] = body_velocity[d];
  }

  void
  ContactCorners::correct_mass(const Kernels::StepContext &step,
                               const NodalVector          *from,
                               const double                share_of_body,
                               NodalVector                *to) const
  {
    const Vector2 of_body = share_of_body * velocity;
    for (const auto &[cell, at_corner] : closed_cells(step))
      {
        // The plain product is M w, w being relative to the body; the cell sees
        // Q w at each of its corners, and each takes Q^T of what it is given.
        const auto             matrix = mass_matrix(step, cell);
        const auto            &nodes  = step.grid.nodes[cell].node;
        std::array<Vector2, 4> w, seen;
        for (unsigned int j = 0; j < 4; ++j)
          {
            w[j]    = vector_of(from[nodes[j]].value) - of_body;
            seen[j] = at_corner[j] ? at_corner[j]->see(w[j]) : w[j];
          }
        for (unsigned int i = 0; i < 4; ++i)
          {
            Vector2 plain, given;
            for (unsigned int j = 0; j < 4; ++j)
              {
                plain += matrix[i][j] * w[j];
                given += matrix[i][j] * seen[j];
              }
            if (at_corner[i])
              given = at_corner[i]->back(given);
            for (unsigned int d = 0; d < 2; ++d)
              to[nodes[i]].value[d] += given[d] - plain[d];
          }
      }
  }

  std::map<unsigned int, std::array<const ContactCorners::Cell *, 4>>
  ContactCorners::closed_cells(const Kernels::StepContext &step) const
  {
    std::map<unsigned int, std::array<const Cell *, 4>> result;
    for (const Corner &corner : corners)
      for (const Cell &cell : corner.cells)
        if (cell.is_owned && cell.closed && corner.has_soil &&
            step.points.first_block[cell.cell] >= 0)
          result[cell.cell][cell.corner] = &cell;
    return result;
  }

  void
  ContactCorners::divide_by_mass(const NodalSums *sums,
                                 const double     share_of_body,
                                 NodalVector     *v) const
  {
    // they have been divided by the plain mass
    for (const Corner &corner : corners)
      if (corner.has_soil)
        {
          const double  total = sums[corner.node].mass;
          const Vector2 mass  = mass_of(corner, total);
          for (unsigned int d = 0; d < 2; ++d)
            {
              double      &own     = v[corner.node].value[d];
              const double of_body = share_of_body * velocity[d];
              own                  = of_body +
                    (mass[d] > 0. ? (own - of_body) * total / mass[d] : 0.);
            }
        }
  }

  double
  ContactCorners::missing_power(const NodalVector *v) const
  {
    double power = 0.;
    for (const Corner &corner : corners)
      if (corner.has_soil && corner.node < n_owned_nodes)
        for (const Cell &cell : corner.cells)
          {
            const Vector2 w = vector_of(v[corner.node].value) - velocity;
            power += contribution(cell).force * (cell.see(w) - w);
          }
    return power;
  }

  Vector2
  ContactCorners::velocity_at_face(const unsigned int node,
                                   const unsigned int soil_cell,
                                   const Vector2     &v) const
  {
    for (const Corner &corner : corners)
      if (corner.node == node)
        for (const Cell &cell : corner.cells)
          if (cell.cell == soil_cell)
            return velocity + cell.see(v - velocity);
    return v;
  }

  void
  ContactCorners::update_views()
  {
    views_.clear();
    for (const Corner &corner : corners)
      for (const Cell &cell : corner.cells)
        if (corner.has_soil && cell.closed)
          views_.push_back({cell.cell,
                            cell.corner,
                            cell.free,
                            {cell.q[0], cell.q[1]},
                            {velocity[0], velocity[1]}});
  }
} // namespace CaissonMPM
