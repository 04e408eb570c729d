// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/operators/contact.h>

#include <cmath>
#include <map>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    /** A face of the body that soil may touch. */
    struct Face
    {
      std::array<unsigned int, 2> nodes;
      Vector2                     normal; // unit, out of the body
      std::array<double, 2>       areas;  // int N_I r ds
      Surface                     surface;
    };

    /** Face @p f of rigid cell @p cell, seen from inside. */
    Face
    make_face(const BackgroundGrid &grid,
              const unsigned int    cell,
              const unsigned int    f)
    {
      constexpr unsigned int corners[4][2] = {{0, 2}, {1, 3}, {0, 1}, {2, 3}};
      constexpr Surface      surfaces[4]   = {inner_wall, outer_wall, tip, top};
      Face                   face;
      Vector2                x[2];
      for (unsigned int i = 0; i < 2; ++i)
        {
          face.nodes[i] = grid.cell_nodes(cell).node[corners[f][i]];
          x[i][0]       = grid.r_of(face.nodes[i]);
          x[i][1]       = grid.z_of(face.nodes[i]);
        }
      const Vector2 along  = x[1] - x[0];
      const double  length = along.norm();
      face.surface =
        surfaces[f] == tip && grid.is_lid(cell) ? lid : surfaces[f];
      face.normal[0] = along[1] / length;
      face.normal[1] = -along[0] / length;
      if (f == 0 || f == 3) // the other side
        face.normal *= -1.;
      const double r0 = grid.axisymmetric() ? x[0][0] : 1.,
                   r1 = grid.axisymmetric() ? x[1][0] : 1.;
      face.areas      = {
             {length * (2. * r0 + r1) / 6., length * (r0 + 2. * r1) / 6.}};
      return face;
    }

    /** Of the surfaces that meet at a node, the one that it counts to. */
    Surface
    dominant(const Surface a, const Surface b)
    {
      for (const Surface s : {tip, lid, top, outer_wall})
        if (a == s || b == s)
          return s;
      return a;
    }
  } // namespace

  void
  Contact::initialize(const BackgroundGrid &grid, const BodySurface &body)
  {
    corner_normals = body.corner_normals;
    circumference  = grid.circumference();
    n_owned_nodes  = grid.n_owned_nodes();
    on_body.assign(grid.n_nodes(), false);
    collect_surface_nodes(grid, body);
    collect_inner_nodes(grid);
    results.assign(nodes.size(), NodeResult());
  }

  namespace
  {
    /** Call action(face) for all faces between the body and soil cells. */
    template <typename Action>
    void
    for_each_face(const BackgroundGrid &grid, const Action &action)
    {
      for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
        for (unsigned int f = 0; grid.is_rigid(cell) && f < 4; ++f)
          {
            const int neighbor = grid.neighbor(cell, f);
            if (neighbor >= 0 && !grid.is_rigid(neighbor))
              action(make_face(grid, cell, f));
          }
    }
  } // namespace

  void
  Contact::collect_surface_nodes(const BackgroundGrid &grid,
                                 const BodySurface    &body)
  {
    std::map<unsigned int, Node> found;
    for_each_face(grid, [&](const Face &face) {
      for (unsigned int i = 0; i < 2; ++i)
        {
          const bool is_new = found.count(face.nodes[i]) == 0;
          Node      &node   = found[face.nodes[i]];
          if (is_new)
            node = {
              face.nodes[i], face.surface, 0, {}, Vector2(), false, 0., 0.};
          node.surface = dominant(node.surface, face.surface);
          if (node.n_normals == 0 ||
              (node.n_normals == 1 && node.normal[0] * face.normal < 1. - 1e-9))
            node.normal[node.n_normals++] = face.normal;
          node.adhesion += body.adhesion[face.surface] * face.areas[i];
        }
    });
    std::vector<unsigned int> n_rigid(grid.n_nodes(), 0);
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      for (const unsigned int node : grid.cell_nodes(cell).node)
        n_rigid[node] += grid.is_rigid(cell);
    nodes.clear();
    for (auto &entry : found)
      {
        Node &node    = entry.second;
        node.concave  = n_rigid[node.node] == 3;
        node.friction = body.friction_coefficient(node.surface);
        find_normals(grid, node);
        nodes.push_back(node);
        on_body[entry.first] = true;
      }
  }

  void
  Contact::find_normals(const BackgroundGrid &grid, Node &node) const
  {
    // by symmetry: the point of a cone
    if (grid.lines().reaches_axis() &&
        grid.is_at(node.node, BackgroundGrid::Side::axis))
      for (unsigned int i = 0; i < node.n_normals; ++i)
        {
          node.normal[i][radial] = 0.;
          node.normal[i] /= node.normal[i].norm();
        }
    for (unsigned int i = 0; i < node.n_normals; ++i)
      node.mean_normal += node.normal[i];
    node.mean_normal /= node.mean_normal.norm();
  }

  void
  Contact::collect_inner_nodes(const BackgroundGrid &grid)
  {
    inner_nodes.clear();
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      if (grid.is_rigid(cell))
        for (const unsigned int node : grid.cell_nodes(cell).node)
          if (!on_body[node])
            {
              on_body[node] = true;
              inner_nodes.push_back(node);
            }
  }

  Contact::NodeResult
  Contact::find_contact(const Node &node, const Vector2 &w) const
  {
    const auto against = [&w](const Vector2 &normal) {
      return w * normal < 0. ? NodeResult{State::sliding, normal} :
                               NodeResult{State::apart, normal};
    };
    if (node.n_normals == 1)
      return against(node.normal[0]);

    // At rest a tip bears on both faces of a corner, whatever it does in
    // motion.
    const bool at_rest = node.surface == tip && velocity.norm_square() == 0.;
    if (at_rest || node.concave ||
        corner_normals == BodySurface::CornerNormals::both)
      return find_contact_at_corner(node, w);
    return against(corner_normal(node));
  }

  Vector2
  Contact::corner_normal(const Node &node) const
  {
    using Corner              = BodySurface::CornerNormals;
    const bool first_is_wall  = std::abs(node.normal[0][1]) < 1e-9,
               second_is_wall = std::abs(node.normal[1][1]) < 1e-9;
    if (corner_normals == Corner::average || first_is_wall == second_is_wall)
      return node.mean_normal;
    const bool take_first = (corner_normals == Corner::wall) == first_is_wall;
    return node.normal[take_first ? 0 : 1];
  }

  Contact::NodeResult
  Contact::find_contact_at_corner(const Node &node, const Vector2 &w) const
  {
    // Into neither face: slide on one if that leads away from the other.
    bool apart = true;
    for (unsigned int i = 0; i < 2; ++i)
      {
        const Vector2 &n = node.normal[i], &other = node.normal[1 - i];
        const double   speed = w * n;
        if (speed >= 0.)
          continue;
        apart = false;
        if ((w - speed * n) * other >= 0.)
          return {State::sliding, n};
      }
    return apart ? NodeResult() : NodeResult{State::sticking, node.mean_normal};
  }

  Contact::NodeResult
  Contact::apply_to_node(const Node  &node,
                         const double dt,
                         const double m,
                         double      *u) const
  {
    Vector2 w;
    for (unsigned int d = 0; d < 2; ++d)
      w[d] = u[d] - velocity[d];
    NodeResult result = find_contact(node, w);
    if (result.state == State::apart)
      return result;
    const double  into    = std::min(0., w * result.normal);
    const Vector2 tangent = w - into * result.normal;
    const double  speed   = tangent.norm();
    // the change of the tangential velocity that friction and adhesion bear
    const double bearable = -node.friction * into + node.adhesion * dt / m;
    if (speed <= bearable)
      result.state = State::sticking;
    Vector2 left; // of the relative velocity
    if (result.state == State::sliding)
      left = tangent * (1. - bearable / speed);
    result.impulse = m * (w - left);
    for (unsigned int d = 0; d < 2; ++d)
      u[d] = velocity[d] + left[d];
    return result;
  }

  ContactResult
  Contact::apply(const Vector2             &body_velocity,
                 const double               dt,
                 const std::vector<double> &mass,
                 Kernels::NodalVector      *v)
  {
    velocity = body_velocity;
    ContactResult sums;
    Vector2       total;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        const Node  &node = nodes[i];
        const double m    = mass[node.node];
        results[i] = m > 0. ? apply_to_node(node, dt, m, v[node.node].value) :
                              NodeResult();
        if (results[i].state == State::apart || node.node >= n_owned_nodes)
          continue;
        ++sums.n_touching;
        sums.n_sticking += results[i].state == State::sticking;
        sums.impulse[node.surface] += circumference * results[i].impulse;
        total += circumference * results[i].impulse;
      }
    for (const unsigned int node : inner_nodes)
      for (unsigned int d = 0; d < 2; ++d)
        v[node].value[d] = velocity[d];
    sums.work = -(total * velocity);
    return sums;
  }

  double
  Contact::friction_heat(const Kernels::NodalVector *mean_velocity) const
  {
    double heat = 0.;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      if (results[i].state != State::apart && nodes[i].node < n_owned_nodes)
        for (unsigned int d = 0; d < 2; ++d)
          heat += results[i].impulse[d] *
                  (mean_velocity[nodes[i].node].value[d] - velocity[d]);
    return circumference * heat;
  }

  Vector2
  Contact::held(const unsigned int i,
                const Vector2     &body_velocity,
                const double      *u) const
  {
    Vector2 w;
    for (unsigned int d = 0; d < 2; ++d)
      w[d] = u[d] - body_velocity[d];
    return results[i].state == State::sliding ?
             body_velocity + w - (w * results[i].normal) * results[i].normal :
             body_velocity;
  }

  void
  Contact::constrain(const Vector2        &body_velocity,
                     Kernels::NodalVector *v) const
  {
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        if (results[i].state == State::apart)
          continue;
        double *const u   = v[nodes[i].node].value;
        const Vector2 now = held(i, body_velocity, u);
        for (unsigned int d = 0; d < 2; ++d)
          u[d] = now[d];
      }
    for (const unsigned int node : inner_nodes)
      for (unsigned int d = 0; d < 2; ++d)
        v[node].value[d] = body_velocity[d];
  }

  void
  Contact::constrain(const Vector2            &body_velocity,
                     const Kernels::NodalSums *sums,
                     const double              share,
                     Kernels::NodalVector     *v,
                     ContactResult            &result)
  {
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        if (results[i].state == State::apart)
          continue;
        const Node         &node = nodes[i];
        const double *const u    = v[node.node].value;
        const Vector2       now  = held(i, body_velocity, u);
        Vector2             impulse;
        for (unsigned int d = 0; d < 2; ++d)
          impulse[d] = share * sums[node.node].mass * (u[d] - now[d]);
        results[i].impulse += impulse;
        if (node.node >= n_owned_nodes)
          continue;
        result.impulse[node.surface] += circumference * impulse;
        result.work -= circumference * (impulse * velocity);
      }
    constrain(body_velocity, v);
  }
} // namespace CaissonMPM
