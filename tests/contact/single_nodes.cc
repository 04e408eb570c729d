// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Contact at single nodes of a box and of a caisson's tip: separation, sliding,
// sticking, adhesion, the treatment of corners, the impulses by surface.
#include <deal.II/base/mpi.h>

#include <vector>

#include "../shared/scene.h"

const std::string mesh = R"(
  subsection Grid
    set Geometry     = plane strain
    set Outer radius = 4
    set Bottom       = -3
    set Top          = 1
  end
  subsection Rigid body
    set Friction angle of the tip        = 26.565051177078
    set Friction angle of the outer wall = 0
    set Friction angle of the inner wall = 45
    set Friction angle of the top        = 16.699244233994
  )";
const std::string box  = mesh + R"(
    set Kind       = box
    set Box left   = 1
    set Box right  = 3
    set Box bottom = -2
    set Box top    = 0
  )";
const std::string tube = R"(
  subsection Grid
    set Outer radius = 6
    set Bottom       = -3
    set Top          = 1
  end
  subsection Rigid body
    set Kind                  = caisson
    set Outer diameter        = 6
    set Skirt length          = 1
    set Wall thickness        = 0.2
    set Initial penetration   = 0.5
    set Tip angle             = 60
    set Friction angle of the tip        = 0
    set Friction angle of the outer wall = 0
    set Friction angle of the inner wall = 0
  )";

unsigned int
node_at(const BackgroundGrid &grid, const double r, const double z)
{
  for (unsigned int n = 0; n < grid.n_nodes(); ++n)
    if (std::abs(grid.r_of(n) - r) + std::abs(grid.z_of(n) - z) < 1e-9)
      return n;
  std::printf("there is no node at %g, %g\n", r, z);
  return 0;
}

constexpr double m = 5., dt = .1;

/** What became of a node with mass m and velocity (vr, vz), while the body
 * moves with (0, vb); then of another velocity held to this contact. The cells
 * at the node are filled to this share. */
void
try_node(const std::string &parameters,
         const char        *what,
         const double       r,
         const double       z,
         const double       vr,
         const double       vz,
         const Vector2     &V,
         const double       filled = 1.)
{
  Scene   s(parameters + "end\n");
  Contact contact;
  contact.initialize(s.grid, s.body.surface());
  const unsigned int                n = node_at(s.grid, r, z);
  std::vector<double>               mass(s.grid.n_nodes(), 0.);
  std::vector<Kernels::NodalVector> v(s.grid.n_nodes(), {{0., 0.}}), other = v;
  mass[n]       = m;
  v[n].value[0] = vr;
  v[n].value[1] = vz;
  other[n]      = {{.25 + V[0], -.5 + V[1]}};
  contact.cover(std::vector<double>(s.grid.n_nodes(), filled).data());
  const ContactResult result = contact.apply(V, dt, mass, v.data());
  contact.constrain(V, other.data());
  std::printf("%s: v %.6f %.6f, held %.4f %.4f, touching %d sticking %d, "
              "work %.4f",
              what,
              v[n].value[0] + 0.,
              v[n].value[1] + 0.,
              other[n].value[0] + 0.,
              other[n].value[1] + 0.,
              result.n_touching,
              result.n_sticking,
              result.work + 0.);
  const char *names[] = {"tip", "inner", "outer", "top", "lid"};
  for (unsigned int i = 0; i < n_surfaces; ++i)
    if (result.impulse[i].norm() > 0.)
      std::printf(", %s %.6f %.6f",
                  names[i],
                  result.impulse[i][0],
                  result.impulse[i][1]);
  std::printf("\n");
}

void
try_node(const std::string &parameters,
         const char        *what,
         const double       r,
         const double       z,
         const double       vr,
         const double       vz,
         const double       vb = 0.)
{
  const Vector2 V({0., vb});
  try_node(parameters, what, r, z, vr, vz, V);
}

void
check_flat_faces()
{
  std::printf("top face, tan(delta) = 0.3, plane strain\n");
  try_node(box, "apart", 2., 0., 1., .5);
  try_node(box, "slides", 2., 0., 1., -1.);
  try_node(box, "slides back", 2., 0., -1., -1.);
  try_node(box, "sticks", 2., 0., .2, -1.);
  try_node(box, "body moves down", 2., 0., 1., -1., -.5);
  try_node(box, "body is faster", 2., 0., 1., -.4, -.5);
  std::printf("adhesion 20 Pa\n");
  try_node(box + "set Adhesion of the top = 20\n", "slides", 2., 0., 1., -1.);
  for (const double height : {1., .5})
    {
      // with the mean share of two cells, filled to this height and not at all
      std::printf("adhesion above soil in the cell below, %.1f\n", height);
      try_node(box + "set Adhesion of the top = 20\n",
               "slides",
               2.,
               0.,
               1.,
               -1.,
               Vector2(),
               .9 * height / 2.);
    }
  std::printf("other faces: 45 degrees, 0, tan(delta) = 0.5\n");
  try_node(box, "inner wall", 1., -1., .5, .75);
  try_node(box, "outer wall", 3., -1., -.5, .75);
  try_node(box, "lower face", 2., -2., .75, .5);
  std::printf("inside\n");
  try_node(box, "node of the body", 2., -1., 1., 1., -.25);
}

