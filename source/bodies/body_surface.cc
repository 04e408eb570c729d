// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/bodies/body_shape.h>
#include <caisson_mpm/bodies/body_surface.h>

#include <deal.II/base/patterns.h>

namespace CaissonMPM
{
  using namespace dealii;

  const std::string &
  name_of(const Surface surface)
  {
    static const std::array<std::string, n_surfaces> names = {
      {"tip", "inner wall", "outer wall", "top", "lid", "ring"}};
    return names[surface];
  }

  BodySurface::BodySurface()
    : Section("/Rigid body")
  {
    add_choice(
      *this,
      "Corner normals",
      splits_corners,
      {{"split", true}, {"both", false}},
      "",
      "At the nodes where two faces of the body meet, with both, soil may not "
      "move into either face; with split, the cells at each face have a "
      "velocity of their own there, so that no soil passes through the body.");
    for (unsigned int s = 0; s < n_surfaces; ++s)
      {
        const std::string &name = name_of(static_cast<Surface>(s));
        add_parameter("Friction angle of the " + name,
                      friction_angle[s],
                      "degrees",
                      "The angle of friction between soil and the body's " +
                        name + ".",
                      Patterns::Double(0., 89.))
          .influence = Influence::motion;
        add_parameter("Adhesion of the " + name,
                      adhesion[s],
                      "Pa",
                      "The adhesion between soil and the body's " + name + ".",
                      Patterns::Double(0.))
          .influence = Influence::motion;
      }
  }

  void
  BodySurface::name_unused_surfaces(ParameterOrigins &origins,
                                    const BodyShape  &shape) const
  {
    const auto add_unused = [&origins](const Surface      surface,
                                       const std::string &reason) {
      const std::string of = " of the " + name_of(surface);
      origins.add_unused({"Rigid body/Friction angle" + of,
                          "Rigid body/Adhesion" + of},
                         reason);
    };
    if (shape.left() <= 0.)
      add_unused(inner_wall,
                 "the body has no inner wall: Rigid body/Kind is " +
                   shape.name);
    if (!shape.has_ledges())
      add_unused(ring,
                 "the body has no ring, and no wall step that makes it "
                 "thicker");
  }
} // namespace CaissonMPM
