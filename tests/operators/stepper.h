// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A scene that can take steps of the nodal motion, for the tests.
#ifndef caisson_mpm_tests_stepper_h
#define caisson_mpm_tests_stepper_h

#include <caisson_mpm/kernels/dispatch.h>
#include <caisson_mpm/operators/nodal_motion.h>

#include <memory>
#include <string>
#include <vector>

#include "../extending/excess_pressure.h"
#include "../shared/scene.h"

constexpr double dt = 1e-3;

/** Sides that hold nothing. */
const std::string free_sides = R"(
  subsection Boundary conditions
    set Axis   = free
    set Side   = free
    set Bottom = free
    set Top    = free
  end
  )";



/** A scene that can take steps. */
struct Stepper
{
  Scene                          scene;
  NodalMotion                    motion;
  NodalForces                    forces = make_nodal_forces();
  Contact                        contact;
  NodalConstraints               constraints;
  std::vector<Kernels::Material> materials;
  // of the inertia in the cells, of translation and of deformation
  std::vector<double> translation, deformation;

  Stepper(const std::string &soil, const std::string &method)
    : scene(soil)
    , constraints{contact,
                  scene.boundary_conditions,
                  scene.grid.hanging_nodes()}
  {
    forces.push_back(std::make_unique<ExcessPressure>());
    auto &prm = dealii::ParameterAcceptor::prm;
    prm.parse_input_from_string(method);
    dealii::ParameterAcceptor::parse_all_parameters(prm);
    scene.generator.generate(scene.grid,
                             scene.body.shape(),
                             scene.soil,
                             scene.points);
    materials = scene.soil.kernel_materials();
    contact.initialize(scene.grid, scene.body.surface());
    scene.boundary_conditions.initialize(scene.grid);
    motion.initialize(scene.grid);
    for (const auto &force : forces)
      force->initialize(1.);
    scene.grid.prepare_motion(0.);
  }

  SoilOnGrid
  soil_on_grid()
  {
    return {*Kernels::select_kernels("auto"),
            scene.points,
            scene.grid,
            materials,
            nullptr,
            translation.empty() ? nullptr : translation.data(),
            deformation.empty() ? nullptr : deformation.data()};
  }

  void
  collect()
  {
    motion.collect(soil_on_grid(), forces, 0.);
  }

  /** Take a step without relocation; returns its works. */
  NodalWork
  step()
  {
    collect();
    motion.accelerate({dt, StepSize::reference_courant},
                      forces,
                      Vector2(),
                      contact);
    motion.correct(soil_on_grid(), forces, 0., Vector2(), constraints, contact);
    motion.constrain(Vector2(), constraints);
    motion.prepare_transfer(constraints);
    const NodalWork work = motion.work_of_step(forces, constraints);
    motion.update_points(scene.grid.next(),
                         nullptr,
                         scene.points.update_result());
    return work;
  }

  struct Sums
  {
    double  mass = 0., max_speed = 0.;
    Vector2 momentum;
  };

  Sums
  sums() const
  {
    Sums result;
    scene.points.for_each_motion([&](const dealii::Point<2> &,
                                     const Vector2 &velocity,
                                     const double   mass,
                                     const unsigned int,
                                     const unsigned int) {
      result.mass += mass;
      result.momentum += mass * velocity;
      result.max_speed = std::max(result.max_speed, velocity.norm());
    });
    return result;
  }
};

#endif
