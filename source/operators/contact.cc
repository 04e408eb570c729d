// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/contact.h>

#include <cmath>
#include <map>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    /** Of the surfaces that meet at a node, the one that it counts to. */
    Surface
    dominant(const Surface a, const Surface b)
    {
      for (const Surface s : {tip, ring, lid, top, outer_wall})
        if (a == s || b == s)
          return s;
      return a;
    }
  } // namespace

  void
  Contact::initialize(const BackgroundGrid &grid, const BodySurface &body)
  {
    circumference = grid.circumference();
    n_owned_nodes = grid.n_owned_nodes();
    on_body.assign(grid.n_nodes(), false);
    faces = collect_contact_faces(grid);
    if (body.splits_corners)
      corners_.initialize(grid, faces);
    collect_surface_nodes(grid);
    collect_inner_nodes(grid);
    results.assign(nodes.size(), NodeResult());
    set_strength(
      [&body](const ContactFace &face) { return strength_of(body, face); });
  }

  void
  Contact::set_strength(const FaceStrengthOf &strength_at)
  {
    std::vector<double> areas(nodes.size(), 0.);
    strengths.resize(faces.size());
    for (Node &node : nodes)
      node.adhesion = 0.;
    for (unsigned int f = 0; f < faces.size(); ++f)
      {
        const ContactFace &face     = faces[f];
        const FaceStrength strength = strengths[f] = strength_at(face);
        for (unsigned int i = 0; i < 2; ++i)
          {
            const int k = nodes_of_faces[f][i];
            if (k < 0)
              continue;
            Node &node = nodes[k];
            node.adhesion += strength.adhesion * face.areas[i];
            if (face.surface != node.surface)
              continue;
            // the mean over the areas
            const bool is_first = areas[k] == 0.;
            areas[k] += face.areas[i];
            if (is_first)
              node.friction = strength.friction;
            else
              node.friction +=
                (strength.friction - node.friction) * face.areas[i] / areas[k];
          }
      }
    corners_.set_strength(faces, strength_at);
  }

  void
  Contact::collect_surface_nodes(const BackgroundGrid &grid)
  {
    // 1. the nodes of all faces, each with its surface and with one normal, or
    //    two where the faces have different directions
    std::map<unsigned int, Node> found;
    for (const ContactFace &face : faces)
      for (unsigned int i = 0; i < 2; ++i)
        {
          const bool is_new = found.count(face.nodes[i]) == 0;
          Node      &node   = found[face.nodes[i]];
          if (is_new)
            {
              node.node    = face.nodes[i];
              node.surface = face.surface;
            }
          node.surface = dominant(node.surface, face.surface);
          if (node.n_normals == 0 ||
              (node.n_normals == 1 && node.normal[0] * face.normal < 1. - 1e-9))
            node.normal[node.n_normals++] = face.normal;
        }
    // 2. the corners that ContactCorners treats are left out
    nodes.clear();
    std::map<unsigned int, int> index;
    for (auto &entry : found)
      {
        Node &node           = entry.second;
        on_body[entry.first] = true;
        if (corners_.is_corner(node.node))
          continue;
        compute_normals(grid, node);
        index[node.node] = nodes.size();
        nodes.push_back(node);
      }
    // 3. the nodes of each face, for set_strength()
    nodes_of_faces.clear();
    for (const ContactFace &face : faces)
      {
        std::array<int, 2> own = {{-1, -1}};
        for (unsigned int i = 0; i < 2; ++i)
          if (index.count(face.nodes[i]) > 0)
            own[i] = index[face.nodes[i]];
        nodes_of_faces.push_back(own);
      }
  }

  void
  Contact::compute_normals(const BackgroundGrid &grid, Node &node) const
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

  void
  Contact::open_lid(const std::vector<double> &filled, const double touching)
  {
    std::vector<unsigned char> is_touched(on_body.size(), false);
    for (const ContactFace &face : faces)
      if (face.surface == lid && filled[face.soil_cell] >= touching)
        for (const unsigned int node : face.nodes)
          is_touched[node] = true;
    for (Node &node : nodes)
      node.is_open = node.surface == lid && !is_touched[node.node];
  }

  void
  Contact::cover(const double *filled)
  {
    // Beside a cell that is filled to the height f, the integrals of the shape
    // functions over the covered part of its face are f^2/2 at its upper node,
    // and f - f^2/2 at its lower one. With the mean x of both cells at a node,
    // that is 2 x^2 of the area of the node above the soil (x = f/2), and
    // 1 - 2 (1 - x)^2 below (x = (1 + f)/2). Points fill a cell within the soil
    // to 0.9 at least, as a rule.
    constexpr double full = .9;
    for (Node &node : nodes)
      if (node.adhesion > 0.)
        {
          const double x     = std::min(filled[node.node] / full, 1.),
                       empty = 1. - x;
          node.covered       = x < .5 ? 2. * x * x : 1. - 2. * empty * empty;
        }
  }

  Contact::NodeResult
  Contact::compute_contact(const Node &node, const Vector2 &w) const
  {
    const auto against = [&w](const Vector2 &normal) {
      return w * normal < 0. ? NodeResult{State::sliding, normal} :
                               NodeResult{State::apart, normal};
    };
    if (node.is_open)
      {
        for (unsigned int i = 0; i < node.n_normals; ++i)
          if (std::abs(node.normal[i][vertical]) < .5) // the wall at its corner
            return against(node.normal[i]);
        return {};
      }
    if (node.n_normals == 1)
      return against(node.normal[0]);

    return compute_contact_at_corner(node, w);
  }

  Contact::NodeResult
  Contact::compute_contact_at_corner(const Node &node, const Vector2 &w) const
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
    NodeResult result = compute_contact(node, w);
    if (result.state == State::apart)
      return result;
    // 1. split w = v - V into its normal part into the body and the rest
    const double  into    = std::min(0., w * result.normal);
    const Vector2 tangent = w - into * result.normal;
    const double  speed   = tangent.norm();
    // 2. the change of the tangential velocity that friction and adhesion bear,
    //    mu |w.n| + a A dt / m, A covered with soil: what is slower sticks, the
    //    rest slides
    const double bearable =
      -node.friction * into + node.covered * node.adhesion * dt / m;
    if (speed <= bearable)
      result.state = State::sticking;
    Vector2 left; // of the relative velocity
    if (result.state == State::sliding)
      left = tangent * (1. - bearable / speed);
    // 3. the impulse on the body is what the soil loses
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
        sums.impulse[surface_of(node)] += circumference * results[i].impulse;
        total += circumference * results[i].impulse;
      }
    add_corners(sums, total);
    for (const unsigned int node : inner_nodes)
      for (unsigned int d = 0; d < 2; ++d)
        v[node].value[d] = velocity[d];
    sums.work   = -(total * velocity);
    sums.inflow = compute_inflow(dt, mass, v);
    return sums;
  }

  Contact::Response
  Contact::respond(const Vector2              &body_velocity,
                   const double                dt,
                   const Kernels::NodalSums   *sums,
                   const std::vector<double>  &mass,
                   const Kernels::NodalVector *v)
  {
    velocity = body_velocity;
    Response response;
    for (const Node &node : nodes)
      {
        const double m = mass[node.node];
        if (node.node >= n_owned_nodes || m <= 0.)
          continue;
        Kernels::NodalVector u      = v[node.node];
        const NodeResult     result = apply_to_node(node, dt, m, u.value);
        if (result.state == State::apart)
          continue;
        response.impulse += circumference * result.impulse;
        for (unsigned int d = 0; d < 2; ++d)
          response.mass[d] += circumference * m *
                              (result.state == State::sticking ?
                                 1. :
                                 result.normal[d] * result.normal[d]);
      }
    const auto of_corners = corners_.respond(dt, sums, v);
    response.impulse += circumference * of_corners.first;
    response.mass += circumference * of_corners.second;
    return response;
  }

  void
  Contact::add_corners(ContactResult &sums, Vector2 &total) const
  {
    corners_.for_each_reaction([&](const unsigned int            node,
                                   const std::array<Surface, 2> &surfaces,
                                   const CornerReaction         &reaction) {
      if (node >= n_owned_nodes)
        return;
      ++sums.n_touching;
      for (unsigned int i = 0; i < 2; ++i)
        {
          const Vector2 impulse = circumference * reaction.impulse[i];
          sums.impulse[surfaces[i]] += impulse;
          total += impulse;
        }
    });
  }

  double
  Contact::compute_inflow(const double                dt,
                          const std::vector<double>  &mass,
                          const Kernels::NodalVector *v) const
  {
    double sum = 0.;
    for (const ContactFace &face : faces)
      {
        double flow = 0.; // out of the body, where both nodes have soil
        for (unsigned int i = 0; i < 2; ++i)
          {
            const unsigned int node = face.nodes[i];
            Vector2            u;
            for (unsigned int d = 0; d < 2; ++d)
              u[d] = v[node].value[d];
            u = corners_.velocity_at_face(node, face.soil_cell, u);
            if (node < n_owned_nodes && mass[node] > 0.)
              flow += face.areas[i] * ((u - velocity) * face.normal);
          }
        // a sliding velocity is along the face but for rounding
        const double rounding =
          1e-12 * velocity.norm() * (face.areas[0] + face.areas[1]);
        sum -= std::min(flow + rounding, 0.);
      }
    return circumference * dt * sum;
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
    corners_.for_each_reaction([&](const unsigned int node,
                                   const std::array<Surface, 2> & /*surfaces*/,
                                   const CornerReaction &reaction) {
      for (unsigned int d = 0; node < n_owned_nodes && d < 2; ++d)
        heat +=
          reaction.friction[d] * (mean_velocity[node].value[d] - velocity[d]);
    });
    return circumference * heat;
  }

  Vector2
  Contact::constrained(const unsigned int i,
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
        const Vector2 now = constrained(i, body_velocity, u);
        for (unsigned int d = 0; d < 2; ++d)
          u[d] = now[d];
      }
    corners_.constrain(body_velocity, v);
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
        const Vector2       now  = constrained(i, body_velocity, u);
        Vector2             impulse;
        for (unsigned int d = 0; d < 2; ++d)
          impulse[d] = share * sums[node.node].mass * (u[d] - now[d]);
        results[i].impulse += impulse;
        if (node.node >= n_owned_nodes)
          continue;
        result.impulse[surface_of(node)] += circumference * impulse;
        result.work -= circumference * (impulse * velocity);
      }
    constrain(body_velocity, v);
  }
} // namespace CaissonMPM
