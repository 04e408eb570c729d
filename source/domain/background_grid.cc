// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/compat.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/domain/background_grid.h>
#include <caisson_mpm/domain/graded_lines.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>

namespace CaissonMPM
{
  using namespace dealii;

  Point<2>
  to_reference(const Kernels::CellGeometry &g, const Point<2> &p)
  {
    const double xi     = (p[0] - g.left) / g.width;
    const double bottom = g.bottom_left + (g.bottom_right - g.bottom_left) * xi;
    const double height = g.height_left + (g.height_right - g.height_left) * xi;
    return Point<2>(xi, (p[1] - bottom) / height);
  }

  Point<2>
  to_position(const Kernels::CellGeometry &g, const Point<2> &x)
  {
    const double bottom =
      g.bottom_left + (g.bottom_right - g.bottom_left) * x[0];
    const double height =
      g.height_left + (g.height_right - g.height_left) * x[0];
    return Point<2>(g.left + g.width * x[0], bottom + height * x[1]);
  }

  BackgroundGrid::BackgroundGrid(const MPI_Comm communicator)
    : ParameterAcceptor("/Grid")
    , triangulation(communicator)
    , fe(1)
    , dof_handler(triangulation)
    , n_ranks_(Utilities::MPI::n_mpi_processes(communicator))
    , rank(Utilities::MPI::this_mpi_process(communicator))
  {
    const Patterns::Double positive(1e-9), not_negative(0.);
    add_parameter("Geometry",
                  geometry_text,
                  "axisymmetric about r = 0, or plane strain. Units: none.",
                  prm,
                  Patterns::Selection("axisymmetric|plane strain"));
    add_parameter("Inner radius",
                  inner_radius,
                  "Smallest r of the domain. Units: m.",
                  prm,
                  not_negative);
    add_parameter("Outer radius",
                  outer_radius,
                  "Largest r of the domain. Units: m.",
                  prm,
                  positive);
    add_parameter("Bottom", bottom, "Lowest z of the domain. Units: m.");
    add_parameter("Top",
                  top,
                  "Highest z of the domain at the start. Units: m.");
    add_parameter("Cell width",
                  cell_width,
                  "Width of the cells far from a caisson; of all cells where "
                  "there is none. Units: m.",
                  prm,
                  positive);
    add_parameter("Cell height",
                  cell_height,
                  "Height of the cells far from a caisson's tip; of all cells "
                  "where there is none. Units: m.",
                  prm,
                  positive);
    add_parameter("Growth ratio",
                  growth,
                  "Ratio of the sizes of neighboring cells away from the fine "
                  "cells. Units: none.",
                  prm,
                  Patterns::Double(1.001, 2.));
    add_parameter("Fine width",
                  fine_width,
                  "Distance from the wall, on both sides, with cells as wide "
                  "as those of the wall (or of the cone, the cylinder). Units: "
                  "m.",
                  prm,
                  not_negative);
    add_parameter("Fine height",
                  fine_height,
                  "Distance from the tip, above and below, with cells as high "
                  "as those of the wall are wide. Units: m.",
                  prm,
                  not_negative);
    add_parameter("Fine cell size",
                  fine_size,
                  "Width and height of the finest cells; 0: of a caisson, cone "
                  "or cylinder by Cells across the wall, of a box Cell width "
                  "and Cell height. Units: m.",
                  prm,
                  not_negative);
    add_parameter("Moving zone below tip",
                  zone_below_tip,
                  "How far the zone that moves with the body reaches below its "
                  "tip. Units: m.",
                  prm,
                  not_negative);
    add_parameter("Upper zone",
                  upper_text,
                  "Above the body, the mesh moves with it (free), or extends "
                  "to a fixed top (extending). Units: none.",
                  prm,
                  Patterns::Selection("free|extending"));
    add_parameter("Smallest row height",
                  smallest_row,
                  "Rows of the compressing zone must stay at least this high, "
                  "and columns around a cylinder this wide. Units: m.",
                  prm,
                  positive);
    add_parameter("Distortion",
                  distortion,
                  "Displace columns and the heights of nodes irregularly by up "
                  "to this share of the cell size, except at the domain's "
                  "sides, the soil surface and the boundaries of layers; for "
                  "tests of the method, without a body. Units: none.",
                  prm,
                  Patterns::Double(0., 0.4));
    add_parameter("Refinement",
                  refinement,
                  "All cell sizes are divided by this number; for studies of "
                  "convergence. Units: none.",
                  prm,
                  Patterns::Integer(1, 256));
  }

