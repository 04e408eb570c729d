// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A caisson: a tube with a triangular or flat tip, open or closed by a lid.
#ifndef caisson_mpm_bodies_caisson_h
#define caisson_mpm_bodies_caisson_h

#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/bodies/body_shape.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  /** The extent is that of the skirt. A lid reaches from the axis to the skirt,
   * with its upper face at the skirt's top. */
  class Caisson : public BodyShape
  {
  public:
    Caisson()
    {
      using dealii::Patterns::Double;
      add_outer_diameter(outer_diameter);
      add_skirt_length(skirt_length);
      add_parameter("Wall thickness",
                    wall_thickness,
                    "The thickness of a caisson's skirt. Units: m.",
                    prm,
                    Double(1e-9));
      add_cells_across(cells_across);
      add_choice(*this,
                 "Tip",
                 tip,
                 {{"triangular", Tip::triangular}, {"flat", Tip::flat}},
                 "The form of a caisson's tip is a wedge with its edge in the "
                 "middle of the wall (triangular), or flat. Units: none.");
      add_parameter("Tip angle",
                    tip_angle,
                    "The angle of the triangular tip's faces to the "
                    "horizontal. Units: degrees.",
                    prm,
                    Double(1., 80.));
      add_parameter("Shoulder bevel",
                    shoulder_bevel,
                    "The height by which the mesh raises the outer nodes of "
                    "the tip, in widths of a cell there. It makes up for the "
                    "resistance that cells at a sharp corner add, and vanishes "
                    "as cells become smaller. Units: none.",
                    prm,
                    Double(0., 2.));
      add_parameter("Lid thickness",
                    lid_thickness,
                    "The thickness of the lid that closes the top of a "
                    "caisson; 0 leaves it open. Units: m.",
                    prm,
                    Double(0.));
      add_initial_penetration(initial_penetration);
    }

    std::string
    name() const override
    {
      return "caisson";
    }

    std::string
    description() const override
    {
      return "a tube that is pushed into the soil";
    }

    void
    check_parameters() const override
    {
      if (2. * wall_thickness >= outer_diameter)
        throw BadInput(
          "Rigid body/Wall thickness = " + to_text(wall_thickness) +
          " m leaves no soil plug within Outer diameter = " +
          to_text(outer_diameter) + " m. Reduce the thickness.");
      check_cells_across(cells_across, tip == Tip::triangular ? 2 : 1);
      check_tip();
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
        origins.add_unused({"Rigid body/Tip angle"}, "Rigid body/Tip is flat");
    }

    void
    check_not_chosen() const override
    {
      if (has_lid())
        throw BadInput("Rigid body/Lid thickness: only a caisson has a lid. "
                       "Set it to 0, or Kind = caisson.");
    }

    double
    left() const override
    {
      return right() - wall_thickness;
    }

    double
    right() const override
    {
      return .5 * outer_diameter;
    }

    double
    bottom() const override
    {
      return -initial_penetration;
    }

    double
    top() const override
    {
      return skirt_length - initial_penetration;
    }

    double
    tip_height() const override
    {
      return slope() * .5 * wall_thickness + bevel();
    }

    double
    height_of_bent_rows() const override
    {
      return 8. * std::max(slope() * .5 * wall_thickness, bevel());
    }

    double
    lower_surface(const double r) const override
    {
      const double from_edge = std::abs(r - .5 * (left() + right())),
                   from_side = .5 * wall_thickness - from_edge;
      return bottom() + slope() * std::min(from_edge, .5 * wall_thickness) +
             bevel() * std::clamp(1. - from_side / cell_width(), 0., 1.);
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
      if (has_lid() && start[0] < left() + round_off)
        return start[1] < top() - round_off &&
               start[1] > lower_face_of_lid() + round_off;
      return is_within_extent(start) &&
             start[1] > lower_surface(start[0]) + round_off;
    }

    NamedNumbers
    dimensions() const override
    {
      return {{"diameter_m", outer_diameter},
              {"wall_thickness_m", wall_thickness},
              {"skirt_length_m", skirt_length},
              {"initial_penetration_m", initial_penetration}};
    }

  private:
    enum class Tip
    {
      triangular,
      flat
    };

    /** Of the tip's faces. */
    double
    slope() const
    {
      return tip == Tip::triangular ? std::tan(radians(tip_angle)) : 0.;
    }

    /** Of the outer nodes above the faces. Units: m. */
    double
    bevel() const
    {
      return cells_across_wall() > 1 ? shoulder_bevel * cell_width() : 0.;
    }

    void
    check_tip() const
    {
      if (tip == Tip::triangular && cells_across_wall() % 2 == 1)
        throw BadInput(
          "Rigid body/Cells across the wall = " + to_text(cells_across) +
          " puts no node at the edge of the triangular tip. Use "
          "an even number, or Tip = flat.");
      if (tip_height() >= skirt_length)
        throw BadInput("Rigid body/Tip angle = " + to_text(tip_angle) +
                       " degrees makes the tip longer than Skirt length = " +
                       to_text(skirt_length) + " m. Reduce the angle.");
    }

    double       outer_diameter      = 6.;
    double       skirt_length        = 7.;
    double       wall_thickness      = 0.1;
    unsigned int cells_across        = 2;
    Tip          tip                 = Tip::triangular;
    double       tip_angle           = 45.;
    double       shoulder_bevel      = 0.5;
    double       lid_thickness       = 0.;
    double       initial_penetration = 0.5;
  };
} // namespace CaissonMPM

#endif
