// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/simulation/scene_review.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  namespace
  {
    // What lies outside of these is hardly meant in SI units, where a body goes
    // into the ground; tests of the method take other numbers.
    constexpr double least_solid_density   = 1000., // kg/m3
      largest_solid_density                = 6000.; // kg/m3
    constexpr double least_fluid_density   = 500.,  // kg/m3
      largest_fluid_density                = 2000.; // kg/m3
    constexpr double least_body_density    = 100.,  // kg/m3
      largest_body_density                 = 3e4;   // kg/m3
    constexpr double largest_gravity       = 5000.; // m/s2, centrifuge
    constexpr double largest_permeability  = 1.;    // m/s
    constexpr double largest_size          = 200.;  // of a body, m
    constexpr double largest_part_of_speed = .1;    // of waves
    constexpr double largest_n_steps = 1e8, largest_n_frames = 1e4,
                     largest_n_records = 1e6;
    // Distances from the wall and below the tip, in diameters, of a body that
    // is deeper than a quarter of them: see doc/limitations.md, Boundaries.
    constexpr double least_to_side = 2., least_to_bottom = 1.5, shallow = .25;
    // of a closed body at any depth: a pile in dense sand bears 5 % more, and
    // 1 % less, with boundaries there
    constexpr double least_to_side_closed = 12., least_to_bottom_closed = 8.;

    const std::string on_rough_surface =
      ": the soil fails before it slides on such a surface. Set at most that "
      "angle; in clay, set 0 and an adhesion.";

    std::string
    meters(const double x)
    {
      return to_text(x, 4) + " m";
    }

    /** Which other unit may be meant by a density; empty if none. */
    std::string
    other_unit_of_density(const double density)
    {
      if (density >= .5 && density < 8.)
        return " The value may be in t/m3 (g/cm3): multiply it by 1000.";
      if (density >= 8. && density < 80.)
        return " The value may be a unit weight in kN/m3: divide it by 9.81 "
               "and multiply it by 1000.";
      return "";
    }
  } // namespace

  void
  SceneReview::all()
  {
    thin_layers();
    const std::string limit =
      parts.grid.lines().known_limit(parts.body.shape());
    if (!limit.empty())
      origins.add_warning(limit);
    gravity();
    if (parts.body.shape().exists() && !is_block())
      {
        stresses();
        layers();
        if (parts.time_step.has_inertia_tolerance())
          contrast_of_stiffness();
        fluid();
      }
    if (parts.body.shape().exists())
      {
        size_of_body();
        motion_of_body();
        confinement();
        cells_at_tip();
        points_at_tip();
        transfer();
        friction();
        boundaries();
        suction();
        seepage();
      }
    length_of_run();
  }

  void
  SceneReview::doubt(const std::string &entry,
                     const double       value,
                     const std::string &unit,
                     const std::string &text)
  {
    origins.add_warning(entry + " = " + to_text(value, 6) +
                        (unit.empty() ? "" : " ") + unit + " " + text);
  }

  // ------------------------------------------------------------ soil

  void
  SceneReview::layers()
  {
    for (const unsigned int i : parts.soil.uppermost_materials())
      {
        const SoilMaterial &soil = parts.soil.material(i);
        stiffness_and_strength(soil);
        solid_density(soil);
        density_of_state(soil);
        const double k = soil.permeability;
        if (parts.water->traits().uses_permeability && k > largest_permeability)
          doubt(soil.section() + "/Permeability",
                k,
                "m/s",
                "is more than that of gravel. Check the unit, m/s.");
      }
  }

  void
  SceneReview::stiffness_and_strength(const SoilMaterial &soil)
  {
    constexpr double stiff_volume = .4;
    if (const auto nu = soil.poisson_ratio)
      if (*nu > stiff_volume &&
          !parts.nodal_motion.settings().uses_mean_volume())
        doubt(soil.section() + "/Poisson ratio",
              *nu,
              "",
              "with Method/Mean volume change = false locks, or loses strength "
              "to vibrations of the volume. Set Mean volume change = true.");
    undrained_volume(soil);
    const auto strength = soil.shear_strength;
    if (strength == 0. && soil.friction_angle == 0.)
      doubt(soil.section() + "/Cohesion",
            0.,
            "Pa",
            "with a friction angle of 0 is no strength at all. In clay, set it "
            "to the undrained shear strength.");
    if (strength && soil.wall_adhesion && *soil.wall_adhesion > *strength)
      origins.add_warning(
        soil.section() + "/Adhesion factor of the walls makes an adhesion of " +
        to_text(*soil.wall_adhesion, 4) + " Pa, more than the cohesion, " +
        to_text(*strength, 4) +
        " Pa: the soil fails before it slides on such a wall. Set at most 1.");
  }

  void
  SceneReview::undrained_volume(const SoilMaterial &soil)
  {
    constexpr double least = .45;
    const auto       nu    = soil.poisson_ratio;
    if (nu && *nu < least && soil.shear_strength && !soil.friction_angle &&
        !parts.water->traits().follows_soil &&
        parts.water->traits().bulk_modulus == 0.)
      doubt(soil.section() + "/Poisson ratio",
            *nu,
            "",
            "lets undrained clay change its volume. Set it to 0.45 to 0.49, or "
            "Water/Level = undrained.");
  }

  void
  SceneReview::solid_density(const SoilMaterial &soil)
  {
    const double      density = soil.solid_density;
    const std::string grains  = "the density of grains, which is about 2650 "
                                "kg/m3." +
                               other_unit_of_density(density),
                      dry = soil.section() + "/Dry density";
    if (density >= least_solid_density && density <= largest_solid_density)
      return;
    if (origins.is_set(dry))
      doubt(dry,
            soil.dry_density(),
            "kg/m3",
            "makes a solid density of " + to_text(density, 4) +
              " kg/m3. That is not " + grains);
    else
      doubt(soil.section() + "/Solid density",
            density,
            "kg/m3",
            "is not " + grains);
  }

  void
  SceneReview::density_of_state(const SoilMaterial &soil)
  {
    if (!soil.loosest_void_ratio)
      return;
    for (const char *const name :
         {"Relative density", "Void ratio", "Porosity"})
      if (origins.is_set(soil.section() + "/" + name))
        return;
    doubt(soil.section() + "/Porosity",
          soil.porosity,
          "",
          "is only the default, and the strength of " + soil.law_name() +
            " depends on it. Set Relative density, Void ratio or Porosity.");
  }

  void
  SceneReview::gravity()
  {
    const double gravity = parts.soil.gravity[vertical];
    if (std::abs(gravity) > largest_gravity)
      origins.add_warning("Soil/Gravity is " + to_text(gravity, 6) +
                          " m/s2 in the vertical, which is more than that of "
                          "a centrifuge. Check the unit, m/s2.");
    if (gravity > 0.)
      origins.add_warning(
        "Soil/Gravity points upward: z grows upward, so that its "
        "second number is negative on earth.");
  }

  void
  SceneReview::fluid()
  {
    const double gravity = parts.soil.gravity[vertical];
    if (!parts.soil.is_submerged() || gravity == 0.)
      return;
    const double density = -parts.soil.unit_weight_of_water() / gravity;
    if (density < least_fluid_density || density > largest_fluid_density)
      doubt("Soil/Fluid density",
            density,
            "kg/m3",
            "is not the density of water." + other_unit_of_density(density));
  }

  void
  SceneReview::thin_layers()
  {
    const double width = parts.body.shape().cell_width();
    const auto   tops  = parts.soil.interfaces();
    for (std::size_t i = 0; i < tops.size(); ++i)
      {
        const double thickness = (i > 0 ? tops[i - 1] : 0.) - tops[i];
        if (thickness < width)
          doubt("Soil/Layer " + to_text(i + 2) + "/Top depth",
                -tops[i],
                "m",
                "makes layer " + to_text(i + 1) + " only " + meters(thickness) +
                  " thick, thinner than the cells at the "
                  "wall (" +
                  meters(width) +
                  "): its row of cells makes the time step small. Join the "
                  "layer with the one above or below.");
      }
  }

  // ------------------------------------------------------------ body

  void
  SceneReview::size_of_body()
  {
    const BodyShape &shape = parts.body.shape();
    const double     size =
      std::max(2. * shape.right(),
               shape.expands() ? 0. : shape.top() - shape.bottom());
    if (size > largest_size)
      origins.add_warning(
        "the body is " + meters(size) +
        " large. Check Rigid body/Outer diameter "
        "and Rigid body/Skirt length: lengths are in meters.");
    const double density = parts.body.density;
    if (density < least_body_density || density > largest_body_density)
      doubt("Rigid body/Density",
            density,
            "kg/m3",
            "is not the density of steel (7850 kg/m3) or concrete (2400 "
            "kg/m3)." +
              other_unit_of_density(density));
    const double top_at_end = shape.top() - parts.grid.lines().total_travel();
    if (!shape.expands() && shape.top() < -1e-9)
      origins.add_warning(
        "the top of the body begins at z = " + meters(shape.top()) +
        ", below the soil surface: soil would flow over it, or a lid would be "
        "in the soil. Reduce Rigid body/Initial penetration, or increase Rigid "
        "body/Skirt length.");
    else if (!shape.expands() && top_at_end < -1e-9)
      origins.add_warning(
        "the travel of " + meters(parts.grid.lines().total_travel()) +
        " brings the top of the body to z = " + meters(top_at_end) +
        ", below the soil surface: soil would flow over it, or a lid would be "
        "in the soil. Increase Rigid body/Skirt length, or end earlier.");
  }

  void
  SceneReview::motion_of_body()
  {
    const double speed = parts.body.motion().usual_velocity();
    if (speed > largest_part_of_speed * wave_speed)
      origins.add_warning(
        "the body moves at " + to_text(speed, 4) +
        " m/s, more than a tenth of the wave speed in the soil, " +
        to_text(wave_speed, 4) +
        " m/s: inertia decides its forces. Check Rigid body/Velocity, which is "
        "in m/s, and Time/Mass scaling.");
  }

  void
  SceneReview::confinement()
  {
    const double deepest =
      std::min(0.,
               parts.body.shape().bottom() - parts.grid.lines().total_travel());
    const unsigned int  m    = parts.soil.material_at(deepest);
    const SoilMaterial &soil = parts.soil.material(m);
    if (!soil.friction_angle || soil.shear_strength.value_or(0.) > 0.)
      return;
    const double speed   = parts.body.motion().usual_velocity(),
                 inertia = parts.soil.inertial_density(m) * speed * speed,
                 stress  = -parts.soil.initial_stress(
                   dealii::Point<2>(0., deepest))[zz];
    if (stress > 0. && inertia > stress)
      origins.add_warning(
        "at the end of the way of the body the vertical stress at rest is " +
        to_text(stress, 4) +
        " Pa, less than the inertia of soil that moves at " +
        to_text(speed, 4) + " m/s, " + to_text(inertia, 4) +
        " Pa: the soil of " + soil.section() +
        " is thrown about, because only confinement gives it strength. Check "
        "the unit of the stress of section Soil, Pa, or reduce Rigid "
        "body/Velocity or Time/Mass scaling.");
  }

  void
  SceneReview::cells_at_tip()
  {
    if (is_pushed_in() && parts.body.shape().cells_across_wall() == 1)
      origins.add_warning(
        "Rigid body/Cells across the wall = 1 makes the tip far too strong: "
        "one cell has been seen to raise its force by 44 % against two, and "
        "two by 10 to 20 % against finer ones. Set at least 2.");
  }

  void
  SceneReview::points_at_tip()
  {
    constexpr double   widths = 5.; // of the wall, for which the points last
    const unsigned int enough = parts.water->traits().least_points,
                       n      = parts.generator.points_per_direction_in_path();
    const BodyShape &shape    = parts.body.shape();
    if (is_pushed_in() && parts.generator.least_points_per_direction() == 1)
      origins.add_warning(
        "one point per cell (section Material points) makes the tip too weak, "
        "by up to a half. Set at least 2 everywhere.");
    if (is_pushed_in() && !parts.generator.splits_and_merges() && n < enough &&
        parts.grid.lines().total_travel() >
          widths * (shape.right() - shape.left()))
      throw BadInput(
        "Material points/Per direction in path = " + to_text(n) +
        " without Split and merge lets cells beneath the tip run out of "
        "points, and coupled water bears half of what the soil should. Set "
        "Material points/Split and merge = true, or at least " +
        to_text(enough) + " points.");
  }

  void
  SceneReview::transfer()
  {
    const auto flip = parts.nodal_motion.settings().given_flip_fraction();
    if (is_pushed_in() && flip && *flip < .95) // the least of auto
      doubt("Method/FLIP fraction",
            *flip,
            "",
            "makes the transfer viscous. The tip force of a caisson has been "
            "seen to rise by 3 to 6 % with 0.9, 15 to 30 % with 0.5, and 20 to "
            "55 % with 0. Set auto.");
  }

  void
  SceneReview::friction()
  {
    const BodyShape    &shape   = parts.body.shape();
    const auto         &angles  = parts.body.surface().friction_angle;
    const double        depth   = shape.expands() ?
                                    parts.grid.lines().depth() :
                                    parts.grid.lines().total_travel() - shape.bottom();
    const double        inner   = shape.left() > 0. ? angles[inner_wall] : 0.;
    const double        wall    = std::max(angles[outer_wall], inner);
    const SoilMaterial *weakest = nullptr, *strongest = nullptr;
    const auto          margin = [wall](const SoilMaterial &soil) {
      return *soil.friction_angle - soil.wall_friction_angle.value_or(wall);
    };
    for (unsigned int i = 0; i < parts.soil.n_materials(); ++i)
      {
        const SoilMaterial &soil = parts.soil.material(i);
        if (!soil.friction_angle || soil.top_depth >= depth)
          continue;
        if (weakest == nullptr || margin(soil) < margin(*weakest))
          weakest = &soil;
        if (strongest == nullptr ||
            *soil.friction_angle > *strongest->friction_angle)
          strongest = &soil;
      }
    if (weakest == nullptr)
      return;
    if (!is_block() && margin(*weakest) < 0.)
      friction_of_walls(*weakest, angles[outer_wall], inner);
    if (angles[tip] > *strongest->friction_angle)
      too_rough(tip,
                "exceeds the friction angle of all soil that the tip meets, at "
                "most " +
                  to_text(*strongest->friction_angle, 4) + " degrees");
  }

  void
  SceneReview::friction_of_walls(const SoilMaterial &soil,
                                 const double        outer,
                                 const double        inner)
  {
    const std::string exceeds = "exceeds the friction angle of layer " +
                                to_text(soil.layer + 1) + ", " +
                                to_text(*soil.friction_angle, 4) + " degrees";
    if (soil.wall_friction_angle)
      doubt(soil.section() + "/Friction angle of the walls",
            *soil.wall_friction_angle,
            "degrees",
            exceeds + on_rough_surface);
    else
      too_rough(outer >= inner ? outer_wall : inner_wall,
                exceeds + (std::min(outer, inner) > *soil.friction_angle ?
                             ", and so does that of the other wall" :
                             ""));
  }

  void
  SceneReview::too_rough(const Surface surface, const std::string &exceeds)
  {
    doubt("Rigid body/Friction angle of the " + name_of(surface),
          parts.body.surface().friction_angle[surface],
          "degrees",
          exceeds + on_rough_surface);
  }

  void
  SceneReview::boundaries()
  {
    const BodyShape &shape = parts.body.shape();
    const GridLines &lines = parts.grid.lines();
    if (!is_pushed_in())
      return;
    const double diameter = 2. * shape.right(),
                 depth    = lines.total_travel() - shape.bottom(),
                 side     = lines.node_start(lines.n_columns(), 0)[radial],
                 to_side  = side - shape.right(),
                 to_floor = lines.depth() - depth;
    // a body that is hardly in the soil does not reach far
    const auto needed = [=](const double n_diameters) {
      return depth <= shallow * diameter ?
               std::min(2. * depth, n_diameters * diameter) :
               n_diameters * diameter;
    };
    const bool   is_closed = shape.left() == 0. && !is_block();
    const double beside    = is_closed ? least_to_side_closed * diameter :
                                         needed(least_to_side),
                 below     = is_closed ? least_to_bottom_closed * diameter :
                                         needed(least_to_bottom);
    const std::string effect =
      ", and changes the forces: see doc/limitations.md, Boundaries. Set ";
    constexpr double tolerance = 1e-9;
    if (to_side < beside - tolerance)
      doubt("Grid/Outer radius",
            side,
            "m",
            "puts the side " + meters(to_side) +
              " from the wall, nearer than " + meters(beside) + effect +
              "at least " + meters(shape.right() + beside) + ".");
    if (to_floor < below - tolerance)
      doubt("Grid/Bottom",
            -lines.depth(),
            "m",
            "is " + meters(to_floor) +
              " below the tip at the end, nearer than " + meters(below) +
              effect + "at most " + meters(-depth - below) + ".");
  }

  bool
  SceneReview::is_block() const
  {
    // the other bodies ask for cells of their own
    return parts.body.shape().cell_width() == 0.;
  }

  bool
  SceneReview::is_pushed_in() const
  {
    return parts.grid.lines().axisymmetric() && !is_block() &&
           !parts.body.shape().expands() &&
           parts.grid.lines().total_travel() > 0.;
  }

  // ------------------------------------------------------------ water

  void
  SceneReview::suction()
  {
    // a hundredth of the least that an installation would meet
    constexpr double  part   = .01;
    const std::string weight = "Rigid body/Submerged weight";
    const double      own = -parts.soil.gravity[vertical] * parts.body.mass();
    if (origins.is_set(weight) && parts.body.submerged_weight() < part * own)
      doubt(weight,
            parts.body.submerged_weight(),
            "N",
            "is less than a hundredth of the weight of the body's cells, " +
              to_text(own, 3) + " N. Check the unit, N: 1 kN is 1000 N.");
    const LidCompartment *const lid = parts.water->traits().lid;
    if (lid == nullptr)
      return;
    const BodyShape &shape = parts.body.shape();
    const double least = part * parts.soil.unit_weight(parts.soil.material(0)) *
                         (shape.top() - shape.bottom());
    const auto check = [&](const std::string &entry, const double pressure) {
      if (pressure > 0. && pressure < least)
        origins.add_warning(
          entry + " is " + to_text(pressure, 4) +
          " Pa, less than a hundredth of the weight of soil over the length "
          "of the skirt. Check the unit, Pa: 1 kPa is 1000 Pa.");
    };
    check("Water/Suction table", lid->settings().largest_of_table());
    check("Water/Largest suction", lid->settings().largest.value_or(0.));
  }

  void
  SceneReview::seepage()
  {
    if (!parts.water->traits().uses_permeability ||
        parts.water->traits().follows_soil)
      return;
    // drained soil has more friction, or a cohesion that is not the larger part
    constexpr double least_angle = 10., usual_angle = 20., part = 4.;
    for (const unsigned int i : parts.soil.uppermost_materials())
      {
        const SoilMaterial &soil     = parts.soil.material(i);
        const double        cohesion = soil.shear_strength.value_or(0.);
        const double        angle    = soil.friction_angle.value_or(0.);
        const double friction = std::tan(angle * pi / 180.) * weight_above();
        if (soil.top_depth < depth_of_skirt() && cohesion > 0. &&
            !soil.has_undrained_strength() &&
            (angle < least_angle ||
             (angle < usual_angle && cohesion > part * friction)))
          origins.add_warning(
            soil.section() + " has the strength of undrained clay, " +
            to_text(cohesion, 4) + " Pa with a friction angle of " +
            to_text(angle, 4) +
            " degrees, but with Water/Level = seepage water flows through it "
            "as through sand, and takes its stress away. Set its Friction angle "
            "= 0, with which it is undrained clay, or give it its drained "
            "strength.");
      }
  }

  // ------------------------------------------------------------ time

  void
  SceneReview::length_of_run()
  {
    std::string depths;
    for (const double depth : parts.schedule.frames_out_of_reach())
      depths += (depths.empty() ? "" : ", ") + meters(depth);
    if (!depths.empty())
      origins.add_cosmetic_warning(
        "Output/Frame penetrations: the body does not come to " + depths +
        ". Remove what is not reached, or set a later end in "
        "section Time.");
    if (!std::isfinite(n_steps))
      return;
    if (n_steps > largest_n_steps)
      origins.add_warning(
        "the run takes about " + to_text(n_steps, 2) +
        " steps. Check the units, the smallest cells, and Time/Time step.");
    const double n_frames =
      std::min<double>(n_steps, parts.schedule.n_frames());
    if (n_frames > largest_n_frames)
      origins.add_warning(
        "the run writes " + to_text(n_frames, 2) +
        " frames. Check Output/Frame interval, which is in s.");
    const double n_records = std::min(n_steps, parts.schedule.n_records());
    if (n_records > largest_n_records)
      origins.add_warning("the run writes " + to_text(n_records, 2) +
                          " rows to history.csv. Check Output/Record interval, "
                          "which is in s.");
  }
} // namespace CaissonMPM