  void
  BackgroundGrid::check_parameters() const
  {
    const auto text = [](const double x) {
      std::ostringstream s;
      s << x;
      return s.str();
    };
    if (inner_radius >= outer_radius)
      throw BadInput("Grid/Inner radius = " + text(inner_radius) +
                     " m must be smaller than Grid/Outer radius = " +
                     text(outer_radius) + " m.");
    if (bottom >= 0. || top < 0.)
      throw BadInput("Grid/Bottom = " + text(bottom) +
                     " m and Grid/Top = " + text(top) +
                     " m must lie below and above the soil surface, z = 0.");
  }

  // ------------------------------------------------------------ grid lines

  double
  BackgroundGrid::finest_cell(const RigidBody &body,
                              const double     otherwise) const
  {
    return fine_size > 0.         ? fine_size :
           body.cell_width() > 0. ? body.cell_width() :
                                    otherwise;
  }

  void
  BackgroundGrid::place_lines(const RigidBody &body,
                              const Soil      &soil,
                              const double     travel,
                              const double     uplift)
  {
    if (distortion > 0. && body.kind() != RigidBody::Kind::none)
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

    std::string
    meters(const double x)
    {
      std::ostringstream s;
      s << x << " m";
      return s.str();
    }
  } // namespace

  void
  BackgroundGrid::place_columns(const RigidBody &body)
  {
    if (body.kind() == RigidBody::Kind::none)
      {
        columns =
          graded_lines({inner_radius, outer_radius}, [this](const double) {
            return cell_width / refinement;
          });
        return;
      }
    const bool expands = body.kind() == RigidBody::Kind::cylinder;
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
  BackgroundGrid::place_rows(const RigidBody &body, const Soil &soil)
  {
    std::vector<double> fixed = {bottom, 0., top};
    for (const double z : soil.interfaces())
      fixed.push_back(z);
    zone_bottom = bottom;
    zone_top    = top;
    if (body.kind() == RigidBody::Kind::none ||
        body.kind() == RigidBody::Kind::cylinder)
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
    if (body.bottom() < bottom || body.top_of_body() > top)
      throw BadInput("The body, from z = " + meters(body.bottom()) + " to " +
                     meters(body.top_of_body()) +
                     ", does not fit in the mesh, from z = " + meters(bottom) +
                     " to " + meters(top) +
                     ". Change Grid/Bottom, Grid/Top or the body.");
    const double fine = finest_cell(body, cell_height);
    zone_bottom       = std::max(bottom, body.bottom() - zone_below_tip);
    zone_top          = body.top_of_body();
    // rows below keep 7/8 of their height, and 3/4 at the axis below a cone
    decay_below =
      body.tip_height() * (body.kind() == RigidBody::Kind::cone ? 4. : 8.);
    decay_above = std::min(decay_below, zone_top - shoulder);
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
  BackgroundGrid::distort(const std::vector<double> &straight_rows)
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

  void
  BackgroundGrid::check_travel() const
  {
    if (expanding_radius > 0.)
      return check_expansion();
    const bool   moves = travel_to_hold > 0. || uplift_to_hold > 0.;
    const double floor = moves ? zone_bottom : bottom;
    const double tip_depth =
      dip.empty() ? 0. : *std::max_element(dip.begin(), dip.end());
    if (tip_depth > 0. && shoulder - decay_below < floor - 1e-9)
      {
        const double needed = decay_below - tip_depth;
        throw BadInput(
          (moves ? "Grid/Moving zone below tip = " + meters(zone_below_tip) :
                   "The mesh below the tip, " +
                     meters(shoulder - tip_depth - bottom) + " deep,") +
          " must be at least " + meters(needed) +
          " for this tip: the rows need that depth to straighten.");
      }
    if (travel_to_hold > 0.)
      check_travel_down();
    if (uplift_to_hold > 0.)
      check_travel_up();
  }

  double
  BackgroundGrid::smallest_row_at(const double travel,
                                  const bool   above_body) const
  {
    double smallest = 1e300;
    for (unsigned int j = 0; j + 1 < rows.size(); ++j)
      if (above_body ? rows[j] > zone_top - 1e-9 : rows[j] < zone_bottom - 1e-9)
        smallest =
          std::min(smallest,
                   height_at(rows[j + 1], travel) - height_at(rows[j], travel));
    return smallest;
  }

  void
  BackgroundGrid::check_travel_up() const
  {
    if (zone_bottom <= bottom)
      throw BadInput("The body moves up by " + meters(uplift_to_hold) +
                     ", and no rows can stretch below Grid/Moving zone below "
                     "tip = " +
                     meters(zone_below_tip) +
                     ". Reduce that, or lower Grid/Bottom.");
    if (upper_text == "free")
      return;
    if (top <= zone_top)
      throw BadInput("Grid/Upper zone = extending needs cells above the body: "
                     "raise Grid/Top above " +
                     meters(zone_top) + ".");
    const double smallest = smallest_row_at(-uplift_to_hold, true);
    if (smallest < smallest_row)
      throw BadInput(
        "Moving up by " + meters(uplift_to_hold) +
        " compresses a row above the body to " + meters(smallest) +
        ", below Grid/Smallest row height = " + meters(smallest_row) +
        ". Raise Grid/Top, or set Grid/Upper zone = free.");
  }

  void
  BackgroundGrid::check_expansion() const
  {
    if (uplift_to_hold > 0.)
      throw BadInput("Rigid body/Velocity: the cylinder would become smaller "
                     "than at the start, by " +
                     meters(uplift_to_hold) + ". It can only grow.");
    const double factor =
      1. - travel_to_hold / (outer_radius - expanding_radius);
    double smallest = 1e300;
    for (unsigned int i = body_column_end; i + 1 < columns.size(); ++i)
      smallest = std::min(smallest, factor * (columns[i + 1] - columns[i]));
    if (smallest < smallest_row)
      throw BadInput(
        "The radius grows by " + meters(travel_to_hold) +
        ", which compresses a column to " + meters(smallest) +
        ", below Grid/Smallest row height = " + meters(smallest_row) +
        ". Increase Grid/Outer radius, or reduce Grid/Smallest "
        "row height or the velocity.");
  }

  void
  BackgroundGrid::check_travel_down() const
  {
    const double available = zone_bottom - bottom;
    if (travel_to_hold >= available)
      throw BadInput("The compressing zone, " + meters(available) +
                     " high, cannot hold a travel of " +
                     meters(travel_to_hold) + ". Lower Grid/Bottom below " +
                     meters(zone_bottom - travel_to_hold) +
                     ", reduce Grid/Moving zone below tip, or push less far.");
    const double smallest = smallest_row_at(travel_to_hold, false);
    if (smallest < smallest_row)
      {
        const double factor = 1. - travel_to_hold / available;
        const double needed =
          travel_to_hold / (1. - smallest_row * factor / smallest);
        throw BadInput(
          "The travel of " + meters(travel_to_hold) +
          " compresses the lowest row to " + meters(smallest) +
          ", below Grid/Smallest row height = " + meters(smallest_row) + ". " +
          (smallest_row * factor < smallest ?
             "Lower Grid/Bottom to about " + meters(zone_bottom - needed) +
               ", or reduce" :
             "Reduce") +
          " Grid/Smallest row height.");
      }
    if (upper_text == "free" && height_at(top, travel_to_hold) <= 0.)
      throw BadInput("After a travel of " + meters(travel_to_hold) +
                     " the top of the mesh lies at z = " +
                     meters(height_at(top, travel_to_hold)) +
                     ", below the soil surface. Raise Grid/Top to more than " +
                     meters(travel_to_hold) +
                     " plus the expected heave, or set Grid/Upper zone = "
                     "extending.");
    if (upper_text == "extending" && top <= zone_top)
      throw BadInput("Grid/Upper zone = extending needs cells above the body: "
                     "raise Grid/Top above " +
                     meters(zone_top) + ".");
  }

  double
  BackgroundGrid::height_at(const double z0, const double travel) const
  {
    if (expanding_radius > 0.)
      return z0;
    double rate = -1.;
    if (z0 < zone_bottom)
      rate = -(z0 - bottom) / (zone_bottom - bottom);
    else if (z0 > zone_top && upper_text == "extending")
      rate = -(top - z0) / (top - zone_top);
    return z0 + rate * travel;
  }

  double
  BackgroundGrid::reference_height(const unsigned int i,
                                   const unsigned int j) const
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
  BackgroundGrid::radial_rate(const double r0) const
  {
    if (expanding_radius == 0.)
      return 0.;
    return r0 < expanding_radius ?
             r0 / expanding_radius :
             (outer_radius - r0) / (outer_radius - expanding_radius);
  }

  bool
  BackgroundGrid::inside_body(const unsigned int column,
                              const unsigned int row) const
  {
    if (row >= body_row_end || column >= body_column_end)
      return false;
    return row >= (column < body_column_begin ? lid_row_begin : body_row_begin);
  }

  // ------------------------------------------------------------ mesh

  void
  BackgroundGrid::create_mesh()
  {
    create_triangulation();
    set_up_part();
  }

  void
  BackgroundGrid::set_up_part()
  {
    dof_handler.distribute_dofs(fe);
    partitioner = std::make_shared<const Utilities::MPI::Partitioner>(
      dof_handler.locally_owned_dofs(),
      Compat::locally_relevant_dofs(dof_handler),
      communicator());
    partitioners.clear();
    collect_cells();
    number_nodes();
    prepare_motion(0.);
    advance();
  }

  void
  BackgroundGrid::repartition(const std::vector<unsigned int> &costs)
  {
    const auto connection = triangulation.signals.weight.connect(
      [&costs](const auto &cell, const auto) { return costs[cell->index()]; });
    triangulation.repartition();
    connection.disconnect();
    set_up_part();
  }

  void
  BackgroundGrid::create_triangulation()
  {
    const unsigned int      n = columns.size();
    std::vector<Point<dim>> vertices;
    for (unsigned int j = 0; j < rows.size(); ++j)
      for (unsigned int i = 0; i < n; ++i)
        vertices.emplace_back(columns[i], reference_height(i, j));
    std::vector<CellData<dim>> cells;
    for (unsigned int j = 0; j < n_rows(); ++j)
      for (unsigned int i = 0; i < n_columns(); ++i)
        {
          CellData<dim> cell;
          cell.vertices    = {j * n + i,
                              j * n + i + 1,
                              (j + 1) * n + i,
                              (j + 1) * n + i + 1};
          cell.material_id = inside_body(i, j) ? 1 : 0;
          cells.push_back(cell);
        }
    triangulation.create_triangulation(vertices, cells, SubCellData());
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const unsigned int face : cell->face_indices())
        if (cell->face(face)->at_boundary())
          cell->face(face)->set_boundary_id(face);
  }

  void
  BackgroundGrid::collect_cells()
  {
    local_numbers.assign(n_global_cells(), numbers::invalid_unsigned_int);
    iterators.clear();
    for (const auto &cell : triangulation.active_cell_iterators())
      if (!cell->is_artificial())
        {
          local_numbers[cell->index()] = iterators.size();
          iterators.push_back(cell);
        }
    const unsigned int n = iterators.size();
    nodes.resize(n);
    neighbors.assign(4 * n, -1);
    rigid.assign(n, 0);
    flags.assign(n, 0);
    zones.assign(n, Zone::moving);
    global_numbers.resize(n);
    owners.resize(n);
    for (auto &g : geometries)
      g.resize(n);
    std::vector<types::global_dof_index> dofs(4);
    for (unsigned int c = 0; c < n; ++c)
      {
        const auto &cell  = iterators[c];
        global_numbers[c] = cell->index(); // a CellId numbers p4est's trees
        owners[c]         = cell->subdomain_id();
        DoFHandler<dim>::active_cell_iterator(&triangulation,
                                              cell->level(),
                                              cell->index(),
                                              &dof_handler)
          ->get_dof_indices(dofs);
        for (unsigned int k = 0; k < 4; ++k)
          nodes[c].node[k] = partitioner->global_to_local(dofs[k]);
        rigid[c] = is_body_cell(global_numbers[c]);
        if (rows[row_of(c)] < zone_bottom - 1e-9)
          zones[c] = Zone::compressing;
        else if (rows[row_of(c)] >= zone_top - 1e-9 &&
                 upper_text == "extending")
          zones[c] = Zone::upper;
        for (unsigned int face = 0; face < 4; ++face)
          if (!cell->at_boundary(face) &&
              !cell->neighbor(face)->is_artificial())
            neighbors[4 * c + face] =
              local_number(cell->neighbor(face)->index());
      }
    soil_neighbors = neighbors;
    for (int &neighbor : soil_neighbors)
      if (neighbor >= 0 && rigid[neighbor])
        neighbor = -1;
    // the cells that share a node with the body
    std::vector<bool> at_body(partitioner->locally_owned_size() +
                                partitioner->n_ghost_indices(),
                              false);
    for (unsigned int c = 0; c < n; ++c)
      if (rigid[c])
        for (const unsigned int node : nodes[c].node)
          at_body[node] = true;
    for (unsigned int c = 0; c < n; ++c)
      for (const unsigned int node : nodes[c].node)
        if (!rigid[c] && at_body[node])
          flags[c] |= Kernels::next_to_body;
  }

  void
  BackgroundGrid::number_nodes()
  {
    const unsigned int n =
      partitioner->locally_owned_size() + partitioner->n_ghost_indices();
    node_r.assign(n, 0.);
    node_start.assign(n, Point<dim>());
    node_rate.assign(n, Tensor<1, dim>());
    node_sides.assign(n, 0);
    vertices.clear();
    std::vector<bool> seen(n, false);
    for (unsigned int c = 0; c < n_cells(); ++c)
      for (unsigned int k = 0; k < 4; ++k)
        {
          const unsigned int i = column_of(c) + k % 2, j = row_of(c) + k / 2;
          const unsigned int node = nodes[c].node[k];
          if (seen[node])
            continue;
          seen[node]       = true;
          node_start[node] = Point<dim>(columns[i], reference_height(i, j));
          node_rate[node][radial]   = radial_rate(columns[i]);
          node_rate[node][vertical] = height_at(rows[j], 1.) - rows[j];
          node_sides[node]          = (i == 0 ? 1 << axis : 0) |
                             (i == n_columns() ? 1 << outer : 0) |
                             (j == 0 ? 1 << bottom_side : 0) |
                             (j == n_rows() ? 1 << top_side : 0);
          vertices.emplace_back(node, &iterators[c]->vertex(k));
        }
    node_z.assign(n, 0.);
  }

  void
  BackgroundGrid::reinit(NodalData &vector, const unsigned int components) const
  {
    auto &scaled = partitioners[components];
    if (!scaled)
      {
        const auto scale = [&](const IndexSet &set) {
          IndexSet result(set.size() * components);
          for (const auto index : set)
            result.add_range(index * components, (index + 1) * components);
          result.compress();
          return result;
        };
        scaled = std::make_shared<const Utilities::MPI::Partitioner>(
          scale(partitioner->locally_owned_range()),
          scale(partitioner->ghost_indices()),
          communicator());
      }
    vector.reinit(scaled);
  }

  // ------------------------------------------------------------ motion

  void
  BackgroundGrid::prepare_motion(const double travel)
  {
    for (unsigned int n = 0; n < n_nodes(); ++n)
      {
        node_r[n] = node_start[n][radial] + node_rate[n][radial] * travel;
        node_z[n] = node_start[n][vertical] + node_rate[n][vertical] * travel;
      }
    auto &next = geometries[1 - current];
    for (unsigned int c = 0; c < n_cells(); ++c)
      {
        const auto  &n    = nodes[c].node;
        const double left = node_z[n[0]], right = node_z[n[1]];
        next[c] = {node_r[n[0]],
                   node_r[n[1]] - node_r[n[0]],
                   left,
                   right,
                   node_z[n[2]] - left,
                   node_z[n[3]] - right};
      }
  }

  void
  BackgroundGrid::advance()
  {
    current = 1 - current;
  }

  void
  BackgroundGrid::write_vertices()
  {
    for (const auto &vertex : vertices)
      *vertex.second = Point<dim>(node_r[vertex.first], node_z[vertex.first]);
  }

  Kernels::GridView
  BackgroundGrid::view() const
  {
    return {geometries[current].data(),
            nodes.data(),
            flags.data(),
            soil_neighbors.data(),
            axisymmetric() ? 1. : 0.};
  }

  Kernels::GridView
  BackgroundGrid::next() const
  {
    Kernels::GridView result = view();
    result.geometry          = geometries[1 - current].data();
    return result;
  }

  Kernels::CellGeometry
  BackgroundGrid::initial_geometry(const unsigned int global_number) const
  {
    const unsigned int i = global_number % n_columns(),
                       j = global_number / n_columns();
    const double left    = reference_height(i, j),
                 right   = reference_height(i + 1, j);
    return {columns[i],
            columns[i + 1] - columns[i],
            left,
            right,
            reference_height(i, j + 1) - left,
            reference_height(i + 1, j + 1) - right};
  }

  double
  BackgroundGrid::smallest_height_met(const unsigned int global_number) const
  {
    const unsigned int i = global_number % n_columns(),
                       j = global_number / n_columns();
    if (!node_shift.empty()) // nothing moves
      {
        const auto g = initial_geometry(global_number);
        return std::max(g.height_left, g.height_right);
      }
    const auto line = [&](const unsigned int row, const double travel) {
      // the side of the column with the deeper dip has the lower cells
      const unsigned int side = !dip.empty() && dip[i] > dip[i + 1] ? i : i + 1;
      return reference_height(side, row) + height_at(rows[row], travel) -
             rows[row];
    };
    const double       low = line(j, 0.), high = line(j + 1, 0.);
    double             smallest  = high - low;
    const unsigned int n_samples = 100;
    const auto meet = [&](const unsigned int first, const double travel) {
      for (unsigned int k = first; k < n_rows(); ++k)
        {
          const double z0 = line(k, travel), z1 = line(k + 1, travel);
          if (z0 > high)
            break;
          if (z1 > low && !inside_body(i, k))
            smallest = std::min(smallest, z1 - z0);
        }
    };
    for (unsigned int s = 1; s <= n_samples && expanding_radius == 0.; ++s)
      {
        // rows sink: soil of this cell meets only cells that began above it
        if (travel_to_hold > 0.)
          meet(j, travel_to_hold * s / n_samples);
        if (uplift_to_hold > 0.)
          meet(0, -uplift_to_hold * s / n_samples);
      }
    return smallest;
  }

  double
  BackgroundGrid::smallest_width_met(const unsigned int global_number) const
  {
    const unsigned int i         = global_number % n_columns();
    const double       r0        = columns[i];
    double             smallest  = columns[i + 1] - r0;
    const unsigned int n_samples = expanding_radius > 0. ? 100 : 0;
    for (unsigned int s = 1; s <= n_samples; ++s)
      {
        const double travel = travel_to_hold * s / n_samples;
        const double a = expanding_radius, b = a + travel;
        const double r =
          axisymmetric() ? std::sqrt(r0 * r0 + b * b - a * a) : r0 + travel;
        // soil that was dr wide is now r0 / r times that
        const double shortened = axisymmetric() ? r0 / r : 1.;
        const double rate      = 1. / (outer_radius - a);
        const double start =
          (r - travel * rate * outer_radius) / (1. - travel * rate);
        const auto next =
          std::upper_bound(columns.begin() + body_column_end + 1,
                           columns.end() - 1,
                           start + 1e-9);
        const double width = (*next - *(next - 1)) * (1. - travel * rate);
        smallest           = std::min(smallest, width / shortened);
      }
    return smallest;
  }

  std::string
  BackgroundGrid::description() const
  {
    std::ostringstream s;
    s << n_columns() << " x " << n_rows() << " cells, "
      << (axisymmetric() ? "axisymmetric" : "plane strain");
    return s.str();
  }
} // namespace CaissonMPM
