// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the tests of the bodies and operators share: a scene without a
// simulation, set up from a text of parameters.
#ifndef caisson_mpm_tests_scene_h
#define caisson_mpm_tests_scene_h

#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/bodies/rigid_body.h>
#include <caisson_mpm/domain/background_grid.h>
#include <caisson_mpm/domain/material_points.h>
#include <caisson_mpm/domain/point_generator.h>
#include <caisson_mpm/materials/soil.h>
#include <caisson_mpm/operators/boundary_conditions.h>
#include <caisson_mpm/operators/contact.h>

#include <cmath>
#include <string>

#include "verdict.h"

using namespace CaissonMPM;

/** Forgets the parameters of an earlier scene when it is made. */
struct EmptyParameters
{
  EmptyParameters()
  {
    dealii::ParameterAcceptor::clear();
  }
};

struct Scene : EmptyParameters
{
  /** @p travel, down, and @p uplift are what the mesh is made to hold. */
  explicit Scene(const std::string &parameters,
                 const double       travel = 0.,
                 const double       uplift = 0.)
    : grid(lines, MPI_COMM_SELF)
    , points(grid)
  {
    auto &prm = dealii::ParameterAcceptor::prm;
    soil.declare_layers(3);
    prm.parse_input_from_string(parameters);
    dealii::ParameterAcceptor::parse_all_parameters(prm);
    body.shape().refine(lines.number_to_divide_by());
    body.check_parameters();
    soil.check_parameters();
    lines.check_parameters();
    lines.place(body.shape(), soil, travel, uplift);
    soil.divide(lines.row_lines());
    grid.create_mesh();
  }

  GridLines          lines;
  BackgroundGrid     grid;
  Soil               soil;
  RigidBody          body;
  PointGenerator     generator;
  BoundaryConditions boundary_conditions;
  MaterialPoints     points;
};

/** A small caisson in a mesh that lets it move. */
inline const std::string caisson = R"(
  subsection Rigid body
    set Kind                  = caisson
    set Outer diameter        = 6
    set Skirt length          = 3
    set Wall thickness        = 0.2
    set Cells across the wall = 2
    set Tip angle             = 60
    set Initial penetration   = 0.5
    set Shoulder bevel        = 0
  end
  subsection Grid
    set Outer radius          = 8
    set Bottom                = -7
    set Top                   = 4
    set Cell width            = 1
    set Cell height           = 0.5
    set Moving zone below tip = 2
  end
  )";

#endif
