// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/domain/graded_lines.h>
#include <caisson_mpm/domain/grid_lines.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace CaissonMPM
{
  using namespace dealii;

  GridLines::GridLines()
    : ParameterAcceptor("/Grid")
  {
    declare_domain();
    declare_cells();
    declare_motion();
    add_parameter(
      "Distortion",
      distortion,
      "Columns and the heights of nodes are displaced irregularly "
      "by up to this share of the cell size, except at the sides of "
      "the domain, the soil surface and the boundaries of layers; "
      "this tests the method in scenes without a body. Units: "
      "none.",
      prm,
      Patterns::Double(0., 0.4));
    add_parameter("Refinement",
                  refinement,
                  "All cell sizes are divided by this number, for studies of "
                  "convergence. Units: none.",
                  prm,
                  Patterns::Integer(1, 256));
  }

  namespace
  {
    const Patterns::Double positive(1e-9), not_negative(0.);
  }

  void
  GridLines::declare_domain()
  {
    add_choice<Geometry>(*this,
                         "Geometry",
                         geometry,
                         {{"axisymmetric", Geometry::axisymmetric},
                          {"plane strain", Geometry::plane_strain}},
                         "The scene is axisymmetric about r = 0, or in plane "
                         "strain. Units: none.");
    add_parameter("Inner radius",
                  inner_radius,
                  "The domain begins at this r. Units: m.",
                  prm,
                  not_negative);
    add_parameter("Outer radius",
                  outer_radius,
                  "The domain ends at this r. Units: m.",
                  prm,
                  positive);
    add_parameter("Bottom",
                  bottom,
                  "The domain begins at this z, below the soil surface at z = "
                  "0. Units: m.");
    add_parameter("Top",
                  top,
                  "The domain ends at this z at the start, on or above the "
                  "soil surface at z = 0. Units: m.");
  }

  void
  GridLines::declare_cells()
  {
    add_parameter("Cell width",
                  cell_width,
                  "Cells far from the body, and all cells of a scene without a "
                  "body, have this width. Units: m.",
                  prm,
                  positive);
    add_parameter("Cell height",
                  cell_height,
                  "Cells far above and below the tip of the body, and all "
                  "cells of a scene without a body, have this height. Units: "
                  "m.",
                  prm,
                  positive);
    add_parameter("Growth ratio",
                  growth,
                  "Away from the fine cells the sizes of neighboring cells "
                  "have this ratio. Units: none.",
                  prm,
                  Patterns::Double(1.001, 2.));
    add_parameter("Fine width",
                  fine_width,
                  "Cells up to this distance from the wall, on both sides, are "
                  "as wide as those of the wall (or of the cone, the "
                  "cylinder). Units: m.",
                  prm,
                  not_negative);
    add_parameter("Fine height",
                  fine_height,
                  "Cells up to this distance above and below the tip are as "
                  "high as those of the wall are wide. Units: m.",
                  prm,
                  not_negative);
    add_word_or_number(*this,
                       "Fine cell size",
                       fine_size,
                       "auto",
                       0.,
                       "The finest cells have this width and height; auto "
                       "takes what Rigid body/Cells across the wall gives for "
                       "a caisson, cone or cylinder, and Cell width and Cell "
                       "height for a box. Units: m.",
                       positive);
  }

  void
  GridLines::declare_motion()
  {
    add_parameter("Moving zone below tip",
                  zone_below_tip,
                  "The zone that moves with the body reaches this far below "
                  "its tip. Units: m.",
                  prm,
                  not_negative);
    add_choice<UpperZone>(*this,
                          "Upper zone",
                          upper_zone,
                          {{"free", UpperZone::free},
                           {"extending", UpperZone::extending}},
                          "The mesh above the body moves with it (free), or "
                          "stretches up to a fixed top (extending). Units: "
                          "none.");
    add_parameter("Smallest row height",
                  smallest_row,
                  "Rows of the compressing zone must stay at least this high, "
                  "and columns around a cylinder this wide. Units: m.",
                  prm,
                  positive);
  }

  void
  GridLines::check_parameters() const
  {
    if (inner_radius >= outer_radius)
      throw BadInput("Grid/Inner radius = " + meters(inner_radius) +
                     " must be smaller than Grid/Outer radius = " +
                     meters(outer_radius) + ".");
    if (bottom >= 0. || top < 0.)
      throw BadInput("Grid/Bottom = " + meters(bottom) +
                     " and Grid/Top = " + meters(top) +
                     " must lie below and above the soil surface, z = 0.");
  }

  std::string
  GridLines::meters(const double x)
  {
    return to_text(x) + " m";
  }

  double
  GridLines::finest_cell(const BodyShape &body, const double otherwise) const
  {
    return fine_size              ? *fine_size :
           body.cell_width() > 0. ? body.cell_width() :
                                    otherwise;
  }

  void
  GridLines::place(const BodyShape &body,
                   const Soil      &soil,
                   const double     travel,
                   const double     uplift)
  {
    if (distortion > 0. && body.exists())
      throw BadInput("Grid/Distortion is for scenes without a rigid body: the "
                     "mesh must fit the body. Set Distortion = 0.");
    travel_to_hold = travel;
    uplift_to_hold = uplift;
    place_columns(body);
    place_rows(body, soil);
    check_travel();
  }

  namespace
  {
    unsigned int
    line_at(const std::vector<double> &lines, const double x)
    {
      const auto it =
        std::min_element(lines.begin(),
                         lines.end(),
                         [x](const double a, const double b) {
                           return std::abs(a - x) < std::abs(b - x);
                         });
      return it - lines.begin();
    }
  } // namespace

  void
  GridLines::place_columns(const BodyShape &body)
  {
    if (!body.exists())
      {
        columns =
          graded_lines({inner_radius, outer_radius}, [this](const double) {
            return cell_width / refinement;
          });
        return;
      }
    const bool expands = body.expands();
    // one column of the cylinder is enough
    const double left  = expands ? inner_radius : body.left(),
                 right = body.right();
    if (expands)
      expanding_radius = right;
    if (expands && right <= inner_radius)
      throw BadInput("Rigid body/Outer diameter: the radius of the cylinder, " +
                     meters(right) + ", must exceed Grid/Inner radius = " +
                     meters(inner_radius) +
                     ". Reduce Grid/Inner radius, for instance to 0.");
    if (left < inner_radius || right > outer_radius)
      throw BadInput("The body, from r = " + meters(left) + " to " +
                     meters(right) + ", does not fit in the mesh, from r = " +
                     meters(inner_radius) + " to " + meters(outer_radius) +
                     ". Change Grid/Outer radius or the body.");
    const double fine = finest_cell(body, cell_width);
    columns           = graded_lines({inner_radius, left, right, outer_radius},
                           [=](const double r) {
                             if (expands && r < right)
                               return right - inner_radius;
                             const double distance =
                               std::max({left - r, r - right, 0.}) - fine_width;
                             return std::min(std::max(cell_width, fine),
                                             fine + (growth - 1.) *
                                                      std::max(0., distance)) /
                                    refinement;
                           });
    body_column_begin = line_at(columns, left);
    body_column_end   = line_at(columns, right);
    dip.assign(columns.size(), 0.);
    if (expands)
      return;
    shoulder = body.bottom() + body.tip_height();
    for (unsigned int i = body_column_begin; i <= body_column_end; ++i)
      dip[i] = shoulder - body.lower_surface(columns[i]);
  }

  void
  GridLines::place_rows(const BodyShape &body, const Soil &soil)
  {
    std::vector<double> fixed = {bottom, 0., top};
    for (const double z : soil.interfaces())
      fixed.push_back(z);
    zone_bottom = bottom;
    zone_top    = top;
    if (!body.exists() || body.expands())
      {
        rows = graded_lines(fixed, [this](double) {
          return cell_height / refinement;
        });
        if (distortion > 0.)
          distort(fixed);
        // of a cylinder all rows; empty without a body
        body_row_end = lid_row_begin = rows.size() - 1;
        return;
      }
    if (body.bottom() < bottom || body.top() > top)
      throw BadInput("The body, from z = " + meters(body.bottom()) + " to " +
                     meters(body.top()) +
                     ", does not fit in the mesh, from z = " + meters(bottom) +
                     " to " + meters(top) +
                     ". Change Grid/Bottom, Grid/Top or the body.");
    const double fine = finest_cell(body, cell_height);
    zone_bottom       = std::max(bottom, body.bottom() - zone_below_tip);
    zone_top          = body.top();
    decay_below       = body.height_of_bent_rows();
    decay_above       = std::min(decay_below, zone_top - shoulder);
    if (travel_to_hold > 0. || uplift_to_hold > 0.)
      fixed.push_back(zone_bottom);
    fixed.push_back(shoulder);
    fixed.push_back(zone_top);
    if (body.has_lid())
      fixed.push_back(body.lower_face_of_lid());
    rows           = graded_lines(fixed, [=](const double z) {
      const double distance = std::abs(z - shoulder) - fine_height;
      return std::min(std::max(cell_height, fine),
                      fine + (growth - 1.) * std::max(0., distance)) /
             refinement;
    });
    body_row_begin = line_at(rows, shoulder);
    body_row_end   = line_at(rows, zone_top);
    lid_row_begin =
      body.has_lid() ? line_at(rows, body.lower_face_of_lid()) : body_row_end;
  }

  namespace
  {
    /** A number from -1 to 1 that looks random, the same on all machines. */
    double
    scatter(const unsigned int i, const unsigned int j)
    {
      // the finalizer of MurmurHash3 on both numbers
      std::uint64_t h = 0x9e3779b97f4a7c15u * (i + 1) + j;
      h               = (h ^ (h >> 33)) * 0xff51afd7ed558ccdu;
      h               = (h ^ (h >> 33)) * 0xc4ceb9fe1a85ec53u;
      return ((h ^ (h >> 33)) >> 11) * 0x1p-52 - 1.;
    }

    /** The shorter distance of an inner line to its neighbors. */
    double
    distance_to_next(const std::vector<double> &lines, const unsigned int i)
    {
      return std::min(lines[i + 1] - lines[i], lines[i] - lines[i - 1]);
    }
  } // namespace

  void
  GridLines::distort(const std::vector<double> &straight_rows)
  {
    const std::vector<double> regular = columns;
    for (unsigned int i = 1; i + 1 < columns.size(); ++i)
      columns[i] += distortion * scatter(i, 0) * distance_to_next(regular, i);
    node_shift.assign(rows.size(), std::vector<double>(columns.size(), 0.));
    for (unsigned int j = 1; j + 1 < rows.size(); ++j)
      {
        const bool is_straight =
          std::any_of(straight_rows.begin(),
                      straight_rows.end(),
                      [&](const double z) {
                        return std::abs(z - rows[j]) < 1e-9;
                      });
        for (unsigned int i = 1; i + 1 < columns.size() && !is_straight; ++i)
          node_shift[j][i] =
            distortion * scatter(i, j) * distance_to_next(rows, j);
      }
  }

  double
  GridLines::height_at(const double z0, const double travel) const
  {
    if (expanding_radius > 0.)
      return z0;
    double rate = -1.;
    if (z0 < zone_bottom)
      rate = -(z0 - bottom) / (zone_bottom - bottom);
    else if (z0 > zone_top && upper_zone == UpperZone::extending)
      rate = -(top - z0) / (top - zone_top);
    return z0 + rate * travel;
  }

  double
  GridLines::reference_height(const unsigned int i, const unsigned int j) const
  {
    if (!node_shift.empty())
      return rows[j] + node_shift[j][i];
    if (dip.empty() || dip[i] == 0.)
      return rows[j];
    const double distance = rows[j] > shoulder ?
                              (rows[j] - shoulder) / decay_above :
                              (shoulder - rows[j]) / decay_below;
    return rows[j] - dip[i] * std::max(0., 1. - distance);
  }

  double
  GridLines::radial_rate(const double r0) const
  {
    if (expanding_radius == 0.)
      return 0.;
    return r0 < expanding_radius ?
             r0 / expanding_radius :
             (outer_radius - r0) / (outer_radius - expanding_radius);
  }

  bool
  GridLines::inside_body(const unsigned int column,
                         const unsigned int row) const
  {
    if (row >= body_row_end || column >= body_column_end)
      return false;
    return row >= (column < body_column_begin ? lid_row_begin : body_row_begin);
  }

  Point<2>
  GridLines::node_start(const unsigned int i, const unsigned int j) const
  {
    return Point<2>(columns[i], reference_height(i, j));
  }

  Tensor<1, 2>
  GridLines::node_rate(const unsigned int i, const unsigned int j) const
  {
    return Tensor<1, 2>(
      {radial_rate(columns[i]), height_at(rows[j], 1.) - rows[j]});
  }

  unsigned int
  GridLines::sides_of(const unsigned int i, const unsigned int j) const
  {
    const bool   lies_on[4] = {i == 0, i == n_columns(), j == 0, j == n_rows()};
    unsigned int result     = 0;
    for (unsigned int side = 0; side < 4; ++side)
      result |= lies_on[side] << side;
    return result;
  }

  Kernels::CellGeometry
  GridLines::initial_geometry(const GlobalCell cell) const
  {
    const unsigned int i = column_of(cell), j = row_of(cell);
    const double       left = reference_height(i, j),
                 right      = reference_height(i + 1, j);
    return {columns[i],
            columns[i + 1] - columns[i],
            left,
            right,
            reference_height(i, j + 1) - left,
            reference_height(i + 1, j + 1) - right};
  }

  GridLines::Zone
  GridLines::zone_of(const GlobalCell cell) const
  {
    const double z = rows[row_of(cell)];
    if (z < zone_bottom - 1e-9)
      return Zone::compressing;
    if (z >= zone_top - 1e-9 && upper_zone == UpperZone::extending)
      return Zone::upper;
    return Zone::moving;
  }

  std::string
  GridLines::description() const
  {
    return to_text(n_columns()) + " x " + to_text(n_rows()) + " cells, " +
           (axisymmetric() ? "axisymmetric" : "plane strain");
  }
} // namespace CaissonMPM
