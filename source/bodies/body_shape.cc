// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/bodies/body_shape.h>

#include <deal.II/base/patterns.h>

namespace CaissonMPM
{
  using namespace dealii;

  void
  BodyShape::add_outer_diameter(double &diameter)
  {
    add_parameter(
      "Outer diameter",
      diameter,
      "m",
      "The outer diameter of a caisson, of a pile, of a cone and its shaft, or "
      "of a cylinder at the start.",
      Patterns::Double(1e-9));
  }

  void
  BodyShape::add_skirt_length(double &length)
  {
    add_parameter(
      "Skirt length",
      length,
      "m",
      "The length of a caisson's skirt, of a pile, or of a cone with its "
      "shaft, measured from the lowest point of the tip.",
      Patterns::Double(1e-9));
  }

  void
  BodyShape::add_initial_penetration(double &depth)
  {
    add_parameter(
      "Initial penetration",
      depth,
      "m",
      "The depth of the tip's lowest point at the start, to which a caisson, "
      "cone or pile is wished in place; 0 is on the surface.",
      Patterns::Double(0.));
  }

  void
  BodyShape::add_cells_across(unsigned int &n)
  {
    add_parameter(
      "Cells across the wall",
      n,
      "",
      "The number of cells across the wall of a caisson, or across the radius "
      "of a cone, pile or cylinder: the width of the cells at the tip is the "
      "thickness over this number, which must be even for a triangular tip.",
      Patterns::Integer(1, 64));
  }

  void
  BodyShape::check_cells_across(const unsigned int n,
                                const unsigned int multiple) const
  {
    if (refinement == 1.)
      return;
    const double       wanted = n * refinement;
    const unsigned int nearest =
      multiple * std::max(1l, std::lround(wanted / multiple));
    if (std::abs(wanted - nearest) > 1e-6 * wanted)
      throw BadInput("Rigid body/Cells across the wall = " + to_text(n) +
                     ", times Grid/Refinement = " + to_text(refinement) +
                     ", is " + to_text(wanted) + " and must be " +
                     (multiple == 1 ? "a whole number" :
                                      "a multiple of " + to_text(multiple)) +
                     ". Use Grid/Refinement = " + to_text(double(nearest) / n) +
                     ".");
  }
} // namespace CaissonMPM
