// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A caisson: a tube with a triangular or flat tip, open or closed by a lid. The
// thickness of its wall may change over the height, and rings may stiffen it.
#ifndef caisson_mpm_bodies_caisson_h
#define caisson_mpm_bodies_caisson_h

#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/bodies/caisson_wall.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace CaissonMPM
{
  /** The extent is that of the skirt, as thick as at the tip. A lid reaches
   * from the axis to the skirt, with its upper face at the skirt's top. */
  class Caisson : public BodyShape
  {
  public:
    Caisson()
      : BodyShape("caisson", "a tube that is pushed into the soil")
    {
      using dealii::Patterns::Double;
      add_outer_diameter(outer_diameter);
      add_skirt_length(skirt_length);
      add_parameter(
        "Wall thickness",
        wall_thickness,
        "m",
        "The thickness of a caisson's skirt, at its tip if it changes.",
        Double(1e-9));
      wall.declare(*this);
      add_cells_across(cells_across);
      add_choice(
        *this,
        "Tip",
        tip,
        {{"triangular", Tip::triangular}, {"flat", Tip::flat}},
        "",
        "The form of a caisson's tip is a wedge (triangular), or flat.");
      add_parameter(
        "Edge of the tip",
        edge_of_tip,
        "",
        "The distance of the triangular tip's edge from the inner face of the "
        "wall, as a share of the thickness: 0 is a bevel outside, 1 a bevel "
        "inside.",
        Double(0., 1.));
      add_parameter(
        "Tip angle",
        tip_angle,
        "degrees",
        "The angle of the triangular tip's faces to the horizontal.",
        Double(1., 80.));
      add_word_or_number(
        *this,
        "Shoulder bevel",
        shoulder_bevel,
        "auto",
        {},
        "",
        "The height by which the mesh raises the outer nodes of the tip, in "
        "widths of a cell there. It makes up for the resistance that cells at "
        "a sharp corner add, and vanishes as cells become smaller; auto is 1, "
        "or 0.5 if no layer has a friction angle or the water is undrained.",
        Double(0., 2.));
      add_parameter(
        "Lid thickness",
        lid_thickness,
        "m",
        "The thickness of the lid that closes the top of a caisson; 0 leaves "
        "it open.",
        Double(0.));
      add_initial_penetration(initial_penetration);
      parse_parameters_call_back.connect(
        [this]() { wall.read(wall_thickness); });
    }

    void
    check_parameters() const override
    {
      if (2. * wall_thickness >= outer_diameter)
        throw BadInput(
          "Rigid body/Wall thickness = " + to_text(wall_thickness) +
          " m leaves no soil plug within Outer diameter = " +
          to_text(outer_diameter) + " m. Reduce the thickness.");
      check_cells_across(cells_across, has_edge_in_middle() ? 2 : 1);
      check_tip();
      wall.check(extent(), tip_height(), lower_face_of_lid() - bottom());
      if (has_lid() && lower_face_of_lid() < -round_off)
        throw BadInput("Rigid body/Lid thickness = " + to_text(lid_thickness) +
                       " m puts the lid's lower face at z = " +
                       to_text(lower_face_of_lid()) +
                       " m, below the soil surface. Reduce it or Initial "
                       "penetration, or increase Skirt length.");
    }

    void
    name_unused_entries(ParameterOrigins &origins) const override
    {
      if (tip == Tip::flat)
        origins.add_unused({"Rigid body/Tip angle",
                            "Rigid body/Edge of the tip"},
                           "Rigid body/Tip is flat");
      if (!wall.has_steps())
        origins.add_unused({"Rigid body/Flush face"},
                           "Rigid body/Wall steps has none");
    }

    void
    check_not_chosen() const override
    {
      if (has_lid())
        throw BadInput("Rigid body/Lid thickness: only a caisson has a lid. "
                       "Set it to 0, or Kind = caisson.");
    }

    BodyPart
    extent() const override
    {
      return {.5 * outer_diameter - wall_thickness,
              .5 * outer_diameter,
              -initial_penetration,
              skirt_length - initial_penetration};
    }

    double
    tip_height() const override
    {
      return height_of_faces() + bevel();
    }

    double
    height_of_bent_rows() const override
    {
      return 8. * std::max(height_of_faces(), bevel());
    }

    double
    lower_surface(const double r) const override
    {
      const double middle    = .5 * (left() + right()),
                   from_edge = std::abs(r - edge()),
                   from_side = .5 * wall_thickness - std::abs(r - middle);
      // an edge at a side stays sharp
      const bool is_sharp =
        tip == Tip::triangular &&
        (r < middle ? edge_of_tip <= 0. : edge_of_tip >= 1.);
      return bottom() + std::min(slope() * from_edge, height_of_faces()) +
             (is_sharp ? 0. : bevel()) *
               std::clamp(1. - from_side / cell_width(), 0., 1.);
    }

    std::vector<double>
    radii_of_tip() const override
    {
      if (tip == Tip::flat || (has_edge_in_middle() && !wall.has_steps()))
        return {};
      return {edge()};
    }

    unsigned int
    n_parts() const override
    {
      return wall.n_parts();
    }

    BodyPart
    part(const unsigned int i) const override
    {
      return wall.part(i, extent());
    }

    bool
    is_ring(const unsigned int i) const override
    {
      return wall.is_ring(i);
    }

    bool
    has_ledges() const override
    {
      return wall.has_ledges();
    }

    double
    left_at_top() const override
    {
      return wall.uppermost(extent()).left;
    }

    bool
    has_lid() const override
    {
      return lid_thickness > 0.;
    }

    double
    lower_face_of_lid() const override
    {
      return top() - lid_thickness;
    }

    double
    cell_width() const override
    {
      return wall_thickness / cells_across_wall();
    }

    std::string
    entry_of_cell_width() const override
    {
      return "Rigid body/Wall thickness = " + to_text(wall_thickness) + " m";
    }

    unsigned int
    cells_across_wall() const override
    {
      return refined(cells_across);
    }

    bool
    contains(const Point &p, const double travel) const override
    {
      const Point start(p[0], p[1] + travel);
      if (has_lid() && start[0] < left_at_top() + round_off &&
          start[1] < top() - round_off &&
          start[1] > lower_face_of_lid() + round_off)
        return true;
      if (is_within(start, part(0)))
        return start[1] > lower_surface(start[0]) + round_off;
      for (unsigned int i = 1; i < n_parts(); ++i)
        if (is_within(start, part(i)))
          return true;
      return false;
    }

    NamedNumbers
    dimensions() const override
    {
      NamedNumbers result = {{"diameter_m", outer_diameter},
                             {"wall_thickness_m", wall_thickness},
                             {"skirt_length_m", skirt_length},
                             {"initial_penetration_m", initial_penetration}};
      if (!radii_of_tip().empty())
        result.emplace_back("edge_of_tip", edge_of_tip);
      wall.add_dimensions(result);
      return result;
    }

  private:
    enum class Tip
    {
      triangular,
      flat
    };

    bool
    has_edge_in_middle() const
    {
      return tip == Tip::triangular && edge_of_tip == .5;
    }

    /** Of the triangular tip, at this radius. Units: m. */
    double
    edge() const
    {
      return (1. - edge_of_tip) * left() + edge_of_tip * right();
    }

    /** Of the tip, at the side that is farther from the edge. Units: m. */
    double
    height_of_faces() const
    {
      return slope() *
             (std::max(edge_of_tip, 1. - edge_of_tip) * wall_thickness);
    }

    /** Of the tip's faces. */
    double
    slope() const
    {
      return tip == Tip::triangular ? std::tan(radians(tip_angle)) : 0.;
    }

    /** Of the outer nodes above the faces. Units: m.
     *
     * The shape function of a node at the shoulder carries the faces half a
     * cell beyond it. A tip of 45 degrees whose outer nodes are one cell higher
     * reaches the height of its shoulder half a cell inside the wall, which
     * makes up for it in sand; in clay half of it does, as runs with 2, 4 and 8
     * cells across the wall show (lab/notes/2026-11-27_mesh_of_real_sand.md).
     */
    double
    bevel() const
    {
      const double cells = shoulder_bevel.value_or(soil_has_friction ? 1. : .5);
      return cells_across_wall() > 1 ? cells * cell_width() : 0.;
    }

    void
    check_tip() const
    {
      if (has_edge_in_middle() && cells_across_wall() % 2 == 1)
        throw BadInput(
          "Rigid body/Cells across the wall = " + to_text(cells_across) +
          " puts no node at the edge of the triangular tip. Use "
          "an even number, or Tip = flat.");
      if (const double off =
            std::min(edge_of_tip, 1. - edge_of_tip) * wall_thickness;
          tip == Tip::triangular && off > 0. && off < .5 * cell_width())
        throw BadInput("Rigid body/Edge of the tip = " + to_text(edge_of_tip) +
                       " is " + to_text(off) +
                       " m from a face of the wall, and cells are " +
                       to_text(cell_width()) +
                       " m wide. Set it to 0 or 1, or increase Cells across "
                       "the wall.");
      if (tip_height() >= skirt_length)
        throw BadInput("Rigid body/Tip angle = " + to_text(tip_angle) +
                       " degrees makes the tip longer than Skirt length = " +
                       to_text(skirt_length) + " m. Reduce the angle.");
    }

    double                outer_diameter = 6.;
    double                skirt_length   = 7.;
    double                wall_thickness = 0.1;
    unsigned int          cells_across   = 2;
    Tip                   tip            = Tip::triangular;
    double                tip_angle      = 45.;
    double                edge_of_tip    = 0.5;
    std::optional<double> shoulder_bevel; // none: by the soil
    double                lid_thickness       = 0.;
    double                initial_penetration = 0.5;
    CaissonWall           wall;
  };
} // namespace CaissonMPM

#endif
