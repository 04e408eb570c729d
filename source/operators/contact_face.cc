// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/operators/contact_face.h>

#include <cmath>

namespace CaissonMPM
{
  namespace
  {
    // of the faces left, right, below, above
    constexpr unsigned int corners_of_face[4][2] = {{0, 2},
                                                    {1, 3},
                                                    {0, 1},
                                                    {2, 3}};

    /** Face @p f of rigid cell @p cell, seen from inside. */
    ContactFace
    make_face(const BackgroundGrid &grid,
              const unsigned int    cell,
              const unsigned int    f)
    {
      constexpr Surface  surfaces[4] = {inner_wall, outer_wall, tip, top};
      ContactFace        face;
      Vector2            x[2];
      const unsigned int opposite = f ^ 1u;
      face.soil_cell              = grid.neighbor(cell, f);
      face.is_vertical            = f < 2;
      for (unsigned int i = 0; i < 2; ++i)
        {
          face.nodes[i]   = grid.cell_nodes(cell).node[corners_of_face[f][i]];
          face.corners[i] = corners_of_face[opposite][i];
          x[i][0]         = grid.r_of(face.nodes[i]);
          x[i][1]         = grid.z_of(face.nodes[i]);
        }
      const Vector2 along  = x[1] - x[0];
      const double  length = along.norm();
      face.surface         = surfaces[f];
      if (face.surface == tip &&
          !grid.lines().is_lowest_cell(grid.global_number(cell)))
        face.surface = grid.is_lid(cell) ? lid : ring;
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
  } // namespace

  FaceStrength
  strength_of(const BodySurface &body, const ContactFace &face)
  {
    return {std::tan(radians(body.friction_angle[face.surface])),
            body.adhesion[face.surface]};
  }

  std::vector<ContactFace>
  collect_contact_faces(const BackgroundGrid &grid)
  {
    std::vector<ContactFace> faces;
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      for (unsigned int f = 0; grid.is_rigid(cell) && f < 4; ++f)
        {
          const int neighbor = grid.neighbor(cell, f);
          if (neighbor >= 0 && !grid.is_rigid(neighbor))
            faces.push_back(make_face(grid, cell, f));
        }
    return faces;
  }
} // namespace CaissonMPM
