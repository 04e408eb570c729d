// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Loads on the soil besides gravity and contact: a body force and a pressure
// around it, both given as expressions.
//
// Body force: f_I += sum m_p N_I(x_p) b(X_p, t), with the initial place X_p of
// the point and its mass without mass scaling.
//
// Surrounding pressure p(t) on all free surfaces of the soil. No surface is
// looked for: with
//   int_Gamma p N_I n dA = int_Omega p grad N_I dV
// the traction -p n becomes part of the internal force, in which sigma + p I
// takes the place of sigma. Soil with sigma = -p I is then at rest exactly, in
// any mesh and at any place of the points. This is the virtual stress of Liang,
// Given & Soga (2023), CMAME 404, 115785. Where the soil touches a wall or a
// body, their reactions are those beyond p.
#ifndef caisson_mpm_operators_loads_h
#define caisson_mpm_operators_loads_h

#include <caisson_mpm/base/expression.h>
#include <caisson_mpm/domain/background_grid.h>
#include <caisson_mpm/domain/material_points.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <vector>

namespace CaissonMPM
{
  /** What acts on the soil. A load that is not set costs nothing. */
  class Loads : public dealii::ParameterAcceptor
  {
  public:
    Loads();

    /** Throws BadInput for an expression that cannot be parsed. */
    void
    check_parameters() const;

    /** @p mass_scaling: the factor that the points' masses contain. */
    void
    initialize(const double mass_scaling);

    /** The pressure on free surfaces, positive in compression. Units: Pa. */
    double
    surrounding_pressure(const double time) const;

    /**
     * The nodal force [2 n_nodes] of the body force at @p time, N per radian
     * (per metre in plane strain); empty without a body force.
     */
    void
    find_body_force(const MaterialPoints &points,
                    const BackgroundGrid &grid,
                    const double          time,
                    const unsigned int    n_nodes,
                    std::vector<double>  &force) const;

  private:
    VectorExpression
    parse_body_force() const;
    Expression
    parse_pressure() const;

    std::string      body_force_text = "0 ; 0";
    std::string      pressure_text   = "0";
    VectorExpression body_force;
    Expression       pressure;
    double           mass_scaling = 1.;
  };
} // namespace CaissonMPM

#endif
