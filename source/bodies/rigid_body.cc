// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/bodies/box.h>
#include <caisson_mpm/bodies/caisson.h>
#include <caisson_mpm/bodies/cone.h>
#include <caisson_mpm/bodies/cylinder.h>
#include <caisson_mpm/bodies/dropped_motion.h>
#include <caisson_mpm/bodies/lowered_motion.h>
#include <caisson_mpm/bodies/pile.h>
#include <caisson_mpm/bodies/prescribed_motion.h>
#include <caisson_mpm/bodies/rigid_body.h>

#include <deal.II/base/patterns.h>

#include <limits>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    /** The shape where there is no body. */
    class NoShape : public BodyShape
    {
    public:
      NoShape()
        : BodyShape("none", "no body")
      {}
      bool
      exists() const override
      {
        return false;
      }
      BodyPart
      extent() const override
      {
        return {0., 0., 0., 0.};
      }
      bool
      contains(const Point &, const double) const override
      {
        return false;
      }
    };

    /** The motion where there is no body. */
    class NoMotion : public BodyMotion
    {
    public:
      NoMotion()
        : BodyMotion("none", "no motion")
      {}
      std::optional<double>
      time_of_travel(const double) const override
      {
        return std::numeric_limits<double>::infinity();
      }
      std::optional<std::pair<double, double>>
      travel_range(const double) const override
      {
        return std::make_pair(0., 0.);
      }

    protected:
      void
      move(const double, const double) override
      {}
    };

    /** Make one object of each type, in this order. */
    template <typename Base, typename... Types>
    std::vector<std::unique_ptr<Base>>
    one_of_each()
    {
      std::vector<std::unique_ptr<Base>> result;
      (result.push_back(std::make_unique<Types>()), ...);
      return result;
    }

    /** Declare an entry that chooses one of @p objects by its name, from the
     * first one on. */
    template <typename Base>
    EntryRecord &
    add_list(Section                                  &owner,
             const std::string                        &entry,
             const std::vector<std::unique_ptr<Base>> &objects,
             const std::size_t                         first,
             std::size_t                              &chosen,
             std::string                               text)
    {
      Choices<std::size_t> choices;
      for (std::size_t i = first; i < objects.size(); ++i)
        {
          choices.emplace_back(objects[i]->name, i);
          text += (i == first ? ": " : "; ") + objects[i]->name + " (" +
                  objects[i]->description + ")";
        }
      return add_choice(owner, entry, chosen, choices, "", text + ".");
    }
  } // namespace

  RigidBody::RigidBody()
    : Section("/Rigid body")
    , shapes(
        one_of_each<BodyShape, NoShape, Caisson, Box, Cone, Pile, Cylinder>())
    , motions(one_of_each<BodyMotion,
                          NoMotion,
                          PrescribedMotion,
                          LoweredMotion,
                          DroppedMotion>())
  {
    add_list(
      *this, "Kind", shapes, 0, chosen_shape, "The rigid body is one of these");
    add_list(*this,
             "Motion",
             motions,
             1,
             chosen_motion,
             "The body's motion is one of these")
      .influence = Influence::motion;
    add_parameter("Density",
                  density,
                  "kg/m3",
                  "The density of the body's material.",
                  Patterns::Double(1e-9));
    add_word_or_number(
      *this,
      "Submerged weight",
      weight,
      "auto",
      -1.,
      "N",
      "The weight of the body in water, with everything that it carries; auto "
      "takes that of its own material, without lid and ballast where the mesh "
      "has none.",
      Patterns::Double(0.))
      .influence = Influence::motion;
    add_parameter(
      "Force table",
      force_text,
      "s : N",
      "Pairs time : force, separated by commas, give the force that acts on a "
      "body besides its weight and the suction, positive downward; linear in "
      "between and constant beyond.",
      Patterns::List(Patterns::List(Patterns::Double(), 2, 2, ":"), 0, 10000))
      .influence = Influence::motion;
    parse_parameters_call_back.connect(
      [this]() { force_table = parse_time_table(force_text); });
  }

  double
  RigidBody::applied_force(const double time) const
  {
    return force_table.empty() ? 0. : value_at(force_table, time);
  }

  void
  RigidBody::compute_weight(const double mass, const Soil &soil)
  {
    const double buoyancy = soil.unit_weight_of_water() * mass / density;
    submerged_weight_     = weight.value_or(-soil.gravity[vertical] * mass -
                                        (soil.is_submerged() ? buoyancy : 0.));
    motion().surroundings.mass = mass;
  }

  void
  RigidBody::check_parameters() const
  {
    shape().check_parameters();
    motion().check_parameters();
    check_time_table(force_table, "Rigid body/Force table");
    for (std::size_t i = 0; i < shapes.size(); ++i)
      if (i != chosen_shape)
        shapes[i]->check_not_chosen();
    if (shape().expands() && motion().traits.follows_loads)
      throw BadInput("Rigid body/Motion is " + motion().name +
                     ": the weight does not expand a cylinder. Set Motion = "
                     "prescribed.");
    if (shape().exists() && motion().name == "lowered" && weight == 0.)
      throw BadInput("Rigid body/Motion is lowered, but Rigid body/Submerged "
                     "weight is 0: a body without weight neither sinks nor "
                     "comes to rest on the soil. Set its weight in N.");
    if (shape().expands() && surface().adhesion[outer_wall] > 0.)
      throw BadInput("Rigid body/Adhesion of the outer wall: the area of an "
                     "expanding cylinder changes, adhesion on it is not "
                     "possible. Set it to 0.");
  }

  void
  RigidBody::name_unused_entries(ParameterOrigins &origins) const
  {
    if (!shape().exists())
      return origins.add_unused({"Rigid body"}, "Rigid body/Kind is none");
    name_entries_of_others(origins,
                           shape(),
                           shapes,
                           "Rigid body/Kind is " + shape().name);
    name_entries_of_others(origins,
                           motion(),
                           motions,
                           "Rigid body/Motion is " + motion().name);
    shape().name_unused_entries(origins);
    surface().name_unused_surfaces(origins, shape());
    motion().name_unused_entries(origins);
    if (!motion().traits.follows_loads)
      origins.add_unused({"Rigid body/Force table"},
                         "Rigid body/Motion is " + motion().name);
  }
} // namespace CaissonMPM