void
check_corners()
{
  std::printf("corner of wall and tip, moving: both\n");
  const std::string text = tube + "set Corner normals = both\n";
  // the outer shoulder: normals (1, 0) and (sin 60, -cos 60)
  const double z = -.5 + .1 * std::sqrt(3.);
  try_node(text, "pushed", 3., z, 0., 0., -.1);
  try_node(text, "passes down", 3., z, .02, -.2, -.1);
  try_node(text, "inward", 3., z, -.1, -.1, -.1);
  // the edge: normals (+-sin 60, -cos 60)
  try_node(text, "edge", 2.9, -.5, 0., 0., -.1);
  std::printf("corner at rest\n");
  try_node(text, "inward", 3., z, -.1, 0.);
  std::printf("face of the tip: normal (sin 60, -cos 60)\n");
  try_node(tube + "set Cells across the wall = 4\n",
           "pushed",
           2.95,
           -.5 + .05 * std::sqrt(3.),
           0.,
           0.,
           -.1);
}

void
check_cone()
{
  const std::string cone = R"(
    subsection Grid
      set Outer radius = 2
      set Bottom       = -4
      set Top          = 1
    end
    subsection Rigid body
      set Kind                  = cone
      set Outer diameter        = 0.4
      set Skirt length          = 1.5
      set Cells across the wall = 4
      set Initial penetration   = 1
      set Friction angle of the tip        = 0
      set Friction angle of the outer wall = 45
    )";
  const double      h    = .2 * std::sqrt(3.);
  std::printf("cone: a face normal (sin 60, -cos 60), vertical at the point\n");
  try_node(cone, "point", 0., -1., 0., 0., -.1);
  try_node(cone, "face", .1, -1. + .5 * h, 0., 0., -.1);
  try_node(cone, "shoulder", .2, -1. + h, 0., 0., -.1);
  try_node(cone, "shaft", .2, 0., -.1, .05, -.1);
  try_node(cone, "pulled up, point", 0., -1., 0., 0., .1);
  try_node(cone, "pulled up, shaft", .2, 0., -.1, 0., .05);
}

void
check_lid()
{
  const std::string on_axis = tube + "set Lid thickness = 0.2\n"
                                     "set Friction angle of the lid = 45\n";
  const std::string lid =
    "subsection Grid\nset Inner radius = 1\nend\n" + on_axis;
  std::printf("lid: lower face at z = 0.3, corner with the inner wall\n");
  try_node(on_axis, "axis", 0., .3, 0., .1, -.1);
  try_node(lid, "slides", 1., .3, .3, .1, -.1);
  try_node(lid, "leaves", 1., .3, .1, -.2, -.1);
  try_node(lid, "corner, up", 2.8, .3, 0., .1);
  try_node(lid, "corner, into the wall", 2.8, .3, .1, -.3);
  try_node(lid, "corner, into both", 2.8, .3, .1, .1);
  try_node(lid, "upper face", 1., .5, 0., -.1);
  try_node(lid + "set Friction angle of the lid = 0\n"
                 "set Adhesion of the lid = 20\n",
           "adhesion",
           1.,
           .3,
           3.,
           .1);
}

void
check_cylinder()
{
  const std::string cylinder = R"(
    subsection Grid
      set Inner radius = 0.4
      set Outer radius = 2
      set Bottom       = -0.2
      set Top          = 0
      set Cell height  = 0.1
    end
    subsection Rigid body
      set Kind           = cylinder
      set Outer diameter = 1
      set Friction angle of the outer wall = 0
    )";
  std::printf("cylinder, growing\n");
  try_node(cylinder, "pushed", .5, -.1, 0., .1, Vector2({.2, 0.}));
  try_node(cylinder, "is faster", .5, -.1, .3, .1, Vector2({.2, 0.}));
  try_node(cylinder, "inside", .4, -.1, 0., 0., Vector2({.2, 0.}));
}

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check_flat_faces();
  check_corners();
  check_cone();
  check_lid();
  check_cylinder();
  return 0;
}
